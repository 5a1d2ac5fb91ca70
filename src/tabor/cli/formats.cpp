#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <optional>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::cli {

namespace {

std::string tier_of(const scan::FormatRow& row) {
  if (row.via_gwyddion) return "through gwyddion";
  if (row.reads && row.writes) return "read and write";
  return row.reads ? "read" : "write";
}

std::string line_about(const std::optional<std::filesystem::path>& gwyddion) {
  if (gwyddion) return fmt::format("\nGwyddion is installed: {}\n", gwyddion->string());
  return "\nGwyddion is not installed: sudo apt install gwyddion\n";
}

int list_formats(Context& context) {
  const auto gwyddion = scan::gwyddion_program();
  io::Json object = json_head(context);
  object["gwyddion"] = {{"installed", gwyddion.has_value()},
                        {"path", gwyddion ? io::Json(gwyddion->string()) : io::Json()}};
  object["formats"] = io::Json::array();
  Table table({"name", "tier", "extensions", "description"});
  for (const scan::FormatRow& row : scan::formats()) {
    object["formats"].push_back({{"name", row.name},
                                 {"description", row.description},
                                 {"extensions", row.extensions},
                                 {"reads", row.reads},
                                 {"writes", row.writes},
                                 {"via_gwyddion", row.via_gwyddion},
                                 {"tier", tier_of(row)}});
    table.row({row.name, tier_of(row), fmt::format("{}", fmt::join(row.extensions, " ")),
               row.description});
  }
  return finish(context, object, table.text() + line_about(gwyddion));
}

}  // namespace

Verb formats_verb() {
  return {
      .name = "formats",
      .arguments = "[options]",
      .summary = "list the scan formats that can be read and written",
      .details = "tabor recognises a file by its content. The extension matters only for writing.",
      .examples = {"tabor formats", "tabor formats --json"},
      .declare = [](OptionSet&) { return list_formats; }};
}

}  // namespace tabor::cli
