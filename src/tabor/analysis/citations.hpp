#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

// What to cite: BibTeX of the methods that results rest on.
namespace tabor::analysis {

/// One BibTeX entry as it stands in references.bib.
struct BibliographyEntry {
  std::string key;   ///< "rey2017"
  std::string text;  ///< from '@' to the closing brace
};

/// Keys of references.bib, as records and result files name them.
using ReferenceKeys = std::set<std::string>;

/// Those of the methods that a result file used, of the software below them and of the file's
/// format. Throws InputError for a file that tabor has not written.
ReferenceKeys references_in(const std::filesystem::path& file);

/// The same keys with those of the software that the methods rest on: transforms, random numbers.
ReferenceKeys with_software(ReferenceKeys keys);

/// tabor itself, under the key "tabor", then these in the order of references.bib; a key that is
/// not in it has none.
std::vector<BibliographyEntry> citations(const ReferenceKeys& keys);
/// tabor itself, then all of references.bib.
std::vector<BibliographyEntry> citations();

/// The entries as a BibTeX file, with an empty line between them.
std::string bibtex_of(const std::vector<BibliographyEntry>& entries);

}  // namespace tabor::analysis
