#include "tabor/cli/markdown.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"

namespace tabor::cli {

namespace {

int show(Context& context) {
  io::Json object = json_head(context);
  object["markdown"] = options_markdown();
  return finish(context, object, options_markdown());
}

}  // namespace

Verb options_verb() {
  return {.name = "options",
          .arguments = "",
          .summary = "print all options as Markdown (docs/options.md)",
          .examples = {"tabor options", "tabor options --json"},
          .declare = [](OptionSet&) -> Action { return show; }};
}

}  // namespace tabor::cli
