#include <algorithm>
#include <utility>
#include <variant>

#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
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
  throw_if_stopped(record.state.convergence);  // half a state is of no use to anybody
  record.convergence = record.state.convergence;
  record.summary =
      contact::summarise(record.state, problem, elasticity.grid(), settings.is_periodic());
  record.fft_seconds = elasticity.fft_seconds() - fft_before;
  record.seconds = watch.seconds();
  record.peak_memory = peak_memory_bytes();
  return record;
}

/// `height` is that of the surface, or what a load path has made of it.
ContactRecord state_of(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                       const Field& height, const ContactSettings& settings,
                       const contact::Control& control, const Observer& observer) {
  ContactRecord record = solve(elasticity, height, settings, control, observer);
  record.surface = topography::digest_of(surface.height, surface.grid);
  record.warnings = of_surface(surface);
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
  return settings.is_periodic() ? elastic::make_periodic(grid, settings.effective_modulus())
                                : elastic::make_free(grid, settings.effective_modulus());
}

ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer) {
  return state_of(elasticity, surface, surface.height, settings, control, observer);
}

ContactRecord contact_state(const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer) {
  return contact_state(*make_operator(settings, surface.grid), surface, settings, control,
                       observer);
}

ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, LoadPath& path,
                            const Observer& observer) {
  const Field& height = path.height.size() > 0 ? path.height : surface.height;
  ContactRecord record = state_of(elasticity, surface, height, settings, control, observer);
  if (settings.load_path) path.height = contact::unloaded_height(height, record.state);
  return record;
}

void contact_states(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                    const ContactSettings& settings, const std::vector<contact::Control>& controls,
                    const std::function<void(ContactRecord&&)>& receive, const Observer& observer) {
  for (const contact::Control& control : controls) {  // before the first of them takes its time
    const auto* separation = std::get_if<contact::Separation>(&control);
    if (separation == nullptr) continue;
    contact::require_reachable(elasticity, surface.height, {.upper = settings.pressure_cap()},
                               separation->value);
  }
  LoadPath path;
  for (const contact::Control& control : controls) {
    receive(contact_state(elasticity, surface, settings, control, path, observer));
  }
}

}  // namespace tabor::cases
