#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/results/citations.hpp"

namespace tabor::cli {

namespace {

std::vector<results::BibliographyEntry> entries_for(const std::vector<std::string>& files) {
  if (files.empty()) return results::citations();
  results::ReferenceKeys wanted;
  for (const std::string& file : files) wanted.merge(results::references_in(file));
  return results::citations(wanted);
}

int show(const std::vector<std::string>& files, Context& context) {
  const std::vector<results::BibliographyEntry> entries = entries_for(files);
  io::Json object = json_head(context);
  object["bibtex"] = io::Json::object();
  for (const auto& entry : entries) object["bibtex"][entry.key] = entry.text;
  return finish(context, object, results::bibtex_of(entries));
}

}  // namespace

Verb cite_verb() {
  return {.name = "cite",
          .arguments = "[RESULT ...]",
          .summary = "print BibTeX entries for the methods of a result, or for all methods",
          .examples = {"tabor cite", "tabor cite --json"},
          .declare = [](OptionSet& set) -> Action {
            const auto files = std::make_shared<std::vector<std::string>>();
            set.group("Results");
            Option& results =
                set.positionals("RESULT", "result files, or folders of studies", *files);
            results.required = false;
            results.names = FileRole::input;
            return [files](Context& context) { return show(*files, context); };
          }};
}

}  // namespace tabor::cli
