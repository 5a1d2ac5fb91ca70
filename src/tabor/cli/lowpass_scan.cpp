#include "tabor/cli/lowpass_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/cli/result.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/parameters.hpp"

namespace tabor::cli {

namespace {

constexpr std::size_t kFewestPoints = 3;

double mean_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
}

bool is_flat(const std::vector<double>& values, std::size_t begin, std::size_t end,
             double tolerance) {
  const double mean = mean_of(values, begin, end);
  return std::all_of(values.begin() + static_cast<std::ptrdiff_t>(begin),
                     values.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](double value) { return std::abs(value - mean) <= tolerance * mean; });
}

std::string filter_of(double cutoff) { return fmt::format("lowpass=hann:{}/L", cutoff); }

/// What a low-pass scan gathers.
struct Gathered {
  io::Json states = io::Json::array();
  Table rows{{"cutoff", "shortest wave", "rms slope", "pressure", "contact", "pixels",
              "friction dry", "certificate", "converged"}};
  std::vector<std::vector<double>> areas;  ///< [pressure][cutoff]
  std::vector<analysis::Case> cases;
};

/// Dry friction of the state, where it is asked for.
void add_friction(const ContactResult& result, const ContactRequest& request,
                  const std::optional<double>& shear_strength, io::Json& state,
                  analysis::Warnings& warnings) {
  state["friction_dry"] = nullptr;
  if (!shear_strength) return;
  const friction::Contact contact = for_friction(result, request);
  const friction::Estimate estimate = friction::estimate(contact, *shear_strength);
  state["friction_dry"] = estimate.friction_dry;
  state["dry_at_bound"] = estimate.at_bound;
  analysis::add(analysis::of_friction(contact, estimate, 0), warnings);
}

void add(Gathered& table, double cutoff, const topography::Topography& surface,
         const ContactResult& result, const ContactRequest& request,
         const std::optional<double>& shear_strength) {
  const double wavelength = topography::filter_side(surface) / cutoff;
  const double slope = topography::rms_slope(surface);
  io::Json state = {{"lowpass", filter_of(cutoff)},
                    {"cutoff_per_length", cutoff},
                    {"cutoff_wavelength_m", wavelength},
                    {"rms_slope", slope}};
  state.update(state_json(result));
  analysis::Warnings warnings = result.warnings;
  add_friction(result, request, shear_strength, state, warnings);
  state["warning_codes"] = analysis::codes_of(warnings);
  table.states.push_back(state);
  table.cases.push_back({.surface = plain(cutoff) + "/L",
                         .pressure = si(result.summary.mean_pressure, "Pa"),
                         .warnings = warnings});
  table.rows.row(
      {plain(cutoff) + "/L", si(wavelength, "m"), plain(slope),
       si(result.summary.mean_pressure, "Pa"), percent(result.summary.contact_area_fraction),
       percent(result.summary.contact_area_fraction_pixels),
       state.at("friction_dry").is_null() ? "-" : plain(state.at("friction_dry").get<double>()),
       fmt::format("{:.1e}", result.state.convergence.certificate),
       yes_no(result.state.convergence.converged)});
}

// Cutoffs that were not reached after Ctrl-C have no area; the plateau is sought among the rest.
io::Json plateaus_of(const ContactRequest& request, const std::vector<double>& cutoffs,
                     const Gathered& table, Facts& facts) {
  io::Json plateaus = io::Json::array();
  for (std::size_t i = 0; i < request.pressures.size(); ++i) {
    const std::vector<double>& areas = table.areas[i];
    const auto known = static_cast<std::ptrdiff_t>(areas.size());
    const auto plateau = find_plateau({cutoffs.begin(), cutoffs.begin() + known}, areas);
    const std::string label = "plateau at " + si(request.pressures[i], "Pa");
    if (!plateau) {
      facts.fact(label, "none within 5 %: the area depends on the cutoff");
      plateaus.push_back(nullptr);
      continue;
    }
    facts.fact(label, fmt::format("{}/L to {}/L, contact {}", plain(plateau->first),
                                  plain(plateau->last), percent(plateau->area_fraction)));
    plateaus.push_back({{"mean_pressure_Pa", request.pressures[i]},
                        {"first_cutoff_per_length", plateau->first},
                        {"last_cutoff_per_length", plateau->last},
                        {"contact_area_fraction", plateau->area_fraction}});
  }
  return plateaus;
}

}  // namespace

std::optional<Plateau> find_plateau(const std::vector<double>& cutoffs,
                                    const std::vector<double>& areas, double tolerance) {
  std::optional<Plateau> best;
  double best_ratio = 1;
  for (std::size_t begin = 0; begin < areas.size(); ++begin) {
    for (std::size_t end = begin + kFewestPoints; end <= areas.size(); ++end) {
      const double ratio = cutoffs[end - 1] / cutoffs[begin];
      if (ratio <= best_ratio || !is_flat(areas, begin, end, tolerance)) continue;
      best_ratio = ratio;
      best = Plateau{cutoffs[begin], cutoffs[end - 1], mean_of(areas, begin, end)};
    }
  }
  return best;
}

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

int run_lowpass_scan(const Scan& scan, const ContactRequest& request,
                     const std::vector<double>& cutoffs,
                     const std::optional<double>& shear_strength, Context& context) {
  const auto elasticity = make_operator(request, scan.surface.grid);
  Gathered table;
  table.areas.resize(request.pressures.size());
  int code = kDone;
  for (const double cutoff : cutoffs) {
    Scan filtered = scan;
    filtered.surface = topography::apply({filter_of(cutoff)}, scan.surface, context.observer());
    std::size_t pressure = 0;
    const int ended =
        solve_all(*elasticity, filtered, request, context, [&](const ContactResult& result) {
          add(table, cutoff, filtered.surface, result, request, shear_strength);
          table.areas[pressure++].push_back(result.summary.contact_area_fraction);
        });
    code = std::max(code, ended);
    if (code == kInterrupted) break;
  }
  context.warn(analysis::findings_of(table.cases));
  io::Json object = json_head(context, scan);
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(settings_json(request));
  object["states"] = table.states;
  Facts head;
  describe(scan, head);
  describe(request, head);
  Facts facts;
  object["plateaus"] = plateaus_of(request, cutoffs, table, facts);
  return finish(context, object, head.text() + '\n' + table.rows.text() + '\n' + facts.text(),
                code);
}

}  // namespace tabor::cli
