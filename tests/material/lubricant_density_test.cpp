#include "tabor/material/lubricant_density.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "material/differences.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"

namespace tabor::material {
namespace {

const std::vector<DensityLaw> kLaws{DensityLaw::constant, DensityLaw::dowson_higginson,
                                    DensityLaw::rounded_dowson_higginson};

TEST(RelativeDensity, IsThatOfDowsonAndHigginson) {
  const RelativeDensity law = relative_density(DensityLaw::dowson_higginson);
  for (const double p : {0.0, 1e6, 1e8, 1e9, 1e11}) {
    EXPECT_NEAR(law.at(p).value, 1 + 0.6e-9 * p / (1 + 1.7e-9 * p), 1e-14) << p;
  }
}

// Worked by hand: 1 + 0.6 * 2.667 / (1 + 1.7 * 2.667) = 1.28916.
TEST(RelativeDensity, GrowsByLessThanAThird) {
  EXPECT_NEAR(relative_density(DensityLaw::dowson_higginson).at(2.667e9).value, 1.28916, 1e-5);
  EXPECT_LT(relative_density(DensityLaw::dowson_higginson).at(1e12).value, 2.3 / 1.7);
}

TEST(RelativeDensity, OfTheRoundedLawDiffersByLessThanAPercent) {
  const RelativeDensity law = relative_density(DensityLaw::dowson_higginson);
  const RelativeDensity rounded = relative_density(DensityLaw::rounded_dowson_higginson);
  for (double p = 0; p < 4e9; p += 1e8) {
    EXPECT_NEAR(rounded.at(p).value / law.at(p).value, 1, 0.01) << p;
    EXPECT_NEAR(rounded.at(p).value, (5.9e8 + 1.34 * p) / (5.9e8 + p), 1e-14) << p;
  }
}

TEST(RelativeDensity, OfAnIncompressibleLiquidIsOneEverywhere) {
  const RelativeDensity law = relative_density(DensityLaw::constant);
  for (const double p : {-1e9, 0.0, 1e12}) {
    EXPECT_EQ(law.at(p).value, 1);
    EXPECT_EQ(law.at(p).by_pressure, 0);
    EXPECT_TRUE(computable_range(law).contains(p));
    EXPECT_TRUE(trusted_range(law).contains(p));
  }
}

TEST(RelativeDensity, HasTheDerivativeOfItsDifferences) {
  double worst = 0;
  for (const DensityLaw name : kLaws) {
    const RelativeDensity law = relative_density(name);
    for (double p = -4e8; p < 4e9; p += 7e7) {
      const double expected = difference([&](double x) { return law.at(x).value; }, p, 1e5);
      worst = test::worse(worst, relative_error(law.at(p).by_pressure, expected, 1e-12));
    }
  }
  test::expect_within("Lubricant", "density laws, -0.4 to 4 GPa",
                      "derivative by pressure, relative", "fourth-order differences", worst, 1e-8);
}

TEST(RelativeDensity, IsPositiveInsideItsComputableRangeOnly) {
  const RelativeDensity law = relative_density(DensityLaw::dowson_higginson);
  const double lowest = computable_range(law).lowest;
  EXPECT_NEAR(lowest, -1 / 2.3e-9, 1);
  EXPECT_GT(law.at(lowest * (1 - 1e-6)).value, 0);
  EXPECT_LT(law.at(lowest * (1 + 1e-6)).value, 0);
}

TEST(RelativeDensity, LawsAreKnownByName) {
  for (const DensityLaw law : kLaws) {
    EXPECT_EQ(parse_density_law(name(law)), law);
  }
  const std::string message = test::rejection([] { parse_density_law("dowson"); });
  EXPECT_NE(message.find("dowson-higginson"), std::string::npos) << message;
}

}  // namespace
}  // namespace tabor::material
