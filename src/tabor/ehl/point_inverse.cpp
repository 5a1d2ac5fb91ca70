#include "tabor/ehl/point_inverse.hpp"

#include <cstdlib>
#include <vector>

namespace tabor::ehl {
namespace {

constexpr Index kReach = 2;  // of the dipoles' deflection, in nodes

/// Deflection by a pressure 1 at a node and -1/4 at each of its neighbours.
double dipole(const PointInfluence& k, Index dy, Index dx) {
  const auto at = [&](Index y, Index x) { return k(std::abs(y), std::abs(x)); };
  return at(dy, dx) - 0.25 * (at(dy, dx - 1) + at(dy, dx + 1) + at(dy - 1, dx) + at(dy + 1, dx));
}

}  // namespace

PointInverse::PointInverse(const PointBalance& balance, const Mask& held,
                           const PointInfluence& influence)
    : held_(held), number_(held.rows(), held.cols()) {
  const Index ny = held.rows(), nx = held.cols();
  for (Index k = 0; k < held.size(); ++k)
    number_.data()[k] = held.data()[k] ? -1 : static_cast<int>(n_++);
  Field kernel(2 * kReach + 7, 2 * kReach + 7);
  const Index mid = kReach + 3;
  for (Index b = -mid; b <= mid; ++b)
    for (Index a = -mid; a <= mid; ++a) kernel(b + mid, a + mid) = dipole(influence, b, a);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n_) * 30);
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      if (number_(j, i) < 0) continue;
      // elastic part
      for (Index b = -kReach; b <= kReach; ++b)
        for (Index a = -kReach - 1; a <= kReach; ++a) {
          const Index J = j + b, I = i + a;
          if (J < 0 || J >= ny || I < 0 || I >= nx || number_(J, I) < 0) continue;
          double v = 0;
          for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
            const auto& at = kPointNeighbours[n];
            v += balance.by_film.coefficient[n](j, i) * kernel(at.y - b + mid, at.x - a + mid);
          }
          entries.emplace_back(number_(j, i), number_(J, I), v);
        }
      for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
        const double c = balance.by_pressure.coefficient[n](j, i);
        if (c == 0) continue;
        const Index J = j + kPointNeighbours[n].y, I = i + kPointNeighbours[n].x;
        if (number_(J, I) < 0) continue;
        // p at (J, I) = q(J,I) - 1/4 sum q
        const Index dj[5] = {0, -1, 1, 0, 0}, di[5] = {0, 0, 0, -1, 1};
        for (int m = 0; m < 5; ++m) {
          if (number_(J + dj[m], I + di[m]) < 0) continue;
          entries.emplace_back(number_(j, i), number_(J + dj[m], I + di[m]), m == 0 ? c : -c / 4);
        }
      }
    }
  Eigen::SparseMatrix<double> matrix(n_, n_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(matrix);
  ok_ = factors_.info() == Eigen::Success;
}

Field PointInverse::operator()(const Field& right) const {
  Eigen::VectorXd b(n_);
  for (Index k = 0; k < held_.size(); ++k)
    if (number_.data()[k] >= 0) b[number_.data()[k]] = right.data()[k];
  const Eigen::VectorXd q = factors_.solve(b);
  Field result = right;
  const Index ny = held_.rows(), nx = held_.cols();
  const auto at = [&](Index j, Index i) { return number_(j, i) < 0 ? 0.0 : q[number_(j, i)]; };
  for (Index j = 1; j + 1 < ny; ++j)
    for (Index i = 1; i + 1 < nx; ++i)
      if (number_(j, i) >= 0)
        result(j, i) =
            at(j, i) - 0.25 * (at(j - 1, i) + at(j + 1, i) + at(j, i - 1) + at(j, i + 1));
  return result;
}

}  // namespace tabor::ehl
