// Where displaced material goes.
#include "tabor/sliding/displaced.hpp"

#include <gtest/gtest.h>

#include "tabor/core/random.hpp"

namespace tabor::sliding {
namespace {

struct Pressed {
  Grid grid{32, 24, 32e-6, 24e-6};
  Field depth = Field::Zero(24, 32);
  Field gap = Field::Zero(24, 32);
  Mask contact = Mask::Constant(24, 32, false);

  Pressed() {
    const CounterRandom random(7);
    for (Index i = 0; i < gap.size(); ++i) {
      contact(i) = random.uniform(static_cast<std::uint64_t>(i)) < 0.3;
      const double amount = random.uniform(static_cast<std::uint64_t>(i + 1000));
      (contact(i) ? depth(i) : gap(i)) = 1e-7 * amount * (contact(i) ? 0.2 : 1);
    }
  }

  Raised raised(Displaced displaced) const {
    return raise(displaced, depth, contact, gap, grid, 2e-6);
  }
};

TEST(DisplacedMaterial, KeepsItsVolumeAndRisesOnlyOutOfContact) {
  const Pressed pressed;
  for (const Displaced displaced : {Displaced::near, Displaced::uniform}) {
    const Raised raised = pressed.raised(displaced);
    EXPECT_NEAR(raised.height.sum() / pressed.depth.sum(), 1, 1e-13);
    EXPECT_EQ(raised.lost, 0);
    EXPECT_EQ(raised.without_space, 0);
    for (Index i = 0; i < pressed.gap.size(); ++i) {
      if (pressed.contact(i)) {
        EXPECT_EQ(raised.height(i), 0);
      } else {
        EXPECT_LE(raised.height(i), pressed.gap(i) * (1 + 1e-9) + 1e-22);
      }
    }
  }
}

TEST(DisplacedMaterial, ThatIsLostLeavesTheSurface) {
  const Pressed pressed;
  const Raised raised = pressed.raised(Displaced::lost);
  EXPECT_EQ(raised.height.sum(), 0);
  EXPECT_DOUBLE_EQ(raised.lost, pressed.depth.sum());
}

TEST(DisplacedMaterial, NearItsContactRisesThere) {
  Pressed pressed;
  pressed.contact.setConstant(false);
  pressed.contact(12, 16) = true;
  pressed.depth.setZero();
  pressed.depth(12, 16) = 1e-9;
  pressed.gap.setConstant(1e-7);
  const Field height = pressed.raised(Displaced::near).height;
  EXPECT_GT(height(12, 17), height(12, 19));
  EXPECT_NEAR(height(12, 17), height(12, 15), 1e-20);
  EXPECT_LT(height(0, 0), 1e-6 * height(12, 17));
  const Field even = pressed.raised(Displaced::uniform).height;
  EXPECT_NEAR(even(0, 0), even(12, 17), 1e-20);
}

TEST(DisplacedMaterial, WithoutRoomRisesEvenlyAndIsCounted) {
  Pressed pressed;
  pressed.gap *= 1e-3;
  const Raised raised = pressed.raised(Displaced::near);
  EXPECT_GT(raised.without_space, 0);
  EXPECT_NEAR(raised.height.sum() / pressed.depth.sum(), 1, 1e-13);
  pressed.contact.setConstant(true);
  EXPECT_DOUBLE_EQ(pressed.raised(Displaced::near).lost, pressed.depth.sum());
}

}  // namespace
}  // namespace tabor::sliding
