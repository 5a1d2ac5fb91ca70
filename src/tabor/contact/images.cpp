#include "tabor/contact/images.hpp"

#include "tabor/core/loops.hpp"
#include "tabor/core/mirror_images.hpp"

namespace tabor::contact {
namespace {

constexpr double kRounding = 1e-12;  // of the range of heights, as filters leave it

}  // namespace

std::optional<Problem> problem_of_image(const Problem& problem) {
  const Extent extent = extent_of(problem.height);
  if (!consists_of_images(problem.height, kRounding * (extent.highest - extent.lowest)) ||
      !consists_of_images(problem.bounds.upper_of_each, 0)) {
    return {};
  }
  return Problem{
      .height = first_image(problem.height),
      .control = problem.control,
      .bounds = {problem.bounds.upper, first_image(problem.bounds.upper_of_each)},
      .start = first_image(problem.start.map()),
      .tolerance = problem.tolerance,
      .max_iterations = problem.max_iterations,
  };
}

State with_images(State image) {
  image.pressure = mirror_images(image.pressure);
  image.displacement = mirror_images(image.displacement);
  image.gap = mirror_images(image.gap);
  return image;
}

std::optional<State> state_of_image(const State& state) {
  if (!consists_of_images(state.pressure, 0)) return {};
  State image{.pressure = first_image(state.pressure),
              .displacement = first_image(state.displacement),
              .gap = first_image(state.gap),
              .mean_pressure = state.mean_pressure,
              .separation = state.separation,
              .gap_error = state.gap_error,
              .gap_limit = state.gap_limit,
              .convergence = state.convergence,
              .compact_steps = state.compact_steps};
  return image;
}

}  // namespace tabor::contact
