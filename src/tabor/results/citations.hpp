#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

// Lists the BibTeX entries to cite for the methods that a result used.
namespace tabor::results {

/// One BibTeX entry as it stands in references.bib.
struct BibliographyEntry {
  std::string key;   ///< "rey2017"
  std::string text;  ///< from '@' to the closing brace
};

/// Keys of references.bib, as records and result files name them.
using ReferenceKeys = std::set<std::string>;

/// Returns the keys of the methods that a result used, a file or the folder of a study, of the
/// software below them and of the file's format. Throws InputError for what tabor has not written.
ReferenceKeys references_in(const std::filesystem::path& result);

/// Adds the keys of the software that the methods rest on: transforms, random numbers.
ReferenceKeys with_software(ReferenceKeys keys);

/// Returns the entry of tabor itself, under the key "tabor", then those of `keys` in the order of
/// references.bib. A key that is not in references.bib has no entry.
std::vector<BibliographyEntry> citations(const ReferenceKeys& keys);
/// Returns the entry of tabor itself, then all of references.bib.
std::vector<BibliographyEntry> citations();

/// Returns the entries as a BibTeX file, with an empty line between them.
std::string bibtex_of(const std::vector<BibliographyEntry>& entries);

}  // namespace tabor::results
