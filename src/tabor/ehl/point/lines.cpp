#include "tabor/ehl/point/lines.hpp"

#include <algorithm>
#include <utility>

namespace tabor::ehl {
namespace {

constexpr Index kUpstream = PointLocal::kUpstream;
constexpr Index kDownstream = PointLocal::kDownstream;
constexpr Index kSide = PointLocal::kSide;

/// Coefficients of q(j + dy, i + dx), dx from kUpstream nodes upstream on.
const double* row_of(const PointLocal& local, Index j, Index i, Index dy) {
  return local.coefficients(j, i) + (dy + kSide) * PointLocal::kRow;
}

numerics::BandedLu line_matrix(const PointLocal& local, Index j) {
  numerics::BandedLu line(local.nx(), kUpstream, kDownstream);
  for (Index i = 0; i < local.nx(); ++i) {
    if (local.held()(j, i)) {
      line.at(i, i) = 1;
      continue;
    }
    const double* const row = row_of(local, j, i, 0);
    for (Index dx = -std::min(i, kUpstream); dx <= kDownstream && i + dx < local.nx(); ++dx) {
      line.at(i, i + dx) = row[dx + kUpstream];
    }
  }
  return line;
}

/// What the unknowns of another line add to the balance of node (j, i).
double part_of_line(const PointLocal& local, Index j, Index i, Index dy, const Field& q) {
  const double* const row = row_of(local, j, i, dy);
  double sum = 0;
  for (Index dx = -std::min(i, kUpstream); dx <= kDownstream && i + dx < local.nx(); ++dx) {
    sum += row[dx + kUpstream] * q(j + dy, i + dx);
  }
  return sum;
}

}  // namespace

PointLines::PointLines(PointLocal local) : local_(std::move(local)) {
  lines_.reserve(static_cast<std::size_t>(local_.ny()));
  for (Index j = 0; j < local_.ny(); ++j) {
    lines_.push_back(line_matrix(local_, j));
    ok_ = lines_.back().factorise() && ok_;
  }
}

void PointLines::solve_line(Index j, const Field& right, Field& q) const {
  for (Index i = 0; i < local_.nx(); ++i) {
    double& rest = q(j, i);
    rest = 0;
    if (local_.held()(j, i)) continue;
    rest = right(j, i);
    for (Index dy = -std::min(j, kSide); dy <= kSide && j + dy < local_.ny(); ++dy) {
      if (dy != 0) rest -= part_of_line(local_, j, i, dy, q);
    }
  }
  lines_[static_cast<std::size_t>(j)].solve(&q(j, 0));
}

Field PointLines::operator()(const Field& right) const {
  Field q = Field::Zero(local_.ny(), local_.nx());
  for (Index j = 1; j + 1 < local_.ny(); ++j) solve_line(j, right, q);
  for (Index j = local_.ny() - 2; j > 0; --j) solve_line(j, right, q);
  return local_.pressure(q);
}

PointDirect::PointDirect(PointLocal local)
    : local_(std::move(local)),
      factors_(std::make_unique<Eigen::SparseLU<Eigen::SparseMatrix<double>>>()) {
  using Entry = Eigen::Triplet<double, Index>;
  const Index nx = local_.nx();
  const Index n = local_.held().size();
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(n * PointLocal::kBox));
  for (Index k = 0; k < n; ++k) {
    if (local_.held().data()[k]) {
      entries.emplace_back(k, k, 1);
      continue;
    }
    const double* value = local_.coefficients(k / nx, k % nx);
    for (Index dy = -kSide; dy <= kSide; ++dy) {
      for (Index dx = -kUpstream; dx <= kDownstream; ++dx, ++value) {
        if (*value != 0) entries.emplace_back(k, k + dy * nx + dx, *value);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_->compute(matrix);
}

Field PointDirect::operator()(const Field& right) const {
  const Field free = local_.held().select(0, right);
  const Eigen::VectorXd solution =
      factors_->solve(Eigen::Map<const Eigen::VectorXd>(free.data(), free.size()));
  return local_.pressure(Eigen::Map<const Field>(solution.data(), free.rows(), free.cols()));
}

}  // namespace tabor::ehl
