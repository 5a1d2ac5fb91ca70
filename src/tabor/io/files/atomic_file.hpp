#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

// Writes files under a temporary name and renames them when they are complete.
namespace tabor::io {

/// Returns the file that writing to `file` makes or replaces: the target of symbolic links, if
/// `file` is one. Throws OutputError if it exists and is no regular file, but a folder, a device or
/// a pipe.
std::filesystem::path written_file(const std::filesystem::path& file);

/// Writes to a temporary name beside `file`; commit() renames it to `file` in one step, so that
/// nobody ever sees half a file. Without commit() the destructor removes what was written. A link
/// stays a link, and a file that is replaced passes on its permissions. The folder of `file` must
/// exist and be writable: OutputError otherwise, already from the constructor.
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
  bool create();  ///< false if another process removed it at once

  std::filesystem::path file_;    ///< as named
  std::filesystem::path target_;  ///< the file that is replaced
  std::filesystem::path temporary_;
  int locked_ = -1;  ///< the open temporary file, locked as long as this process may write to it
};

/// True for the names TemporaryFile makes.
bool is_temporary_name(const std::filesystem::path& file);

/// Removes the temporary files of `file` that a killed program left behind and that nobody has
/// locked. Files that cannot be removed stay.
void remove_leftovers(const std::filesystem::path& file);
/// Removes the leftovers of every file in a folder.
void remove_all_leftovers(const std::filesystem::path& folder);

/// Replaces `file` by these bytes, or leaves it as it was and throws OutputError.
void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& file, std::string_view text);
/// Replaces `file` by what `write` appends piece after piece, so that it need not be in memory at
/// once.
using Append = std::function<void(std::string_view piece)>;
void write_file(const std::filesystem::path& file,
                const std::function<void(const Append& append)>& write);

/// Makes a folder and its parents. Throws OutputError if that fails.
void make_folder(const std::filesystem::path& folder);

/// Reads a text file of at most `max_bytes`. Throws InputError otherwise.
std::string read_text(const std::filesystem::path& file, std::size_t max_bytes = 64u << 20);

}  // namespace tabor::io
