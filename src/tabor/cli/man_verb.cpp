#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "tabor/cli/man_page.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::cli {

namespace {

struct Request {
  std::string verb;
  std::optional<std::string> folder;
};

/// The page of a verb; without one that of the program, or of everything where files are written.
std::vector<ManPage> pages_for(const Request& request) {
  if (!request.verb.empty()) return {man_page(find_verb(request.verb))};
  return request.folder ? man_pages() : std::vector{man_page()};
}

int show(const Request& request, Context& context) {
  const std::vector<ManPage> pages = pages_for(request);
  io::Json object = json_head(context);
  object["pages"] = io::Json::array();
  std::string text;
  for (const ManPage& page : pages) {
    object["pages"].push_back({{"name", page.name}, {"text", page.text}});
    text += page.text;
  }
  if (!request.folder) return finish(context, object, text);
  const std::filesystem::path folder = *request.folder;
  io::make_folder(folder);
  for (const ManPage& page : pages) io::write_file(folder / page.file(), page.text);
  return finish(context, object,
                fmt::format("{} pages written to {}\n", pages.size(), folder.string()));
}

}  // namespace

Verb man_verb() {
  return {.name = "man",
          .arguments = "[VERB] [-o DIR]",
          .summary = "print a manual page, or write all of them",
          .details = "The pages say the same as --help. 'tabor man contact | man -l -' shows one.",
          .examples = {"tabor man contact", "tabor man -o man1"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            set.group("Pages");
            Option& verb =
                set.positional("VERB", "the verb of the page [tabor itself]", request->verb);
            verb.required = false;
            verb.words = names_of_verbs();
            set.output("DIR", "write the pages into this folder; without VERB all of them", {},
                       request->folder);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
