#include "tabor/material/lubricant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/material/lubricant_mixture.hpp"

namespace tabor::material {
namespace {

const Lubricant kOil{.viscosity = roelands_viscosity(0.43, 2e-8),
                     .density = relative_density(DensityLaw::dowson_higginson),
                     .shear = {}};

TEST(Lubricant, HandsOverItsLawsForEveryNode) {
  const std::vector<double> pressure{0, 1e7, 1e9};
  NodeLaws laws;
  evaluate(kOil, pressure, laws);
  ASSERT_EQ(laws.viscosity.size(), 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double p = pressure[static_cast<std::size_t>(i)];
    EXPECT_EQ(laws.viscosity[i], viscosity_at(kOil.viscosity, p).value);
    EXPECT_EQ(laws.viscosity_by_pressure[i], viscosity_at(kOil.viscosity, p).by_pressure);
    EXPECT_EQ(laws.density[i], kOil.density.at(p).value);
    EXPECT_EQ(laws.density_by_pressure[i], kOil.density.at(p).by_pressure);
  }
}

TEST(Lubricant, RejectsPressuresAtWhichALawHasNoNumber) {
  EXPECT_NO_THROW(check_pressure(kOil, 3e9));
  EXPECT_THROW(check_pressure(kOil, -2e8), InputError);
  EXPECT_THROW(check_pressure(kOil, std::nan("")), InputError);
  const Lubricant barus{.viscosity = barus_viscosity(0.43, 2e-8), .density = {}, .shear = {}};
  const std::string message = test::rejection([&] { check_pressure(barus, 20e9); });
  EXPECT_NE(message.find("barus"), std::string::npos) << message;
  EXPECT_NE(message.find("15 GPa"), std::string::npos) << message;
}

TEST(Lubricant, WarningsPressuresBeyondWhatItsLawsAreTrustedFor) {
  EXPECT_TRUE(warnings(kOil, 0.3e9).empty());
  EXPECT_EQ(warnings(kOil, 0.5e9).size(), 1U);
  EXPECT_EQ(warnings(kOil, 2e9).size(), 2U);
  EXPECT_TRUE(warnings(Lubricant{}, 1e12).empty());
}

TEST(Lubricant, ComputableRangeIsThatOfAllItsLaws) {
  const PressureRange range = computable_range(kOil);
  EXPECT_DOUBLE_EQ(range.lowest, computable_range(kOil.viscosity).lowest);
  EXPECT_DOUBLE_EQ(range.highest, computable_range(kOil.viscosity).highest);
}

double centipoise(double mass_fraction, double celsius,
                  GlycerolWaterFit fit = GlycerolWaterFit::cheng) {
  return 1e3 * glycerol_water_viscosity(mass_fraction, celsius + kZeroCelsius, fit);
}

// Worked outside tabor from the published formula.
TEST(GlycerolWater, HasTheViscosityOfItsParts) {
  EXPECT_NEAR(centipoise(0, 24), 0.9135, 5e-5);
  EXPECT_NEAR(centipoise(1, 24), 987.6, 0.05);
}

TEST(GlycerolWater, HasTheViscosityOfTheMixture) {
  EXPECT_NEAR(centipoise(0.95, 24), 374.0, 0.05);
  EXPECT_NEAR(centipoise(0.95, 23.70), 383, 0.5);
}

TEST(GlycerolWater, ThesisVariantNearlyGivesThePrintedNumber) {
  const double computed = centipoise(0.95, 24, GlycerolWaterFit::thesis);
  EXPECT_NEAR(computed, 364.4, 0.05);
  test::expect_within("Lubricant", "95 % glycerol at 24 degrees Celsius, c = 0.0012",
                      "viscosity, relative", "363.8 cP, Akchurin's thesis",
                      std::abs(computed / 363.8 - 1), 2e-3);
}

// Water at 20 and 60 degrees Celsius: 1.0016 and 0.4660 mPa s (IAPWS 2008, doi:10.1063/1.3088050);
// pure glycerol at 20: 1412 mPa s (Segur & Oberstar 1951, doi:10.1021/ie50501a040).
TEST(GlycerolWater, AgreesWithMeasurementsOfItsParts) {
  EXPECT_NEAR(centipoise(0, 20) / 1.0016, 1, 0.01);
  EXPECT_NEAR(centipoise(0, 60) / 0.4660, 1, 0.01);
  EXPECT_NEAR(centipoise(1, 20) / 1412, 1, 0.01);
}

TEST(GlycerolWater, ThickensWithGlycerolAndThinsWithTemperature) {
  for (double C = 0.05; C <= 1; C += 0.05) {
    for (double T = 5; T <= 100; T += 5) {
      EXPECT_GT(centipoise(C, T), centipoise(C - 0.05, T)) << C << " " << T;
      EXPECT_LT(centipoise(C, T), centipoise(C, T - 5)) << C << " " << T;
    }
  }
}

TEST(GlycerolWater, RejectsWhatTheFormulaWasNotFittedTo) {
  EXPECT_THROW(glycerol_water_viscosity(95, 297.15), InputError);
  EXPECT_THROW(glycerol_water_viscosity(1.01, 297.15), InputError);
  EXPECT_THROW(glycerol_water_viscosity(-0.1, 297.15), InputError);
  EXPECT_THROW(glycerol_water_viscosity(0.95, 24), InputError);
  EXPECT_THROW(glycerol_water_viscosity(std::nan(""), 297.15), InputError);
}

}  // namespace
}  // namespace tabor::material
