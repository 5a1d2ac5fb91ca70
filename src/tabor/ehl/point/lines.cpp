#include "tabor/ehl/point/lines.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"

namespace tabor::ehl {
namespace {

constexpr PointLocal::Reach kOwnLine =
    PointLocal::kReaches[static_cast<std::size_t>(PointLocal::kSide)];

/// Calls body(place, reach, dx) for each coefficient of other lines' unknowns, place = 0, 1, ...
template <typename Body>
void for_each_of_others(const Body& body) {
  Index place = 0;
  for (const PointLocal::Reach& reach : PointLocal::kReaches) {
    if (reach.dy == 0) continue;
    for (Index dx = reach.first; dx <= reach.last; ++dx) body(place++, reach, dx);
  }
}

}  // namespace

class PointLines::Plane {
 public:
  Plane() = default;
  Plane(Index nx, Index n_batches)
      : stride_((n_batches + 2) * kLanes),
        values_(static_cast<std::size_t>((nx + PointLocal::kUpstream + PointLocal::kDownstream) *
                                         stride_),
                0.0) {}

  /// The values at node i of the lines from the m-th of this colour on; nodes beyond the ends and
  /// lines beyond the border are zero.
  double* at(Index i, Index m) {
    return &values_[static_cast<std::size_t>((i + PointLocal::kUpstream) * stride_ + m + kLanes)];
  }
  const double* at(Index i, Index m) const {
    return &values_[static_cast<std::size_t>((i + PointLocal::kUpstream) * stride_ + m + kLanes)];
  }
  Index stride() const { return stride_; }  ///< from a value at node i to that at i + 1
  static Lanes load(const double* first) {
    Lanes lanes;
    std::memcpy(&lanes, first, sizeof lanes);
    return lanes;
  }
  void store(Index i, Index m, const Lanes& lanes) { std::memcpy(at(i, m), &lanes, sizeof lanes); }

 private:
  Index stride_ = 0;
  std::vector<double> values_;
};

PointLines::PointLines(PointLocal local)
    : local_(std::move(local)),
      n_batches_((local_.ny() + kColours * kLanes - 1) / (kColours * kLanes)) {
  for (std::vector<Batch>& of_colour : batches_) {
    of_colour.assign(static_cast<std::size_t>(n_batches_), Batch(local_.nx()));
  }
  std::atomic<bool> ok = true;
  for_each_batch([&](Index colour, Index batch) {
    if (!fill(colour, batch)) ok = false;
  });
  ok_ = ok;
}

/// Calls body(colour, batch) for all batches, on all threads.
template <typename Body>
void PointLines::for_each_batch(const Body& body) const {
  for (Index colour = 0; colour < kColours; ++colour) {
    parallel_for(n_batches_, batches_of_block(), [&](Index begin, Index end) {
      for (Index batch = begin; batch < end; ++batch) body(colour, batch);
    });
  }
}

/// Batches that one thread takes at a time: few nodes are not worth a meeting of threads.
Index PointLines::batches_of_block() const {
  constexpr Index kNodes = 8192;
  return std::max<Index>(1, kNodes / (local_.nx() * kLanes));
}

/// False if a line is singular.
bool PointLines::fill(Index colour, Index batch) {
  Batch& to = batches_[static_cast<std::size_t>(colour)][static_cast<std::size_t>(batch)];
  const Index nx = local_.nx();
  for (int lane = 0; lane < kLanes; ++lane) {
    const Index j = line_of(colour, batch, lane);
    for (Index i = 0; i < nx; ++i) {
      if (j >= local_.ny() || local_.held()(j, i)) {
        to.factors.at(i, i)[lane] = 1;
        continue;
      }
      const double* const row = local_.coefficients(j, i);
      const Index last = std::min(kOwnLine.last, nx - 1 - i);
      for (Index dx = std::max(kOwnLine.first, -i); dx <= last; ++dx) {
        to.factors.at(i, i + dx)[lane] = row[kOwnLine.place + dx - kOwnLine.first];
      }
      for_each_of_others([&](Index place, const PointLocal::Reach& reach, Index dx) {
        to.of_others[static_cast<std::size_t>(i * kOfOthers + place)][lane] =
            row[reach.place + dx - reach.first];
      });
    }
  }
  return to.factors.factorise();
}

void PointLines::solve_lines(Index colour, Index batch, const Planes& right, Planes& q) const {
  const Batch& lines = batches_[static_cast<std::size_t>(colour)][static_cast<std::size_t>(batch)];
  const Index m = batch * kLanes;
  Plane& own = q[static_cast<std::size_t>(colour)];
  std::array<const double*, kOfOthers> others{};  // unknowns that the first balance depends on
  for_each_of_others([&](Index place, const PointLocal::Reach& reach, Index dx) {
    const Index line = colour + reach.dy + kColours;  // that of m = 0 is kColours lines further up
    const Plane& plane = q[static_cast<std::size_t>(line % kColours)];
    others[static_cast<std::size_t>(place)] = plane.at(dx, m + line / kColours - 1);
  });
  const Index nx = local_.nx();
  std::vector<Lanes> unknowns(static_cast<std::size_t>(nx + LineFactors::kPadding), Lanes{});
  for (Index i = 0; i < nx; ++i) {
    Lanes rest = Plane::load(right[static_cast<std::size_t>(colour)].at(i, m));
    const Lanes* const coefficients = &lines.of_others[static_cast<std::size_t>(i * kOfOthers)];
    for (std::size_t k = 0; k < others.size(); ++k) {
      rest -= coefficients[k] * Plane::load(others[k] + i * own.stride());
    }
    unknowns[static_cast<std::size_t>(i)] = rest;
  }
  lines.factors.solve(unknowns.data());
  for (Index i = 0; i < nx; ++i) own.store(i, m, unknowns[static_cast<std::size_t>(i)]);
}

Field PointLines::operator()(const Field& right) const {
  Planes balances, q;
  balances.fill(Plane(local_.nx(), n_batches_));
  q.fill(Plane(local_.nx(), n_batches_));
  for_each_batch([&](Index colour, Index batch) {
    Plane& plane = balances[static_cast<std::size_t>(colour)];
    for (Index i = 0; i < local_.nx(); ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const Index j = line_of(colour, batch, lane);
        const bool is_free = j < local_.ny() && !local_.held()(j, i);
        plane.at(i, batch * kLanes)[lane] = is_free ? right(j, i) : 0;
      }
    }
  });
  for (const Index colour : {2, 1, 0, 2, 1, 0, 2, 1, 0}) {
    parallel_for(n_batches_, batches_of_block(), [&](Index begin, Index end) {
      for (Index batch = begin; batch < end; ++batch) solve_lines(colour, batch, balances, q);
    });
  }
  Field unknowns(local_.ny(), local_.nx());
  for_each_row(local_.ny(), [&](Index j) {
    const Plane& plane = q[static_cast<std::size_t>(j % kColours)];
    for (Index i = 0; i < local_.nx(); ++i) unknowns(j, i) = *plane.at(i, j / kColours);
  });
  return local_.pressure(unknowns);
}

PointDirect::PointDirect(PointLocal local)
    : local_(std::move(local)),
      factors_(std::make_unique<Eigen::SparseLU<Eigen::SparseMatrix<double>>>()) {
  using Entry = Eigen::Triplet<double, Index>;
  const Index nx = local_.nx();
  const Index n = local_.held().size();
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(n * PointLocal::kCoefficients));
  for (Index k = 0; k < n; ++k) {
    if (local_.held().data()[k]) {
      entries.emplace_back(k, k, 1);
      continue;
    }
    const double* value = local_.coefficients(k / nx, k % nx);
    for (const PointLocal::Reach& reach : PointLocal::kReaches) {
      for (Index dx = reach.first; dx <= reach.last; ++dx, ++value) {
        if (*value != 0) entries.emplace_back(k, k + reach.dy * nx + dx, *value);
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
