#include "tabor/numerics/grid_transfer.hpp"

#include <gtest/gtest.h>

#include "numerics/matrices.hpp"

namespace tabor::numerics {
namespace {

struct Pair {
  Grid fine, coarse;
};

class NodeTransferTest : public testing::TestWithParam<Pair> {};

double place(Index i, Index n) { return static_cast<double>(i) / static_cast<double>(n - 1); }

Field bilinear(const Grid& grid) {
  return Field::NullaryExpr(grid.ny, grid.nx, [&](Index y, Index x) {
    const double a = place(x, grid.nx);
    const double b = place(y, grid.ny);
    return 2 - 3 * a + 5 * b + 7 * a * b;
  });
}

TEST_P(NodeTransferTest, KeepsPlanesBetweenTheCoarseNodes) {
  const Grid fine = GetParam().fine;
  const Grid coarse = GetParam().coarse;
  const Field plane = Field::NullaryExpr(coarse.ny, coarse.nx, [&](Index y, Index x) {
    return 2 - 3 * place(x, coarse.nx) + 5 * place(y, coarse.ny);
  });
  const Field found = NodeTransfer(fine, coarse).to_fine(plane);
  ASSERT_EQ(found.rows(), fine.ny);
  ASSERT_EQ(found.cols(), fine.nx);
  for (Index y = 0; y < fine.ny; ++y) {
    for (Index x = 0; x < fine.nx; ++x) {
      EXPECT_NEAR(found(y, x), 2 - 3 * place(x, fine.nx) + 5 * place(y, fine.ny), 1e-13);
    }
  }
}

TEST_P(NodeTransferTest, HitsTheCornersExactly) {
  const Grid fine = GetParam().fine;
  const Grid coarse = GetParam().coarse;
  const Field coarse_values = bilinear(coarse);
  const Field found = NodeTransfer(fine, coarse).to_fine(coarse_values);
  EXPECT_NEAR(found(0, 0), coarse_values(0, 0), 1e-14);
  EXPECT_NEAR(found(fine.ny - 1, fine.nx - 1), coarse_values(coarse.ny - 1, coarse.nx - 1), 1e-13);
}

TEST_P(NodeTransferTest, TransposedIsTheTransposed) {
  const Grid fine = GetParam().fine;
  const Grid coarse = GetParam().coarse;
  const NodeTransfer transfer(fine, coarse);
  const Field a = test::scattered_field(coarse.ny, coarse.nx);
  const Field b = test::scattered_field(fine.ny, fine.nx, 17);
  EXPECT_NEAR((transfer.to_fine(a) * b).sum(), (a * transfer.transposed(b)).sum(),
              1e-13 * static_cast<double>(fine.size()));
}

TEST_P(NodeTransferTest, MeansOfAConstantAreTheConstant) {
  const Grid fine = GetParam().fine;
  const Grid coarse = GetParam().coarse;
  const Field mean = NodeTransfer(fine, coarse).mean(Field::Constant(fine.ny, fine.nx, 3.5));
  ASSERT_EQ(mean.rows(), coarse.ny);
  ASSERT_EQ(mean.cols(), coarse.nx);
  EXPECT_LE((mean - 3.5).abs().maxCoeff(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Sizes, NodeTransferTest,
                         testing::Values(Pair{{.nx = 17, .ny = 9}, {.nx = 9, .ny = 5}},
                                         Pair{{.nx = 20, .ny = 31}, {.nx = 10, .ny = 16}},
                                         Pair{{.nx = 5, .ny = 7}, {.nx = 5, .ny = 7}},
                                         Pair{{.nx = 4, .ny = 5}, {.nx = 2, .ny = 2}},
                                         Pair{{.nx = 6, .ny = 6},
                                              {.nx = 11, .ny = 13}}));  // onto more nodes, too

}  // namespace
}  // namespace tabor::numerics
