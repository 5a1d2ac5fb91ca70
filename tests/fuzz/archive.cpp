#include "fuzz/archive.hpp"

#include <set>

namespace tabor::fuzz {
namespace {

constexpr std::string_view kMark = "=== ";

}  // namespace

std::string plain_archive(const std::vector<io::ZipContent>& entries) {
  std::string listing;
  for (const io::ZipContent& entry : entries) {
    listing.append(kMark).append(entry.name).append("\n").append(entry.bytes).append("\n");
  }
  return listing;
}

std::string packed_archive(std::string_view listing) {
  constexpr std::size_t kMostEntries = 32;
  std::vector<io::ZipContent> entries;
  std::set<std::string, std::less<>> names;
  std::size_t mark = listing.starts_with(kMark) ? 0 : listing.find("\n=== ");
  const std::string head(listing.substr(0, std::min(mark, listing.size())));
  while (mark < listing.size() && entries.size() < kMostEntries) {
    listing.remove_prefix(listing.find(kMark, mark) + kMark.size());
    const std::size_t line_end = std::min(listing.find('\n'), listing.size());
    mark = listing.find("\n=== ", line_end);
    const std::string name(listing.substr(0, line_end));
    const std::string_view rest = listing.substr(0, std::min(mark, listing.size()));
    const std::string bytes(rest.substr(std::min(line_end + 1, rest.size())));
    if (!name.empty() && names.insert(name).second) entries.push_back({name, bytes});
  }
  return entries.empty() ? head : head + io::zip(entries);
}

std::string unpacked(const std::string& archive) {
  const io::ZipReader reader(archive, "sample");
  std::vector<io::ZipContent> entries;
  for (const io::ZipEntry& entry : reader.entries()) {
    entries.push_back({entry.name, reader.read(entry, entry.size)});
  }
  return plain_archive(entries);
}

}  // namespace tabor::fuzz
