#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <string>

// Opens regular files for reading and rejects folders, devices and pipes.
namespace tabor::io {

/// Opens a regular file for reading. Every file of a user is opened by this class: folders, devices
/// and pipes (also behind links) are rejected at once, never waited for or read without end.
class RegularFile {
 public:
  /// Throws InputError: no such file, no permission, not a regular file.
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  int descriptor() const { return descriptor_; }
  const struct stat& status() const { return status_; }

  /// Reads the next bytes, at most `size`, and returns their number; 0 at the end. Throws
  /// InputError.
  std::size_t read(char* bytes, std::size_t size) const;

 private:
  std::string name_;
  int descriptor_;
  struct stat status_ {};
};

/// Returns why a file could not be opened, from errno: "no such file", "cannot be read: ...".
std::string reading_problem(int error);

}  // namespace tabor::io
