#include "tabor/reference/roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tabor::reference {
namespace {

TEST(RoughContact, KappasAreWhatTheTheoriesSay) {
  EXPECT_DOUBLE_EQ(kKappaBushGibsonThomas, std::sqrt(2 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(kKappaPersson, std::sqrt(8 / std::numbers::pi));
}

TEST(RoughContact, PerssonsAreaStartsWithHisKappa) {
  EXPECT_NEAR(persson_area_fraction(1e-6) / 1e-6, kKappaPersson, 1e-9);
}

TEST(RoughContact, PerssonsAreaEndsInFullContact) {
  EXPECT_EQ(persson_area_fraction(0), 0);
  EXPECT_NEAR(persson_area_fraction(5), 1, 1e-12);
}

TEST(RoughContact, SaturatedFrictionOfTheAluminiumSheet) {
  // 70 MPa / 240 MPa, Costagliola et al. 2021.
  EXPECT_NEAR(saturated_friction(70e6, 240e6), 0.2917, 5e-5);
}

TEST(RoughContact, ElasticFrictionIsAreaTimesShearOverPressure) {
  const double modulus = 78.55e9;
  const double slope = 0.1;
  const double pressure = 1e-4 * modulus * slope;
  const double area = persson_area_fraction(pressure / (modulus * slope));
  EXPECT_NEAR(elastic_friction(70e6, modulus, slope, kKappaPersson), area * 70e6 / pressure, 1e-8);
}

}  // namespace
}  // namespace tabor::reference
