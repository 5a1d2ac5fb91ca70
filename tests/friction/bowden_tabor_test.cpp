#include "tabor/friction/bowden_tabor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"

namespace tabor::friction {
namespace {

constexpr double kShearStrength = 70e6;  // Costagliola et al. 2021: aluminium, [Pa]
constexpr double kSaturation = 240e6;    // [Pa]

Contact saturated(double mean_pressure) {
  const double area = mean_pressure / kSaturation;
  return {mean_pressure, area, area, kSaturation, 0};
}

TEST(BowdenTabor, SaturatedLimitIsShearStrengthOverSaturationPressure) {
  double worst = 0;
  for (const double pressure : {2e6, 7e6, 15e6}) {
    const double mu = estimate(saturated(pressure), kShearStrength).friction_dry;
    worst = test::worse(worst, std::abs(mu - 70.0 / 240.0));
  }
  EXPECT_LT(worst, 1e-15);  // 0.29167, whatever the load
  test::record_validation("Friction", "every contact pixel saturated", "dry coefficient, absolute",
                          "tau_y / p_sat = 0.29167", worst, 1e-15);
}

TEST(BowdenTabor, NothingWetIsDryAndAllWetIsFrictionless) {
  Contact contact = saturated(7e6);
  EXPECT_EQ(estimate(contact, kShearStrength).friction_lubricated,
            estimate(contact, kShearStrength).friction_dry);
  contact.lubricated_share = 1;
  EXPECT_EQ(estimate(contact, kShearStrength).friction_lubricated, 0);
  contact.lubricated_share = 0.25;
  EXPECT_DOUBLE_EQ(estimate(contact, kShearStrength).friction_lubricated, 0.75 * 70.0 / 240.0);
}

TEST(BowdenTabor, AreaChoiceScalesBothCoefficients) {
  const Contact contact{10e6, 0.04, 0.05, std::numeric_limits<double>::infinity(), 0.5};
  const Estimate corrected = estimate(contact, kShearStrength, Area::corrected);
  const Estimate pixels = estimate(contact, kShearStrength, Area::pixels);
  EXPECT_DOUBLE_EQ(corrected.friction_dry, 0.28);
  EXPECT_DOUBLE_EQ(pixels.friction_dry, 0.35);
  EXPECT_DOUBLE_EQ(pixels.friction_lubricated, 0.175);
  EXPECT_EQ(pixels.area_fraction, 0.05);
  EXPECT_EQ(pixels.area, Area::pixels);
}

TEST(BowdenTabor, CorrectedAreaIsNeverBelowLoadOverSaturationPressure) {
  Contact contact = saturated(7e6);
  contact.contact_area_fraction *= 0.9;  // over-corrected: no pressure field could carry the load
  EXPECT_DOUBLE_EQ(estimate(contact, kShearStrength).friction_dry, 70.0 / 240.0);
}

TEST(BowdenTabor, ElasticAreaHasNoFloor) {
  const Contact contact{10e6, 0.001, 0.0012, std::numeric_limits<double>::infinity(), 0};
  EXPECT_DOUBLE_EQ(estimate(contact, kShearStrength).friction_dry, 0.007);
}

TEST(BowdenTabor, RejectsValuesOutOfRange) {
  const double nan = std::nan("");
  EXPECT_THROW(estimate(saturated(7e6), 0), InputError);
  EXPECT_THROW(estimate(saturated(7e6), nan), InputError);
  EXPECT_THROW(estimate({0, 0.1, 0.1, kSaturation, 0}, kShearStrength), InputError);
  EXPECT_THROW(estimate({7e6, 1.1, 0.1, kSaturation, 0}, kShearStrength), InputError);
  EXPECT_THROW(estimate({7e6, nan, 0.1, kSaturation, 0}, kShearStrength), InputError);
  EXPECT_THROW(estimate({7e6, 0.1, -0.1, kSaturation, 0}, kShearStrength), InputError);
  EXPECT_THROW(estimate({7e6, 0.1, 0.1, kSaturation, 1.5}, kShearStrength), InputError);
  EXPECT_THROW(estimate({7e6, 0.1, 0.1, nan, 0}, kShearStrength), InputError);
}

TEST(BowdenTabor, AreaNamesReadBack) {
  EXPECT_EQ(parse_area(name(Area::corrected)), Area::corrected);
  EXPECT_EQ(parse_area(name(Area::pixels)), Area::pixels);
  EXPECT_THROW(parse_area("pixel"), InputError);
}

}  // namespace
}  // namespace tabor::friction
