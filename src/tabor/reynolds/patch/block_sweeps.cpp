#include "tabor/reynolds/patch/block_sweeps.hpp"

#include <algorithm>
#include <utility>

#include "tabor/core/parallel.hpp"

namespace tabor::reynolds {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kNodesOfBlock = 1 << 13;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sum of the couplings [begin, end) times the values of their neighbours.
double drawn(const double* coupling, const std::int32_t* neighbour, std::int32_t begin,
             std::int32_t end, const double* x) {
  double total = 0;
  for (std::int32_t k = begin; k < end; ++k) total += coupling[k] * x[neighbour[k]];
  return total;
}

}  // namespace

BlockSweeps::BlockSweeps(CouplingMatrix matrix) {
  rows_.resize(at(matrix.size()) + 1);
  for (Index node = 0; node < matrix.size(); ++node) sort_row(node, matrix);
  rows_.back().begin = matrix.begin.back();
  neighbour_ = std::move(matrix.neighbour);
  coupling_ = std::move(matrix.coupling);
  diagonal_ = std::move(matrix.diagonal);
  inverse_ = diagonal_.cwiseInverse();
}

/// In the row of a node: neighbours before it in its block, ascending; those after it, descending;
/// those in other blocks. Divides their couplings by the diagonal.
void BlockSweeps::sort_row(Index node, CouplingMatrix& matrix) {
  const auto block_begin = static_cast<std::int32_t>(node / kNodesOfBlock * kNodesOfBlock);
  const auto block_end = static_cast<std::int32_t>(block_begin + kNodesOfBlock);
  const auto part = [&](std::int32_t other) {
    return other < block_begin || other >= block_end ? 2 : other < node ? 0 : 1;
  };
  std::vector<std::pair<std::int32_t, double>> links;
  matrix.for_neighbours(node, [&](std::int32_t other, double coupling) {
    links.emplace_back(other, coupling / matrix.diagonal[node]);
  });
  std::stable_sort(links.begin(), links.end(), [&](const auto& a, const auto& b) {
    const int part_a = part(a.first);
    const int part_b = part(b.first);
    if (part_a != part_b) return part_a < part_b;
    return part_a == 1 ? a.first > b.first : a.first < b.first;
  });
  Row& row = rows_[at(node)];
  row.begin = row.later = row.outer = matrix.begin[at(node)];
  for (std::size_t i = 0; i < links.size(); ++i) {
    matrix.neighbour[at(row.begin) + i] = links[i].first;
    matrix.coupling[at(row.begin) + i] = links[i].second;
    row.later += part(links[i].first) < 1 ? 1 : 0;
    row.outer += part(links[i].first) < 2 ? 1 : 0;
  }
  if (row.outer < matrix.begin[at(node) + 1]) {
    outer_rows_.push_back(static_cast<std::int32_t>(node));
  }
}

void BlockSweeps::multiply(const VectorXd& x, VectorXd& y) const {
  y.resize(size());
  parallel_for(size(), kNodesOfBlock, [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      const double flow = drawn(coupling_.data(), neighbour_.data(), rows_[at(node)].begin,
                                rows_[at(node) + 1].begin, x.data());
      y[node] = diagonal_[node] * (x[node] - flow);
    }
  });
}

void BlockSweeps::smooth_from_zero(const VectorXd& right, VectorXd& x, VectorXd& rest) const {
  x.resize(size());
  rest.resize(size());
  parallel_for(size(), kNodesOfBlock, [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      const Row& row = rows_[at(node)];
      double total = right[node] * inverse_[node];
      for (std::int32_t k = row.begin; k < row.later; ++k) {
        total += coupling_[at(k)] * x[neighbour_[at(k)]];
      }
      x[node] = total;
    }
  });
  parallel_for(size(), kNodesOfBlock, [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      rest[node] =
          diagonal_[node] * drawn(coupling_.data(), neighbour_.data(), rows_[at(node)].later,
                                  rows_[at(node) + 1].begin, x.data());
    }
  });
}

void BlockSweeps::relax_backward(const VectorXd& right, VectorXd& x) const {
  std::vector<double> from_outer(outer_rows_.size());
  for (std::size_t i = 0; i < outer_rows_.size(); ++i) {
    const auto node = at(outer_rows_[i]);
    from_outer[i] = drawn(coupling_.data(), neighbour_.data(), rows_[node].outer,
                          rows_[node + 1].begin, x.data());
  }
  parallel_for(size(), kNodesOfBlock, [&](Index begin, Index end) {
    auto outer = static_cast<std::size_t>(
        std::lower_bound(outer_rows_.begin(), outer_rows_.end(), static_cast<std::int32_t>(end)) -
        outer_rows_.begin());
    for (Index node = end - 1; node >= begin; --node) {
      const Row& row = rows_[at(node)];
      double total = right[node] * inverse_[node];
      if (outer > 0 && outer_rows_[outer - 1] == node) total += from_outer[--outer];
      for (std::int32_t k = row.begin; k < row.outer; ++k) {
        total += coupling_[at(k)] * x[neighbour_[at(k)]];
      }
      x[node] = total;
    }
  });
}

}  // namespace tabor::reynolds
