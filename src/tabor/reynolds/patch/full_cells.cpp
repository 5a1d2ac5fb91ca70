#include "tabor/reynolds/patch/full_cells.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace tabor::reynolds {
namespace {

using Eigen::VectorXd;

constexpr int kUnitSweeps = 3;
constexpr double kInflow = 1e-6;  // into a cell, over what a pressure of 1 drives out of a mean one

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Link {
  Index cell;
  double conductance;
};

/// The four neighbours of a cell with the conductances to them.
std::array<Link, 4> links_of(const PatchCells& cells, Index cell) {
  const auto [left, right, up, down] = cells.around(cell);
  return {Link{left, cells.conduct_x.data()[left]}, Link{right, cells.conduct_x.data()[cell]},
          Link{up, cells.conduct_y.data()[up]}, Link{down, cells.conduct_y.data()[cell]}};
}

/// Writes the rows of the matrix.
class Rows {
 public:
  Rows(const PatchCells& cells, const std::vector<CellKind>& kinds, double time,
       const std::vector<std::int32_t>& cell)
      : cells_(cells), kinds_(kinds), time_(time), unknown_(at(cells.size()), -1) {
    const auto n = static_cast<Index>(cell.size());
    for (Index i = 0; i < n; ++i) unknown_[at(cell[at(i)])] = static_cast<std::int32_t>(i);
    matrix_.diagonal = VectorXd::Zero(n);
    matrix_.begin.reserve(at(n) + 1);
    matrix_.neighbour.reserve(at(5 * n));
    matrix_.coupling.reserve(at(5 * n));
    for (Index i = 0; i < n; ++i) {
      add_driven_out(i, cell[at(i)]);
      add_carried_back(i, cell[at(i)]);
      matrix_.begin.push_back(static_cast<std::int32_t>(matrix_.neighbour.size()));
      if (!(matrix_.diagonal[i] > 0)) matrix_.diagonal[i] = 1;  // tied to nothing
    }
  }

  CouplingMatrix take() { return std::move(matrix_); }

 private:
  void add_driven_out(Index row, Index cell) {
    for (const auto& [other, conductance] : links_of(cells_, cell)) {
      if (conductance == 0) continue;
      matrix_.diagonal[row] += conductance;
      if (unknown_[at(other)] >= 0) couple(unknown_[at(other)], conductance);
    }
  }

  /// Oil that enters the starved cells upstream in the row, each of which keeps a little of it.
  void add_carried_back(Index row, Index cell) {
    double share = 1;
    for (Index left = cells_.around(cell).left; kinds_[at(left)] == CellKind::starved;
         left = cells_.around(left).left) {
      const double carried = cells_.carried.data()[left];
      share *= carried / (cells_.gap.data()[left] / time_ + carried);
      for (const auto& [other, conductance] : links_of(cells_, left)) {
        const std::int32_t from = unknown_[at(other)];
        if (from < 0 || conductance == 0) continue;
        if (from == row) {
          matrix_.diagonal[row] -= share * conductance;
        } else {
          couple(from, share * conductance);
        }
      }
    }
  }

  void couple(std::int32_t to, double coupling) {
    matrix_.neighbour.push_back(to);
    matrix_.coupling.push_back(coupling);
  }

  const PatchCells& cells_;
  const std::vector<CellKind>& kinds_;
  double time_;
  std::vector<std::int32_t> unknown_;  // of a cell, -1 if none
  CouplingMatrix matrix_;
};

/// The x of one node that balances it.
double relaxed(const CouplingMatrix& matrix, Index node, double right, const VectorXd& x) {
  double total = right;
  matrix.for_neighbours(node,
                        [&](std::int32_t other, double coupling) { total += coupling * x[other]; });
  return total / matrix.diagonal[node];
}

/// Brings the units nearer to the pressures that an even inflow would raise. They stay positive, as
/// all couplings are.
void improve(const CouplingMatrix& matrix, VectorXd& unit) {
  if (matrix.size() == 0) return;
  const double inflow = kInflow * matrix.diagonal.mean();
  const Index n = matrix.size();
  for (int sweep = 0; sweep < kUnitSweeps; ++sweep) {
    for (Index node = 0; node < n; ++node) unit[node] = relaxed(matrix, node, inflow, unit);
    for (Index node = n; node-- > 0;) unit[node] = relaxed(matrix, node, inflow, unit);
  }
}

/// Measures each unknown in its unit.
void scale(CouplingMatrix& matrix, const VectorXd& unit) {
  matrix.diagonal.array() *= unit.array();
  for (std::size_t k = 0; k < matrix.coupling.size(); ++k) {
    matrix.coupling[k] *= unit[matrix.neighbour[k]];
  }
}

}  // namespace

FullCells::FullCells(const PatchCells& cells, const std::vector<CellKind>& kinds, double time,
                     Field& unit)
    : multigrid_(matrix_of(cells, kinds, time, unit)) {}

CouplingMatrix FullCells::matrix_of(const PatchCells& cells, const std::vector<CellKind>& kinds,
                                    double time, Field& unit) {
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (kinds[at(cell)] == CellKind::full) cell_.push_back(static_cast<std::int32_t>(cell));
  }
  CouplingMatrix matrix = Rows(cells, kinds, time, cell_).take();
  unit_.resize(count());
  for (Index i = 0; i < count(); ++i) unit_[i] = unit.data()[cell(i)];
  improve(matrix, unit_);
  for (Index i = 0; i < count(); ++i) unit.data()[cell(i)] = unit_[i];
  scale(matrix, unit_);
  return matrix;
}

void FullCells::apply(const VectorXd& x, VectorXd& y) {
  ++n_products_;
  multigrid_.system().multiply(x, y);
}

bool FullCells::solve(const VectorXd& right, double tolerance, int max_products, VectorXd& x,
                      const std::function<void()>& tick) {
  x.setZero(count());
  const bool is_solved = iterate(right, tolerance, max_products, x, tick);
  x.array() *= unit_.array();
  return is_solved;
}

/// Adds to x, in its units, what leaves no more than the tolerance of r.
bool FullCells::iterate(VectorXd r, double tolerance, int max_products, VectorXd& x,
                        const std::function<void()>& tick) {
  const Index n = count();
  VectorXd image(n);
  const VectorXd shadow = r;
  VectorXd p = VectorXd::Zero(n);
  VectorXd v = p;
  VectorXd smooth_p(n);
  VectorXd smooth_r(n);
  double rho = 1;
  double alpha = 1;
  double omega = 1;
  const int last = n_products_ + max_products;
  while (r.norm() > tolerance) {
    if (n_products_ >= last) return false;
    tick();
    const double rho_before = std::exchange(rho, shadow.dot(r));
    if (rho == 0 || omega == 0 || !std::isfinite(rho)) return false;
    const double beta = rho / rho_before * (alpha / omega);
    p = r + beta * (p - omega * v);
    multigrid_.apply(p, smooth_p);
    apply(smooth_p, v);
    alpha = rho / shadow.dot(v);
    if (!std::isfinite(alpha)) return false;
    r -= alpha * v;
    x += alpha * smooth_p;
    if (r.norm() <= tolerance) return true;
    multigrid_.apply(r, smooth_r);
    apply(smooth_r, image);
    omega = image.dot(r) / image.squaredNorm();
    if (!std::isfinite(omega)) return false;
    x += omega * smooth_r;
    r -= omega * image;
  }
  return true;
}

}  // namespace tabor::reynolds
