#include "tabor/cli/bibliography.hpp"

namespace tabor::cli {

std::vector<BibliographyEntry> bibliography() {
  std::vector<BibliographyEntry> entries;
  const std::string_view text = bibliography_text();
  std::size_t begin = text.find('@');
  while (begin != std::string_view::npos) {
    // Entries end with a closing brace in the first column.
    const std::size_t end = text.find("\n}", begin) + 2;
    const std::string_view entry = text.substr(begin, end - begin);
    const std::size_t key = entry.find('{') + 1;
    entries.push_back({std::string(entry.substr(key, entry.find(',') - key)), std::string(entry)});
    begin = text.find('@', end);
  }
  return entries;
}

}  // namespace tabor::cli
