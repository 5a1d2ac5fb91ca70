#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/topography/parameters.hpp"

namespace tabor::cli {

namespace {

std::string value_of(const topography::Parameter& parameter) {
  if (parameter.unit == "m") return si(parameter.value, "m");
  const std::string number = plain(parameter.value, 5);
  return parameter.unit == "1" || parameter.unit.empty() ? number : number + " " + parameter.unit;
}

int show(const ScanRequest& request, Context& context) {
  const Scan scan = load_scan(request, context);
  warn_if_not_levelled(scan, context);
  io::Json object = json_head(context, scan);
  object["parameters"] = io::Json::object();
  Table table({"symbol", "value", "definition"});
  for (const topography::Parameter& parameter : topography::parameters(scan.surface)) {
    object["parameters"][parameter.symbol] = {{"value", io::number(parameter.value)},
                                              {"unit", parameter.unit},
                                              {"definition", parameter.definition}};
    table.row({parameter.symbol, value_of(parameter), parameter.definition});
  }
  Facts facts;
  describe(scan, facts);
  return finish(context, object, facts.text() + '\n' + table.text());
}

}  // namespace

Verb params_verb() {
  return {.name = "params",
          .arguments = "SCAN [options]",
          .summary = "roughness parameters (ISO 25178-2), each with its definition",
          .details = "",
          .examples = {"tabor params surfaces/edt_before.x3p --level plane",
                       "tabor params surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                       "--json"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<ScanRequest>();
            declare_scan(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
