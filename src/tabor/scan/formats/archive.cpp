#include "tabor/scan/formats/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tabor/core/resources.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::size_t kMaxMain = std::size_t{64} << 20;
/// Parsed XML takes some ten times its text, so a small archive must not hold a huge one. Heights
/// listed as text pack to a tenth; only repetition packs to a hundredth.
constexpr std::size_t kAnyMain = std::size_t{1} << 20;
constexpr std::size_t kMainRatio = 100;

/// Some programs of Windows separate folders by back slashes.
std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

bool names(const std::string& path, const std::string& name) {
  return !path.starts_with("__MACOSX") && (path == name || path.ends_with("/" + name));
}

}  // namespace

bool is_zip(std::string_view head) { return head.starts_with("PK\x03\x04"); }

Archive::Archive(const Contents& contents, const std::string& main, const std::string& format_name)
    : contents_(contents), zip_(contents.bytes, contents.file.string()), main_(main) {
  std::string found;
  for (const io::ZipEntry& entry : zip_.entries()) {
    const std::string path = with_slashes(entry.name);
    if (!names(path, main)) continue;
    if (!found.empty() && found != path) {
      reject(contents, fmt::format("an archive with '{}' and '{}'", found, path), "one scan",
             "unpack it and read its files one by one");
    }
    found = path;
  }
  if (found.empty()) {
    throw Unrecognised(contents,
                       fmt::format("a ZIP archive without {} (so not {})", main, format_name),
                       "unpack it if it holds several files");
  }
  folder_ = found.substr(0, found.size() - main.size());
}

std::string Archive::main() const { return text(find(main_)); }

std::string Archive::text(const io::ZipEntry& entry) const {
  const std::size_t likely = std::max(kAnyMain, kMainRatio * contents_.bytes.size());
  return zip_.read(entry, std::min(kMaxMain, likely));
}

const io::ZipEntry& Archive::find(std::string link) const {
  link = with_slashes(std::move(link));
  while (link.starts_with("./") || link.starts_with("/")) link.erase(0, link.find('/') + 1);
  const io::ZipEntry* found = nullptr;
  for (const io::ZipEntry& entry : zip_.entries()) {
    if (with_slashes(entry.name) != folder_ + link) continue;
    if (found != nullptr) reject(contents_, "two entries named '" + link + "'", "one", kDamaged);
    found = &entry;
  }
  if (found == nullptr) {
    reject(contents_, "no entry '" + link + "'", "the data " + main_ + " links to", kDamaged);
  }
  return *found;
}

const io::ZipEntry& Archive::entry(const std::string& link, std::size_t size) const {
  const io::ZipEntry& entry = find(link);
  if (entry.size != size) {
    reject(contents_, fmt::format("{} of {} bytes", link, entry.size),
           fmt::format("{} bytes as {} says", size, main_), kDamaged);
  }
  return entry;
}

std::string Archive::read(const io::ZipEntry& entry) const {
  const std::size_t likely = kLargestDeflateRatio * contents_.bytes.size();
  const std::size_t memory = available_memory_bytes();
  return zip_.read(entry, memory > 0 ? std::min(likely, memory / 2) : likely);
}

void Archive::read(const io::ZipEntry& entry,
                   const std::function<void(std::string_view)>& accept) const {
  std::size_t n_read = 0;
  zip_.read(entry, entry.size, [&](std::string_view piece) {
    accept(piece);
    n_read += piece.size();
    // Where the packed bytes lie only the library knows: now and then all pages are given back.
    constexpr std::size_t kPiecesPerRelease = 32;
    const bool releases = n_read / io::ZipReader::kPiece % kPiecesPerRelease == 0;
    contents_.finished(releases ? contents_.bytes : std::string_view(),
                       static_cast<double>(n_read) / static_cast<double>(entry.size));
  });
}

}  // namespace tabor::scan::format
