#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>

#include "tabor/analysis/warnings.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/film_request.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  FilmRequest film;
  std::optional<std::string> output;
};

std::vector<std::string> row_of(const io::Json& state) {
  const auto number = [&](const char* key) { return state.at(key).get<double>(); };
  return {plain(number("lubricant_density_g_per_m2")) + " g/m²",
          si(number("mean_film_m"), "m"),
          percent(number("wet_fraction")),
          si(number("max_film_m"), "m"),
          fmt::format("{}", state.at("n_pools").get<std::int64_t>()),
          fmt::format("{}", state.at("n_droplets").get<std::int64_t>()),
          percent(number("lost_volume_m3") / number("dosed_volume_m3")),
          state.at("flooded").get<bool>() ? "YES" : "no",
          si(number("seconds"), "s")};
}

analysis::Case case_of(double density, const lubrication::Film& film,
                       const analysis::Warnings& about_surface) {
  analysis::Case one{.density = density_text(density), .warnings = about_surface};
  analysis::add(analysis::of_film(film), one.warnings);
  return one;
}

std::vector<analysis::Case> values_of(const std::map<std::size_t, analysis::Case>& cases) {
  std::vector<analysis::Case> values;
  for (const auto& [place, one] : cases) values.push_back(one);
  return values;
}

int show(const Request& request, Context& context) {
  check(request.film);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  const io::Json settings = settings_json(request.film, context);
  std::optional<FieldsFile> file;
  if (request.output) {
    file.emplace(*request.output, context, scan, settings, methods_of(request.film));
  }

  const analysis::Warnings about_surface = analysis::of_surface(scan.surface);
  std::map<std::size_t, io::Json> states;  // films come in rising order of dose
  std::map<std::size_t, analysis::Case> cases;
  int code = kDone;
  try {
    rain(scan, request.film, context, [&](std::size_t place, lubrication::Film&& film) {
      cases[place] = case_of(request.film.densities[place], film, about_surface);
      states[place] = state_json(request.film.densities[place], film);
      states[place]["warning_codes"] = analysis::codes_of(cases[place].warnings);
      if (!file) return;
      file->add_state(place, states[place],
                      {{"film_thickness", "m", "thickness of the lubricant film", film.thickness}});
    });
  } catch (const Interrupted&) {
    if (states.empty()) throw;
    context.warn("interrupted: only the densities that were finished are shown");
    code = kInterrupted;
  }
  context.warn(analysis::findings_of(values_of(cases)));
  if (file) file->commit(context);

  io::Json object = json_head(context, scan);
  object.update(settings);
  object["states"] = io::Json::array();
  Table table(
      {"density", "mean film", "wet", "max film", "pools", "droplets", "lost", "flooded", "time"});
  for (const auto& [place, state] : states) {
    object["states"].push_back(state);
    table.row(row_of(state));
  }
  Facts facts;
  describe(scan, facts);
  describe(request.film, context, facts);
  return finish(context, object, facts.text() + '\n' + table.text(), code);
}

}  // namespace

Verb lubricate_verb() {
  return {.name = "lubricate",
          .arguments = "SCAN --density D [options]",
          .summary = "where the lubricant collects: droplets, their limit, or bottom fill",
          .details =
              "The mean film is the areal density divided by the density of the oil. Several "
              "densities are reached in one run.",
          .examples = {"tabor lubricate surfaces/edt_before.x3p --level plane --density "
                       "0.45g/m^2,0.9g/m^2",
                       "tabor lubricate surfaces/edt_before.x3p --level plane --density 0.9g/m^2 "
                       "--model limit -o film.h5"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            declare_film(set, request->film);
            declare_output(set, request->output);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
