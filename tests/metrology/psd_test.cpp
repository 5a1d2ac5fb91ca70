#include "tabor/metrology/spectra/psd.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "support/rough_recipe.hpp"
#include "support/sample_surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

const Grid kGrid{128, 96, 128e-6, 192e-6};

PsdOptions unwindowed() {
  PsdOptions options;
  options.window = PsdWindow::none;
  return options;
}

/// Where buffers lie in memory must not decide about the last bit.
TEST(PowerSpectra, HaveTheSameBitsHoweverMemoryIsUsed) {
  const auto rough = synthesis::self_affine(rough_recipe(101, 0.8));
  const auto first = power_spectra(rough, {});
  std::vector<std::vector<double>> blocks;
  for (std::size_t i = 1; i < 24; ++i) {
    blocks.emplace_back(2 * i + 1, 1.0);
    const auto again = power_spectra(rough, {});
    EXPECT_EQ(again.x.density, first.x.density) << i;
    EXPECT_EQ(again.y.density, first.y.density) << i;
    EXPECT_EQ(again.radial.density, first.radial.density) << i;
  }
}

TEST(PowerSpectra, ShowASineAtItsWavevectorWithItsPower) {
  const double a = 3e-6;
  const auto wave =
      surface(kGrid, [=](double x, double) { return a * std::sin(2 * pi * 9 * x / kGrid.lx); });
  const auto spectra = power_spectra(wave, unwindowed());
  const auto peak = std::max_element(spectra.x.density.begin(), spectra.x.density.end());
  const auto k = static_cast<std::size_t>(peak - spectra.x.density.begin());
  EXPECT_EQ(k, 8u);
  EXPECT_NEAR(spectra.x.q[k], 2 * pi * 9 / kGrid.lx, 1e-6);
  EXPECT_NEAR(*peak / (a * a * kGrid.lx / 4), 1, 1e-12);  // |dx FFT|^2 / L of a sine
  EXPECT_LT(spectra.y.rms_height, 1e-20);
}

class Parseval : public testing::TestWithParam<std::pair<Index, Index>> {};

TEST_P(Parseval, HoldsWithoutAWindow) {
  const auto [nx, ny] = GetParam();
  const auto rough = noise({nx, ny, 1e-4, 2e-4});
  const auto spectra = power_spectra(rough, unwindowed());
  tabor::test::expect_within("Power spectra", fmt::format("Parseval, {} x {}", nx, ny),
                             "rms height", "direct sum",
                             std::abs(spectra.rms_height / rms_height(rough) - 1), 1e-12);
}

TEST_P(Parseval, HoldsForProfilesAboutTheirMeans) {
  const auto [nx, ny] = GetParam();
  const auto rough = noise({nx, ny, 1e-4, 2e-4});
  const Field rows = rough.height.colwise() - rough.height.rowwise().mean();
  const Field columns = rough.height.rowwise() - rough.height.colwise().mean();
  const auto spectra = power_spectra(rough, unwindowed());
  EXPECT_NEAR(spectra.x.rms_height / std::sqrt(rows.square().mean()), 1, 1e-12);
  EXPECT_NEAR(spectra.y.rms_height / std::sqrt(columns.square().mean()), 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Parseval,
                         testing::Values(std::pair<Index, Index>{64, 48},
                                         std::pair<Index, Index>{63, 50},
                                         std::pair<Index, Index>{64, 49},
                                         std::pair<Index, Index>{101, 37}));

/// Integral over q > 0 of a density sampled once per bin of a square scan.
double integral(const Spectrum& spectrum) {
  const double dq = 2 * pi / 256e-6;
  return dq * std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.0);
}

topography::Topography rough_surface(Index n = 256, double hurst = 0.8, double roll_off = 0,
                                     std::uint64_t seed = 1) {
  synthesis::SelfAffine recipe = rough_recipe(n, hurst, seed);
  recipe.roll_off_wavelength = roll_off;
  return synthesis::self_affine(recipe);
}

TEST(PsdConventions, IntegrateToTheMeanSquareEachInItsWay) {
  const auto rough = rough_surface(256, 0.8, 16e-6);  // most of its power far from the first ring
  auto options = unwindowed();
  const double line = std::pow(power_spectra(rough, options).x.rms_height, 2);
  EXPECT_NEAR(integral(power_spectra(rough, options).x) / pi / line, 1, 1e-9);
  options.convention = PsdConvention::persson;
  EXPECT_NEAR(2 * integral(power_spectra(rough, options).x) / line, 1, 1e-9);
  options.convention = PsdConvention::gwyddion;
  const auto gwyddion = power_spectra(rough, options);
  EXPECT_NEAR(2 * integral(gwyddion.x) / line, 1, 1e-9);
  EXPECT_NEAR(integral(gwyddion.radial) / std::pow(gwyddion.rms_height, 2), 1, 0.02);  // rings
  EXPECT_EQ(gwyddion.radial.unit, "m^3");
}

TEST(PsdConventions, OfTheAreaDifferByFourPiSquared) {
  const auto rough = rough_surface();
  auto options = unwindowed();
  const auto jacobs = power_spectra(rough, options);
  options.convention = PsdConvention::persson;
  const auto persson = power_spectra(rough, options);
  EXPECT_NEAR(jacobs.radial.density[20] / persson.radial.density[20], 4 * pi * pi, 1e-9);
  EXPECT_EQ(jacobs.radial.unit, "m^4");
  EXPECT_EQ(jacobs.radial.hurst.hurst, persson.radial.hurst.hurst);
}

TEST(PowerSpectra, OfARingAverageEqualTheTargetSpectrum) {
  synthesis::SelfAffine recipe;
  recipe.grid = {128, 128, 128e-6, 128e-6};
  recipe.hurst = 0.6;
  recipe.rms_height = 1e-6;
  const auto spectra = power_spectra(synthesis::self_affine(recipe));
  // Random phases only: every mode has exactly the power of the law, q^-3.2.
  const double a = spectra.radial.density[9] * std::pow(spectra.radial.q[9], 3.2);
  const double b = spectra.radial.density[49] * std::pow(spectra.radial.q[49], 3.2);
  EXPECT_NEAR(a / b, 1, 0.01);  // rings have a width
}

class HurstOfSurface : public testing::TestWithParam<double> {};

TEST_P(HurstOfSurface, IsFoundWithinItsError) {
  const auto spectra = power_spectra(rough_surface(512, GetParam()));
  for (const HurstFit& fit : {spectra.x.hurst, spectra.y.hurst, spectra.radial.hurst}) {
    EXPECT_NEAR(fit.hurst, GetParam(), 0.03 + 3 * fit.standard_error);
    EXPECT_LT(fit.standard_error, 0.05);
    EXPECT_GE(fit.n_bins, 8);
  }
}

INSTANTIATE_TEST_SUITE_P(Exponents, HurstOfSurface, testing::Values(0.3, 0.5, 0.8, 1.0));

TEST(FitHurst, IsExactOnAnExactPowerLaw) {
  std::vector<double> q, density;
  for (int i = 1; i <= 1000; ++i) {
    q.push_back(1e4 * i);
    density.push_back(1e-20 * std::pow(q.back(), -(1 + 2 * 0.77)));
  }
  const auto fit = fit_hurst(q, density, 1, 5e4, 5e6);
  EXPECT_NEAR(fit.hurst, 0.77, 1e-4);  // mean logs of a bin lie slightly off the curve
  EXPECT_LT(fit.standard_error, 1e-4);
  EXPECT_EQ(fit.q_min, 5e4);
}

TEST(FitHurst, GivesNoNumberWithoutThreeBins) {
  EXPECT_TRUE(std::isnan(fit_hurst({1, 2}, {1, 0.5}, 1, 1, 2).hurst));
  EXPECT_TRUE(std::isnan(fit_hurst({}, {}, 1, 1, 2).hurst));
}

// Random phases only: every mode has the power of the law, so that what is left is the filter's
// bias.
TEST(FindFitRange, StaysAboveTheRollOffAndBelowAFilter) {
  synthesis::SelfAffine recipe;
  recipe.grid = {512, 512, 512e-6, 512e-6};
  recipe.rms_height = 1e-6;
  recipe.hurst = 0.7;
  recipe.roll_off_wavelength = 128e-6;
  const auto smooth =
      topography::low_pass(synthesis::self_affine(recipe), topography::parse_filter("hann:3um"));
  const auto fit = power_spectra(smooth).radial.hurst;
  EXPECT_GT(fit.q_min, 0.9 * 2 * pi / 128e-6);
  EXPECT_LT(fit.q_max, 2 * pi / 3e-6);
  EXPECT_NEAR(fit.hurst, 0.7, 0.1);
}

TEST(FindFitRange, IsNotCutShortByTheScatterOfTheFirstBins) {
  Spectrum spectrum;
  for (int k = 1; k <= 500; ++k) {
    spectrum.q.push_back(k);
    spectrum.density.push_back(std::pow(k, -2.5) * (k == 4 ? 3.5 : k == 7 ? 0.3 : 1));
    spectrum.modes.push_back(3 * k);
  }
  EXPECT_EQ(find_fit_range(spectrum, 1).q_max, 250);
}

/// All waves are there up to the cut-off, none beyond.
TEST(FindFitRange, ReachesASharpCutOff) {
  for (const double hurst : {0.3, 0.8}) {
    for (const double cutoff : {5e-6, 8e-6, 16e-6}) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        synthesis::SelfAffine recipe = rough_recipe(512, hurst, seed);
        recipe.short_cutoff_wavelength = cutoff;
        const auto fit = power_spectra(synthesis::self_affine(recipe), unwindowed()).radial.hurst;
        EXPECT_GT(fit.q_max, 0.95 * 2 * pi / cutoff) << hurst << ' ' << cutoff << ' ' << seed;
        EXPECT_LE(fit.q_max, 1.001 * 2 * pi / cutoff) << hurst << ' ' << cutoff << ' ' << seed;
        EXPECT_NEAR(fit.hurst, hurst, 3 * fit.standard_error) << cutoff << ' ' << seed;
        EXPECT_LT(fit.standard_error, 0.06) << cutoff;
      }
    }
  }
}

TEST(FindFitRange, LeavesOutAGradualFall) {
  for (const double hurst : {0.3, 0.8}) {
    for (const double cutoff : {10e-6, 20e-6}) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto smooth =
            topography::low_pass(rough_surface(512, hurst, 0, seed),
                                 {.kind = topography::FilterKind::gauss, .wavelength = cutoff});
        const auto fit = power_spectra(smooth, unwindowed()).radial.hurst;
        // The filter takes exp(-2 ln 2 (q cutoff/2 pi)^2) of the power: a quarter is left at the
        // cutoff.
        EXPECT_LT(fit.q_max, 0.5 * 2 * pi / cutoff) << hurst << ' ' << cutoff << ' ' << seed;
        EXPECT_GT(fit.q_max, 0.2 * 2 * pi / cutoff) << hurst << ' ' << cutoff << ' ' << seed;
        EXPECT_NEAR(fit.hurst, hurst, 3 * fit.standard_error) << cutoff << ' ' << seed;
      }
    }
  }
}

TEST(PowerSpectra, OfTheTransposedSurfaceSwapXAndY) {
  const auto rough = noise(kGrid);
  const auto straight = power_spectra(rough), turned = power_spectra(topography::transpose(rough));
  ASSERT_EQ(straight.x.density.size(), turned.y.density.size());
  for (std::size_t i = 0; i < straight.x.density.size(); ++i) {
    EXPECT_NEAR(straight.x.density[i] / turned.y.density[i], 1, 1e-10);
  }
  EXPECT_NEAR(straight.rms_slope / turned.rms_slope, 1, 1e-12);
}

TEST(PowerSpectra, ScaleWithTheSquareOfTheHeights) {
  auto rough = rough_surface();
  const PsdOptions windowed{.window = PsdWindow::hann, .fit_q_min = {}, .fit_q_max = {}};
  const auto before = power_spectra(rough, windowed);
  rough.height *= 1e3;
  const auto after = power_spectra(rough, windowed);
  EXPECT_NEAR(after.radial.density[5] / before.radial.density[5], 1e6, 1e-4);
  EXPECT_NEAR(after.x.hurst.hurst, before.x.hurst.hurst, 1e-9);
}

TEST(PowerSpectra, GiveTheSpectralSlopeOfAWave) {
  const auto wave = surface(kGrid, [](double x, double y) {
    return 1e-6 * std::cos(2 * pi * (4 * x / kGrid.lx + 7 * y / kGrid.ly));
  });
  const double q = 2 * pi * std::hypot(4 / kGrid.lx, 7 / kGrid.ly);
  EXPECT_NEAR(power_spectra(wave, unwindowed()).rms_slope / (1e-6 * q / std::numbers::sqrt2), 1,
              1e-12);
}

TEST(PowerSpectra, WindowByDefaultWhoseEdgesDoNotMatch) {
  const auto wave =
      surface(kGrid, [](double x, double) { return 1e-6 * std::cos(2 * pi * 4 * x / kGrid.lx); });
  EXPECT_FALSE(wave.periodic);
  EXPECT_EQ(power_spectra(wave).window, PsdWindow::none);
  auto rough = noise(kGrid);
  for (Index x = 0; x < kGrid.nx; ++x) rough.height.col(x) += 1e-6 * static_cast<double>(x);
  EXPECT_EQ(power_spectra(rough).window, PsdWindow::hann);
  const auto spectra = power_spectra(rough);
  EXPECT_DOUBLE_EQ(spectra.window_gain,
                   std::pow(spectra.rms_height / numerics::rms_height(rough.height), 2));
  EXPECT_GT(std::abs(spectra.window_gain - 1), 0.01);
  rough.periodic = true;
  EXPECT_EQ(power_spectra(rough).window, PsdWindow::none);
  EXPECT_EQ(power_spectra(rough).window_gain, 1);
}

TEST(PowerSpectra, OfWhiteNoiseAreFlatThroughTheWindow) {
  const CounterRandom random(3);
  std::uint64_t k = 0;
  const auto white =
      surface({512, 512, 512, 512}, [&](double, double) { return random.normal(k++); });
  const auto spectra =
      power_spectra(white, {.window = PsdWindow::hann, .fit_q_min = {}, .fit_q_max = {}});
  const auto begin = spectra.x.density.begin();
  EXPECT_NEAR(std::accumulate(begin + 10, begin + 250, 0.0) / 240, 1, 0.01);  // variance * dx
}

TEST(PowerSpectra, OfAProfileAreThoseOfItsLine) {
  const Grid grid{240, 1, 120e-6, 1e-6};
  const double a = 2e-6;
  const auto row =
      surface(grid, [=](double x, double) { return a * std::sin(2 * pi * 6 * x / grid.lx); });
  const auto spectra = power_spectra(row, unwindowed());
  EXPECT_NEAR(spectra.x.density[5] / (a * a * grid.lx / 4), 1, 1e-12);
  EXPECT_TRUE(spectra.y.q.empty());
  EXPECT_TRUE(spectra.radial.q.empty());
  EXPECT_NEAR(spectra.rms_height / (a / std::sqrt(2)), 1, 1e-12);
  EXPECT_NEAR(spectra.rms_slope / (a / std::sqrt(2) * 2 * pi * 6 / grid.lx), 1, 1e-12);
  EXPECT_EQ(spectra.window_gain, 1);
}

TEST(PowerSpectra, OfAColumnAreThoseOfTheSameRow) {
  const auto row = noise({200, 1, 100e-6, 3e-6});
  auto column = row;
  column.grid = {1, 200, 3e-6, 100e-6};
  column.height = row.height.transpose();
  const auto spectra = power_spectra(column);
  EXPECT_EQ(spectra.y.density, power_spectra(row).x.density);
  EXPECT_TRUE(spectra.x.q.empty());
  EXPECT_EQ(spectra.window_gain, power_spectra(row).window_gain);
}

TEST(PowerSpectra, RejectASingleHeight) {
  const auto point = surface({1, 1, 1e-6, 1e-6}, [](double, double) { return 1e-6; });
  EXPECT_THROW(power_spectra(point), InputError);
}

TEST(PowerSpectra, RejectHoles) {
  auto holed = noise(kGrid);
  holed.height(0, 0) = kHole;
  try {
    power_spectra(holed);
    FAIL() << "accepted holes";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("<fill=harmonic>"));
  }
}

TEST(PowerSpectra, RejectAFitThatEndsBeforeItBegins) {
  const auto rough = noise({16, 16, 1e-3, 1e-3});
  EXPECT_THROW(power_spectra(rough, {.window = {}, .fit_q_min = 2e4, .fit_q_max = 1e4}),
               InputError);
  EXPECT_NO_THROW(power_spectra(rough, {.window = {}, .fit_q_min = 1e4, .fit_q_max = 2e4}));
  EXPECT_THROW(power_spectra(rough, {.window = {}, .fit_q_min = 1e12, .fit_q_max = {}}),
               InputError);
  EXPECT_THROW(power_spectra(rough, {.window = {}, .fit_q_min = {}, .fit_q_max = 1e-3}),
               InputError);
}

TEST(PowerSpectra, GiveTheSameBitsOnAnyNumberOfThreads) {
  const auto rough = noise({300, 200, 1e-3, 1e-3});
  expect_same_bits_on_any_threads([&] {
    const auto density = power_spectra(rough).radial.density;
    return Field(Eigen::Map<const Field>(density.data(), 1, static_cast<Index>(density.size())));
  });
}

TEST(PsdNames, AreReadAndWritten) {
  EXPECT_EQ(psd_convention_from("persson"), PsdConvention::persson);
  EXPECT_EQ(psd_window_from("hann"), PsdWindow::hann);
  EXPECT_FALSE(psd_convention_from("perssson"));
  EXPECT_EQ(name_of(PsdConvention::gwyddion), "gwyddion");
  EXPECT_EQ(name_of(PsdWindow::none), "none");
}

}  // namespace
}  // namespace tabor::metrology::test
