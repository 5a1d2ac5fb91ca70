#include <algorithm>
#include <memory>
#include <set>

#include "tabor/cli/bibliography.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/hdf5_guard.hpp"

namespace tabor::cli {

namespace {

using Keys = std::set<std::string>;

// A study says what it used by its settings: docs/results.md lists these attributes.
Keys keys_of_study(const io::Hdf5Reader& file) {
  Keys keys = {"rey2017",         "polonsky1999", "stanley1997",  "bowden1950",
               "costagliola2021", "jacobs2017",   "yastrebov2017"};
  if (file.has_attribute("/", "saturation_pressure_Pa")) keys.insert("almqvist2007");
  if (file.has_attribute("/", "fluid")) keys.insert("elrod1981");
  const std::string config = file.text("/", "config_toml");
  if (config.find("limit") != std::string::npos) keys.insert("barnes2021");
  return keys;
}

Keys keys_in(const io::Hdf5Reader& file, const std::string& path) {
  if (!file.has_attribute("/", "format") || file.text("/", "format") != "tabor") {
    throw InputError(path, "an HDF5 file of another program", "a result file of tabor", "");
  }
  Keys keys;
  if (file.has_attribute("/", "methods")) {
    const std::vector<std::string> named = file.attribute_texts("/", "methods");
    keys.insert(named.begin(), named.end());
  } else if (file.exists("/table")) {
    keys = keys_of_study(file);
  }
  if (keys.contains("stanley1997") || keys.contains("love1929")) keys.insert("frigo2005");
  if (keys.contains("costagliola2021")) keys.insert("salmon2011");
  keys.insert("hdf5");
  return keys;
}

Keys keys_of(const std::string& path) {
  return io::read_guarded(path, [&](const io::Hdf5Reader& file) { return keys_in(file, path); });
}

std::string own_entry() {
  return std::string(
             "@software{tabor,\n  title   = {tabor: real contact area, lubricant and friction "
             "of scanned rough surfaces},\n  version = {") +
         kVersion + "}\n}";
}

int show(const std::vector<std::string>& files, Context& context) {
  Keys wanted;
  for (const std::string& file : files) wanted.merge(keys_of(file));
  io::Json object = json_head(context);
  object["bibtex"] = io::Json::object({{"tabor", own_entry()}});
  std::string text = own_entry() + "\n";
  for (const BibliographyEntry& entry : bibliography()) {
    if (!files.empty() && !wanted.contains(entry.key)) continue;
    object["bibtex"][entry.key] = entry.text;
    text += "\n" + entry.text + "\n";
  }
  return finish(context, object, text);
}

}  // namespace

Verb cite_verb() {
  return {.name = "cite",
          .arguments = "[RESULT.h5 ...]",
          .summary = "BibTeX of the methods a result file used; without a file, of all methods",
          .examples = {"tabor cite", "tabor cite --json"},
          .declare = [](OptionSet& set) -> Action {
            const auto files = std::make_shared<std::vector<std::string>>();
            set.group("Results");
            Option& results = set.positionals("RESULT", "result files", *files);
            results.required = false;
            results.names = FileRole::input;
            return [files](Context& context) { return show(*files, context); };
          }};
}

}  // namespace tabor::cli
