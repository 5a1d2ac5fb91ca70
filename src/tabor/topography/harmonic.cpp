#include "tabor/topography/harmonic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/numerics/conjugate_gradients.hpp"

namespace tabor::topography {
namespace {

using Node = std::int32_t;
constexpr Node kNone = -1;
constexpr double kTolerance = 1e-12;
constexpr int kMaxIterations = 500;
constexpr std::size_t kCoarsest = 4;  // nodes
constexpr int kCoarsestSweeps = 8;
/// Piecewise constant corrections are too small by up to 2; Braess (1995, Computing 55, 379) finds
/// 1.8 best for a V-cycle inside conjugate gradients.
constexpr float kOvercorrection = 1.8F;

/// Missing pixels (or 2 x 2 aggregates of them) as the nodes of a five-point network.
struct Level {
  std::vector<std::array<Node, 4>> neighbours;  // left, right, above, below; kNone = no such node
  std::vector<std::array<float, 4>> weights;    // of these links, >= 0
  std::vector<float> diagonal;                  // sum of all links, those to valid pixels included
  std::vector<std::array<Node, 2>> position;    // x, y
  std::vector<std::array<Node, 4>> children;    // nodes of the finer level, kNone-filled
  std::vector<float> value, right, residual;    // scratch of one V-cycle

  std::size_t size() const { return diagonal.size(); }
  void resize(std::size_t n) {
    neighbours.resize(n, {kNone, kNone, kNone, kNone});
    weights.resize(n, {0, 0, 0, 0});
    diagonal.resize(n, 0);
    position.resize(n);
    value.resize(n);
    right.resize(n);
    residual.resize(n);
  }
};

template <typename Body>
void for_each_node(std::size_t n, const Body& body) {
  parallel_for(static_cast<Index>(n), kBlock, [&body](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) body(i);
  });
}

/// Sum of weight * value over the linked nodes.
template <typename Real>
Real linked_sum(const Level& level, const std::vector<Real>& value, std::size_t i) {
  Real sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Node j = level.neighbours[i][k];
    if (j != kNone) {
      sum += static_cast<Real>(level.weights[i][k]) * value[static_cast<std::size_t>(j)];
    }
  }
  return sum;
}

/// Gauss-Seidel on one colour of the checkerboard: nodes of one colour are not linked, so that the
/// order does not matter.
void relax(Level& level, int colour) {
  for_each_node(level.size(), [&](std::size_t i) {
    if (((level.position[i][0] + level.position[i][1]) & 1) == colour) {
      level.value[i] = (level.right[i] + linked_sum(level, level.value, i)) / level.diagonal[i];
    }
  });
}

void restrict_residual(Level& fine, Level& coarse) {
  for_each_node(fine.size(), [&](std::size_t i) {
    fine.residual[i] =
        fine.right[i] + linked_sum(fine, fine.value, i) - fine.diagonal[i] * fine.value[i];
  });
  for_each_node(coarse.size(), [&](std::size_t p) {
    float sum = 0;
    for (const Node child : coarse.children[p]) {
      sum += child == kNone ? 0 : fine.residual[static_cast<std::size_t>(child)];
    }
    coarse.right[p] = sum;
  });
}

void add_correction(const Level& coarse, Level& fine) {
  for_each_node(coarse.size(), [&](std::size_t p) {
    for (const Node child : coarse.children[p]) {
      if (child != kNone) {
        fine.value[static_cast<std::size_t>(child)] += kOvercorrection * coarse.value[p];
      }
    }
  });
}

/// One symmetric V-cycle from zero: value ~ A^-1 right on the given level.
void cycle(std::vector<Level>& levels, std::size_t depth) {
  Level& level = levels[depth];
  std::fill(level.value.begin(), level.value.end(), 0.0F);
  const bool coarsest = depth + 1 == levels.size();
  const int sweeps = coarsest ? kCoarsestSweeps : 1;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    relax(level, 0);
    relax(level, 1);
  }
  if (!coarsest) {
    restrict_residual(level, levels[depth + 1]);
    cycle(levels, depth + 1);
    add_correction(levels[depth + 1], level);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    relax(level, 1);
    relax(level, 0);
  }
}

/// Joins the nodes of every 2 x 2 block of positions: the Galerkin operator of piecewise constants.
Level aggregate(const Level& fine, Node width) {
  const Node coarse_width = width / 2 + 1;
  Node height = 0;
  for (const auto& [x, y] : fine.position) height = std::max(height, y / 2 + 1);
  std::vector<Node> parent_at(
      static_cast<std::size_t>(coarse_width) * static_cast<std::size_t>(height), kNone);
  std::vector<std::size_t> parent(fine.size());
  Level coarse;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const auto [x, y] = fine.position[i];
    Node& slot =
        parent_at[static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(coarse_width) +
                  static_cast<std::size_t>(x / 2)];
    if (slot == kNone) {
      slot = static_cast<Node>(coarse.children.size());
      coarse.children.push_back({kNone, kNone, kNone, kNone});
      coarse.position.push_back({x / 2, y / 2});
    }
    parent[i] = static_cast<std::size_t>(slot);
    const std::size_t quarter = (y % 2 != 0 ? 2U : 0U) + (x % 2 != 0 ? 1U : 0U);
    coarse.children[parent[i]][quarter] = static_cast<Node>(i);
  }
  coarse.resize(coarse.children.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const std::size_t p = parent[i];
    coarse.diagonal[p] += fine.diagonal[i];
    for (std::size_t k = 0; k < 4; ++k) {
      const Node j = fine.neighbours[i][k];
      if (j == kNone) continue;
      const std::size_t q = parent[static_cast<std::size_t>(j)];
      if (q == p) {
        coarse.diagonal[p] -= fine.weights[i][k];
      } else {
        coarse.neighbours[p][k] = static_cast<Node>(q);
        coarse.weights[p][k] += fine.weights[i][k];
      }
    }
  }
  return coarse;
}

/// Numbers the missing pixels row by row.
Eigen::Array<Node, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> number_holes(
    const Field& height, Level& level) {
  Eigen::Array<Node, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> node(height.rows(),
                                                                           height.cols());
  std::vector<std::array<Node, 2>> position;
  for (Index y = 0; y < height.rows(); ++y) {
    for (Index x = 0; x < height.cols(); ++x) {
      node(y, x) = kNone;
      if (std::isnan(height(y, x))) {
        node(y, x) = static_cast<Node>(position.size());
        position.push_back({static_cast<Node>(x), static_cast<Node>(y)});
      }
    }
  }
  level.resize(position.size());
  level.position = std::move(position);
  return node;
}

/// The equations of the missing pixels; `right` collects the valid neighbours' heights over
/// `datum`.
Level finest_level(const Field& height, const Grid& grid, double datum,
                   std::vector<double>& right) {
  Level level;
  const auto node = number_holes(height, level);
  right.assign(level.size(), 0);
  const auto along_x = static_cast<float>(grid.dy() / grid.dx());
  const std::array<float, 4> weights{along_x, along_x, 1 / along_x, 1 / along_x};
  constexpr std::array<std::array<Index, 2>, 4> steps{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for_each_node(level.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Index x = level.position[i][0] + steps[k][0];
      const Index y = level.position[i][1] + steps[k][1];
      if (x < 0 || y < 0 || x >= height.cols() || y >= height.rows()) {
        continue;  // no flux across the edge of the scan
      }
      level.diagonal[i] += weights[k];
      if (node(y, x) == kNone) {
        right[i] += static_cast<double>(weights[k]) * (height(y, x) - datum);
      } else {
        level.neighbours[i][k] = node(y, x);
        level.weights[i][k] = weights[k];
      }
    }
  });
  return level;
}

std::vector<Level> build_levels(Level finest, Index width) {
  std::vector<Level> levels;
  levels.push_back(std::move(finest));
  auto level_width = static_cast<Node>(width);
  while (levels.back().size() > kCoarsest) {
    levels.push_back(aggregate(levels.back(), level_width));
    level_width = level_width / 2 + 1;
  }
  return levels;
}

/// Counts connected groups of nodes and the size of the largest.
void count_components(const Level& level, HarmonicFill& report) {
  std::vector<bool> seen(level.size(), false);
  std::vector<Node> stack;
  for (std::size_t start = 0; start < level.size(); ++start) {
    go_on_or_throw(start);
    if (seen[start]) continue;
    ++report.n_holes;
    Index size = 0;
    seen[start] = true;
    stack.push_back(static_cast<Node>(start));
    while (!stack.empty()) {
      const auto i = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      ++size;
      for (const Node j : level.neighbours[i]) {
        if (j != kNone && !seen[static_cast<std::size_t>(j)]) {
          seen[static_cast<std::size_t>(j)] = true;
          stack.push_back(j);
        }
      }
    }
    report.largest = std::max(report.largest, size);
  }
}

/// The equations of all levels as a system of conjugate gradients, preconditioned by one cycle.
class Network {
 public:
  explicit Network(std::vector<Level> levels) : levels_(std::move(levels)) {}

  /// Returns the diagonal of the finest level.
  double diagonal(std::size_t i) const { return levels_[0].diagonal[i]; }

  void apply(const std::vector<double>& x, std::vector<double>& image) const {
    const Level& fine = levels_[0];
    for_each(fine.size(), [&](std::size_t i) {
      image[i] = static_cast<double>(fine.diagonal[i]) * x[i] - linked_sum(fine, x, i);
    });
  }

  const std::vector<float>& precondition(const std::vector<double>& residual) {
    Level& fine = levels_[0];
    for_each(fine.size(), [&](std::size_t i) { fine.right[i] = static_cast<float>(residual[i]); });
    cycle(levels_, 0);
    return fine.value;
  }

  template <typename Number>
  static double dot(const std::vector<double>& a, const std::vector<Number>& b) {
    return deterministic_sum(static_cast<Index>(a.size()), [&](Index begin, Index end) {
      double sum = 0;
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        sum += a[i] * static_cast<double>(b[i]);
      }
      return sum;
    });
  }

  template <typename Body>
  static void for_each(std::size_t n, const Body& body) {
    for_each_node(n, body);
  }

 private:
  std::vector<Level> levels_;
};

double largest_per_link(const std::vector<double>& residual, const Network& network) {
  return parallel_max(static_cast<Index>(residual.size()), [&](Index begin, Index end) {
    double largest = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      largest = std::max(largest, std::abs(residual[i]) / network.diagonal(i));
    }
    return largest;
  });
}

/// Stops when the largest residual per link is below `target` [m].
Convergence solve(Network& network, std::vector<double> residual, double target,
                  const Observer& observer, std::vector<double>& solution) {
  Convergence convergence;
  convergence.tolerance = kTolerance;
  const auto is_done = [&](int n_iterations) {
    convergence.iterations = n_iterations;
    convergence.operator_applications = n_iterations;
    convergence.certificate =
        kTolerance * (target > 0 ? largest_per_link(residual, network) / target : 0);
    if (convergence.certificate <= kTolerance) convergence.status = Status::converged;
    if (asks_to_stop(observer, {"fill holes", 0.0, &convergence})) throw Interrupted();
    return convergence.converged() || n_iterations == kMaxIterations;
  };
  solution.assign(residual.size(), 0);
  numerics::conjugate_gradients(network, residual, solution, is_done);
  return convergence;
}

}  // namespace

HarmonicFill fill_harmonic(Field& height, const Grid& grid, const Observer& observer) {
  const Watch watch(observer, "fill holes");
  const double lowest = height.minCoeff<Eigen::PropagateNumbers>();
  const double highest = height.maxCoeff<Eigen::PropagateNumbers>();
  const double datum = (lowest + highest) / 2;
  std::vector<double> right;
  Level finest = finest_level(height, grid, datum, right);
  const auto position = finest.position;
  HarmonicFill report;
  report.n_filled = static_cast<Index>(finest.size());
  count_components(finest, report);
  Network network(build_levels(std::move(finest), grid.nx));
  std::vector<double> solution;
  report.convergence =
      solve(network, std::move(right), kTolerance * (highest - lowest), observer, solution);
  for_each_node(position.size(), [&](std::size_t i) {
    height(position[i][1], position[i][0]) = datum + solution[i];
  });
  return report;
}

}  // namespace tabor::topography
