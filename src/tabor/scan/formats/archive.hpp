#pragma once

#include <string>
#include <string_view>

#include "tabor/io/files/zip.hpp"
#include "tabor/scan/formats/format.hpp"

// Reads scan formats that are ZIP archives around one main document.
namespace tabor::scan::format {

/// True where the bytes begin like a ZIP archive.
bool is_zip(std::string_view head);

/// Reads a ZIP archive around one main document, whose links to other entries are relative to its
/// folder. Nothing is ever unpacked to the disk: a name such as ../x is only a name.
class Archive {
 public:
  /// Finds `main` in any folder but __MACOSX. Throws Unrecognised, saying that this is no
  /// `format_name` file, if there is none; InputError for a damaged archive or several of that
  /// name.
  Archive(const Contents& contents, const std::string& main, const std::string& format_name);

  /// Returns the main document, of at most 64 MiB and not much larger than its archive.
  std::string main() const;

  /// Returns the entry that a link names; slashes of both kinds and a leading ./ are understood.
  /// Throws InputError if there is none, several, or one of another size [bytes].
  const io::ZipEntry& entry(const std::string& link, std::size_t size) const;
  /// Returns the entry that a link names, of any size.
  const io::ZipEntry& find(std::string link) const;

  /// Returns an entry of text under the limits of the main document.
  std::string text(const io::ZipEntry& entry) const;

  const io::ZipEntry& main_entry() const { return find(main_); }

  /// Reads all of an entry, if it is not larger than deflate and the free memory allow.
  std::string read(const io::ZipEntry& entry) const;
  /// Reads an entry piece after piece, reporting progress.
  void read(const io::ZipEntry& entry,
            const std::function<void(std::string_view piece)>& accept) const;

 private:
  Contents contents_;
  io::ZipReader zip_;
  std::string main_;
  std::string folder_;
};

/// Largest ratio of unpacked to packed size of a deflate stream (zlib's technical note).
inline constexpr std::size_t kLargestDeflateRatio = 1032;

}  // namespace tabor::scan::format
