// Pressures of the full cells of a patch, whose balance PatchBalance tells by itself.
#include "tabor/reynolds/patch/full_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "patches.hpp"
#include "tabor/reynolds/patch/patch_balance.hpp"

namespace tabor::reynolds {
namespace {

using Eigen::VectorXd;

constexpr double kTime = 1e-2;  // [s]

/// A rough patch whose gaps differ by orders of magnitude, the more the larger the exponent.
PatchProblem jagged_patch(Index n, double separation, double exponent) {
  PatchProblem problem = test::rough_patch(n, separation);
  problem.gap = 1e-6 * (problem.gap / 1e-6).pow(exponent);
  return problem;
}

/// Cells of such a patch, some of which are starved: streaks along x, as sliding leaves them.
class StreakyPatch {
 public:
  StreakyPatch(Index n, double separation, double exponent = 1)
      : cells_(patch_cells(jagged_patch(n, separation, exponent))), balance_(cells_, oil(), kTime) {
    std::mt19937 random(7);
    bool starved = false;
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (random() % 8 == 0) starved = random() % 3 == 0;
      if (!cells_.is_open(cell)) continue;
      balance_.set_kind(cell, starved ? CellKind::starved : CellKind::full);
    }
  }

  FullCells equations(Field& unit) const { return {cells_, balance_.kinds(), kTime, unit}; }
  Field no_units() const { return Field::Ones(cells_.ny, cells_.nx); }

  /// What the full cells gain too much under pressures x [m/s].
  VectorXd surplus(const FullCells& system, const VectorXd& x) {
    for (Index i = 0; i < system.count(); ++i) balance_.pressure(system.cell(i)) = x[i];
    balance_.sweep();
    VectorXd surplus(system.count());
    for (Index i = 0; i < system.count(); ++i) surplus[i] = balance_.surplus(system.cell(i));
    return surplus;
  }

 private:
  const PatchOil& oil() {
    oil_.volume = 0.7 * cells_.gap;
    return oil_;
  }

  PatchCells cells_;
  PatchOil oil_;
  PatchBalance balance_;
};

VectorXd zeros(const FullCells& system) { return VectorXd::Zero(system.count()); }

TEST(FullCells, HavePressuresUnderWhichNoneGainsTooMuch) {
  for (const double separation : {0.2e-6, 0.5e-6, 2e-6}) {
    StreakyPatch patch(48, separation);
    Field unit = patch.no_units();
    FullCells system = patch.equations(unit);
    const VectorXd at_rest = patch.surplus(system, zeros(system));
    VectorXd x;
    ASSERT_TRUE(system.solve(at_rest, 1e-10 * at_rest.norm(), 400, x, [] {})) << separation;
    EXPECT_LT(patch.surplus(system, x).norm(), 2e-10 * at_rest.norm()) << separation;
  }
}

TEST(FullCells, AreSolvedAlikeInAnyUnits) {
  StreakyPatch patch(48, 0.5e-6);
  Field unit = patch.no_units();
  FullCells system = patch.equations(unit);
  const VectorXd at_rest = patch.surplus(system, zeros(system));
  VectorXd expected;
  ASSERT_TRUE(system.solve(at_rest, 1e-12 * at_rest.norm(), 400, expected, [] {}));
  std::mt19937 random(3);
  for (double& one : unit.reshaped()) one *= std::exp2(static_cast<double>(random() % 9) - 4);
  FullCells others = patch.equations(unit);
  VectorXd x;
  ASSERT_TRUE(others.solve(at_rest, 1e-12 * at_rest.norm(), 400, x, [] {}));
  EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm());
}

TEST(FullCells, NeedFewerProductsOnceTheirUnitsAreKnown) {
  StreakyPatch patch(128, 0.2e-6, 4);
  Field unit = patch.no_units();
  int first = 0;
  int last = 0;
  for (int time = 0; time < 10; ++time) {
    FullCells system = patch.equations(unit);
    EXPECT_TRUE((unit > 0).all());
    const VectorXd at_rest = patch.surplus(system, zeros(system));
    VectorXd x;
    ASSERT_TRUE(system.solve(at_rest, 1e-10 * at_rest.norm(), 400, x, [] {}));
    last = system.n_products();
    if (time == 0) first = last;
  }
  RecordProperty("products_first", first);
  RecordProperty("products_last", last);
  EXPECT_LE(last, first);
}

TEST(FullCells, MayBeNone) {
  StreakyPatch patch(16, -1e-5);
  Field unit = patch.no_units();
  FullCells system = patch.equations(unit);
  VectorXd x;
  EXPECT_EQ(system.count(), 0);
  EXPECT_TRUE(system.solve(VectorXd(), 0, 10, x, [] {}));
}

}  // namespace
}  // namespace tabor::reynolds
