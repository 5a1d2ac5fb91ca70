// The fast engine against the rule taken word for word, on tiny surfaces full of ties.
#include "deposition/agreement.hpp"

namespace tabor::deposition::testing {
namespace {

TEST(FastDeposition, AgreesWithTheNaiveRuleOnTinySurfacesFullOfTies) {
  expect_agreement(0, 8000, 6);
}

TEST(FastDeposition, AgreesWithTheNaiveRuleOnLargerSurfaces) { expect_agreement(1000000, 500, 14); }

}  // namespace
}  // namespace tabor::deposition::testing
