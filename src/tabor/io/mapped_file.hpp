#pragma once

#include <filesystem>
#include <string_view>

namespace tabor::io {

/// The bytes of a file, read only, as pages of the file itself: nothing is copied, and a page takes
/// memory only from its first use until release(). The file must not be cut short as long as this
/// object lives (the system then ends the program with a bus error).
class MappedFile {
 public:
  /// Throws InputError: no such file, a folder, device or pipe (none of which is waited for), no
  /// permission, no bytes.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

  /// Gives back the memory of the whole pages inside `part`; reading them again fetches them again.
  /// What is not part of this file is left alone.
  void release(std::string_view part) const;

 private:
  std::string_view bytes_;
};

}  // namespace tabor::io
