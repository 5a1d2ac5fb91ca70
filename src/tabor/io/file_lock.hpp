#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tabor::io {

/// A lock on a file, known to other processes, held as long as the object lives. The system drops
/// it when a process dies, however it dies.
class FileLock {
 public:
  enum class Kind {
    alone,  ///< nobody else may have one
    shared  ///< others may have shared ones
  };

  /// Makes the file if there is none. Nothing if others' locks exclude this one. Throws
  /// OutputError.
  static std::optional<FileLock> take(const std::filesystem::path& file, Kind kind);

  /// The same in a folder that is made if there is none. Throws InputError, which says `rejection`,
  /// if others' locks exclude this one.
  static FileLock take_or_reject(const std::filesystem::path& file, Kind kind,
                                 const std::string& rejection);

  FileLock(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace tabor::io
