#include "tabor/metrology/spectra/correlation.hpp"

#include <gmock/gmock.h>

#include <map>

#include "support/rejection.hpp"
#include "support/sample_surfaces.hpp"
#include "support/scans.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/spectra/height_differences.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/levelling.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

/// Sums over all pairs of valid points that are (ly, lx) apart, one by one.
struct DirectSums {
  double products = 0;  ///< about the mean of all valid points
  double squares = 0;   ///< of differences
  double pairs = 0;
};

DirectSums direct_sums(const Field& height, Index ly, Index lx) {
  const auto valid = !height.isNaN();
  const double mean = valid.select(height, 0).sum() / static_cast<double>(valid.count());
  DirectSums sums;
  for (Index y = std::max<Index>(0, -ly); y < std::min(height.rows(), height.rows() - ly); ++y) {
    for (Index x = std::max<Index>(0, -lx); x < std::min(height.cols(), height.cols() - lx); ++x) {
      const double a = height(y, x), b = height(y + ly, x + lx);
      if (!std::isnan(a) && !std::isnan(b)) {
        sums.products += (a - mean) * (b - mean);
        sums.squares += (a - b) * (a - b);
        sums.pairs += 1;
      }
    }
  }
  return sums;
}

class Correlations : public testing::TestWithParam<double> {
 protected:
  topography::Topography scan(Index nx, Index ny) const {
    auto rough = noise({nx, ny, static_cast<double>(nx) * 1e-6, static_cast<double>(ny) * 1.7e-6});
    punch_holes(rough, GetParam());
    return rough;
  }
};

TEST_P(Correlations, AreTheMeanProductOfAllPairs) {
  const auto rough = scan(23, 17);
  const auto acf = autocorrelation(rough.height, rough.grid);
  const DirectSums zero = direct_sums(rough.height, 0, 0);
  double largest = 0;
  for (Index ly = -16; ly <= 16; ++ly) {
    for (Index lx = -22; lx <= 22; ++lx) {
      const DirectSums sums = direct_sums(rough.height, ly, lx);
      if (sums.pairs == 0) {
        EXPECT_TRUE(std::isnan(acf(ly, lx))) << ly << ' ' << lx;
      } else {
        const double exact = sums.products / sums.pairs / (zero.products / zero.pairs);
        // Single precision: errors are relative to the sum over all pairs.
        largest =
            tabor::test::worse(largest, std::abs(acf(ly, lx) - exact) * sums.pairs / zero.pairs);
      }
    }
  }
  tabor::test::expect_within("Spectra", fmt::format("autocorrelation, {} holes", GetParam()),
                             "all lags", "direct sum over pairs", largest, 5e-7);
}

TEST_P(Correlations, OfDifferencesAreTheirMeanSquares) {
  const auto rough = scan(23, 17);
  const auto differences = height_differences(rough.height, rough.grid);
  double largest = 0;
  const auto compare = [&](const HeightDifference& got, Index k, const DirectSums& sums) {
    const auto i = static_cast<std::size_t>(k - 1);
    EXPECT_EQ(got.pairs[i], sums.pairs);
    largest =
        tabor::test::worse(largest, std::abs(got.mean_square[i] / (sums.squares / sums.pairs) - 1));
  };
  for (Index k = 1; k <= 12; ++k) {
    EXPECT_NEAR(differences.x.lag[static_cast<std::size_t>(k - 1)], 1e-6 * static_cast<double>(k),
                1e-18);
    EXPECT_NEAR(differences.y.lag[static_cast<std::size_t>(k - 1)], 1.7e-6 * static_cast<double>(k),
                1e-18);
    compare(differences.x, k, direct_sums(rough.height, 0, k));
    compare(differences.y, k, direct_sums(rough.height, k, 0));
  }
  tabor::test::expect_within("Spectra", fmt::format("height differences, {} holes", GetParam()),
                             "along x and y, relative", "direct sum over pairs", largest, 1e-12);
}

TEST_P(Correlations, OfDifferencesInRingsAreThoseOfAllTheirPairs) {
  const auto rough = scan(19, 13);
  const auto radial = height_differences(rough.height, rough.grid).radial;
  struct Ring {
    double squares = 0, pairs = 0, distances = 0;
  };
  std::map<int, Ring> rings;  // width 1.7 um
  for (Index ly = 0; ly <= 12; ++ly) {
    for (Index lx = ly == 0 ? 1 : -18; lx <= 18; ++lx) {
      const DirectSums sums = direct_sums(rough.height, ly, lx);
      const double r = std::hypot(1e-6 * static_cast<double>(lx), 1.7e-6 * static_cast<double>(ly));
      Ring& ring = rings[static_cast<int>(std::floor(r / 1.7e-6 + 0.5))];
      ring.squares += sums.squares;
      ring.pairs += sums.pairs;
      ring.distances += sums.pairs * r;
    }
  }
  ASSERT_EQ(radial.lag.size(), 11U);  // the shorter side is 19 um
  for (std::size_t i = 0; i < radial.lag.size(); ++i) {
    const Ring& ring = rings.at(static_cast<int>(i) + 1);
    EXPECT_EQ(radial.pairs[i], ring.pairs);
    EXPECT_NEAR(radial.mean_square[i] / (ring.squares / ring.pairs), 1, 1e-12);
    EXPECT_NEAR(radial.lag[i] / (ring.distances / ring.pairs), 1, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(ShareOfHoles, Correlations, testing::Values(0.0, 0.1, 0.6));

TEST(Autocorrelation, OfAWaveIsItsCosine) {
  const double period = 16e-6;
  const auto wave = surface({320, 240, 320e-6, 240e-6},
                            [&](double x, double) { return 1e-6 * std::cos(2 * pi * x / period); });
  const auto acf = autocorrelation(wave.height, wave.grid);
  EXPECT_NEAR(acf.mean_square(), 0.5e-12, 1e-25);
  for (Index lx = 0; lx < 200; lx += 16) {  // where unbiased means of whole periods are exact
    EXPECT_NEAR(acf(3, lx), 1, 1e-5);
  }
  EXPECT_NEAR(acf(0, 8), -1, 2e-2);
}

TEST(Autocorrelation, IsSymmetricAboutZeroLag) {
  const auto rough = noise({31, 40, 1e-3, 1e-3});
  const auto acf = autocorrelation(rough.height, rough.grid);
  EXPECT_FLOAT_EQ(static_cast<float>(acf(0, 0)), 1);
  EXPECT_EQ(acf(5, -7), acf(-5, 7));
  EXPECT_NEAR(acf(0, -7), acf(0, 7), 1e-6);
  EXPECT_TRUE(std::isnan(acf(40, 0)));
  EXPECT_TRUE(std::isnan(acf(0, 31)));
}

TEST(Autocorrelation, InterpolatesBetweenLags) {
  const auto rough = noise({30, 20, 30e-6, 40e-6});
  const auto acf = autocorrelation(rough.height, rough.grid);
  EXPECT_NEAR(acf.at(6e-6, 4e-6), acf(3, 4), 1e-12);
  EXPECT_NEAR(acf.at(7e-6, 4.5e-6), (acf(3, 4) + acf(4, 4) + acf(3, 5) + acf(4, 5)) / 4, 1e-12);
  EXPECT_NEAR(acf.at(0, -4e-6), acf(0, -4), 1e-12);
  EXPECT_FALSE(std::isnan(acf.at(0, 29e-6)));
  EXPECT_TRUE(std::isnan(acf.at(0, 29.5e-6)));
}

TEST(Autocorrelation, OfAFlatHasNoValues) {
  const auto flat = surface({12, 9, 1e-3, 1e-3}, [](double, double) { return 3e-6; });
  const auto acf = autocorrelation(flat.height, flat.grid);
  EXPECT_EQ(acf.mean_square(), 0);
  EXPECT_TRUE(std::isnan(acf(0, 0)));
  EXPECT_TRUE(std::isnan(correlation_lengths(acf).shortest));
  for (const double square : height_differences(flat.height, flat.grid).radial.mean_square) {
    EXPECT_EQ(square, 0);
  }
}

TEST(Autocorrelation, DoesNotDependOnUnitsOrOffset) {
  auto rough = noise({48, 36, 1e-3, 1e-3});
  const auto before = autocorrelation(rough.height, rough.grid);
  rough.height = 1e-12 * rough.height + 1e-15;  // atoms of atoms
  const auto after = autocorrelation(rough.height, rough.grid);
  EXPECT_NEAR(after(4, -9), before(4, -9), 1e-6);
  EXPECT_NEAR(after.mean_square() / before.mean_square(), 1e-24, 1e-33);
}

TEST(Autocorrelation, RejectsAScanOfHoles) {
  const Field nothing = Field::Constant(8, 8, kHole);
  const Grid grid{8, 8, 1, 1};
  EXPECT_THAT(tabor::test::rejection([&] { autocorrelation(nothing, grid); }),
              testing::HasSubstr("no valid height"));
  EXPECT_THAT(tabor::test::rejection([&] { height_differences(nothing, grid); }),
              testing::HasSubstr("no valid height"));
}

TEST(Correlation, GivesTheSameBitsOnAnyNumberOfThreads) {
  auto rough = noise({300, 200, 1e-3, 1e-3});
  punch_holes(rough, 0.2);
  expect_same_bits_on_any_threads([&] {
    const auto acf = autocorrelation(rough.height, rough.grid);
    Field values(200, 300);
    for (Index i = 0; i < values.size(); ++i) values.data()[i] = acf(i / 300, i % 300);
    return values;
  });
  expect_same_bits_on_any_threads([&] {
    const auto squares = height_differences(rough.height, rough.grid).radial.mean_square;
    return Field(Eigen::Map<const Field>(squares.data(), 1, std::ssize(squares)));
  });
}

/// White noise smoothed by a Gaussian of the given widths [pixels] has the autocorrelation
/// exp(-x^2 / (4 a^2) - y^2 / (4 b^2)); its values at single lags are estimated from one surface.
topography::Topography gaussian_bumps(Index n, double a, double b, std::uint64_t seed) {
  const CounterRandom random(seed);
  std::uint64_t counter = 0;
  const double side = static_cast<double>(n) * 1e-6;
  auto rough =
      surface({n, n, side, side}, [&](double, double) { return random.normal(counter++); });
  for (const double width : {a, b}) {
    Field smooth = Field::Zero(n, n);
    for (Index k = -40; k <= 40; ++k) {
      const double weight = std::exp(-static_cast<double>(k * k) / (2 * width * width));
      for (Index x = 0; x < n; ++x) {
        smooth.col(x) += weight * rough.height.col(((x + k) % n + n) % n);
      }
    }
    rough.height = Field(smooth.transpose());
  }
  return topography::level(rough, topography::Form::plane);
}

TEST(CorrelationLengths, OfSmoothedNoiseAreThoseOfItsGaussian) {
  const auto rough = gaussian_bumps(512, 3, 6, 4);
  const auto lengths = correlation_lengths(autocorrelation(rough.height, rough.grid));
  const double decay = 2 * std::sqrt(std::log(5.0));
  ASSERT_TRUE(lengths.longest);
  EXPECT_NEAR(lengths.shortest / (3e-6 * decay), 1, 0.04);
  EXPECT_NEAR(*lengths.longest / (6e-6 * decay), 1, 0.08);
  EXPECT_NEAR(*lengths.texture_aspect(), 0.5, 0.04);
  EXPECT_NEAR(std::abs(std::remainder(lengths.shortest_angle, pi)), 0, 0.15);
  EXPECT_NEAR(lengths.longest_angle, pi / 2, 0.15);
  EXPECT_EQ(lengths.n_unfinished_rays, 0);
}

TEST(CorrelationLengths, AlongALayAreOnlyBounded) {
  const auto lay = surface({256, 128, 256e-6, 128e-6},
                           [](double x, double) { return std::cos(2 * pi * x / 32e-6); });
  const auto lengths = correlation_lengths(autocorrelation(lay.height, lay.grid));
  EXPECT_FALSE(lengths.longest);
  EXPECT_FALSE(lengths.texture_aspect());
  // Part of a period is left at the end of the pairs: up to 1/(249 sin k) of the mean square, over
  // the slope of the cosine there; the straight line between two lags adds 0.025 pixels.
  EXPECT_NEAR(lengths.shortest, 32e-6 * std::acos(0.2) / (2 * pi), 0.13e-6);
  EXPECT_NEAR(lengths.longest_angle, pi / 2, 0.1);
  EXPECT_NEAR(lengths.reach, 127e-6, 1e-6);
  EXPECT_LT(lengths.texture_bound(), 0.06);
}

/// Rows "Sal" and "Str" of the table of reference values: scans after removal of a plane.
struct ReferenceTexture {
  const char* scan;
  double shortest;  ///< Sal [m]
  double aspect;    ///< Str; 0 = the autocorrelation never falls to 0.2 along the lay
};

class TextureOfScan : public testing::TestWithParam<ReferenceTexture> {};

TEST_P(TextureOfScan, IsThatOfTheReference) {
  const auto& [name, shortest, aspect] = GetParam();
  TABOR_NEEDS_SHARED_SCAN(name);
  const auto scan =
      topography::level(scan::read(tabor::test::shared_scan(name)), topography::Form::plane);
  const auto lengths = correlation_lengths(autocorrelation(scan.height, scan.grid));
  EXPECT_NEAR(lengths.shortest / shortest, 1, 0.01);
  EXPECT_EQ(lengths.longest.has_value(), aspect > 0);
  if (aspect > 0) {
    EXPECT_NEAR(lengths.texture_aspect().value_or(0) / aspect, 1, 0.03);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Measured, TextureOfScan,
    testing::Values(ReferenceTexture{"confocal_tilted_flat.plu", 7.25329943903e-05, 0},
                    ReferenceTexture{"confocal_nanofocus1.nms", 1.40653457663e-05, 0.925608187176},
                    ReferenceTexture{"focusvar_rough.al3d", 1.24259505111e-05, 0.46166671221},
                    ReferenceTexture{"wli_ds_nonsquare.x3p", 2.66399607465e-06, 0},
                    ReferenceTexture{"zygo_metropro.dat", 0.00011836489529, 0},
                    ReferenceTexture{"afm_gwyddion_export.txt", 1.05970136159e-06, 0.865296546732}),
    [](const auto& instance) {
      std::string name = instance.param.scan;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

}  // namespace
}  // namespace tabor::metrology::test
