#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/topography/file.hpp"

namespace tabor::cli {

namespace {

int list_formats(Context& context) {
  io::Json object = json_head(context);
  object["formats"] = io::Json::array();
  Table table({"name", "extensions", "reads", "writes", "description"});
  for (const topography::FormatRow& row : topography::formats()) {
    object["formats"].push_back({{"name", row.name},
                                 {"description", row.description},
                                 {"extensions", row.extensions},
                                 {"reads", row.reads},
                                 {"writes", row.writes},
                                 {"via_gwyddion", row.via_gwyddion}});
    const std::string reads = !row.reads ? "" : row.via_gwyddion ? "by gwyddion" : "yes";
    table.row({row.name, fmt::format("{}", fmt::join(row.extensions, " ")), reads,
               row.writes ? "yes" : "", row.description});
  }
  return finish(context, object, table.text());
}

}  // namespace

Verb formats_verb() {
  return {.name = "formats",
          .arguments = "[options]",
          .summary = "list the scan formats that can be read and written",
          .details =
              "Formats are told apart by their content; the extension only matters for "
              "writing.",
          .examples = {"tabor formats", "tabor formats --json"},
          .declare = [](OptionSet&) { return list_formats; }};
}

}  // namespace tabor::cli
