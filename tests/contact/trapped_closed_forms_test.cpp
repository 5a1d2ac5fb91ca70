// Trapped liquid that carries load, where its pressure is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/trapped.hpp"
#include "support/validation.hpp"

namespace tabor::test {
namespace {

constexpr double kFullPressure = std::numbers::pi * kUnitAmplitude;  // p* for E* = 1, L = 1
constexpr const char* kSection = "Trapped liquid";

/// Westergaard's wave with liquid of a mean height in the whole cell: pressure of the liquid, share
/// of solid contact.
struct WaveResult {
  double liquid = 0;  // of p*
  double area = 0;
};

WaveResult press_wave(Index n, double height, double bulk_modulus) {
  Field wave(1, n);
  for (Index x = 0; x < n; ++x) {
    wave(0, x) = kUnitAmplitude * std::cos(2 * std::numbers::pi * (static_cast<double>(x) + 0.5) /
                                           static_cast<double>(n));
  }
  const contact::TrappedState state =
      press_whole_cell(wave, 0.6 * kFullPressure, contact::kNoSaturation, height * kUnitAmplitude,
                       bulk_modulus * kFullPressure);
  EXPECT_TRUE(state.contact.convergence.converged());
  return {state.liquid.max_pressure / kFullPressure, area_of(contact::solid_contact(state))};
}

struct WaveCase {
  double height;        // of the liquid, of the amplitude
  double bulk_modulus;  // of p*
  double liquid;        // pi/p* at P = 0.6 p*: D v(sigma) = Vl (1 - pi/K), sigma = (P - pi)/p*
};

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(TrappedLiquid, InAWaveHasThePressureOfItsClosedForm) {
  for (const WaveCase one :
       {WaveCase{0.3, kInfinite, 0.266245}, WaveCase{0.5, kInfinite, 0.413318},
        WaveCase{0.7, kInfinite, 0.512771}, WaveCase{0.3, 1, 0.205328}, WaveCase{0.5, 1, 0.306526},
        WaveCase{0.7, 1, 0.374143}, WaveCase{0.3, 0.1, 0.057991}, WaveCase{0.5, 0.1, 0.072924},
        WaveCase{0.7, 0.1, 0.080005}}) {
    const WaveResult found = press_wave(512, one.height, one.bulk_modulus);
    const std::string name = fmt::format("wave, liquid {} of the amplitude, K/p* = {}, n = 512",
                                         one.height, one.bulk_modulus);
    expect_within(kSection, name, "pressure of the liquid / p*", "closed form",
                  std::abs(found.liquid - one.liquid), 6e-6);
    const double sigma = 0.6 - one.liquid;
    expect_within(kSection, name, "share of solid contact, pixels", "Westergaard 1939",
                  512 * std::abs(found.area - 2 / std::numbers::pi * std::asin(std::sqrt(sigma))),
                  1.5);
  }
}

TEST(TrappedLiquid, ThatDoesNotFillTheGapLeavesTheBitsOfTheDryContact) {
  const Field wave = test::wave(32, kUnitAmplitude, true);
  const contact::State dry =
      solve_unit(wave, 0.1 * kFullPressure, contact::kNoSaturation, 1e-7).state;
  const double gap = dry.gap.mean();
  const contact::TrappedState loose =
      press_whole_cell(wave, 0.1 * kFullPressure, contact::kNoSaturation, 0.9 * gap, kInfinite);
  EXPECT_TRUE((loose.contact.pressure == dry.pressure).all());
  EXPECT_TRUE((loose.contact.gap == dry.gap).all());
  EXPECT_EQ(loose.liquid.load_share, 0);
  const contact::TrappedState full =
      press_whole_cell(wave, 0.1 * kFullPressure, contact::kNoSaturation, 1.1 * gap, kInfinite);
  EXPECT_GT(full.liquid.load_share, 0);
}

/// z = cos cos: the numbers are of a general solver on the same grid.
TEST(TrappedLiquid, InAnEggBoxIsADryContactUnderTheRestOfTheLoad) {
  const Index n = 128;
  const Field height = test::wave(n, kUnitAmplitude, true);
  const double pressure = 0.12 * kFullPressure;
  struct Item {
    double cap, liquid;  // of p*
  };
  for (const Item item : {Item{kInfinite, 0.06220}, Item{0.3, 0.09281}}) {
    const double cap = item.cap * kFullPressure;
    const contact::TrappedState state =
        press_whole_cell(height, pressure, cap, 0.6 * kUnitAmplitude, kInfinite, 1e-8);
    const std::string name = fmt::format("egg box, p_sat/p* = {}, n = 128", item.cap);
    const double liquid = state.liquid.max_pressure;
    expect_within(kSection, name, "pressure of the liquid / p*", "independent solver",
                  std::abs(liquid / kFullPressure - item.liquid), 6e-6);
    // Under any cap: solution(P, p_sat, pi) = pi + dry(P - pi, p_sat - pi).
    const contact::State rest = solve_unit(height, pressure - liquid, cap - liquid, 1e-9).state;
    expect_within(
        kSection, name, "pressure of solids, largest difference / p*",
        "dry contact under the rest of the load",
        (state.contact.pressure - liquid - rest.pressure).abs().maxCoeff() / kFullPressure, 1e-5);
    // The gap holds the liquid.
    EXPECT_NEAR(state.contact.gap.max(0.0).mean(), 0.6 * kUnitAmplitude, 1e-5 * kUnitAmplitude);
  }
}

}  // namespace
}  // namespace tabor::test
