// Seconds of a lubricated impact: rows of the table of Larsson & Höglund 1994.
//
//   bench_impact [nodes] [--baseline]     --baseline: one factorization per Newton iteration beside
//   it
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "tabor/core/resources.hpp"
#include "tabor/ehl/impact/impact.hpp"
#include "tabor/ehl/plain.hpp"

namespace {

using namespace tabor;

struct Row {
  int number;
  double layer, speed, mass, material;  ///< H00, V0, M, G
};

constexpr Row kRows[] = {
    {1, 0.005, 1.30e-12, 7.475e13, 3500},   {3, 0.005, 8.70e-12, 7.475e13, 3500},
    {5, 0.005, 43.5e-12, 7.475e13, 3500},   {7, 0.005, 8.70e-12, 1.49e13, 3500},
    {9, 0.005, 8.70e-12, 0.75e13, 3500},    {11, 0.005, 8.70e-12, 7.475e13, 4600},
    {16, 0.00125, 8.70e-12, 7.475e13, 3500}};

/// The R, E' and eta0 that all of the table follows from.
ehl::ImpactProblem problem_of(const Row& row, Index nodes) {
  constexpr double kRadius = 0.01;
  constexpr double kModulus = 230e9;
  constexpr double kViscosity = 0.1;
  ehl::ImpactProblem problem;
  problem.radius = kRadius;
  problem.effective_modulus = kModulus / 2;
  problem.layer = row.layer * kRadius;
  problem.speed = row.speed * kModulus * kRadius / kViscosity;
  problem.mass = row.mass * kRadius * kViscosity * kViscosity / kModulus;
  problem.lubricant.viscosity = material::roelands_viscosity(kViscosity, row.material / kModulus);
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.nodes = nodes;
  return problem;
}

void measure(const Row& row, Index nodes, bool plain) {
  const Stopwatch watch;
  const ehl::ImpactProblem problem = problem_of(row, nodes);
  const ehl::ImpactResult result =
      plain ? ehl::solve_impact_plainly(problem) : ehl::solve_impact(problem);
  fmt::print("{:>3} {:<6} {:>5} {:>5} {:>6} {:>6} {:>8} {:>7.2f} {:>7.4f}\n", row.number,
             plain ? "plain" : "kept", nodes, result.n_steps, result.count.newton_iterations,
             result.count.n_factorizations, result.count.n_products, watch.seconds(),
             result.restitution);
}

}  // namespace

int main(int argc, char** argv) {
  Index nodes = 300;
  bool baseline = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--baseline") {
      baseline = true;
    } else {
      nodes = std::atoi(argv[i]);
    }
  }
  fmt::print("row factors nodes steps newton  facts products       s       e\n");
  for (const Row& row : kRows) {
    measure(row, nodes, false);
    if (baseline) measure(row, nodes, true);
  }
}
