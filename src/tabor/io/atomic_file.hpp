#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tabor::io {

/// The file that writing to `file` makes or replaces: behind symbolic links, if `file` is one.
/// Throws OutputError for what is there and no regular file: a folder, a device, a pipe.
std::filesystem::path written_file(const std::filesystem::path& file);

/// A name beside `file` to write to; commit() makes it `file` in one step, so that nobody ever sees
/// half a file. Without commit() the destructor removes what was written. A link stays a link, and
/// a file that is replaced passes on its permissions. The folder of `file` must exist and be
/// writable: OutputError otherwise, already from the constructor.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path file);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }  ///< to be written to, closed
  const std::filesystem::path& final_path() const { return file_; }

  /// Forces the bytes to the disk, then renames. Throws OutputError.
  void commit();

 private:
  bool create();  ///< false if somebody else removed it at once

  std::filesystem::path file_;    ///< as named
  std::filesystem::path target_;  ///< what is replaced
  std::filesystem::path temporary_;
  int locked_ = -1;  ///< the open temporary file, locked as long as somebody may write to it
};

/// True for the names TemporaryFile makes.
bool is_temporary_name(const std::filesystem::path& file);

/// Removes the temporary files of `file` that a killed program left behind: those that nobody has
/// locked. What cannot be removed stays.
void remove_leftovers(const std::filesystem::path& file);
/// The same for every file in a folder.
void remove_all_leftovers(const std::filesystem::path& folder);

/// Replaces `file` by these bytes, or leaves it as it was and throws OutputError.
void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& file, std::string_view text);
/// The same of what `write` appends piece after piece, so that it need not be in memory at once.
using Append = std::function<void(std::string_view piece)>;
void write_file(const std::filesystem::path& file,
                const std::function<void(const Append& append)>& write);

/// Makes a folder and its parents; OutputError if that cannot be.
void make_folder(const std::filesystem::path& folder);

/// All bytes of a text file of at most `max_bytes`; InputError otherwise.
std::string read_text(const std::filesystem::path& file, std::size_t max_bytes = 64u << 20);

}  // namespace tabor::io
