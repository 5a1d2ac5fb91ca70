// Counts and times of the point contact on one thread and on two.
//
//   bench_point [NODES...]             (default 65 129 257 513)
//
// M = 200, L = 10, Roelands and Dowson-Higginson: smooth, and with waves of all directions of 0.3
// times the film. plain: sparse factors of the local equations in each Newton iteration, up to 129
// nodes; tabor: one V-cycle of multigrid. Films agree; iterations are those of all grids together.
#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/ehl/plain.hpp"
#include "tabor/ehl/point/point.hpp"

namespace {

using namespace tabor;
using namespace std::string_view_literals;

constexpr Index kLargestPlain = 129;

ehl::PointProblem smooth_case(Index nodes) {
  constexpr double kAlpha = 2.2e-8;
  constexpr double kReducedModulus = 2.26e11;
  const double viscosity = std::exp(kAlpha / (5.1e-9 * 0.6) - 9.67);
  const double twice_speed_group = std::pow(10 / (kAlpha * kReducedModulus), 4);
  ehl::PointProblem problem;
  problem.radius_x = problem.radius_y = 0.01;
  problem.effective_modulus = kReducedModulus / 2;
  problem.load = 200 * std::pow(twice_speed_group, 0.75) * kReducedModulus * 1e-4;
  problem.entrainment_speed = twice_speed_group / 2 * kReducedModulus * 0.01 / viscosity;
  problem.lubricant.viscosity = material::roelands_viscosity(viscosity, kAlpha);
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.nodes_x = problem.nodes_y = nodes;
  return problem;
}

/// Waves of 0.15 to 0.45 half axes, their rms 0.3 times the film.
ehl::PointProblem rough_case(Index nodes) {
  constexpr int kWaves = 100;
  ehl::PointProblem problem = smooth_case(nodes);
  const CounterRandom random(1);
  const double half_axis = ehl::hertz_of(problem).half_axis_x;
  const Eigen::ArrayXd x = ehl::point_x(problem);
  const Eigen::ArrayXd y = ehl::point_y(problem);
  problem.roughness = Field::Zero(nodes, nodes);
  for (std::uint64_t k = 0; k < kWaves; ++k) {
    const double wavelength = half_axis * (0.15 + 0.3 * random.uniform(3 * k));
    const double q = 2 * std::numbers::pi / wavelength;
    const double direction = 2 * std::numbers::pi * random.uniform(3 * k + 1);
    const double phase = 2 * std::numbers::pi * random.uniform(3 * k + 2);
    for (Index j = 0; j < nodes; ++j) {
      problem.roughness.row(j) +=
          (q * (x * std::cos(direction) + y[j] * std::sin(direction)) + phase).cos().transpose();
    }
  }
  const double film = ehl::film_groups_of(problem).nijenbanning_central();
  problem.roughness *= 0.3 * film / std::sqrt(kWaves / 2.0);
  return problem;
}

void solve(const char* surface, const char* way, int threads, const ehl::PointProblem& problem) {
  set_thread_count(threads);
  const Stopwatch watch;
  const ehl::PointResult result =
      way == "plain"sv ? ehl::solve_point_plainly(problem) : ehl::solve_point(problem);
  const double seconds = watch.seconds();
  fmt::print("{:>6} {:<7} {:<6} {:>7} {:>9.3f} {:>10} {:>6} {:>9} {:>9.2f}{}\n", problem.nodes_x,
             surface, way, threads, result.film.minCoeff() * 1e9, result.convergence.iterations,
             result.n_linear_iterations, result.convergence.operator_applications, seconds,
             result.convergence.converged() ? "" : " not converged");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Index> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::stol(argv[i]));
  if (sizes.empty()) sizes = {65, 129, 257, 513};
  fmt::print("{:>6} {:<7} {:<6} {:>7} {:>9} {:>10} {:>6} {:>9} {:>9}\n", "nodes", "surface", "way",
             "threads", "film nm", "iterations", "GMRES", "products", "seconds");
  for (const Index nodes : sizes) {
    const ehl::PointProblem problem = smooth_case(nodes);
    if (nodes <= kLargestPlain) solve("smooth", "plain", 1, problem);
    for (const int threads : {1, 2}) solve("smooth", "tabor", threads, problem);
    if (nodes < 200) continue;  // shorter waves than the grid shows
    for (const int threads : {1, 2}) solve("rough", "tabor", threads, rough_case(nodes));
  }
  return 0;
}
