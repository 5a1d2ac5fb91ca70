#include "tabor/results/citations.hpp"

#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/results/bibliography.hpp"
#include "tabor/results/result_maps.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::results {
namespace {

/// All entries in the order of the file.
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

BibliographyEntry own_entry() {
  return {"tabor",
          std::string("@software{tabor,\n  title   = {tabor: real contact area, lubricant and "
                      "friction of scanned rough surfaces},\n  version = {") +
              kVersion + "}\n}"};
}

// A study says what it used by its settings: docs/results.md lists these attributes.
ReferenceKeys keys_of_study(const io::Hdf5Reader& file) {
  ReferenceKeys keys = {"rey2017",         "polonsky1999", "stanley1997",  "bowden1950",
                        "costagliola2021", "jacobs2017",   "yastrebov2017"};
  if (file.has_attribute("/", "saturation_pressure_Pa")) keys.insert("almqvist2007");
  if (file.has_attribute("/", "fluid")) keys.insert("elrod1981");
  const std::string config = file.text("/", "config_toml");
  if (config.find("limit") != std::string::npos) keys.insert("barnes2021");
  return keys;
}

ReferenceKeys keys_in(const io::Hdf5Reader& file, const std::string& path) {
  if (!file.has_attribute("/", "format") || file.text("/", "format") != "tabor") {
    throw InputError(path, "an HDF5 file of another program", "a result file of tabor", "");
  }
  ReferenceKeys keys;
  if (file.has_attribute("/", "methods")) {
    const std::vector<std::string> named = file.attribute_texts("/", "methods");
    keys.insert(named.begin(), named.end());
  } else if (file.exists("/table")) {
    keys = keys_of_study(file);
  }
  keys.insert("hdf5");
  return with_software(std::move(keys));
}

}  // namespace

ReferenceKeys references_in(const std::filesystem::path& result) {
  const std::filesystem::path file = file_of_result(result);
  return io::read_guarded(
      file, [&](const io::Hdf5Reader& reader) { return keys_in(reader, file.string()); });
}

ReferenceKeys with_software(ReferenceKeys keys) {
  if (keys.contains("stanley1997") || keys.contains("love1929")) {
    keys.insert(spectral::transform_reference());
  }
  if (keys.contains("costagliola2021")) keys.insert("salmon2011");
  return keys;
}

std::vector<BibliographyEntry> citations(const ReferenceKeys& keys) {
  std::vector<BibliographyEntry> entries = {own_entry()};
  for (BibliographyEntry& entry : bibliography()) {
    if (keys.contains(entry.key)) entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<BibliographyEntry> citations() {
  std::vector<BibliographyEntry> entries = bibliography();
  entries.insert(entries.begin(), own_entry());
  return entries;
}

std::string bibtex_of(const std::vector<BibliographyEntry>& entries) {
  std::string text;
  for (const BibliographyEntry& entry : entries) {
    text += (text.empty() ? "" : "\n") + entry.text + "\n";
  }
  return text;
}

}  // namespace tabor::results
