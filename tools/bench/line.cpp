// Counts and times of the line contact on one thread.
//
//   bench_line [NODES...]             (default 300 600 1000 4000)
//
// Table 6 of Akchurin's thesis, HDPE on steel. plain: Newton's method with a full matrix and its
// factors, up to 1000 nodes; tabor: differential deflection with the whole kernel in every
// residual and product. Both in turns, the faster of three. Then one cycle of wear in 600 steps.
#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "ehl/line/akchurin.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/ehl/line/wear.hpp"
#include "tabor/ehl/plain.hpp"

namespace {

using namespace tabor;

constexpr Index kLargestPlain = 1000;
constexpr int kRepeats = 3;

ehl::LineProblem table_6(Index nodes) {
  ehl::LineProblem problem = test::table_6();
  problem.nodes = nodes;
  return problem;
}

void print_row(Index nodes, const char* way, const ehl::LineResult& result, double seconds) {
  fmt::print("{:>6} {:<6} {:>9.3f} {:>10} {:>9} {:>9.4f}\n", nodes, way, result.min_film * 1e9,
             result.convergence.iterations, result.convergence.operator_applications, seconds);
}

void compare(Index nodes) {
  ehl::LineResult results[2];
  double seconds[2] = {1e9, 1e9};
  const int first = nodes <= kLargestPlain ? 0 : 1;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    for (int way = first; way < 2; ++way) {
      const ehl::LineProblem problem = table_6(nodes);
      const Stopwatch watch;
      results[way] = way == 0 ? ehl::solve_line_plainly(problem) : ehl::solve_line(problem);
      seconds[way] = std::min(seconds[way], watch.seconds());
    }
  }
  if (first == 0) print_row(nodes, "plain", results[0], seconds[0]);
  print_row(nodes, "tabor", results[1], seconds[1]);
}

void wear_one_cycle() {
  ehl::WearProblem problem;
  problem.contact = table_6(1000);
  problem.wear_coefficient = 2.8e-15;
  problem.track_length = 2 * std::numbers::pi * problem.contact.radius;
  problem.cycles_each = 3600;
  const Stopwatch watch;
  const ehl::WearResult result = ehl::solve_wear(problem);
  fmt::print("\nwear, 1000 nodes: {} steps, {} iterations, {:.2f} s{}\n", result.history.size() - 1,
             result.convergence.iterations, watch.seconds(),
             result.convergence.converged() ? "" : ", not converged");
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  std::vector<Index> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::stol(argv[i]));
  if (sizes.empty()) sizes = {300, 600, 1000, 4000};
  fmt::print("{:>6} {:<6} {:>9} {:>10} {:>9} {:>9}\n", "nodes", "way", "film nm", "iterations",
             "products", "seconds");
  for (const Index nodes : sizes) compare(nodes);
  wear_one_cycle();
  return 0;
}
