#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tabor::cli {

/// One BibTeX entry as it stands in references.bib.
struct BibliographyEntry {
  std::string key;
  std::string text;  ///< from '@' to the closing brace
};

/// The content of references.bib, compiled in.
std::string_view bibliography_text();

/// All entries in the order of the file.
std::vector<BibliographyEntry> bibliography();

}  // namespace tabor::cli
