#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tabor::io {

struct ZipEntry {
  std::string name;             ///< as stored, folders separated by '/'
  std::size_t size = 0;         ///< unpacked [bytes], as the archive claims
  std::size_t packed_size = 0;  ///< [bytes]
};

/// A ZIP archive in memory, for reading. The bytes must outlive it.
class ZipReader {
 public:
  /// `name` is what error messages call the archive. Throws InputError if it is not a ZIP archive.
  ZipReader(std::string_view bytes, std::string name);
  ~ZipReader();
  ZipReader(ZipReader&&) noexcept;
  ZipReader& operator=(ZipReader&&) noexcept;

  const std::vector<ZipEntry>& entries() const { return entries_; }

  /// The unpacked content of an entry. Memory grows only with bytes that were really unpacked and
  /// never beyond `limit`: InputError for larger, damaged or truncated entries.
  std::string read(const ZipEntry& entry, std::size_t limit) const;

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
  std::string name_;
  std::vector<ZipEntry> entries_;
};

struct ZipContent {
  std::string name;
  std::string bytes;
};

/// A ZIP archive (deflate) of these files with a fixed time stamp: the same content always gives
/// the same bytes. Throws OutputError when memory or the library fails.
std::string zip(const std::vector<ZipContent>& files);

}  // namespace tabor::io
