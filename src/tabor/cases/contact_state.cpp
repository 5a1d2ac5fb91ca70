#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/checks.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/topography/digest.hpp"

namespace tabor::cases {
namespace {

ContactStatistics statistics_of(elastic::ElasticOperator& elasticity, const contact::State& state,
                                const ContactSettings& settings) {
  return {.stiffness = contact::contact_stiffness(elasticity, state, settings.pressure_cap()),
          .pressure = contact::pressure_histogram(state),
          .gap = contact::gap_histogram(state),
          .patch_area =
              contact::patch_area_histogram(state, elasticity.grid(), settings.is_periodic())};
}

ContactRecord solve(elastic::ElasticOperator& elasticity, const Field& height,
                    const ContactSettings& settings, const contact::Control& control,
                    const Observer& observer) {
  const contact::Problem problem{.height = height,
                                 .control = control,
                                 .bounds = {.upper = settings.pressure_cap()},
                                 .tolerance = settings.tolerance};
  const Stopwatch watch;
  const double fft_before = elasticity.fft_seconds();
  ContactRecord record;
  record.state = contact::solve(elasticity, problem, settings.solver, observer);
  throw_if_stopped(record.state.convergence);  // a partial solution is not a result
  record.convergence = record.state.convergence;
  record.summary =
      contact::summarise(record.state, problem, elasticity.grid(), settings.is_periodic());
  record.fft_seconds = elasticity.fft_seconds() - fft_before;
  record.seconds = watch.seconds();
  record.peak_memory = peak_memory_bytes();
  return record;
}

/// Puts the tool of the settings at its first place.
Pressing first_pressing(const topography::Topography& surface, const ContactSettings& settings,
                        const Observer& observer) {
  if (!settings.tool.is_rough()) return {};
  const Tool tool = make_tool(settings.tool, surface.grid, observer);
  return pressing(surface, tool, places_of(settings.tool, tool).front());
}

ContactRecord state_of(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                       const Pressing& pressing, const ContactSettings& settings,
                       const contact::Control& control, const Observer& observer) {
  const OneThreadIfSmall limit(surface.grid.size());
  ContactRecord record =
      solve(elasticity, pressing.height_of(surface), settings, control, observer);
  record.surface = topography::digest_of(surface.height, surface.grid);
  record.tool = pressing.tool;
  record.tool_place = pressing.place;
  record.warnings = of_surface(surface);
  add(pressing.warnings, record.warnings);
  record.references = references_of(settings);
  add(of_contact(surface, settings, record.state, record.summary), record.warnings);
  if (settings.statistics) {
    record.statistics = statistics_of(elasticity, record.state, settings);
    add(of_stiffness(record.statistics->stiffness), record.warnings);
  }
  return record;
}

}  // namespace

std::unique_ptr<elastic::ElasticOperator> make_operator(const ContactSettings& settings,
                                                        const Grid& grid) {
  constexpr double kBytesOfPixel = 24;  // that a contact takes at least, beside the heights
  check_memory("contact", fmt::format("{} x {} pixels", grid.nx, grid.ny),
               kBytesOfPixel * static_cast<double>(grid.size()), "crop or resample the surface");
  return settings.is_periodic() ? elastic::make_periodic(grid, settings.effective_modulus())
                                : elastic::make_free(grid, settings.effective_modulus());
}

Pressing pressing(const topography::Topography& surface, const Tool& tool, Index place) {
  Pressing made;
  made.tool = std::make_shared<const Field>(height_at(tool, place, surface.grid));
  made.height = surface.height + *made.tool;
  made.place = ToolPlace{static_cast<double>(place) * tool.grid.dx()};
  made.warnings = of_tool(surface, tool);
  return made;
}

ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer) {
  return state_of(elasticity, surface, first_pressing(surface, settings, observer), settings,
                  control, observer);
}

ContactRecord contact_state(const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer) {
  return contact_state(*make_operator(settings, surface.grid), surface, settings, control,
                       observer);
}

ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, Pressing& pressing,
                            const Observer& observer) {
  ContactRecord record = state_of(elasticity, surface, pressing, settings, control, observer);
  if (settings.load_path) {
    pressing.height = contact::unloaded_height(pressing.height_of(surface), record.state);
  }
  return record;
}

void contact_states(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                    const ContactSettings& settings, const std::vector<contact::Control>& controls,
                    const std::function<void(ContactRecord&&)>& receive, const Observer& observer) {
  Pressing pressing = first_pressing(surface, settings, observer);
  for (const contact::Control& control : controls) {  // before the first of them takes its time
    const auto* separation = std::get_if<contact::Separation>(&control);
    if (separation == nullptr) continue;
    contact::require_reachable(elasticity, pressing.height_of(surface),
                               {.upper = settings.pressure_cap()}, separation->value);
  }
  for (const contact::Control& control : controls) {
    receive(contact_state(elasticity, surface, settings, control, pressing, observer));
  }
}

}  // namespace tabor::cases
