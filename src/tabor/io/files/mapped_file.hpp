#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace tabor::io {

/// Maps a file into memory, read only: nothing is copied, and a page takes memory only from its
/// first use until release(). Another program may cut the file short or rewrite it meanwhile;
/// check() detects that. Reading a lost page raises the signal SIGBUS; a program that called
/// trap_lost_pages() (protection.hpp) reads zeros there instead.
class MappedFile {
 public:
  /// Opens the file. Throws InputError: no such file, a folder, device or pipe (none of which is
  /// waited for), no permission, no bytes.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

  /// Releases the memory of the whole pages inside `part`; reading them again loads them again.
  /// Memory that is not part of this file stays as it is.
  void release(std::string_view part) const;

  /// Throws InputError if the file has changed since it was opened: then the bytes read may be
  /// wrong, too.
  void check() const;
  /// Throws InputError as check(), also if its name leads to another file by now: for code that
  /// read by the name.
  void check_name() const;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
  std::string_view bytes_;
};

}  // namespace tabor::io
