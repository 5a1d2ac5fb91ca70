// What holds for every parameter.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"
#include "values.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

/// Smooth, rough at all scales, without symmetry.
topography::Topography rough(Index n = 96) {
  synthesis::SelfAffine recipe;
  recipe.grid = {n, n + 16, 1e-6 * static_cast<double>(n), 1e-6 * static_cast<double>(n + 16)};
  recipe.hurst = 0.8;
  recipe.rms_height = 1e-6;
  recipe.seed = 5;
  topography::Topography topography = synthesis::self_affine(recipe);
  topography.periodic = false;
  return topography;
}

std::map<std::string, double> by_symbol(const topography::Topography& topography) {
  std::map<std::string, double> values;
  for (const Parameter& parameter : parameters(topography)) {
    values[parameter.symbol] = parameter.value;
  }
  return values;
}

/// Power of a length in a unit.
int power_of_length(const std::string& unit) {
  static const std::map<std::string, int> powers{{"m", 1},    {"m^2", 2},    {"m^3", 3},
                                                 {"1/m", -1}, {"1/m^2", -2}, {"m^3/m^2", 1},
                                                 {"1", 0},    {"%", 0},      {"deg", 0}};
  const auto found = powers.find(unit);
  EXPECT_NE(found, powers.end()) << unit;
  return found == powers.end() ? 0 : found->second;
}

TEST(AllParameters, CarryUnitDefinitionAndSetAndAppearOnce) {
  std::set<std::string> known;
  std::set<ParameterSet> sets;
  for (const Parameter& parameter : parameters(rough())) {
    EXPECT_TRUE(known.insert(parameter.symbol).second) << parameter.symbol << " appears twice";
    power_of_length(parameter.unit);
    EXPECT_GT(parameter.definition.size(), 15u) << parameter.symbol;
    sets.insert(parameter.set);
  }
  EXPECT_EQ(sets.size(), kParameterSets.size());
}

/// What rounding makes of a constant is no roughness, whatever the constant and however it became
/// one.
TEST(AllParameters, OfAConstantAreThoseOfZero) {
  const Grid grid{64, 48, 64e-6, 48e-6};
  const auto zero = surface(grid, [](double, double) { return 0; });
  const auto expected = parameters(zero);
  const auto check = [&](const topography::Topography& flat, const std::string& what) {
    const auto found = parameters(flat);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(std::isnan(found[i].value), std::isnan(expected[i].value))
          << found[i].symbol << ' ' << what << ' ' << found[i].value;
      if (!std::isnan(found[i].value)) {
        EXPECT_EQ(found[i].value, expected[i].value) << found[i].symbol << ' ' << what;
      }
    }
    for (const auto& warning : topography::warnings(flat)) {
      EXPECT_NE(warning.code, "tilt") << what;
      EXPECT_NE(warning.code, "height-steps") << what;
    }
    EXPECT_EQ(power_spectra(flat).rms_height, 0) << what;
    EXPECT_TRUE(std::isnan(power_spectra(flat).radial.hurst.hurst)) << what;
  };
  for (const double z : {3.1e-6, -7.3e-5, 0.1, 1e-9 / 3, 1234.5}) {
    const auto constant = surface(grid, [z](double, double) { return z; });
    check(constant, fmt::format("constant {}", z));
    for (const char* step : {"level=plane", "level=mean", "highpass=gauss:10um",
                             "lowpass=gauss:10um", "lowpass=hann:10um"}) {
      check(topography::apply({step}, constant), fmt::format("constant {} {}", z, step));
    }
    const auto tilted = surface(grid, [z](double x, double y) { return z + 0.1 * x - 0.37 * y; });
    check(topography::apply({"level=plane"}, tilted), fmt::format("tilted {}", z));
  }
}

/// Without levelling a plane has slopes, but neither curvature nor roughness of profiles.
TEST(AllParameters, OfAPlaneHaveNoCurvatureAndNoProfile) {
  const auto plane =
      surface({64, 48, 64e-6, 48e-6}, [](double x, double y) { return 3e-6 + 0.1 * x - 0.3 * y; });
  const auto found = by_symbol(plane);
  EXPECT_EQ(found.at("m4"), 0);
  EXPECT_TRUE(std::isnan(found.at("alpha")));
  EXPECT_EQ(found.at("Rq_x"), 0);
  EXPECT_TRUE(std::isnan(found.at("RSm_x")));
  EXPECT_TRUE(std::isnan(found.at("Rsk_y")));
  for (const auto& warning : topography::warnings(plane)) EXPECT_NE(warning.code, "tilt");
}

/// A profile's c is that of the area unless it has its own.
TEST(AllParameters, HaveTheirHeightsOfMaterialRatios) {
  const auto surface = rough();
  const auto ratio = [&](const ParameterOptions& options) {
    for (const Parameter& parameter : parameters(surface, options)) {
      if (parameter.symbol == "Rmr(c)_x") return parameter;
    }
    return Parameter{};
  };
  ParameterOptions options{.sets = {ParameterSet::profile}};
  const double at_zero = ratio(options).value;
  options.smr_height = 200e-9;
  const Parameter at_that_of_smr = ratio(options);
  EXPECT_LT(at_that_of_smr.value, at_zero - 1);
  EXPECT_THAT(at_that_of_smr.definition, testing::HasSubstr("above c = 200 nm"));
  options.profile.ratio_height = 0;
  EXPECT_EQ(ratio(options).value, at_zero);
  options.profile.ratio_height = 200e-9;
  options.smr_height = 0;
  EXPECT_EQ(ratio(options).value, at_that_of_smr.value);
  options.profile.ratio_height = kHole;
  EXPECT_THROW(parameters(surface, options), InputError);
  EXPECT_THROW(parameters(surface, {.sets = {ParameterSet::function}, .smr_height = kHole}),
               InputError);
}

TEST(AllParameters, ScaleWithTheUnit) {
  auto surface = rough();
  const auto before = parameters(surface);
  constexpr double factor = 1024;
  surface.height *= factor;
  surface.grid.lx *= factor;
  surface.grid.ly *= factor;
  const auto after = by_symbol(surface);
  for (const Parameter& parameter : before) {
    // Cut-offs of profiles are lengths of a standard: they do not scale.
    if (parameter.set == ParameterSet::profile || std::isnan(parameter.value)) continue;
    const double expected = parameter.value * std::pow(factor, power_of_length(parameter.unit));
    EXPECT_NEAR(after.at(parameter.symbol), expected, 1e-9 * std::abs(expected))
        << parameter.symbol;
  }
}

TEST(AllParameters, DoNotDependOnTheDatum) {
  auto surface = rough();
  const auto before = by_symbol(surface);
  surface.height += 1e-3;
  for (const auto& [symbol, value] : by_symbol(surface)) {
    if (std::isnan(value)) continue;
    EXPECT_NEAR(value, before.at(symbol), 1e-6 * std::abs(before.at(symbol)) + 1e-15) << symbol;
  }
}

TEST(AllParameters, StayWhenTheScanIsTurnedRound) {
  auto surface = rough();
  const auto before = parameters(surface);
  surface.height = surface.height.reverse().eval();
  const auto after = by_symbol(surface);
  for (const Parameter& parameter : before) {
    if (parameter.set == ParameterSet::profile || std::isnan(parameter.value)) continue;
    // The common grid of forward differences leaves other edges out.
    const double tolerance = parameter.symbol == "Sdq" ? 1e-3 : 1e-6;
    EXPECT_NEAR(after.at(parameter.symbol), parameter.value, tolerance * std::abs(parameter.value))
        << parameter.symbol;
  }
}

TEST(AllParameters, HaveTheSameBitsOnAnyNumberOfThreads) {
  const auto surface = rough();
  set_thread_count(1);
  const auto one = parameters(surface);
  set_thread_count(4);
  const auto four = parameters(surface);
  set_thread_count(0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE(one[i].value == four[i].value || std::isnan(one[i].value)) << one[i].symbol;
  }
}

TEST(AllParameters, HardlyChangeWhenAFewPixelsAreMissing) {
  auto surface = rough(192);
  const auto before = by_symbol(surface);
  punch_holes(surface, 0.03);
  const auto after = by_symbol(surface);
  for (const char* symbol : {"Sa", "Sq", "Sku", "Sdq", "Sk", "Spk", "Svk", "Vmc", "Vvc", "Sxp",
                             "Sal", "Str", "m2", "m4", "alpha"}) {
    EXPECT_NEAR(after.at(symbol) / before.at(symbol), 1, 0.02) << symbol;
  }
}

class PoorSurface : public testing::TestWithParam<Grid> {};

TEST_P(PoorSurface, HasAReasonForEveryMissingValue) {
  for (const double share_of_holes : {0.0, 0.5}) {
    auto poor = noise(GetParam());
    punch_holes(poor, share_of_holes);
    poor.height(0, 0) = 1;
    for (const Parameter& parameter : parameters(poor)) {
      EXPECT_TRUE(!std::isnan(parameter.value) || !parameter.note.empty()) << parameter.symbol;
      EXPECT_FALSE(std::isinf(parameter.value)) << parameter.symbol;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PoorSurface,
                         testing::Values(Grid{1, 1, 1e-6, 1e-6}, Grid{2, 1, 2e-6, 1e-6},
                                         Grid{1, 2, 1e-6, 2e-6}, Grid{2, 2, 2e-6, 2e-6},
                                         Grid{3, 3, 3e-6, 3e-6}, Grid{40, 1, 4e-5, 1e-6},
                                         Grid{1, 40, 1e-6, 4e-5}, Grid{7, 5, 7e-6, 5e-6}));

TEST(AllParameters, OfAFlatSurfaceHaveAReasonForEveryMissingValue) {
  const auto flat = surface({9, 8, 9e-6, 8e-6}, [](double, double) { return 0.1; });
  for (const Parameter& parameter : parameters(flat)) {
    EXPECT_TRUE(!std::isnan(parameter.value) || !parameter.note.empty()) << parameter.symbol;
  }
}

TEST(AllParameters, RejectASurfaceOfHolesOnly) {
  auto holed = noise({4, 4, 1, 1});
  holed.height = kHole;
  for (const ParameterSet set : kParameterSets) {
    EXPECT_THROW(parameters(holed, {.sets = {set}}), InputError) << name_of(set);
  }
}

TEST(AllParameters, StopWhenTheObserverSaysSo) {
  EXPECT_THROW(parameters(rough(), {}, [](const Progress&) { return false; }), Interrupted);
}

TEST(ParameterSets, AreFoundByName) {
  for (const ParameterSet set : kParameterSets) {
    EXPECT_EQ(parameter_set_from(name_of(set)), set);
  }
  EXPECT_EQ(parameter_set_from("hight"), std::nullopt);
}

}  // namespace
}  // namespace tabor::metrology::test
