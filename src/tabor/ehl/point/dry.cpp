#include "tabor/ehl/point/dry.hpp"

#include <cmath>

#include "tabor/contact/contact.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/elastic/half_space.hpp"

namespace tabor::ehl {
namespace {

/// The contact solver measures its error by the rms height, here that of a ball far outside the
/// contact; this is the error asked for, in units of what solve_point() balances.
constexpr double kCertificate = 1e-3;

bool reaches_border(const Field& pressure) {
  return pressure.row(0).maxCoeff() > 0 || pressure.bottomRows(1).maxCoeff() > 0 ||
         pressure.col(0).maxCoeff() > 0 || pressure.rightCols(1).maxCoeff() > 0;
}

}  // namespace

Field point_height(const PointProblem& problem) {
  const Eigen::ArrayXd x = point_x(problem);
  const Eigen::ArrayXd y = point_y(problem);
  Field height = -(x.square() / (2 * problem.radius_x)).transpose().replicate(y.size(), 1) -
                 (y.square() / (2 * problem.radius_y)).replicate(1, x.size());
  if (problem.roughness.size() > 0) height += problem.roughness;
  return height;
}

PointResult solve_point_dry(const PointProblem& problem, const Observer& observer) {
  check_point(problem);
  PointResult result;
  result.grid = point_grid(problem);
  const contact::Problem dry{.height = point_height(problem),
                             .control = contact::Force{problem.load},
                             .bounds = {.upper = problem.plastic_pressure},
                             .tolerance = kCertificate * problem.tolerance};
  const auto half_space = elastic::make_free(result.grid, problem.effective_modulus);
  const contact::State state = contact::solve(*half_space, dry, contact::Solver::fast, observer);
  result.pressure = Field::Zero(result.grid.ny, result.grid.nx);
  result.contact_pressure = state.pressure;
  result.film = state.gap.max(0.0);
  if (std::isfinite(problem.plastic_pressure)) result.plastic_depth = (-state.gap).max(0.0);
  result.separation = state.separation;
  result.load_error = std::abs(sum(state.pressure) * result.grid.pixel_area() / problem.load - 1);
  result.convergence = state.convergence;
  if (reaches_border(state.pressure)) {
    result.warnings.push_back({"dry-contact", "The dry contact reaches the border of the domain"});
  }
  return result;
}

}  // namespace tabor::ehl
