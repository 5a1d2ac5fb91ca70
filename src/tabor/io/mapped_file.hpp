#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace tabor::io {

/// The bytes of a file, read only, as pages of the file itself: nothing is copied, and a page takes
/// memory only from its first use until release(). Another program may cut the file short or write
/// it anew meanwhile; check() tells. Touching a page that is gone raises the signal SIGBUS; a
/// program that called trap_lost_pages() (protection.hpp) reads zeros there instead.
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

  /// Throws InputError if the file is no longer what was opened: then nor is what was read of it.
  void check() const;
  /// Also if its name leads to another file by now: for what was read by the name.
  void check_name() const;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
  std::string_view bytes_;
};

}  // namespace tabor::io
