// The pieces of the solver: projection, certificate, preconditioner, patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "contact/surfaces.hpp"
#include "tabor/contact/candidate_set.hpp"
#include "tabor/contact/certificate.hpp"
#include "tabor/contact/long_waves.hpp"
#include "tabor/contact/patches.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/core/random.hpp"

namespace tabor::contact {
namespace {

constexpr double kNoCap = std::numeric_limits<double>::infinity();

std::vector<double> random_values(std::size_t n, std::uint64_t seed) {
  const CounterRandom random(seed);
  std::vector<double> values(n);
  for (std::size_t k = 0; k < n; ++k) values[k] = random.normal(k) * 1e8;
  return values;
}

TEST(ProjectOnLoad, KeepsBoundsAndLoad) {
  for (const double cap : {kNoCap, 2e8, 1e7}) {
    for (const double share : {1e-6, 0.1, 0.5, 0.999}) {
      std::vector<double> x = random_values(5000, 4);
      const double load = share * 5000 * std::min(cap, 1e8);
      project_on_load(x, load, cap);
      EXPECT_NEAR(std::accumulate(x.begin(), x.end(), 0.0) / load, 1, 1e-13);
      EXPECT_GE(*std::min_element(x.begin(), x.end()), 0);
      EXPECT_LE(*std::max_element(x.begin(), x.end()), cap);
    }
  }
}

TEST(ProjectOnLoad, LeavesAFeasiblePointAlone) {
  std::vector<double> x{0.0, 1.0, 2.0, 5.0};
  project_on_load(x, 8.0, 5.0);
  EXPECT_EQ(x, (std::vector<double>{0.0, 1.0, 2.0, 5.0}));
}

TEST(DualityGap, IsZeroForTheKnapsackItself) {
  EXPECT_EQ(duality_gap({{0, 3, 0}, {2.0, 1.0, 5.0}}, 3, kNoCap), 0);
  EXPECT_EQ(duality_gap({{1, 2, 0}, {2.0, 1.0, 5.0}}, 3, 2), 0);
}

TEST(DualityGap, IsTheDistanceToTheBestFeasibleLoad) {
  // All on v = 5 costs 15; best without cap is 3 * 1, with cap 2 it is 2 * 1 + 1 * 2.
  EXPECT_DOUBLE_EQ(duality_gap({{0, 0, 3}, {2.0, 1.0, 5.0}}, 3, kNoCap), 12);
  EXPECT_DOUBLE_EQ(duality_gap({{0, 1, 2}, {2.0, 1.0, 5.0}}, 3, 2), 11 - 4);
}

TEST(DualityGap, DoesNotDependOnTheLevelOfTheResidual) {
  const double gap = duality_gap({{1, 1, 1}, {2.0, 1.0, 5.0}}, 3, 2);
  EXPECT_NEAR(duality_gap({{1, 1, 1}, {1002.0, 1001.0, 1005.0}}, 3, 2), gap, 1e-11);
}

// Certificate and separation of the candidates are those of the whole field, whatever the pressure.
TEST(CandidateSet, LeavesOutNothingThatMatters) {
  constexpr Index n = 200;
  const CounterRandom random(12);
  Field pressure = Field::Zero(n, n);
  Field residual(n, n);
  for (Index i = 0; i < n * n; ++i) {
    const auto key = static_cast<std::uint64_t>(i);
    residual(i) = random.normal(key);
    const bool is_pressed = residual(i) < -0.5 && random.uniform(key + 100000) < 0.5;
    pressure(i) = is_pressed ? random.uniform(key + 200000) : 0.0;
  }
  const double load = pressure.sum();
  const double step = 0.3;
  const auto separation = [&](const Candidates& values, double cap) {
    std::vector<double> wanted(values.pressure);
    for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k] -= step * values.residual[k];
    return -shift_for_load(wanted, load, cap) / step;
  };
  const Candidates all{{pressure.data(), pressure.data() + n * n},
                       {residual.data(), residual.data() + n * n}};
  for (const double cap : {kNoCap, 1.0, 1.5}) {
    CandidateSet set = pressed_pixels(pressure);
    for (std::size_t k = 0; k < set.size(); ++k) set.values.residual[k] = residual(set.pixels[k]);
    const double threshold = candidate_threshold(set, load, cap, step);
    FieldF change = residual.cast<float>();
    collect_candidates(
        residual, &change, threshold, [](Index) {}, set);
    EXPECT_LT(set.size(), static_cast<std::size_t>(n * n) / 2);
    EXPECT_NEAR(duality_gap(set.values, load, cap) / duality_gap(all, load, cap), 1, 1e-12);
    EXPECT_NEAR(separation(set.values, cap), separation(all, cap), 1e-12);
    EXPECT_EQ(set.response.front(), static_cast<float>(residual(set.pixels.front())));
    EXPECT_EQ(change.abs().maxCoeff(), 0);
    Field spread(n, n);
    spread_pressure(set, spread);
    EXPECT_TRUE((spread == pressure).all());
  }
}

TEST(Preconditioner, DirectSumsArePositiveDefiniteOnAnySet) {
  const Grid grid{48, 40, 1.0, 0.9};
  const Preconditioner preconditioner(grid, 1.0, elastic::Border::repeats);
  const CounterRandom random(9);
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    FieldF residual = FieldF::Zero(40, 48);
    PixelList set;
    for (std::uint32_t pixel = 0; pixel < 40 * 48; ++pixel) {
      if (random.uniform(trial * 10000 + pixel) < 0.1) {
        set.push_back(pixel);
        residual(pixel) = static_cast<float>(random.normal(trial * 10000 + 5000 + pixel));
      }
    }
    std::vector<float> out;
    std::vector<float> row_sums;
    preconditioner.apply(set, residual, out, row_sums);
    double product = 0;
    for (std::size_t k = 0; k < set.size(); ++k) {
      product += static_cast<double>(out[k]) * residual(set[k]);
    }
    EXPECT_GT(product, 0);
  }
}

TEST(Preconditioner, RowSumsAreTheAnswerToAConstant) {
  const Grid grid{40, 40, 1.0, 1.0};
  const Preconditioner preconditioner(grid, 1.0, elastic::Border::repeats);
  FieldF residual = FieldF::Zero(40, 40);
  const PixelList set{3, 4, 5, 44, 820, 821, 860};
  for (const std::uint32_t pixel : set) residual(pixel) = 2.0F;
  std::vector<float> out;
  std::vector<float> row_sums;
  preconditioner.apply(set, residual, out, row_sums);
  for (std::size_t k = 0; k < set.size(); ++k) {
    EXPECT_NEAR(out[k], 2 * row_sums[k], 1e-5 * preconditioner.diagonal());
  }
}

// Where everything touches, the inverse of the operator is known: E* |q| / 2.
TEST(LongWaves, CompleteThePreconditionerToTheInverseOfTheOperatorOnLongWaves) {
  constexpr Index n = 256;
  const Grid grid{n, n, 1.0, 1.0};
  const Preconditioner preconditioner(grid, 1.0, elastic::Border::repeats);
  LongWaves long_waves(grid, 1.0, preconditioner.plateau(), elastic::Border::repeats);
  PixelList everywhere(n * n);
  std::iota(everywhere.begin(), everywhere.end(), 0U);
  for (const int k : {1, 2}) {  // waves of many blocks
    FieldF residual(n, n);
    for (Index x = 0; x < n; ++x) {
      residual.col(x) = static_cast<float>(
          std::cos(2 * std::numbers::pi * k * (static_cast<double>(x) + 0.3) / n));
    }
    std::vector<float> direction;
    std::vector<float> row_sums;
    preconditioner.apply(everywhere, residual, direction, row_sums);
    const std::vector<float> compact = direction;
    long_waves.start_anew();
    long_waves.correct(everywhere, row_sums, compact, compact, LongWaves::Accuracy::full,
                       direction);
    const auto gain = [&](const std::vector<float>& answer) {
      return (Eigen::Map<const FieldF>(answer.data(), n, n) * residual).sum() /
             residual.square().sum();
    };
    const double exact = std::numbers::pi * k;
    EXPECT_GT(gain(compact), 2 * exact);
    EXPECT_NEAR(gain(direction) / exact, 1, 0.05) << "wave " << k;
  }
}

TEST(LongWaves, LeaveAloneWhatBoundsHold) {
  const Grid grid{64, 64, 1.0, 1.0};
  LongWaves long_waves(grid, 1.0, 10.0, elastic::Border::repeats);
  std::vector<float> direction{1.0F, 2.0F};
  long_waves.start_anew();
  long_waves.correct({100, 2000}, {5.0F, 5.0F}, {0.0F, 0.0F}, {1.0F, 2.0F},
                     LongWaves::Accuracy::full, direction);
  EXPECT_EQ(direction, (std::vector<float>{1.0F, 2.0F}));
}

TEST(Preconditioner, SumsAcrossTheEdgesOfAPeriodicCell) {
  const Grid grid{40, 40, 1.0, 1.0};
  const Preconditioner preconditioner(grid, 1.0, elastic::Border::repeats);
  const auto response = [&](Index y, Index x) {
    FieldF residual = FieldF::Zero(40, 40);
    residual(y, x) = 1;
    const auto neighbour = static_cast<std::uint32_t>(((y + 2) % 40) * 40 + (x + 3) % 40);
    std::vector<float> out;
    std::vector<float> row_sums;
    preconditioner.apply({neighbour}, residual, out, row_sums);
    return out[0];
  };
  EXPECT_EQ(response(20, 20), response(39, 38));
  EXPECT_LT(response(20, 20), 0);
}

TEST(FindPatches, JoinsAcrossPeriodicBorders) {
  Mask contact = Mask::Constant(4, 5, false);
  contact(0, 0) = contact(0, 4) = contact(3, 0) = true;  // one patch around the corner
  contact(1, 2) = true;
  EXPECT_EQ(find_patches(contact, true).pixel_counts, (std::vector<Index>{3, 1}));
  EXPECT_EQ(find_patches(contact, false).pixel_counts, (std::vector<Index>{1, 1, 1, 1}));
}

TEST(FindPatches, DiagonalNeighboursAreSeparate) {
  Mask contact = Mask::Constant(3, 3, false);
  contact(0, 0) = contact(1, 1) = true;
  EXPECT_EQ(find_patches(contact, false).size(), 2);
}

TEST(LabelPatches, NumbersThemInTheOrderOfTheirCounts) {
  Mask contact = Mask::Constant(4, 5, false);
  contact(0, 0) = contact(0, 4) = contact(3, 0) = true;
  contact(1, 2) = contact(1, 3) = true;
  for (const bool periodic : {true, false}) {
    const LabelMap labels = label_patches(contact, periodic);
    const std::vector<Index> counts = find_patches(contact, periodic).pixel_counts;
    EXPECT_EQ(labels.maxCoeff(), static_cast<std::int32_t>(counts.size()));
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_EQ((labels == static_cast<std::int32_t>(i + 1)).count(), counts[i]);
    }
    EXPECT_TRUE(((labels > 0) == contact).all());
    EXPECT_EQ(labels(1, 2), labels(1, 3));
    EXPECT_EQ(labels(0, 0) == labels(0, 4), periodic);
  }
}

TEST(CountTransitions, CountsTheOutlineOfABlock) {
  Mask contact = Mask::Constant(8, 8, false);
  contact.block(2, 3, 2, 3) = true;  // 2 rows, 3 columns
  const Transitions transitions = count_transitions(contact, true);
  EXPECT_EQ(transitions.along_rows, 4);
  EXPECT_EQ(transitions.along_columns, 6);
  contact = Mask::Constant(8, 8, false);
  contact.leftCols(3) = true;
  EXPECT_EQ(count_transitions(contact, true).along_rows, 16);
  EXPECT_EQ(count_transitions(contact, false).along_rows, 8);
  EXPECT_EQ(count_transitions(contact, true).along_columns, 0);
}

/// Corners of a square of four pixels, as their number and places say.
Index corners_of(bool a, bool b, bool c, bool d) {
  const int n = int{a} + int{b} + int{c} + int{d};
  if (n == 2) return a == d ? 2 : 0;
  return n % 2;
}

TEST(CountTransitions, CountsPixelByPixelWithCornersOnMapsOfAnyShape) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CounterRandom random(seed);
    const auto ny = static_cast<Index>(1 + seed % 7);
    const auto nx = static_cast<Index>(1 + seed / 7 % 11);
    const Mask contact = Mask::NullaryExpr(ny, nx, [&](Index y, Index x) {
      return random.uniform(static_cast<std::uint64_t>(y * nx + x)) < 0.5;
    });
    for (const bool periodic : {true, false}) {
      Index corners = 0;
      Transitions expected;
      for (Index y = 0; y < ny; ++y) {
        for (Index x = 0; x < nx; ++x) {
          const Index right = (x + 1) % nx, below = (y + 1) % ny;
          const bool has_right = periodic || x + 1 < nx, has_below = periodic || y + 1 < ny;
          if (has_right) expected.along_rows += contact(y, x) != contact(y, right);
          if (has_below) expected.along_columns += contact(y, x) != contact(below, x);
          if (has_right && has_below) {
            corners += corners_of(contact(y, x), contact(y, right), contact(below, x),
                                  contact(below, right));
          }
        }
      }
      const Transitions found = count_transitions(contact, periodic);
      EXPECT_EQ(found.along_rows, expected.along_rows) << seed;
      EXPECT_EQ(found.along_columns, expected.along_columns) << seed;
      EXPECT_EQ(count_corners(contact, periodic), corners) << seed;
    }
  }
}

TEST(CountTransitions, WrapsOnlyRoundAPeriodicCell) {
  for (const bool at_the_end : {false, true}) {
    Mask rows = Mask::Constant(5, 7, false);
    rows.row(at_the_end ? 4 : 0) = true;
    EXPECT_EQ(count_transitions(rows, true).along_columns, 14);
    EXPECT_EQ(count_transitions(rows, false).along_columns, 7);
    const Mask columns = rows.transpose();
    EXPECT_EQ(count_transitions(columns, true).along_rows, 14);
    EXPECT_EQ(count_transitions(columns, false).along_rows, 7);
  }
}

}  // namespace
}  // namespace tabor::contact
