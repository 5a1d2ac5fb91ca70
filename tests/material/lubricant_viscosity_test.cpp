#include "tabor/material/lubricant_viscosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "material/differences.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"

namespace tabor::material {
namespace {

constexpr ThermalThinning kThermal{.coefficient = 0.042, .reference_kelvin = 313.15};

std::vector<Viscosity> every_law() {
  return {constant_viscosity(0.3638), barus_viscosity(0.3638, 5.9e-9, kThermal),
          roelands_viscosity(0.43, 2e-8, kThermal), roelands_viscosity_from_z(0.08, 0.6, kThermal)};
}

TEST(Viscosity, IsTheAmbientOneAtNoPressure) {
  for (const Viscosity& law : every_law()) {
    EXPECT_DOUBLE_EQ(viscosity_at(law, 0).value, ambient_viscosity(law));
    EXPECT_DOUBLE_EQ(viscosity_at(law, 0, kThermal.reference_kelvin).value, ambient_viscosity(law));
  }
}

TEST(Viscosity, OfBarusGrowsByTheSameFactorForEveryPressureStep) {
  const Viscosity law = barus_viscosity(0.1, 1e-8);
  for (const double p : {-1e8, 0.0, 3e8, 2e9}) {
    EXPECT_NEAR(viscosity_at(law, p + 1e8).value / viscosity_at(law, p).value, std::exp(1.0),
                1e-12);
  }
}

TEST(Viscosity, OfRoelandsStartsAsBarusAndThenGrowsSlower) {
  const Viscosity roelands = roelands_viscosity(0.1, 2e-8);
  const Viscosity barus = barus_viscosity(0.1, 2e-8);
  EXPECT_NEAR(viscosity_at(roelands, 0).by_pressure, 0.1 * 2e-8, 1e-20);
  EXPECT_NEAR(pressure_coefficient(roelands), 2e-8, 1e-20);
  EXPECT_LT(viscosity_at(roelands, 1e9).value, viscosity_at(barus, 1e9).value);
}

// Worked by hand from eta0 = 0.08 Pa s, z = 0.6: at p = 196 MPa, 1 + 5.1e-9 p = 1.9996, so that
// eta = 0.08 exp(7.144271 (1.9996^0.6 - 1)) = 0.08 exp(7.144271 * 0.515535) = 3.18162 Pa s.
TEST(Viscosity, OfRoelandsHasAValueWorkedByHand) {
  const Viscosity law = roelands_viscosity_from_z(0.08, 0.6);
  EXPECT_NEAR(viscosity_at(law, 196e6).value, 3.18162, 2e-5);
}

// Mixed point contact after Redlich: z = 0.6 and eta0 = 0.08 Pa s have alpha z-scaled from 1.98e8
// Pa.
TEST(Viscosity, OfRoelandsTurnsZIntoAPressureCoefficientAndBack) {
  const RoelandsViscosity from_z = roelands_viscosity_from_z(0.08, 0.6);
  const RoelandsViscosity back = roelands_viscosity(0.08, from_z.pressure_coefficient());
  EXPECT_NEAR(back.z, 0.6, 1e-14);
}

TEST(Viscosity, OfAllOilsMeetsAtTheRoelandsPole) {
  const double nearly_there = -(1 - 1e-12) / 5.1e-9;
  for (const double ambient : {0.01, 0.1, 1.0}) {
    const Viscosity law = roelands_viscosity_from_z(ambient, 0.6);
    EXPECT_NEAR(viscosity_at(law, nearly_there).value, std::exp(-9.67), 1e-10);
  }
}

TEST(Viscosity, HasTheDerivativesOfItsDifferences) {
  double worst = 0;
  for (const Viscosity& law : every_law()) {
    const double highest = std::min(3e9, computable_range(law).highest);
    for (double p = -1e8; p < highest; p += 0.037 * highest) {
      const auto eta = [&](double x) { return viscosity_at(law, x).value; };
      const double expected = difference(eta, p, 1e5);
      worst = test::worse(
          worst, relative_error(viscosity_at(law, p).by_pressure, expected, 1e-9 * eta(p)));
    }
  }
  test::expect_within("Lubricant", "viscosity laws, -0.1 to 3 GPa",
                      "derivative by pressure, relative", "fourth-order differences", worst, 1e-8);
}

TEST(Viscosity, HasTheThermalDerivativesOfItsDifferences) {
  double worst = 0;
  for (const Viscosity& law : every_law()) {
    for (const double kelvin : {283.15, 313.15, 373.15}) {
      for (const double p : {0.0, 2e8, 8e8}) {
        const ThermalLawValue at = viscosity_at(law, p, kelvin);
        const double by_p =
            difference([&](double x) { return viscosity_at(law, x, kelvin).value; }, p, 1e5);
        const double by_T =
            difference([&](double x) { return viscosity_at(law, p, x).value; }, kelvin, 0.05);
        worst = test::worst_of({worst, relative_error(at.by_pressure, by_p, 1e-9 * at.value),
                                relative_error(at.by_temperature, by_T, 1e-3 * at.value)});
      }
    }
  }
  test::expect_within("Lubricant", "viscosity laws, 10 to 100 degrees Celsius",
                      "derivatives by pressure and temperature, relative",
                      "fourth-order differences", worst, 1e-8);
}

TEST(Viscosity, FallsWithTemperatureByTheGivenCoefficient) {
  for (const Viscosity& law : {Viscosity(barus_viscosity(0.1, 2e-8, kThermal)),
                               Viscosity(roelands_viscosity(0.1, 2e-8, kThermal))}) {
    const ThermalLawValue at = viscosity_at(law, 0, kThermal.reference_kelvin);
    EXPECT_NEAR(at.by_temperature / at.value, -0.042, 1e-14);
  }
}

TEST(Viscosity, OfManyPressuresIsThatOfEach) {
  const std::vector<double> pressure{-1e7, 0, 5e7, 1e9};
  std::vector<double> value(4), slope(4);
  for (const Viscosity& law : every_law()) {
    evaluate(law, pressure, value, slope);
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      EXPECT_EQ(value[i], viscosity_at(law, pressure[i]).value);
      EXPECT_EQ(slope[i], viscosity_at(law, pressure[i]).by_pressure);
    }
  }
}

TEST(Viscosity, IsFiniteAndPositiveInsideItsComputableRange) {
  for (const Viscosity& law : every_law()) {
    const PressureRange range = computable_range(law);
    for (const double p :
         {std::max(range.lowest * (1 - 1e-9), -1e12), std::min(range.highest, 1e12)}) {
      const LawValue at = viscosity_at(law, p);
      EXPECT_TRUE(at.value > 0 && std::isfinite(at.value * at.value)) << p;
      EXPECT_TRUE(std::isfinite(at.by_pressure)) << p;
    }
  }
}

TEST(Viscosity, OfRoelandsHasNoNumberBelowItsPole) {
  const Viscosity law = roelands_viscosity(0.1, 2e-8);
  EXPECT_FALSE(computable_range(law).contains(-2e8));
  EXPECT_FALSE(computable_range(law).contains(std::nan("")));
  EXPECT_TRUE(std::isnan(viscosity_at(law, -2e8).value));
}

TEST(Viscosity, LawsAreKnownByName) {
  for (const auto law : {ViscosityLaw::constant, ViscosityLaw::barus, ViscosityLaw::roelands}) {
    EXPECT_EQ(parse_viscosity_law(name(law)), law);
    EXPECT_EQ(law_of(make_viscosity(law, 0.1, 2e-8)), law);
  }
  const std::string message = test::rejection([] { parse_viscosity_law("roeland"); });
  EXPECT_NE(message.find("did you mean 'roelands'"), std::string::npos) << message;
}

TEST(Viscosity, RejectsWhatMakesNoSense) {
  const double nan = std::nan("");
  for (const double bad : {0.0, -0.1, nan}) {
    EXPECT_THROW(constant_viscosity(bad), InputError) << bad;
    EXPECT_THROW(barus_viscosity(bad, 2e-8), InputError) << bad;
    EXPECT_THROW(roelands_viscosity(bad, 2e-8), InputError) << bad;
  }
  EXPECT_THROW(barus_viscosity(0.1, -2e-8), InputError);
  EXPECT_THROW(roelands_viscosity(0.1, nan), InputError);
  EXPECT_THROW(roelands_viscosity_from_z(0.1, -0.6), InputError);
  EXPECT_THROW(roelands_viscosity(0.1, 2e-8, {.coefficient = -1}), InputError);
  EXPECT_THROW(roelands_viscosity(0.1, 2e-8, {.coefficient = 0.04, .reference_kelvin = 40}),
               InputError);
}

TEST(Viscosity, RejectsOilsThinnerThanTheRoelandsPole) {
  const std::string message = test::rejection([] { roelands_viscosity(6e-5, 2e-8); });
  EXPECT_NE(message.find("6.31e-05"), std::string::npos) << message;
  EXPECT_NO_THROW(barus_viscosity(6e-5, 2e-8));
}

}  // namespace
}  // namespace tabor::material
