#include "tabor/friction/wet_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::friction {
namespace {

Field row(std::initializer_list<double> values) {
  Field field(1, static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), field.data());
  return field;
}

Mask mask(std::initializer_list<bool> values) {
  Mask result(1, static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

TEST(LubricatedShare, CountsWetPixelsAmongContactPixels) {
  const Mask contact = mask({true, true, true, true, false});
  EXPECT_EQ(lubricated_share(contact, row({0, 1e-7, 0, 0, 1e-6})), 0.25);
  EXPECT_EQ(lubricated_share(contact, row({0, 0, 0, 0, 1e-6})), 0);
  EXPECT_EQ(lubricated_share(contact, row({1e-9, 1e-9, 1e-9, 1e-9, 0})), 1);
}

TEST(WetContact, IsTheContactUnderAFilmThickEnough) {
  const Mask wet = wet_contact(mask({true, true, false}), row({1e-7, 1e-9, 1e-6}), 1e-8);
  EXPECT_TRUE((wet == mask({true, false, false})).all());
  EXPECT_THROW(wet_contact(mask({true}), row({1e-7, 0})), InputError);
}

TEST(LubricatedShare, IsZeroWhereNothingTouches) {
  EXPECT_EQ(lubricated_share(mask({false, false}), row({1e-6, 1e-6})), 0);
}

TEST(SpillOver, IsTheLiquidThatDoesNotFit) {
  // 1 um on a gap of 0.4 um spills 0.6; 2 um under 3 um fits; 1 um of 4 on a closed pixel spills
  // all.
  EXPECT_DOUBLE_EQ(spill_over_fraction(row({1e-6, 2e-6, 1e-6, 0}), row({4e-7, 3e-6, 0, 1e-6})),
                   0.4);
}

TEST(SpillOver, OverlapHoldsNoLiquidAndSpillsNoMoreThanThereIs) {
  EXPECT_EQ(spill_over_fraction(row({1e-6, 0}), row({-5e-6, -5e-6})), 1);
}

TEST(SpillOver, IsZeroWithoutLiquidOrWithRoomForAll) {
  EXPECT_EQ(spill_over_fraction(row({0, 0}), row({0, 1e-6})), 0);
  EXPECT_EQ(spill_over_fraction(row({1e-7, 1e-6}), row({1e-7, 1e-6})), 0);
}

TEST(WetContact, RejectsOtherShapesAndNan) {
  const double nan = std::nan("");
  EXPECT_THROW(lubricated_share(mask({true}), row({0, 0})), InputError);
  EXPECT_THROW(lubricated_share(mask({true, true}), row({0, nan})), InputError);
  EXPECT_THROW(spill_over_fraction(row({0}), row({0, 0})), InputError);
  EXPECT_THROW(spill_over_fraction(row({nan, 1}), row({0, 0})), InputError);
  EXPECT_THROW(spill_over_fraction(row({1, 1}), row({0, nan})), InputError);
}

TEST(WetContact, SameBitsForAnyThreadCount) {
  const Field film = Field::Random(300, 301).abs();
  const Field gap = Field::Random(300, 301);
  const Mask contact = gap < 0;
  set_thread_count(1);
  const double spill = spill_over_fraction(film, gap);
  const double share = lubricated_share(contact, film);
  set_thread_count(3);
  EXPECT_EQ(spill_over_fraction(film, gap), spill);
  EXPECT_EQ(lubricated_share(contact, film), share);
  set_thread_count(0);
}

}  // namespace
}  // namespace tabor::friction
