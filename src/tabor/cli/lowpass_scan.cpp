#include "tabor/cli/lowpass_scan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/cases/lowpass.hpp"
#include "tabor/cases/plateau.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

constexpr double kFlat = 0.05;  // areas within this of their mean are the same

// Cutoffs that were not reached after Ctrl-C have no area; the plateau is sought among the rest.
io::Json plateaus_of(const cases::CaseSettings& settings, const std::vector<double>& cutoffs,
                     const std::vector<std::vector<double>>& all_areas, Facts& facts) {
  io::Json plateaus = io::Json::array();
  for (std::size_t i = 0; i < settings.mean_pressures.size(); ++i) {
    const std::vector<double>& areas = all_areas[i];
    const auto known = static_cast<std::ptrdiff_t>(areas.size());
    const auto plateau =
        cases::find_plateau({cutoffs.begin(), cutoffs.begin() + known}, areas, kFlat);
    const std::string label = "plateau at " + si(settings.mean_pressures[i], "Pa");
    if (!plateau) {
      facts.fact(label, "none within 5 %: the area depends on the cutoff");
      plateaus.push_back(nullptr);
      continue;
    }
    facts.fact(label, fmt::format("{}/L to {}/L, contact {}", plain(plateau->first),
                                  plain(plateau->last), percent(plateau->value)));
    plateaus.push_back({{"mean_pressure_Pa", settings.mean_pressures[i]},
                        {"first_cutoff_per_length", plateau->first},
                        {"last_cutoff_per_length", plateau->last},
                        {"contact_area_fraction", plateau->value}});
  }
  return plateaus;
}

/// Surfaces are called by their cutoffs.
results::Case case_of(const cases::LowpassRecord& record) {
  return {.surface = plain(record.cutoff) + "/L",
          .pressure = si(record.contact.summary.mean_pressure, "Pa"),
          .warnings = record.contact.warnings};
}

}  // namespace

std::vector<double> parse_cutoffs(const std::string& text) {
  std::vector<double> cutoffs;
  for (const std::string& part : split(text, ',')) {
    const std::optional<double> cutoff = parse_number(part);
    const double last = cutoffs.empty() ? 0 : cutoffs.back();
    if (!cutoff || !std::isfinite(*cutoff) || *cutoff <= last) {
      throw UsageError("--lowpass-scan: got '" + text +
                       "'; expected rising numbers of waves per scan side such as 64,128,256");
    }
    cutoffs.push_back(*cutoff);
  }
  return cutoffs;
}

int run_lowpass_scan(const Scan& scan, const cases::CaseSettings& settings,
                     const std::vector<double>& cutoffs,
                     const std::optional<double>& shear_strength, const CsvRequest& csv,
                     Context& context) {
  std::vector<cases::LowpassRecord> records;
  std::vector<results::Case> cases;
  std::vector<std::vector<double>> areas(settings.mean_pressures.size());  // [pressure][cutoff]
  const auto receive = [&](cases::LowpassRecord&& record, std::size_t pressure) {
    areas[pressure].push_back(record.contact.summary.contact_area_fraction);
    cases.push_back(case_of(record));
    record.contact.state = {};
    records.push_back(std::move(record));
  };
  std::optional<cases::FrictionSettings> friction;
  if (shear_strength) friction = cases::FrictionSettings{.shear_strength = *shear_strength};
  int code = until_interrupted(context, [&] {
    cases::lowpass_states(scan.surface, settings.contact, settings.mean_pressures, cutoffs,
                          friction, receive, context.observer());
  });
  for (const cases::LowpassRecord& record : records) {
    if (code == kDone && !record.contact.convergence.converged()) code = kNotConverged;
  }
  context.warn(results::findings_of(cases));
  io::Json object = json_head(context, scan);
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(results::settings_json(settings.contact));
  object["states"] = states_json(cases::lowpass_columns(), records);
  Facts head;
  describe(scan, head);
  describe(settings.contact, head);
  Facts facts;
  object["plateaus"] = plateaus_of(settings, cutoffs, areas, facts);
  const std::string text =
      head.text() + '\n' + table_of(cases::lowpass_columns(), records).text() + '\n' + facts.text();
  return finish(context, object,
                write_csv(csv, states_csv(cases::lowpass_columns(), records), text), code);
}

}  // namespace tabor::cli
