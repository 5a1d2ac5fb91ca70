// Guards the work of the fast solver: transform pairs are deterministic, seconds are not.
//
// fft_pairs.csv holds the pairs of each case. A case that needs over 5 % more fails. To renew the
// table after a change that is meant, copy what the test prints as "measured" into it and say why
// in the commit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "contact/surfaces.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {
namespace {

struct Row {
  std::string surface;
  Index n;
  double reduced_pressure;    // P / (E* rms slope)
  double reduced_saturation;  // p_sat / (E* rms slope), 0: none
  double fft_pairs;
};

std::vector<Row> table() {
  std::ifstream file(TABOR_SOURCE_DIR "/tests/contact/fft_pairs.csv");
  std::string line;
  std::getline(file, line);  // names of the columns
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Row row;
    words >> row.surface >> row.n >> row.reduced_pressure >> row.reduced_saturation >>
        row.fft_pairs;
    rows.push_back(row);
  }
  return rows;
}

Field surface(const Row& row) {
  if (row.surface == "edt") {
    synthesis::Edt recipe;
    recipe.grid = square(row.n, static_cast<double>(row.n) * 0.67e-6);
    const Field height = synthesis::edt(recipe).height;
    const double side = recipe.grid.lx;
    return height / side;
  }
  return self_affine(row.n, 0.8, 4, static_cast<double>(row.n) / 8, 1);
}

TEST(SolveContact, NeedsNoMoreTransformsThanBefore) {  // slow
  const std::vector<Row> rows = table();
  ASSERT_GE(rows.size(), 8U);
  for (const Row& row : rows) {
    const Field height = surface(row);
    const double slope = rms_slope(height);
    const double cap =
        row.reduced_saturation > 0 ? row.reduced_saturation * slope : contact::kNoSaturation;
    const Convergence found =
        solve_unit(height, row.reduced_pressure * slope, cap).state.convergence;
    EXPECT_TRUE(found.converged());
    const std::string measured =
        fmt::format("measured {},{},{},{},{:.2f}", row.surface, row.n, row.reduced_pressure,
                    row.reduced_saturation, found.fft_pairs);
    EXPECT_LE(found.fft_pairs, 1.05 * row.fft_pairs) << measured;
    if (found.fft_pairs < 0.95 * row.fft_pairs) {
      fmt::print("better than the table, worth renewing: {}\n", measured);
    }
  }
}

}  // namespace
}  // namespace tabor::test
