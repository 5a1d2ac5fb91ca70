#include "tabor/ehl/point/accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::ehl {
namespace {

constexpr double kSmallError = 0.01;
constexpr double kShape = 1.5;        // of a chosen domain: the inlet over the half width
constexpr double kInlets = 6;         // a chosen inlet is at least so many lengths sqrt(2 R h) long
constexpr Index kMostNodes = 1025;    // along x of a chosen grid
constexpr double kFarPressure = 9.6;  // p r^4 / (eta u_m R^2 |x|)

/// [m] Central film of smooth bodies, no less than the boundary film.
double film_of(const PointProblem& problem) {
  const reference::PointContactFilm groups = film_groups_of(problem);
  const double smooth = groups.nijenbanning_central();
  const double film = std::isfinite(smooth) ? smooth : groups.hamrock_dowson_central();
  return std::max(film, problem.asperities.boundary_film);
}

double ratio_of(const PointProblem& problem) { return problem.radius_x / problem.radius_y; }

/// -d ln Hc / d ln M at constant L; that of a sphere where the formula does not hold.
double load_exponent(const PointProblem& problem) {
  constexpr double step = 0.01;
  const reference::PointContactFilm groups = film_groups_of(problem);
  const double ratio = std::min(1.0, ratio_of(problem));
  const auto film = [&](double factor) {
    return reference::nijenbanning_central_film(factor * groups.moes_load(),
                                                groups.moes_viscosity(), ratio);
  };
  return std::log(film(1 - step) / film(1 + step)) / std::log((1 + step) / (1 - step));
}

/// Integral of cos(theta) / distance to the border over the inlet's half of a rectangle that
/// reaches `ahead` before the centre and `aside` to either side.
double beyond(double ahead, double aside) {
  const double corner = std::atan2(aside, ahead);
  const double front = corner / 2 + std::sin(2 * corner) / 4;
  const double sides = std::cos(corner) * std::cos(corner) / 2;
  return 2 * (front / ahead + sides / aside);
}

/// What film and load of a problem are measured by.
struct Scales {
  double length_x, length_y;  ///< sqrt(2 R h) [m]
  double axis_x, axis_y;      ///< of the dry contact [m]
  double share;               ///< error of the film over beyond() of a domain in those lengths

  explicit Scales(const PointProblem& problem) {
    const double film = film_of(problem);
    const reference::HertzEllipse hertz = hertz_of(problem);
    axis_x = hertz.half_axis_x;
    axis_y = hertz.half_axis_y;
    length_x = std::sqrt(2 * problem.radius_x * film);
    length_y = std::sqrt(2 * problem.radius_y * film);
    const double viscosity = material::ambient_viscosity(problem.lubricant.viscosity);
    const double load = kFarPressure * viscosity * problem.entrainment_speed * problem.radius_x *
                        problem.radius_y / length_x;
    share = load_exponent(problem) * load / problem.load;
  }

  /// [m] over which the film is built up: where the gap of Hertz is as large as the film.
  double inlet(const PointProblem& problem) const {
    const double elastic =
        std::pow(film_of(problem) * problem.radius_x / (axis_x * axis_x), 2.0 / 3) * axis_x;
    return std::min(elastic, length_x);
  }
};

double grid_coefficient(const PointProblem& problem) {
  const double newtonian = std::min(0.2, 0.09 + 0.022 * film_groups_of(problem).moes_viscosity());
  const bool is_newtonian =
      material::law_of(problem.lubricant.shear) == material::ShearLaw::newtonian;
  const bool thins = !is_newtonian && problem.sliding_speed != 0;
  return (thins ? 2.5 : 1) * newtonian;
}

}  // namespace

double point_grid_error(const PointProblem& problem) {
  const double spacing = point_grid(problem).dx();
  const double nodes = Scales(problem).inlet(problem) / spacing;
  const double coefficient = grid_coefficient(problem);
  return coefficient / (nodes * nodes + 1.65 * coefficient);
}

double point_domain_error(const PointProblem& problem) {
  const Scales scales(problem);
  return scales.share * beyond(problem.inlet * scales.axis_x / scales.length_x,
                               problem.half_width * scales.axis_y / scales.length_y);
}

PointProblem with_domain_chosen(PointProblem problem, bool chooses_nodes, double most_axes) {
  const Scales scales(problem);
  const double aside = scales.share * beyond(kShape, 1) / kSmallError;  // in lengths
  const double x = scales.length_x / scales.axis_x;
  const double y = scales.length_y / scales.axis_y;
  const double spacing_x = point_grid(problem).dx();
  const double spacing_y = point_grid(problem).dy();
  problem.inlet =
      std::min(most_axes, std::max({problem.inlet, kShape * aside * x, 1 + kInlets * x}));
  problem.half_width = std::min(most_axes, std::max(problem.half_width, aside * y));
  problem.outlet = std::min(most_axes, std::max(problem.outlet, 1 + x));
  if (!chooses_nodes) return problem;
  const double coefficient = grid_coefficient(problem);
  const double needed =
      std::sqrt(coefficient / kSmallError - 1.65 * coefficient);  // nodes in the inlet
  const double length = (problem.inlet + problem.outlet) * scales.axis_x;
  const double width = 2 * problem.half_width * scales.axis_y;
  const double spacing =
      std::max(scales.inlet(problem) / needed, length / static_cast<double>(kMostNodes - 1));
  problem.nodes_x = 1 + static_cast<Index>(std::ceil(length / spacing));
  problem.nodes_y = 1 + static_cast<Index>(std::ceil(width / (spacing * spacing_y / spacing_x)));
  return problem;
}

}  // namespace tabor::ehl
