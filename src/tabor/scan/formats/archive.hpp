#pragma once

#include <string>
#include <string_view>

#include "tabor/io/zip.hpp"
#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {

/// Whether the bytes begin like a ZIP archive.
bool is_zip(std::string_view head);

/// A ZIP archive around one main document, whose links to other entries are relative to its folder.
/// Nothing is ever unpacked to the disk: a name such as ../x is only a name.
class Archive {
 public:
  /// Finds `main` in any folder but __MACOSX. Throws Unrecognised, saying that this is no
  /// `format_name` file, if there is none; InputError for a damaged archive or several of that
  /// name.
  Archive(const Contents& contents, const std::string& main, const std::string& format_name);

  /// The main document, of at most 64 MiB and not much larger than its archive.
  std::string main() const;

  /// The entry a link names; slashes of both kinds and a leading ./ are understood. Throws
  /// InputError if there is none, several, or one of another size [bytes].
  const io::ZipEntry& entry(const std::string& link, std::size_t size) const;

  const io::ZipEntry& main_entry() const { return find(main_); }

  /// All of an entry, if it is not larger than deflate and the free memory allow.
  std::string read(const io::ZipEntry& entry) const;
  /// Piece after piece, reporting progress.
  void read(const io::ZipEntry& entry,
            const std::function<void(std::string_view piece)>& accept) const;

 private:
  const io::ZipEntry& find(std::string link) const;

  Contents contents_;
  io::ZipReader zip_;
  std::string main_;
  std::string folder_;
};

/// A deflate stream unpacks to at most this many times its size (zlib's technical note).
inline constexpr std::size_t kLargestDeflateRatio = 1032;

}  // namespace tabor::scan::format
