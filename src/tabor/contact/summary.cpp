#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/patches.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

/// Area that each contact transition adds in excess, in pixels (Yastrebov, Anciaux & Molinari 2017,
/// doi:10.1016/j.triboint.2017.04.023).
constexpr double kTransitionArea = (std::numbers::pi - 1 + std::numbers::ln2) / 24;

template <typename Value>
double mean_of(Index n, const Value& value) {
  return sum_over(n, value) / static_cast<double>(n);
}

/// Corners per pixel edge of a contact line: 2 - sqrt 2 = 0.59 of one that runs in all directions
/// alike (a disc of any size 0.5 to 0.7, rough contacts up to 1), 1/n of a square of n pixels, none
/// of ridges along the grid. Half of the first parts them.
constexpr double kFewestCorners = 0.3;

/// The correction takes a contact line to cut pixels at random. One that runs along the pixel grid
/// ends on pixel edges instead, and the count is right as it is.
bool runs_along_the_grid(const Mask& contact, const Transitions& transitions, bool periodic) {
  return static_cast<double>(count_corners(contact, periodic)) <
         kFewestCorners * static_cast<double>(transitions.total());
}

}  // namespace

Summary summarise(const State& state, const Problem& problem, const Grid& grid, bool periodic) {
  const Mask contact = contact_mask(state);
  const Transitions transitions = count_transitions(contact, periodic);
  const Index n = grid.size();
  const Caps caps = problem.bounds.caps();

  Summary summary;
  summary.mean_pressure = state.mean_pressure;
  summary.contact_area_fraction_pixels =
      mean_of(n, [&](Index i) { return contact(i) ? 1.0 : 0.0; });
  summary.area_correction_valid = !runs_along_the_grid(contact, transitions, periodic);
  const double excess =
      kTransitionArea * static_cast<double>(transitions.total()) / static_cast<double>(n);
  const double floor = caps.bound() ? state.mean_pressure / caps.highest(n) : 0.0;
  summary.contact_area_fraction = std::max(
      floor, summary.contact_area_fraction_pixels - (summary.area_correction_valid ? excess : 0.0));
  summary.saturated_area_fraction =
      mean_of(n, [&](Index i) { return at_cap(state.pressure(i), caps(i)) ? 1.0 : 0.0; });
  summary.mean_gap = mean_of(n, [&](Index i) { return std::max(state.gap(i), 0.0); });
  summary.separation = state.separation;
  summary.approach = extent_of(problem.height).highest - state.separation;
  summary.contact_gap_error = state.gap_error;
  summary.max_pressure = max_over(n, [&](Index i) { return state.pressure(i); });
  summary.elastic_energy =
      mean_of(n, [&](Index i) { return 0.5 * state.pressure(i) * state.displacement(i); });
  summary.n_patches = find_patches(contact, periodic).size();
  summary.perimeter = static_cast<double>(transitions.along_rows) * grid.dy() +
                      static_cast<double>(transitions.along_columns) * grid.dx();
  return summary;
}

}  // namespace tabor::contact
