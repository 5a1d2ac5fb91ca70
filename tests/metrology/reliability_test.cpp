#include "tabor/metrology/spectra/reliability.hpp"

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "support/rough_recipe.hpp"
#include "support/sample_surfaces.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

const Grid kGrid{200, 160, 200e-6, 160e-6};

/// Second difference of a parabola at any distance is its curvature.
topography::Topography paraboloid(double curvature) {
  return surface(kGrid, [=](double x, double y) {
    return -0.5 * curvature * (std::pow(x - 1e-4, 2) + std::pow(y - 8e-5, 2));
  });
}

TEST(TipLimitedWavelength, IsNoneOnBlunterPeaks) {
  const auto peak = paraboloid(0.49e5);
  EXPECT_EQ(tip_limited_wavelength(peak.height, kGrid, 10e-6), 0);
}

TEST(TipLimitedWavelength, IsTheWholeFieldOnASharperParaboloid) {
  const auto peak = paraboloid(0.51e5);
  EXPECT_NEAR(tip_limited_wavelength(peak.height, kGrid, 10e-6), 198e-6, 1e-9);
}

TEST(TipLimitedWavelength, DoesNotMindSharpValleys) {
  auto valley = paraboloid(3e5);
  valley.height = -valley.height;
  EXPECT_EQ(tip_limited_wavelength(valley.height, kGrid, 10e-6), 0);
}

// Of a ridge |x| second differences over d at its top are -2 s / d.
TEST(TipLimitedWavelength, OfARidgeIsWhereItsSecondDifferenceCrosses) {
  const auto ridge = surface(kGrid, [](double x, double) { return -0.1 * std::abs(x - 99.5e-6); });
  // 0.2 / d > 1 / (2 * 40 um) up to d < 16 um: the last pixel distance is 15.
  EXPECT_NEAR(tip_limited_wavelength(ridge.height, kGrid, 40.001e-6 / 1.0), 32e-6, 1e-9);
  EXPECT_NEAR(tip_limited_wavelength(ridge.height, kGrid, 39.99e-6), 30e-6, 1e-9);
}

TEST(TipLimitedWavelength, LeavesHolesOut) {
  auto rough = paraboloid(0.49e5);
  punch_holes(rough, 0.5);
  EXPECT_EQ(tip_limited_wavelength(rough.height, kGrid, 10e-6), 0);
}

TEST(TipLimitedWavelength, RejectsATipWithoutARadius) {
  const auto rough = noise(kGrid);
  for (const double radius : {0.0, -1e-6, kHole}) {
    EXPECT_THAT(
        tabor::test::rejection([&] { tip_limited_wavelength(rough.height, kGrid, radius); }),
        HasSubstr("<tip_radius=2um>"));
  }
}

TEST(TrustedRange, LiesBetweenPixelAndSide) {
  const auto smooth = paraboloid(1);
  const auto range = trusted_range(smooth.height, {200, 160, 400e-6, 160e-6});
  EXPECT_DOUBLE_EQ(range.shortest, 8e-6);
  EXPECT_DOUBLE_EQ(range.longest, 40e-6);
  EXPECT_FALSE(range.tip_limits);
}

TEST(TrustedRange, BeginsWhereTheTipEnds) {
  const auto ridge = surface(kGrid, [](double x, double) { return -0.1 * std::abs(x - 99.5e-6); });
  const auto range = trusted_range(ridge.height, kGrid, 39.99e-6);
  EXPECT_TRUE(range.tip_limits);
  EXPECT_NEAR(range.shortest, 30e-6, 1e-9);
}

/// An exact power law has the exact exponent, whatever the bins.
TEST(DifferenceHurst, IsExactOnAnExactPowerLaw) {
  HeightDifference differences;
  for (int k = 1; k <= 300; ++k) {
    differences.lag.push_back(1e-6 * k);
    differences.mean_square.push_back(1e-18 * std::pow(k, 2 * 0.63));
    differences.pairs.push_back(1000);
  }
  const auto fit = fit_hurst(differences, 1);
  EXPECT_NEAR(fit.hurst, 0.63, 1e-4);
  EXPECT_LT(fit.standard_error, 1e-4);
  EXPECT_EQ(fit.lag_min, 2e-6);
  EXPECT_EQ(fit.lag_max, 300e-6);
}

TEST(DifferenceHurst, StopsBeforeThePlateau) {
  HeightDifference differences;
  for (int k = 1; k <= 300; ++k) {
    differences.lag.push_back(k);
    differences.mean_square.push_back(2 * (1 - std::exp(-std::pow(k / 100.0, 1.2))));
    differences.pairs.push_back(1000);
  }
  const auto fit = fit_hurst(differences, 1);
  EXPECT_LE(fit.lag_max, 29);  // 100 (-ln 0.8)^(1/1.2)
  EXPECT_NEAR(fit.hurst, 0.6, 0.03);
}

TEST(DifferenceHurst, IsNoNumberWithoutThreeBins) {
  EXPECT_TRUE(std::isnan(fit_hurst(HeightDifference{}, 1).hurst));
}

synthesis::SelfAffine recipe_of(double hurst, std::uint64_t seed) {
  synthesis::SelfAffine recipe;
  recipe.grid = {256, 256, 256e-6, 256e-6};
  recipe.hurst = hurst;
  recipe.rms_height = 1e-6;
  recipe.random_amplitudes = true;
  recipe.seed = seed;
  return recipe;
}

/// Exponents found on many surfaces of one kind, and what they claim to be known to.
struct Sample {
  double n = 0, sum = 0, squares = 0, claimed = 0;
  void add(const HurstFit& fit) {
    n += 1;
    sum += fit.hurst;
    squares += fit.hurst * fit.hurst;
    claimed += fit.standard_error * fit.standard_error;
  }
  double mean() const { return sum / n; }
  double scatter() const { return std::sqrt((squares - sum * sum / n) / (n - 1)); }
  double error() const { return std::sqrt(claimed / n); }
};

struct Surfaces {
  double hurst;
  Index n_pixels;
  PsdWindow window;
};

class HurstOfManySurfaces : public testing::TestWithParam<Surfaces> {};

/// Over surfaces of the same recipe the exponent scatters by as much as its standard error says,
/// and its mean is right. Scatter of 48 numbers is known to a tenth.
TEST_P(HurstOfManySurfaces, ScattersByItsStandardError) {  // slow
  const auto [hurst, n_pixels, window] = GetParam();
  Sample lines, radial;
  for (std::uint64_t seed = 1; seed <= 48; ++seed) {
    const auto spectra =
        power_spectra(synthesis::self_affine(tabor::test::rough_recipe(n_pixels, hurst, seed)),
                      {.window = window});
    lines.add(spectra.x.hurst);
    lines.add(spectra.y.hurst);
    radial.add(spectra.radial.hurst);
  }
  EXPECT_GT(radial.scatter() / radial.error(), 0.8);
  EXPECT_LT(radial.scatter() / radial.error(), 1.25);
  EXPECT_GT(lines.scatter() / lines.error(), 0.8);
  EXPECT_LT(lines.scatter() / lines.error(), 1.25);
  EXPECT_NEAR(radial.mean(), hurst, 0.5 * radial.error());
  // Sums over all qy up to Nyquist fall a little faster than a power law of qx.
  EXPECT_NEAR(lines.mean(), hurst, hurst < 0.5 ? 0.04 : 0.025);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, HurstOfManySurfaces,
    testing::Values(Surfaces{0.3, 256, PsdWindow::none}, Surfaces{0.8, 256, PsdWindow::none},
                    Surfaces{0.5, 128, PsdWindow::none}, Surfaces{0.3, 256, PsdWindow::hann},
                    Surfaces{0.8, 256, PsdWindow::hann}, Surfaces{0.5, 128, PsdWindow::hann},
                    Surfaces{0.8, 128, PsdWindow::hann}, Surfaces{0.8, 128, PsdWindow::none}));

/// Grooves have as many independent profiles as there are grooves' waves: one.
TEST(HurstOfGrooves, IsKnownLessWellThanOfAsManyIndependentProfiles) {
  Sample grooves;
  for (std::uint64_t seed = 1; seed <= 48; ++seed) {
    auto map = synthesis::self_affine(tabor::test::rough_recipe(256, 0.8, seed));
    const Eigen::ArrayXd profile = map.height.row(7).transpose();
    map.height.rowwise() = profile.transpose();
    grooves.add(power_spectra(map, {.window = PsdWindow::none}).x.hurst);
  }
  EXPECT_GT(grooves.scatter() / grooves.error(), 0.8);
  EXPECT_LT(grooves.scatter() / grooves.error(), 1.25);
}

TEST(HurstOfHeightDifferences, IsNearlyThatOfTheSurface) {
  for (const double hurst : {0.3, 0.6}) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto rough = synthesis::self_affine(recipe_of(hurst, seed));
      const auto differences = height_differences(rough.height, rough.grid);
      sum += fit_hurst(differences.radial, 1e-12).hurst / 4;
    }
    EXPECT_NEAR(sum, hurst, 0.12);  // pixels and the side bend a short range of scales
  }
}

/// Their scatter over that error grows with H: no one factor makes an error of it.
TEST(HurstOfHeightDifferences, ScattersByMoreThanItsErrorWhichIsALowerBound) {
  std::vector<double> ratios;
  for (const double hurst : {0.3, 0.8}) {
    Sample lines;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
      const auto rough = synthesis::self_affine(tabor::test::rough_recipe(128, hurst, seed));
      const auto differences = height_differences(rough.height, rough.grid);
      for (const HeightDifference& along : {differences.x, differences.y}) {
        const DifferenceHurst fit = fit_hurst(along, rough.height.square().mean());
        if (std::isfinite(fit.hurst)) {
          lines.add({.hurst = fit.hurst, .standard_error = fit.standard_error});
        }
      }
    }
    ratios.push_back(lines.scatter() / lines.error());
  }
  EXPECT_GT(ratios[0], 1.5);
  EXPECT_GT(ratios[1], 1.3 * ratios[0]);
}

}  // namespace
}  // namespace tabor::metrology::test
