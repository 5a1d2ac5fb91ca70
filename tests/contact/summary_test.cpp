// What is read from a state, by counting on paper, and what the certificate is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "contact/surfaces.hpp"

namespace tabor::test {
namespace {

constexpr double kNoCap = contact::kNoSaturation;

/// A block of 2 x 3 pixels carries 1, 2, 3, 4, 5, 6 Pa on 8 x 10 pixels of 2 m x 5 m. It is pressed
/// in by 0.1, 0.2, ... m; around it the gap is 1 m, but for one overlap of a quarter of a metre.
struct Block {
  Grid grid{10, 8, 20, 40};
  contact::Problem problem;
  contact::State state;

  explicit Block(double cap) {
    problem.height = Field::Zero(8, 10);
    problem.bounds.upper = cap;
    state.pressure = state.displacement = Field::Zero(8, 10);
    state.gap = Field::Ones(8, 10);
    for (Index k = 0; k < 6; ++k) {
      const Index y = 2 + k / 3;
      const Index x = 4 + k % 3;
      state.pressure(y, x) = static_cast<double>(k + 1);
      state.displacement(y, x) = 0.1 * static_cast<double>(k + 1);
      state.gap(y, x) = state.pressure(y, x) < cap ? 0 : -0.25;
    }
    state.mean_pressure = 21.0 / 80;
    state.separation = 7;
    state.convergence.status = Status::converged;
  }
  contact::Summary summary(bool periodic = true) const {
    return contact::summarise(state, problem, grid, periodic);
  }
};

TEST(Summary, OfABlockIsWhatCountingGives) {
  const contact::Summary found = Block(kNoCap).summary();
  EXPECT_DOUBLE_EQ(found.mean_pressure, 21.0 / 80);
  EXPECT_DOUBLE_EQ(found.contact_area_fraction_pixels, 6.0 / 80);
  // 4 changes along rows, 6 along columns, each worth (pi - 1 + ln 2)/24 pixels.
  const double transition = (std::numbers::pi - 1 + std::log(2.0)) / 24;
  EXPECT_DOUBLE_EQ(found.contact_area_fraction, (6 - 10 * transition) / 80);
  EXPECT_TRUE(found.area_correction_valid);
  EXPECT_EQ(found.saturated_area_fraction, 0);
  EXPECT_DOUBLE_EQ(found.mean_gap, 74.0 / 80);
  EXPECT_EQ(found.separation, 7);
  EXPECT_EQ(found.max_pressure, 6);
  EXPECT_DOUBLE_EQ(found.elastic_energy, 0.5 * 0.1 * (1 + 4 + 9 + 16 + 25 + 36) / 80);
  EXPECT_EQ(found.n_patches, 1);
  EXPECT_DOUBLE_EQ(found.perimeter, 2 * (2 * 5.0 + 3 * 2.0));  // two rows high, three columns wide
}

TEST(Summary, OfACappedBlockCountsThePixelsAtTheCap) {
  const contact::Summary found = Block(6).summary();
  EXPECT_DOUBLE_EQ(found.saturated_area_fraction, 1.0 / 80);
  EXPECT_DOUBLE_EQ(found.contact_area_fraction_pixels, 6.0 / 80);
  EXPECT_DOUBLE_EQ(found.mean_gap, 74.0 / 80);  // an overlap is no gap
}

TEST(Summary, AreaIsNeverBelowWhatTheCapMustHave) {
  Block block(6);
  block.state.mean_pressure = 0.45;  // 6 of 80 pixels at the cap would carry just that
  EXPECT_DOUBLE_EQ(block.summary().contact_area_fraction, 6.0 / 80);
}

/// What is found where these pixels are in contact, with and without a cap that all of them reach.
std::vector<contact::Summary> summaries_of(const Mask& contact) {
  std::vector<contact::Summary> all;
  for (const double cap : {kNoCap, 1.0}) {
    const Grid grid{contact.cols(), contact.rows(), 1, 1};
    contact::Problem problem;
    problem.bounds.upper = cap;
    contact::State state;
    state.mean_pressure = 1e-6;
    state.pressure = contact.cast<double>();
    state.displacement = Field::Zero(contact.rows(), contact.cols());
    state.gap = 1 - state.pressure;
    for (const bool periodic : {true, false}) {
      all.push_back(contact::summarise(state, problem, grid, periodic));
    }
  }
  return all;
}

template <typename Inside>
Mask mask_of(Index n, const Inside& inside) {
  Mask mask(n, n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) mask(y, x) = inside(double(x), double(y));
  }
  return mask;
}

void expect_counted(const Mask& contact, const std::string& name) {
  for (const Mask& mask : {contact, Mask(contact.transpose())}) {
    for (const contact::Summary& found : summaries_of(mask)) {
      EXPECT_FALSE(found.area_correction_valid) << name;
      EXPECT_DOUBLE_EQ(found.contact_area_fraction, mask.cast<double>().mean()) << name;
    }
  }
}

void expect_corrected(const Mask& contact, const std::string& name) {
  for (const contact::Summary& found : summaries_of(contact)) {
    EXPECT_TRUE(found.area_correction_valid) << name;
    EXPECT_LT(found.contact_area_fraction, found.contact_area_fraction_pixels) << name;
  }
}

TEST(Summary, AreaIsCountedWhereContactLinesRunAlongTheGrid) {
  const auto part = [](double a, double period) { return std::fmod(a, period); };
  for (const double width : {1.0, 4.0, 20.0}) {
    expect_counted(mask_of(64, [&](double x, double) { return part(x, 32) < width; }), "ridges");
    expect_counted(mask_of(64, [&](double x, double) { return x >= 30 && x < 30 + width; }), "one");
  }
  for (const double side : {4.0, 7.0, 15.0}) {
    expect_counted(
        mask_of(64, [&](double x, double y) { return part(x, 32) < side && part(y, 16) < side; }),
        "punches");
  }
  expect_counted(mask_of(64, [](double x, double y) { return x >= 9 && y >= 7; }), "a corner");
  expect_counted(
      mask_of(64, [](double x, double y) { return std::hypot((x - 31) / 30, (y - 31) / 2.5) < 1; }),
      "a needle");
}

TEST(Summary, AreaIsCorrectedWhereContactLinesCrossTheGrid) {
  for (const double radius : {1.2, 2.0, 3.5, 8.0, 25.0}) {
    for (const double place : {31.0, 31.3, 31.5}) {
      expect_corrected(
          mask_of(64,
                  [&](double x, double y) { return std::hypot(x - place, y - place) < radius; }),
          "disc");
    }
  }
  expect_corrected(mask_of(64, [](double x, double y) { return std::fmod(x + y, 32) < 9; }),
                   "ridges across");
  expect_corrected(mask_of(64, [](double x, double y) { return x == 20 && y == 30; }), "one pixel");
  const Field rough = self_affine(64, 0.8, 2, 16, 3);
  expect_corrected(rough > 0.5 * rough.maxCoeff(), "rough");
}

TEST(Summary, LooksAcrossTheEdgesOfAPeriodicCellOnly) {
  Block block(kNoCap);
  block.state.pressure.setZero();
  block.state.pressure.leftCols(3) = 1;
  EXPECT_DOUBLE_EQ(block.summary(true).perimeter, 2 * 40.0);
  EXPECT_DOUBLE_EQ(block.summary(false).perimeter, 40.0);
}

/// sum p r - min over q of sum q r, q as p within its bounds and of the same sum; over N P rms(z).
double certificate_of(const Field& pressure, const Field& height, double cap) {
  const Grid grid = square(height.rows());
  Field displacement(height.rows(), height.cols());
  elastic::make_periodic(grid, 1.0)->apply(pressure, displacement);
  const Field residual = displacement - height;
  std::vector<double> ascending(residual.data(), residual.data() + residual.size());
  std::sort(ascending.begin(), ascending.end());
  const double load = pressure.sum();
  double left = load;
  double least = 0;
  for (const double r : ascending) {
    least += std::min(cap, left) * r;
    left -= std::min(cap, left);
  }
  const double rms = std::sqrt((height - height.mean()).square().mean());
  return ((pressure * residual).sum() - least) / (load * rms);
}

TEST(SolveContact, CertificateIsThatOfTheReturnedPressure) {
  const Field height = self_affine(48, 0.8, 1, 12, 5);
  for (const contact::Solver solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
    for (const double cap : {kNoCap, 0.3}) {
      const Solved solved = solve_unit(height, 0.02, cap, 1e-2, solver);
      const double found = solved.state.convergence.certificate;
      EXPECT_TRUE(solved.state.convergence.converged());
      if (solver == contact::Solver::polonsky_keer && cap == kNoCap) {  // one pair each
        EXPECT_EQ(solved.state.convergence.operator_applications,
                  solved.state.convergence.fft_pairs);
      }
      EXPECT_NEAR(certificate_of(solved.state.pressure, height, cap) / found, 1, 1e-3);
    }
  }
}

// Powers of two change the exponents of all numbers and none of their digits.
TEST(SolveContact, CertificateHasNoUnit) {
  const Field height = self_affine(32, 0.8, 1, 8, 6);
  const auto certificate = [&](double length, double modulus, double pressure, double cap) {
    const Grid grid = square(32, length);
    const auto elasticity = elastic::make_periodic(grid, modulus);
    contact::Problem problem;
    problem.height = height * length;
    problem.control = contact::MeanPressure{pressure * modulus};
    problem.bounds.upper = cap * modulus;
    return contact::solve(*elasticity, problem).convergence.certificate;
  };
  for (const double pressure : {0.02, 8.0}) {  // the second is full contact
    const double expected = certificate(1, 1, pressure, kNoCap);
    EXPECT_GT(expected, 0);
    EXPECT_LE(expected, 1e-6);
    EXPECT_NEAR(certificate(0x1p-20, 1, pressure, kNoCap) / expected, 1, 1e-9);
    EXPECT_NEAR(certificate(1, 0x1p36, pressure, kNoCap) / expected, 1, 1e-9);
  }
}

}  // namespace
}  // namespace tabor::test
