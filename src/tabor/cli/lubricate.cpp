#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>

#include "tabor/cases/warnings.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  cases::FilmSettings film;
  FieldsRequest file;
};

int show(const Request& request, Context& context) {
  cases::FilmSettings settings = request.film;
  settings.seed = context.seed_or_default();
  check(cases::objection(settings));
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  auto file = fields_file(request.file, context, scan, settings);
  const Warnings about_surface = cases::of_surface(scan.surface);
  std::map<std::size_t, cases::FilmRecord> films;  // they come in rising order of dose
  const auto receive = [&](cases::FilmRecord&& record) {
    record.warnings = cases::joined(about_surface, record.warnings);
    const std::size_t place = record.film.request;
    if (file) file->add(place, record);
    record.film.thickness = {};
    films.emplace(place, std::move(record));
  };
  const int code = until_interrupted(
      context, [&] { cases::film_state(scan.surface, settings, receive, context.observer()); },
      "densities");
  if (films.empty()) throw Interrupted();
  std::vector<cases::FilmRecord> records;
  std::vector<results::Case> cases;
  for (auto& [place, record] : films) {
    cases.push_back(results::case_of(record));
    records.push_back(std::move(record));
  }
  context.warn(results::findings_of(cases));
  if (file) file->commit(context.warnings);

  io::Json object = json_head(context, scan);
  object.update(results::settings_json(settings));
  object["states"] = states_json(cases::film_columns(), records);
  Facts facts;
  describe(scan, facts);
  describe(settings, facts);
  const std::string text = facts.text() + '\n' + table_of(cases::film_columns(), records).text();
  return finish(context, object,
                write_csv(request.file.csv, states_csv(cases::film_columns(), records), text),
                code);
}

}  // namespace

Verb lubricate_verb() {
  return {.name = "lubricate",
          .arguments = "SCAN --density D [options]",
          .summary = "compute where the lubricant collects",
          .details =
              "The mean film thickness is the areal density divided by the density of the oil. "
              "One run computes several densities.",
          .examples = {"tabor lubricate surfaces/edt_before.x3p --level plane --density "
                       "0.45g/m^2,0.9g/m^2",
                       "tabor lubricate surfaces/edt_before.x3p --level plane --density 0.9g/m^2 "
                       "--model limit -o film.h5"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            declare_film(set, request->film);
            declare_fields(set, request->file);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
