#include "tabor/material/solid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tabor/core/error.hpp"

namespace tabor::material {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(EffectiveModulus, OfAluminiumUnderARigidFlat) {
  // 70 GPa / (1 - 0.33^2) = 70 / 0.8911 GPa, worked by hand.
  EXPECT_NEAR(effective_modulus({70e9, 0.33}), 78.55459544e9, 10);
}

TEST(EffectiveModulus, IsTheModulusItselfWithoutLateralContraction) {
  EXPECT_DOUBLE_EQ(effective_modulus({3e9, 0.0}), 3e9);
}

TEST(EffectiveModulus, OfTwoEqualSolidsIsHalfThatOfOne) {
  const Solid steel{210e9, 0.3};
  EXPECT_DOUBLE_EQ(effective_modulus(steel, steel), 0.5 * effective_modulus(steel));
}

TEST(EffectiveModulus, DoesNotDependOnWhichSolidIsNamedFirst) {
  const Solid steel{210e9, 0.3};
  const Solid aluminium{70e9, 0.33};
  EXPECT_DOUBLE_EQ(effective_modulus(steel, aluminium), effective_modulus(aluminium, steel));
}

TEST(EffectiveModulus, OfARigidCounterBodyIsThatOfTheSolidAlone) {
  const Solid aluminium{70e9, 0.33};
  EXPECT_EQ(effective_modulus(aluminium, {kRigid, 0.3}), effective_modulus(aluminium));
}

TEST(EffectiveModulus, AcceptsAnIncompressibleSolid) {
  EXPECT_DOUBLE_EQ(effective_modulus({1e6, 0.5}), 1e6 / 0.75);
}

TEST(EffectiveModulus, RejectsAModulusThatIsNotPositive) {
  for (const double modulus : {0.0, -1e9, kNaN}) {
    EXPECT_THROW(effective_modulus({modulus, 0.3}), InputError) << modulus;
    EXPECT_THROW(effective_modulus({70e9, 0.3}, {modulus, 0.3}), InputError) << modulus;
  }
}

TEST(EffectiveModulus, RejectsAPoissonsRatioOutOfItsRange) {
  for (const double ratio : {-1.0, 0.51, kNaN}) {
    EXPECT_THROW(effective_modulus({70e9, ratio}), InputError) << ratio;
  }
}

TEST(EffectiveModulus, RejectsTwoRigidBodies) {
  EXPECT_THROW(effective_modulus({kRigid, 0.3}), InputError);
  EXPECT_THROW(effective_modulus({kRigid, 0.3}, {kRigid, 0.3}), InputError);
}

TEST(EffectiveModulus, NamesTheQuantityAndTheValueItRejects) {
  try {
    effective_modulus({70e9, 0.7});
    FAIL() << "0.7 was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("Poisson's ratio"), std::string::npos) << message;
    EXPECT_NE(message.find("0.7"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace tabor::material
