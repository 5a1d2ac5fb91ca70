// As agreement.cpp, with as many surfaces as it takes to trust that the two engines are one.
#include "deposition/agreement.hpp"

namespace tabor::deposition::testing {
namespace {

TEST(FastDepositionAtLength, AgreesWithTheNaiveRuleOn150000TinySurfaces) {
  expect_agreement(10000, 150000, 7);
}

TEST(FastDepositionAtLength, AgreesWithTheNaiveRuleOn10000LargerSurfaces) {
  expect_agreement(2000000, 10000, 24);
}

}  // namespace
}  // namespace tabor::deposition::testing
