#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// Reads and makes ZIP archives in memory.
namespace tabor::io {

struct ZipEntry {
  std::uint64_t index = 0;      ///< place in the archive's directory
  std::string name;             ///< as stored, folders separated by '/'
  std::size_t size = 0;         ///< unpacked [bytes], as the archive claims
  std::size_t packed_size = 0;  ///< [bytes]
};

/// Reads a ZIP archive in memory. The bytes must outlive the reader.
class ZipReader {
 public:
  /// `name` is what error messages call the archive. Throws InputError if it is not a ZIP archive.
  ZipReader(std::string_view bytes, std::string name);
  ~ZipReader();
  ZipReader(ZipReader&&) noexcept;
  ZipReader& operator=(ZipReader&&) noexcept;

  const std::vector<ZipEntry>& entries() const { return entries_; }

  /// Returns the unpacked content of an entry. Memory grows only with bytes that were really
  /// unpacked and never beyond `limit`: InputError for larger, damaged or truncated entries.
  std::string read(const ZipEntry& entry, std::size_t limit) const;

  /// Unpacks an entry piece after piece, so that it need not fit into memory: each piece has at
  /// most kPiece bytes; the last one may be shorter.
  static constexpr std::size_t kPiece = std::size_t{1} << 20;
  void read(const ZipEntry& entry, std::size_t limit,
            const std::function<void(std::string_view piece)>& accept) const;

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

/// Returns a ZIP archive (deflate) of these files with a fixed time stamp: the same content always
/// gives the same bytes. Throws OutputError when memory or the library fails.
std::string zip(const std::vector<ZipContent>& files);

}  // namespace tabor::io
