#include "tabor/topography/parameters.hpp"

#include <gmock/gmock.h>

#include <random>

#include "sample_surfaces.hpp"
#include "support/scans.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/file.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"

namespace tabor::topography::test {
namespace {

double value(const Topography& topography, const std::string& symbol) {
  for (const Parameter& parameter : parameters(topography)) {
    if (parameter.symbol == symbol) {
      return parameter.value;
    }
  }
  ADD_FAILURE() << "no parameter " << symbol;
  return kHole;
}

/// NumPy's RandomState(seed).normal(): MT19937 and the polar method.
class NumpyNormal {
 public:
  explicit NumpyNormal(std::uint32_t seed) : bits_(seed) {}

  double operator()() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    double x = 0, y = 0, square = 0;
    do {
      x = 2 * uniform() - 1;
      y = 2 * uniform() - 1;
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double factor = std::sqrt(-2 * std::log(square) / square);
    second_ = factor * x;
    has_second_ = true;
    return factor * y;
  }

 private:
  double uniform() {
    const auto high = static_cast<double>(bits_() >> 5U);
    const auto low = static_cast<double>(bits_() >> 6U);
    return (high * 67108864.0 + low) / 9007199254740992.0;
  }

  std::mt19937 bits_;
  double second_ = 0;
  bool has_second_ = false;
};

/// The synthetic surface whose parameters the surfalize project publishes (also computed with
/// libgwyddion): a wave of 20 um with ripples of 1 um and noise, pixels of 0.1 um.
Topography published_surface() {
  Topography topography;
  topography.grid = {1000, 700, 100e-6, 70e-6};
  topography.height.resize(700, 1000);
  NumpyNormal normal(0);
  for (Index j = 0; j < 700; ++j) {
    for (Index i = 0; i < 1000; ++i) {
      const auto x = static_cast<double>(i), y = static_cast<double>(j);
      const double ripple = std::sin((std::sin(y / 10) + x) / 10 * 2 * pi);
      const double z = std::sin(x / 200 * 2 * pi) +
                       0.5 * (std::sin((x - 100) / 200 * 2 * pi) + 1) * 0.3 * ripple;
      topography.height(j, i) = 1e-6 * (z + normal() / 5);
    }
  }
  return topography;
}

void expect_published(const Topography& surface, const std::string& symbol, double expected,
                      const std::string& source) {
  const double error = std::abs(value(surface, symbol) / expected - 1);
  tabor::test::expect_within("Surface parameters", "published synthetic surface", symbol, source,
                             error, 1e-9);
}

TEST(Parameters, AgreeWithLibgwyddionOnAPublishedSurface) {
  const auto surface = published_surface();
  expect_published(surface, "Sa", 0.6531317451415803e-6, "libgwyddion 2.62");
  expect_published(surface, "Sq", 0.7459607542946238e-6, "libgwyddion 2.62");
  expect_published(surface, "Ssk", -0.08144041387549059, "libgwyddion 2.62");
  expect_published(surface, "Sku", 1.8180137313618905, "libgwyddion 2.62");
}

TEST(Parameters, AgreeWithTheDigitsSurfalizePublishes) {
  const auto surface = published_surface();
  EXPECT_NEAR(value(surface, "Sp"), 1.854956e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sv"), 1.998661e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sz"), 3.853617e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sdr"), 275.201045, 1e-6);
  EXPECT_NEAR(value(surface, "Sdq"), 4.082139680093371, 1e-12);  // common grid, with NumPy
}

// Its reflecting edges are our mirror tiling; its kernel ends at four sigma, which leaves 6e-5 out.
TEST(GaussianFilter, AgreesWithAPublishedFilteredSurface) {
  const auto tiled = mirror(crop(published_surface(), {0, 0, 1000, 700}));
  for (const auto& [text, expected] : {std::pair{"gauss:1.5um", 0.7050198091916576e-6},
                                       {"gauss:2um", 0.7023321806489939e-6},
                                       {"gauss:5um", 0.6779729867708357e-6}}) {
    const double error = std::abs(rms_height(low_pass(tiled, parse_filter(text))) / expected - 1);
    tabor::test::expect_within("Filters", "published synthetic surface",
                               std::string("Sq after ") + text, "surfalize", error, 1e-4);
  }
}

/// a sin(2 pi x / L), whole periods, a crest on a sample.
Topography sine(Index n, double a = 2e-6) {
  return surface({n, 6, 1e-4, 1e-5}, [=](double x, double) {
    return a * std::sin(2 * pi * 5 * (x / 1e-4 - 0.5 / static_cast<double>(n)));
  });
}

TEST(Parameters, OfASineAreItsClosedForms) {
  const auto wave = sine(2000);
  // 2/pi for infinitely many samples; n on half a period give cot(pi/(2n))/n
  EXPECT_NEAR(value(wave, "Sa") / 2e-6, 1 / (200 * std::tan(pi / 400)), 1e-12);
  EXPECT_NEAR(value(wave, "Sa") / 2e-6, 2 / pi, 2e-5);
  EXPECT_NEAR(value(wave, "Sq") / 2e-6, 1 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(value(wave, "Ssk"), 0, 1e-12);
  EXPECT_NEAR(value(wave, "Sku"), 1.5, 1e-12);
  EXPECT_NEAR(value(wave, "Sp") / 2e-6, 1, 1e-12);
  EXPECT_NEAR(value(wave, "Sz") / 2e-6, 2, 1e-12);
}

TEST(RmsSlope, OfASineIsLowByTheSincOfTheForwardDifference) {
  const Index n = 2000;
  const double periods = 5;
  const double half_phase = pi * periods / static_cast<double>(n);
  const double expected =
      std::numbers::sqrt2 * pi * 2e-6 * periods / 1e-4 * std::sin(half_phase) / half_phase;
  // the common grid leaves out the last column, one of 2000 samples of cos^2
  EXPECT_NEAR(value(sine(n), "Sdq") / expected, 1, 1.0 / static_cast<double>(n));
}

TEST(RmsSlope, OfAPlaneIsItsGradient) {
  const auto plane =
      surface({9, 7, 9e-6, 14e-6}, [](double x, double y) { return 0.3 * x + 0.4 * y; });
  EXPECT_NEAR(rms_slope(plane), 0.5, 1e-14);
  EXPECT_NEAR(developed_area_ratio(plane), 100 * (std::sqrt(1.25) - 1), 1e-11);
}

TEST(DevelopedArea, KeepsTinySlopes) {
  const auto plane = surface({9, 7, 9e-6, 14e-6}, [](double x, double) { return 1e-9 * x; });
  EXPECT_NEAR(developed_area_ratio(plane) / (100 * 0.5e-18), 1, 1e-6);
}

TEST(Parameters, DoNotSeeHoles) {
  auto holed = noise({40, 30, 4e-5, 3e-5});
  auto part = crop(holed, {0, 0, 40, 18});
  holed.height.bottomRows(12) = kHole;
  const auto expected = parameters(part), found = parameters(holed);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i].value, expected[i].value, 1e-13 * std::abs(expected[i].value))
        << expected[i].symbol;
  }
  EXPECT_EQ(value(holed, "N"), 40 * 18);
}

TEST(Parameters, ScaleWithTheUnit) {
  auto rough = noise({40, 30, 4e-5, 3e-5});
  const auto before = parameters(rough);
  rough.height *= 1e6;
  rough.grid.lx *= 1e6;
  rough.grid.ly *= 1e6;
  const auto after = parameters(rough);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double factor = before[i].unit == "m" ? 1e6 : 1;
    EXPECT_NEAR(after[i].value / (factor * before[i].value), 1, 1e-11) << before[i].symbol;
  }
}

TEST(Parameters, DoNotDependOnTheDatum) {
  auto rough = noise({40, 30, 4e-5, 3e-5});
  const double sq = rms_height(rough);
  rough.height += 1e-3;
  EXPECT_NEAR(rms_height(rough) / sq, 1, 1e-9);
}

TEST(Parameters, OfAFlatSurfaceHaveNoSkewness) {
  const auto flat = surface({5, 5, 1, 1}, [](double, double) { return 3.0; });
  EXPECT_EQ(value(flat, "Sq"), 0);
  EXPECT_TRUE(std::isnan(value(flat, "Ssk")));
  EXPECT_EQ(value(flat, "Sdr"), 0);
}

TEST(Parameters, CarryUnitAndDefinition) {
  for (const Parameter& parameter : parameters(noise({8, 8, 1, 1}))) {
    EXPECT_FALSE(parameter.unit.empty()) << parameter.symbol;
    EXPECT_GT(parameter.definition.size(), 15u) << parameter.symbol;
  }
}

TEST(Parameters, RefuseASurfaceOfHolesOnly) {
  auto holed = noise({4, 4, 1, 1});
  holed.height = kHole;
  EXPECT_THROW(parameters(holed), InputError);
}

/// Published or independently computed values of measured scans (expected.csv beside them).
struct Measured {
  std::string file, symbol;
  bool levelled;
  double expected, tolerance;
};

class MeasuredScan : public testing::TestWithParam<Measured> {};

TEST_P(MeasuredScan, HasTheExpectedParameter) {
  const Measured& row = GetParam();
  TABOR_NEEDS_SHARED_SCAN(row.file);
  Topography scan = read(tabor::test::shared_scan(row.file));
  if (row.levelled) {
    scan = level(scan, Form::plane);
  }
  const double error = std::abs(value(scan, row.symbol) / row.expected - 1);
  tabor::test::expect_within("Surface parameters", row.file, row.symbol, "expected.csv", error,
                             row.tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Expected, MeasuredScan,
    testing::Values(Measured{"wli_ds_nonsquare.x3p", "Sq", false, 7.728033274e-08, 1e-9},
                    Measured{"wli_ds_nonsquare.x3p", "Sdq", false, 0.062070074, 1e-9},
                    Measured{"wli_ds_nonsquare.x3p", "Sdq", true, 0.0620700056324, 1e-11},
                    Measured{"wli_ds_nonsquare.x3p", "Sdr", true, 0.192026141797, 1e-11},
                    Measured{"afm_gwyddion_export.txt", "Sdq", false, 0.1923560228, 1e-9},
                    Measured{"afm_gwyddion_export.txt", "Sdr", true, 1.74748957387, 1e-11},
                    Measured{"rubber_alicona.x3p", "Sq", true, 3.39837998803e-06, 1e-9},
                    Measured{"rubber_alicona.x3p", "Sa", true, 2.70450941997e-06, 1e-9},
                    Measured{"rubber_alicona.x3p", "Ssk", true, 0.736167485418, 1e-9},
                    Measured{"rubber_alicona.x3p", "Sku", true, 3.68563472639, 1e-9},
                    Measured{"rubber_alicona.x3p", "Sz", true, 2.55887162139e-05, 1e-9}));

}  // namespace
}  // namespace tabor::topography::test
