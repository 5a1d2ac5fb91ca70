#include "tabor/ehl/point/measures.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/parallel.hpp"

namespace tabor::ehl {
namespace {

constexpr double kCentralDisc = 2.0 / 3.0;   // of the half axes
constexpr double kBondStrength = 1.0 / 6.0;  // of P_plast

/// Sum of term(i) over all nodes, with the same bits for any number of threads.
template <typename Term>
double sum_nodes(Index n, const Term& term) {
  return deterministic_sum(n, [&](Index begin, Index end) {
    double partial = 0;
    for (Index i = begin; i < end; ++i) partial += term(i);
    return partial;
  });
}

double value_or_zero(const Field& field, Index i) { return field.size() > 0 ? field(i) : 0.0; }

/// Mean of values over the nodes of an area.
template <typename Value>
double mean_over(const Mask& area, const Value& value) {
  const double total = sum_nodes(area.size(), [&](Index i) { return area(i) ? value(i) : 0.0; });
  return total / static_cast<double>(area.count());
}

bool is_plastic(const PointResult& result, Index i) {
  return value_or_zero(result.plastic_depth, i) > 0;
}

bool touches(const PointResult& result, Index i) {
  return result.film(i) <= 0 || is_plastic(result, i);
}

/// Stress [Pa] of the sheared film at a node, 0 where there is none.
double film_stress(const PointProblem& problem, const PointResult& result, Index i) {
  if (!(result.pressure(i) > 0) || touches(result, i)) return 0;
  const double pressure = result.pressure(i);
  const double rate = problem.sliding_speed / result.film(i);
  const double viscosity = material::viscosity_at(problem.lubricant.viscosity, pressure).value;
  return material::shear_stress(problem.lubricant.shear, viscosity, rate, pressure).value;
}

void measure_films(const PointProblem& problem, const PointResult& result,
                   PointMeasures& measures) {
  const auto film = [&](Index i) { return result.film(i); };
  const Mask hertz = hertz_area(problem);
  measures.mean_central_film = mean_over(hertz_area(problem, kCentralDisc), film);
  measures.min_film = result.film.minCoeff();
  measures.fluid_volume =
      mean_over(hertz, film) * static_cast<double>(hertz.count()) * result.grid.pixel_area();
  Index row = 0;
  Index column = 0;
  point_y(problem).abs().minCoeff(&row);
  point_x(problem).abs().minCoeff(&column);
  measures.film_at_centre = result.film(row, column);
  // One node of a rough surface says nothing.
  const bool is_rough = problem.roughness.size() > 0;
  measures.central_film = is_rough ? measures.mean_central_film : measures.film_at_centre;
}

/// What slides over solids: friction [N] of bonds where they flow and of asperities elsewhere.
double solid_friction(const PointProblem& problem, double carried, double area,
                      double plastic_area) {
  if (problem.sliding_speed == 0) return 0;
  const double bonds =
      plastic_area > 0 ? kBondStrength * problem.plastic_pressure * plastic_area : 0;
  return std::copysign(bonds + problem.asperities.friction(carried, area), problem.sliding_speed);
}

void measure_solids(const PointProblem& problem, const PointResult& result,
                    PointMeasures& measures) {
  const Mask hertz = hertz_area(problem);
  const auto contact_pressure = [&](Index i) { return value_or_zero(result.contact_pressure, i); };
  const auto plastic = [&](Index i) { return is_plastic(result, i) ? 1.0 : 0.0; };
  const auto touching = [&](Index i) { return touches(result, i) ? 1.0 : 0.0; };
  const auto elastic = [&](Index i) { return touching(i) - plastic(i); };
  const Index n = result.film.size();
  const double cell = result.grid.pixel_area();
  measures.contact_load_share = cell * sum_nodes(n, contact_pressure) / problem.load;
  measures.solid_contact_fraction = mean_over(hertz, touching);
  measures.plastic_fraction = mean_over(hertz, plastic);
  for (Index i = 0; i < n; ++i) {
    measures.max_pressure =
        std::max(measures.max_pressure, result.pressure(i) + contact_pressure(i));
    measures.max_plastic_depth =
        std::max(measures.max_plastic_depth, value_or_zero(result.plastic_depth, i));
  }
  const double carried =
      cell * sum_nodes(n, [&](Index i) { return elastic(i) * contact_pressure(i); });
  const double area = carried > 0 ? cell * sum_nodes(n, elastic) : 0;
  measures.boundary_load_share = carried / problem.load;
  measures.friction_solid =
      solid_friction(problem, carried, area, cell * sum_nodes(n, plastic)) / problem.load;
}

}  // namespace

Mask hertz_area(const PointProblem& problem, double scale) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  const Eigen::ArrayXd x = point_x(problem) / (scale * hertz.half_axis_x);
  const Eigen::ArrayXd y = point_y(problem) / (scale * hertz.half_axis_y);
  return x.square().transpose().replicate(y.size(), 1) + y.square().replicate(1, x.size()) <= 1.0;
}

PointMeasures measure_point(const PointProblem& problem, const PointResult& result) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  PointMeasures measures;
  measures.hertz_radius = std::sqrt(hertz.half_axis_x * hertz.half_axis_y);
  measures.hertz_pressure = hertz.max_pressure;
  measure_films(problem, result, measures);
  measure_solids(problem, result, measures);
  const auto stress = [&](Index i) { return film_stress(problem, result, i); };
  measures.friction_fluid =
      result.grid.pixel_area() * sum_nodes(result.film.size(), stress) / problem.load;
  for (Index i = 0; i < result.film.size(); ++i) {
    measures.max_shear_stress = std::max(measures.max_shear_stress, std::abs(stress(i)));
  }
  measures.friction_coefficient = measures.friction_fluid + measures.friction_solid;
  return measures;
}

Mask touching_nodes(const PointResult& result) {
  Mask nodes(result.film.rows(), result.film.cols());
  for (Index i = 0; i < nodes.size(); ++i) nodes(i) = touches(result, i);
  return nodes;
}

std::vector<double> slice_plane(const PointProblem& problem, const PointResult& result,
                                const std::vector<double>& levels) {
  const Mask hertz = hertz_area(problem);
  std::vector<double> films;
  films.reserve(static_cast<std::size_t>(hertz.count()));
  for (Index i = 0; i < hertz.size(); ++i) {
    if (hertz(i)) films.push_back(touches(result, i) ? 0 : result.film(i));
  }
  std::sort(films.begin(), films.end());
  std::vector<double> shares;
  shares.reserve(levels.size());
  for (const double level : levels) {
    const auto below = std::upper_bound(films.begin(), films.end(), level) - films.begin();
    shares.push_back(static_cast<double>(below) / static_cast<double>(films.size()));
  }
  return shares;
}

}  // namespace tabor::ehl
