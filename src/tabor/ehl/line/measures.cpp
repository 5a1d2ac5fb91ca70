#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/units.hpp"
#include "tabor/ehl/film.hpp"
#include "tabor/ehl/line/film.hpp"
#include "tabor/ehl/line/line.hpp"

namespace tabor::ehl {
namespace {

constexpr double kFewestInletNodes = 0.1;
constexpr double kInletLengths = 4;  // sqrt(2 R h) before the contact: less may starve it
/// Rounding may leave a trace of pressure in the cavity: the film ends before it.
constexpr double kFilmEnd = 1e-6;
constexpr double kSharp =
    0.03;  // of the pressure: peaks that bend less are within a per cent of those on finer grids

/// Nodes in the inlet over which a film [m] is built up, where the gap of Hertz is as large as it.
double inlet_nodes(const LineProblem& problem, double film, double spacing) {
  const double half_width = hertz_of(problem).half_width;
  const double elastic =
      std::pow(film * problem.radius / (half_width * half_width), 2.0 / 3) * half_width;
  return std::min(elastic, std::sqrt(2 * problem.radius * film)) / spacing;
}

/// True if the pressure bends between the neighbours of a node by more than a grid can show.
bool is_sharp(const Eigen::ArrayXd& pressure, Index i) {
  if (i == 0 || i + 1 >= pressure.size()) return false;
  const double mean = (pressure[i - 1] + pressure[i + 1]) / 2;
  return std::abs(pressure[i] - mean) > kSharp * pressure[i];
}

/// [Pa] The largest pressure before the spike at the end of the film, which grows with the number
/// of nodes; that of all nodes where the grid shows the spike, or there is none.
double pressure_before_spike(const LineResult& result) {
  Index highest = 0;
  const double largest = result.pressure.maxCoeff(&highest);
  if (!(result.x[highest] > 0) || !is_sharp(result.pressure, highest)) return largest;
  Index foot = highest;  // the spike begins in the valley before it
  while (foot > 0 && result.pressure[foot - 1] < result.pressure[foot]) --foot;
  const double before = result.pressure.head(foot + 1).maxCoeff();
  return before > result.pressure[foot] ? before : largest;  // no valley, no spike
}

Warnings warnings_of(const LineProblem& problem, const LineResult& result) {
  Warnings warnings = material::warnings(problem.lubricant, result.max_pressure_before_spike);
  if (result.max_pressure_before_spike < result.pressure.maxCoeff()) {
    warnings.push_back(
        {"pressure-spike",
         fmt::format("The largest pressure is a spike at the outlet that grows with the number of "
                     "nodes. Without it the pressure is {}",
                     si(result.max_pressure_before_spike, "Pa")),
         result.pressure.maxCoeff() / result.max_pressure_before_spike});
  }
  const double film =
      std::max(film_groups_of(problem).moes_min_film(), problem.asperities.boundary_film);
  const double nodes = inlet_nodes(problem, film, result.x[1] - result.x[0]);
  if (nodes < 2) {
    warnings.push_back(
        {"coarse-grid",
         fmt::format("Only {:.2g} nodes lie where the film builds up, so its thickness is "
                     "uncertain. Use {:.2g} times as many",
                     nodes, 3 / nodes),
         1 / nodes});
  }
  const double half_width = hertz_of(problem).half_width;
  const double inlet = (-result.x[0] - half_width) / std::sqrt(2 * problem.radius * film);
  if (inlet < kInletLengths) warnings.push_back(short_inlet(inlet));
  return warnings;
}

bool touches(const LineResult& result, Index i) {
  return result.asperity_pressure.size() > 0 && result.asperity_pressure[i] > 0;
}

/// Friction of the film [N/m], its stress and where it ends.
double measure_liquid(const LineProblem& problem, LineResult& result) {
  material::NodeLaws laws;
  const auto n = static_cast<std::size_t>(result.pressure.size());
  material::evaluate(problem.lubricant, {result.pressure.data(), n}, laws);
  const double film_end = kFilmEnd * result.pressure.maxCoeff();
  double force = 0;
  for (Index i = 0; i < result.x.size(); ++i) {
    if (!(result.pressure[i] > 0)) continue;
    if (result.pressure[i] > film_end) result.rupture = result.x[i];
    if (touches(result, i)) continue;
    const double rate = problem.sliding_speed / result.film[i];
    const double stress =
        material::shear_stress(problem.lubricant.shear, laws.viscosity[i], rate, result.pressure[i])
            .value;
    result.shear_stress[i] = stress;
    force += (result.x[1] - result.x[0]) * stress;
    result.max_shear_stress = std::max(result.max_shear_stress, std::abs(stress));
  }
  return force;
}

/// [Pa] of both, p + P.
Eigen::ArrayXd whole_pressure(const LineResult& result) {
  if (result.asperity_pressure.size() == 0) return result.pressure;
  return result.pressure + result.asperity_pressure;
}

/// Stress of solids where they touch, and stress over pressure.
void measure_local_friction(const LineProblem& problem, LineResult& result) {
  const double sign = problem.sliding_speed == 0 ? 0 : std::copysign(1, problem.sliding_speed);
  for (Index i = 0; i < result.x.size(); ++i) {
    if (!touches(result, i)) continue;
    const double stress = problem.asperities.friction(result.asperity_pressure[i], 1);
    result.shear_stress[i] = sign == 0 ? 0 : sign * stress;
  }
  const Eigen::ArrayXd pressure = whole_pressure(result);
  result.local_friction = (pressure > 0).select(result.shear_stress / pressure, 0.0);
}

/// Load and width that asperities carry; their friction [N/m].
double measure_asperities(const LineProblem& problem, LineResult& result) {
  if (result.asperity_pressure.size() == 0) return 0;
  const double spacing = result.x[1] - result.x[0];
  const double carried = spacing * result.asperity_pressure.sum();
  result.asperity_load_share = carried / problem.load;
  result.contact_width = spacing * static_cast<double>((result.asperity_pressure > 0).count());
  const double force = problem.asperities.friction(carried, result.contact_width);
  return problem.sliding_speed == 0 ? 0 : std::copysign(force, problem.sliding_speed);
}

/// The largest value where `inside`; NaN if one of them is.
double largest(const Eigen::ArrayXd& values, const Eigen::Array<bool, Eigen::Dynamic, 1>& inside) {
  return inside.select(values, 0.0).maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace

bool sees_inlet(const LineProblem& problem, const Eigen::ArrayXd& x, const Eigen::ArrayXd& film) {
  const double spacing = x[1] - x[0];
  const double half_width = std::max(spacing, hertz_of(problem).half_width);
  const Eigen::ArrayXd inside = (x.abs() <= half_width).cast<double>();
  const double thickness = (inside * film).sum() / inside.sum();
  const double thinnest = film.minCoeff();
  if (problem.asperities.boundary_film >= (1 - 1e-3) * thinnest) return thinnest > 0;
  return thinnest > 0 && inlet_nodes(problem, thickness, spacing) >= kFewestInletNodes;
}

AsperityEffect asperity_effect(const LineResult& rough, const LineResult& smooth, double width,
                               double place) {
  const Eigen::Array<bool, Eigen::Dynamic, 1> inside = (rough.x - place).abs() <= width / 2;
  return {.local_friction = largest(rough.local_friction.abs(), inside),
          .smooth_local_friction = largest(smooth.local_friction.abs(), inside),
          .max_pressure = largest(whole_pressure(rough), inside),
          .smooth_max_pressure = largest(whole_pressure(smooth), inside)};
}

void measure_line(const LineProblem& problem, LineResult& result) {
  const bool touches_somewhere = (result.asperity_pressure > 0).any();
  result.min_film = touches_somewhere ? result.film.minCoeff() : smallest_film(result.film);
  result.central_film = value_between_nodes(result.x, result.film, 0);
  result.max_pressure = whole_pressure(result).maxCoeff();
  result.max_pressure_before_spike =
      problem.roughness.size() > 0 ? result.pressure.maxCoeff() : pressure_before_spike(result);
  result.shear_stress.setZero(result.x.size());
  const double liquid = measure_liquid(problem, result);
  const double solid = measure_asperities(problem, result);
  measure_local_friction(problem, result);
  result.friction_force = liquid + solid;
  result.friction_coefficient = result.friction_force / problem.load;
  result.friction_fluid = liquid / problem.load;
  result.friction_solid = solid / problem.load;
  result.warnings = warnings_of(problem, result);
}

}  // namespace tabor::ehl
