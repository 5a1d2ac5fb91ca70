#include "tabor/study/resolution_scan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/scan_friction.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

constexpr Index kFewestPixels = 64;  // along a side: a quarter of them is the coarsest grid

void check_scan(const topography::Topography& surface, const cases::CaseSettings& settings) {
  const Grid& grid = surface.grid;
  if (std::min(grid.nx, grid.ny) < kFewestPixels) {
    throw InputError("resolution scan", fmt::format("{} x {} pixels", grid.nx, grid.ny),
                     fmt::format("{0} x {0} or more", kFewestPixels),
                     "it solves the scan with four times fewer pixels along each side, too");
  }
  if (settings.fluid.flows()) {
    throw InputError("resolution scan", "oil that flows", "oil at rest",
                     "leave out the fluid film");
  }
}

std::string resampled(const Grid& grid, Index factor) {
  return fmt::format("resample={},{}", grid.nx / factor, grid.ny / factor);
}

std::string low_passed(const Grid& grid, int pixels) {
  return fmt::format("lowpass=gauss:{:.6g}um", 1e6 * pixels * grid.dx());
}

void add_records(const topography::Topography& surface, const std::string& step,
                 const cases::CaseSettings& settings, const engine::RunOptions& options,
                 std::vector<ResolutionRecord>& records) {
  const topography::Topography treated = topography::apply({step}, surface, options.observer);
  const auto receive = [&](const FrictionState& state) {
    records.push_back({step, treated.grid.dx(), state.friction});
  };
  friction_of(treated, settings, receive, ContactMaps::dropped, options);
}

}  // namespace

const Columns<ResolutionRecord>& resolution_columns() {
  using Record = ResolutionRecord;
  using Friction = cases::FrictionRecord;
  static const Columns<Friction> friction{
      {"mean_pressure_Pa", "Pa", "pressure", &Friction::mean_pressure},
      {"lubricant_density_g_per_m2",
       "g/m²",
       "lubricant",
       [](const Friction& one) { return in_g_per_m2(one.lubricant_density); },
       {.shown = Shown::unscaled}},
      {"contact_area_fraction_pixels", "", "", &Friction::contact_area_fraction_pixels},
      cases::friction_area_columns()[0],
      cases::friction_area_columns()[1],
      {"lubricated_share", "", "wet share", &Friction::lubricated_share, {.shown = Shown::percent}},
      {"friction_lubricated", "", "friction wet", &Friction::friction_lubricated},
      {"converged", "", "converged", &Friction::converged}};
  static const Columns<Record> all = joined<Record>(
      {{"step", "", "after", [](const Record& one) { return one.step.empty() ? "-" : one.step; }},
       {"pixel_x_m", "m", "pixel", &Record::pixel_x}},
      within(friction, &Record::friction));
  return all;
}

std::vector<ResolutionRecord> resolution_scan(const topography::Topography& surface,
                                              const cases::CaseSettings& settings,
                                              std::vector<cases::FrictionRecord>& as_measured,
                                              const engine::RunOptions& options) {
  check_scan(surface, settings);
  std::vector<ResolutionRecord> records;
  add_records(surface, resampled(surface.grid, 4), settings, options, records);
  const std::size_t first_half = records.size();
  add_records(surface, resampled(surface.grid, 2), settings, options, records);
  for (std::size_t i = 0; i < as_measured.size(); ++i) {
    const ResolutionRecord& coarse = records.at(first_half + i);
    add(cases::of_pixel(coarse.pixel_x, coarse.friction.lubricated_share, surface.grid.dx(),
                        as_measured[i].lubricated_share),
        as_measured[i].warnings);
  }
  for (const cases::FrictionRecord& record : as_measured) {
    records.push_back({"", surface.grid.dx(), record});
  }
  for (const int pixels : {4, 8, 16}) {
    add_records(surface, low_passed(surface.grid, pixels), settings, options, records);
  }
  return records;
}

}  // namespace tabor::study
