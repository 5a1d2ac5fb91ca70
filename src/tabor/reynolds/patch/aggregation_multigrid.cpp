#include "tabor/reynolds/patch/aggregation_multigrid.hpp"

#include <algorithm>
#include <utility>

namespace tabor::reynolds {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kCoarsestSize = 100;
constexpr double kStrong = 0.25;         // of a node's largest coupling
constexpr double kLeastShrinking = 0.8;  // coarsening that gains less than this has ended

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Groups of nodes, counted from zero in the order of their first nodes.
struct Aggregates {
  std::vector<std::int32_t> of;
  Index count = 0;
};

/// Each node with its free neighbour of strongest coupling; one that finds none free joins the
/// group of the strongest.
Aggregates pairs_of(const CouplingMatrix& matrix) {
  const Index n = matrix.size();
  Aggregates groups{std::vector<std::int32_t>(at(n), -1), 0};
  for (Index node = 0; node < n; ++node) {
    if (groups.of[at(node)] >= 0) continue;
    double strongest = 0;
    double strongest_free = 0;
    std::int32_t partner = -1;
    std::int32_t free_partner = -1;
    matrix.for_neighbours(node, [&](std::int32_t other, double coupling) {
      if (other == node) return;
      if (coupling > strongest) {
        strongest = coupling;
        partner = other;
      }
      if (groups.of[at(other)] < 0 && coupling > strongest_free) {
        strongest_free = coupling;
        free_partner = other;
      }
    });
    if (free_partner >= 0 && strongest_free >= kStrong * strongest) {
      groups.of[at(free_partner)] = static_cast<std::int32_t>(groups.count);
    } else if (partner >= 0 && groups.of[at(partner)] >= 0) {
      groups.of[at(node)] = groups.of[at(partner)];
      continue;
    }
    groups.of[at(node)] = static_cast<std::int32_t>(groups.count++);
  }
  return groups;
}

/// Members of each group, one group after the other.
std::vector<std::int32_t> members_of(const Aggregates& groups, std::vector<std::int32_t>& begin) {
  begin.assign(at(groups.count) + 1, 0);
  for (const std::int32_t group : groups.of) ++begin[at(group) + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<std::int32_t> place(begin.begin(), begin.end() - 1);
  std::vector<std::int32_t> members(groups.of.size());
  for (std::size_t node = 0; node < groups.of.size(); ++node) {
    members[at(place[at(groups.of[node])]++)] = static_cast<std::int32_t>(node);
  }
  return members;
}

/// Galerkin with piecewise constants: couplings between groups add up, those inside vanish.
CouplingMatrix coarsened(const CouplingMatrix& fine, const Aggregates& groups) {
  std::vector<std::int32_t> begin;
  const std::vector<std::int32_t> members = members_of(groups, begin);
  CouplingMatrix coarse;
  coarse.diagonal = VectorXd::Zero(groups.count);
  coarse.begin.reserve(at(groups.count) + 1);
  coarse.neighbour.reserve(fine.neighbour.size() / 2);
  coarse.coupling.reserve(fine.coupling.size() / 2);
  VectorXd lost = coarse.diagonal;                        // by the members one by one
  std::vector<std::int32_t> place(at(groups.count), -1);  // of a neighbour in the row being made
  for (Index group = 0; group < groups.count; ++group) {
    const auto row_begin = static_cast<std::int32_t>(coarse.neighbour.size());
    for (auto k = at(begin[at(group)]); k < at(begin[at(group) + 1]); ++k) {
      const std::int32_t node = members[k];
      coarse.diagonal[group] += fine.diagonal[node];
      lost[group] += fine.diagonal[node];
      fine.for_neighbours(node, [&](std::int32_t other, double coupling) {
        const std::int32_t to = groups.of[at(other)];
        if (to == group) {
          coarse.diagonal[group] -= coupling;
        } else if (place[at(to)] >= row_begin) {
          coarse.coupling[at(place[at(to)])] += coupling;
        } else {
          place[at(to)] = static_cast<std::int32_t>(coarse.neighbour.size());
          coarse.neighbour.push_back(to);
          coarse.coupling.push_back(coupling);
        }
      });
    }
    coarse.begin.push_back(static_cast<std::int32_t>(coarse.neighbour.size()));
  }
  // What is left of a group that loses nothing may cancel to nothing.
  for (Index group = 0; group < groups.count; ++group) {
    if (!(coarse.diagonal[group] > 1e-14 * lost[group])) coarse.diagonal[group] = lost[group];
  }
  return coarse;
}

Eigen::SparseMatrix<double> sparse(const CouplingMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index node = 0; node < matrix.size(); ++node) {
    entries.emplace_back(node, node, matrix.diagonal[node]);
    matrix.for_neighbours(node, [&](std::int32_t other, double coupling) {
      entries.emplace_back(node, other, -coupling);
    });
  }
  Eigen::SparseMatrix<double> full(matrix.size(), matrix.size());
  full.setFromTriplets(entries.begin(), entries.end());
  return full;
}

}  // namespace

AggregationMultigrid::AggregationMultigrid(CouplingMatrix matrix) {
  while (matrix.size() > kCoarsestSize) {
    const Aggregates first = pairs_of(matrix);
    const CouplingMatrix between = coarsened(matrix, first);
    const Aggregates second = pairs_of(between);
    if (static_cast<double>(second.count) > kLeastShrinking * static_cast<double>(matrix.size())) {
      break;
    }
    std::vector<std::int32_t> both(first.of.size());
    for (std::size_t i = 0; i < both.size(); ++i) both[i] = second.of[at(first.of[i])];
    CouplingMatrix coarse = coarsened(between, second);
    add_level(std::exchange(matrix, std::move(coarse)), std::move(both));
  }
  if (matrix.size() > 0) coarsest_.compute(sparse(matrix));
  add_level(std::move(matrix), {});
}

void AggregationMultigrid::add_level(CouplingMatrix matrix, std::vector<std::int32_t> coarse) {
  levels_.push_back({BlockSweeps(std::move(matrix)), std::move(coarse), {}, {}, {}, {}});
}

void AggregationMultigrid::cycle(std::size_t number, const VectorXd& r, VectorXd& z) {
  Level& level = levels_[number];
  const Index n = level.system.size();
  if (n == 0) return;
  if (level.coarse.empty()) {
    z = coarsest_.solve(r);
    return;
  }
  Level& next = levels_[number + 1];
  level.system.smooth_from_zero(r, z, level.rest);
  next.right.setZero(next.system.size());
  for (Index i = 0; i < n; ++i) next.right[level.coarse[at(i)]] += level.rest[i];
  cycle(number + 1, next.right, next.solution);
  if (!next.coarse.empty()) {
    next.system.multiply(next.solution, next.rest);
    next.right -= next.rest;
    cycle(number + 1, next.right, next.second_solution);
    next.solution += next.second_solution;
  }
  for (Index i = 0; i < n; ++i) z[i] += next.solution[level.coarse[at(i)]];
  level.system.relax_backward(r, z);
}

void AggregationMultigrid::apply(const VectorXd& r, VectorXd& z) { cycle(0, r, z); }

}  // namespace tabor::reynolds
