#include <gtest/gtest.h>

#include "ehl/impact/larsson.hpp"
#include "support/validation.hpp"
#include "tabor/ehl/impact/measures.hpp"
#include "tabor/reference/impact.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;
using test::safa_gohar;

const ImpactResult& drop() {
  static const ImpactResult result = solve_impact(safa_gohar());
  return result;
}

const reference::DryImpact& dry() {
  static const reference::DryImpact impact = reference::hertz_impact(0.0127, 5.5e10, 0.066, 0.313);
  return impact;
}

/// Relative to the paper's value, with the tolerance that its digits and the spread of codes allow.
void expect_paper(const char* quantity, double value, double paper, double tolerance) {
  expect_within("EHL", "Safa-Gohar ball drop", quantity, "Larsson & Höglund 1995",
                std::abs(value / paper - 1), tolerance);
}

TEST(SafaGoharDrop, HasThePapersFilmAndDeformation) {
  ASSERT_EQ(drop().end, ImpactEnd::rebound) << drop().reason;
  expect_paper("smallest film, relative", drop().min_film, 2.9e-6, 0.03);
  expect_paper("time of the smallest film, relative", drop().time_min_film, 176e-6, 0.03);
  expect_paper("largest deformation, relative", drop().max_deformation, 16e-6, 0.03);
}

TEST(SafaGoharDrop, HasThePapersTimes) {
  expect_paper("impact time, relative", drop().impact_time, 241e-6, 0.03);
  expect_paper("turning time, relative", drop().turning_time, 158e-6, 0.03);
  expect_paper("time of the first pressure peak, relative", drop().time_primary_pressure, 163e-6,
               0.03);
  expect_paper("begin of cavitation, relative", drop().cavitation_time, 166e-6, 0.03);
  expect_within("EHL", "Safa-Gohar ball drop", "time of the largest force, us",
                "Larsson & Höglund 1995", std::abs(drop().time_max_force - 145e-6) * 1e6, 10);
}

TEST(SafaGoharDrop, ReboundsAsInThePaper) {
  expect_paper("coefficient of restitution, relative", drop().restitution, 0.82, 0.03);
  expect_paper("rebound speed, relative", drop().rebound_speed, 0.257, 0.03);
}

TEST(SafaGoharDrop, CarriesTheDryForceWhereThePaperDoes) {
  const double touching = 30e-6 / 0.313;  // when the dry ball would touch the flat
  double time = 0;
  for (const ImpactInstant& at : drop().history) {
    if (at.force > 1 && at.force < dry().force_at(at.time - touching)) {
      time = at.time;
      break;
    }
  }
  expect_paper("time at which film and dry ball carry the same, relative", time, 140e-6, 0.03);
}

TEST(SafaGoharDrop, HasThePapersDryImpact) {
  expect_paper("dry contact time, relative", dry().contact_time, 148e-6, 0.005);
  expect_paper("dry deformation, relative", dry().max_approach, 15.72e-6, 0.005);
  expect_paper("dry force, relative", dry().max_force, 515, 0.005);
  const double touching = 30e-6 / 0.313;
  expect_paper("begin of the dry impact, relative", touching, 96e-6, 0.005);
  expect_paper("dry peak, relative", touching + dry().contact_time / 2, 170e-6, 0.005);
}

// The paper does not say how large its domain was when the film tore: the rebound says it was near
// 17 Hertz radii of the weight, between its 15 and the wet disc of 18.1.
TEST(SafaGoharDrop, LosesMoreInALargerDomain) {
  const double reference[] = {0.837, 0.827, 0.819, 0.811};
  const double domain[] = {15, 16, 17, 18.1};
  for (int i = 0; i < 4; ++i) {
    const ImpactResult result = solve_impact(safa_gohar(domain[i]));
    ASSERT_EQ(result.end, ImpactEnd::rebound);
    EXPECT_NEAR(result.restitution, reference[i], 0.0015) << domain[i];
  }
}

TEST(SafaGoharDrop, HardlyDependsOnGridAndTimeStep) {
  ImpactProblem coarse = safa_gohar();
  coarse.nodes = 200;
  ImpactProblem quick = safa_gohar();
  quick.time_step = 1e-6;
  for (const ImpactProblem& problem : {coarse, quick}) {
    const ImpactResult result = solve_impact(problem);
    EXPECT_NEAR(result.min_film / drop().min_film, 1, 0.01);
    EXPECT_NEAR(result.restitution, drop().restitution, 0.003);
    EXPECT_NEAR(result.max_force / drop().max_force, 1, 0.002);
  }
}

TEST(SafaGoharDrop, ListsWhatThePaperPrintsOtherwise) {
  test::record_unreproduced("EHL", "Safa-Gohar ball drop", "time of the largest force [us]",
                            "Larsson & Höglund 1995", 145, drop().time_max_force * 1e6,
                            "the maximum is flat: 2 % of the force lie within 8 us; the paper's "
                            "explicit step uses the old force");
  const double shift = (drop().time_min_film - drop().time_max_force) * 1e6;
  test::record_unreproduced("EHL", "Safa-Gohar ball drop",
                            "smallest film after the largest force [us]", "Larsson & Höglund 1995",
                            31, shift, "follows from the time of the largest force");
  EXPECT_GT(shift, 15);
  EXPECT_LT(shift, 31);
}

}  // namespace
}  // namespace tabor::ehl
