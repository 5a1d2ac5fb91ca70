#include "tabor/ehl/impact/impact.hpp"
#include "tabor/ehl/plain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ehl/impact/larsson.hpp"
#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/ehl/impact/approach.hpp"
#include "tabor/elastic/axisymmetric.hpp"
#include "tabor/reference/impact.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;
using test::from_groups;
using test::rejection;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::Value;

ImpactProblem usual() { return from_groups(0.005, 8.70e-12, 7.475e13, 3500); }

TEST(RigidApproach, FollowsItsClosedFormWithoutGravity) {
  const ImpactProblem problem = usual();
  const double damping = 6 * M_PI * 0.1 * problem.radius * problem.radius / problem.mass;
  const std::vector<Approach> path = rigid_approach(problem);
  ASSERT_GT(path.size(), 100u);
  double worst = 0;
  for (const Approach& at : path) {
    const double x = at.separation / problem.layer;
    const double lost = -damping * (std::log(x) - 2 * (x - 1) + (x * x - 1) / 2);
    worst = test::worse(worst, std::abs(at.speed + problem.speed - lost) / problem.speed);
  }
  expect_within("EHL", "rigid approach", "speed over the first speed", "closed form", worst, 1e-8);
  EXPECT_GT(path.back().force, 0);
  EXPECT_LT(path.back().separation, problem.layer);
}

TEST(RigidApproach, StopsASlowBallInAThickOil) {
  ImpactProblem problem = usual();
  problem.speed = 1e-3;
  const ImpactResult result = solve_impact(problem);
  EXPECT_EQ(result.end, ImpactEnd::sticks);
  EXPECT_TRUE(result.convergence.converged());
  EXPECT_EQ(result.restitution, 0);
  EXPECT_THAT(result.reason, HasSubstr("before anything deformed"));
}

TEST(SolveImpact, StopsAtAnyQuestion) {
  ImpactProblem problem = usual();
  problem.nodes = 30;
  test::expect_to_stop_at_once([&](const Observer& observer) {
    const ImpactResult result = solve_impact(problem, observer);
    EXPECT_GE(result.history.size(), 1U);
    return result.convergence;
  });
}

TEST(SolveImpact, SaysThatASlowBallSticks) {
  ImpactProblem problem = usual();
  problem.speed = 0.01;
  problem.nodes = 100;
  const ImpactResult result = solve_impact(problem);
  EXPECT_EQ(result.end, ImpactEnd::sticks);
  EXPECT_THAT(result.reason, HasSubstr("did not come back"));
  EXPECT_TRUE(std::isnan(result.turning_time));
}

TEST(SolveImpact, ApproachesTheDryImpactAsTheOilThins) {  // slow
  double before = 1;
  for (const double viscosity : {0.1, 0.02, 0.004}) {
    ImpactProblem problem = usual();
    problem.lubricant.viscosity = material::roelands_viscosity(viscosity, 1.5e-8);
    const ImpactResult result = solve_impact(problem);
    ASSERT_EQ(result.end, ImpactEnd::rebound) << result.reason;
    const reference::DryImpact dry = reference::hertz_impact(
        problem.radius, problem.effective_modulus, problem.mass, problem.speed);
    const double lost = 1 - result.max_force / dry.max_force;
    EXPECT_LT(lost, before);
    EXPECT_GT(lost, 0);
    EXPECT_LT(result.restitution, 1);
    before = lost;
  }
  EXPECT_LT(before, 0.05);
}

TEST(SolveImpact, TakesBarusAndConstantLaws) {
  for (const material::ViscosityLaw law :
       {material::ViscosityLaw::constant, material::ViscosityLaw::barus}) {
    ImpactProblem problem = usual();
    problem.speed = 0.05;
    problem.nodes = 150;
    problem.lubricant.viscosity = material::make_viscosity(law, 0.1, 0.5e-8);
    problem.lubricant.density = {};
    const ImpactResult result = solve_impact(problem);
    EXPECT_EQ(result.end, ImpactEnd::rebound) << material::name(law) << result.reason;
  }
}

TEST(SolveImpact, GivesTheSameWithAndWithoutKeptFactorizations) {
  ImpactProblem problem = usual();
  problem.nodes = 120;
  const ImpactResult kept = solve_impact(problem);
  const ImpactResult plain = solve_impact_plainly(problem);
  EXPECT_LT(10 * kept.count.n_factorizations, 2 * plain.count.n_factorizations);
  EXPECT_NEAR(kept.max_force / plain.max_force, 1, 1e-5);
  EXPECT_NEAR(kept.min_film / plain.min_film, 1, 1e-4);
  EXPECT_NEAR(kept.restitution, plain.restitution, 1e-4);
}

TEST(SolveImpact, KeepsProfilesAtTheAskedTimes) {
  ImpactProblem problem = usual();
  problem.nodes = 100;
  problem.profile_times = {200e-6, 290e-6, 1};
  const ImpactResult result = solve_impact(problem);
  ASSERT_EQ(result.profiles.size(), 2u);
  EXPECT_EQ(result.profiles[1].time, 290e-6);
  EXPECT_EQ(result.profiles[1].film.size(), result.radius.size());
  EXPECT_EQ(result.profiles[1].pressure[100], 0);
  EXPECT_GE(result.profiles[1].pressure.minCoeff(), 0);
}

TEST(SolveImpact, RejectsWhatMakesNoSense) {
  const auto rejected = [](auto change) {
    ImpactProblem problem = usual();
    change(problem);
    return rejection([&] { solve_impact(problem); });
  };
  EXPECT_THAT(rejected([](auto& p) { p.mass = 0; }), HasSubstr("mass of the ball"));
  EXPECT_THAT(rejected([](auto& p) { p.speed = -1; }), HasSubstr("above zero"));
  EXPECT_THAT(rejected([](auto& p) { p.layer = 1e-6; }), HasSubstr("thicker layer"));
  EXPECT_THAT(rejected([](auto& p) { p.domain_radius = 1e-4; }), HasSubstr("larger domain"));
  EXPECT_THAT(rejected([](auto& p) { p.nodes = 3; }), HasSubstr("10 or more"));
  EXPECT_THAT(
      rejected([](auto& p) { p.lubricant.viscosity = material::barus_viscosity(0.1, 3e-7); }),
      HasSubstr("barus"));
}

TEST(SolveImpact, TellsWhereTheTimeStepDecides) {
  ImpactProblem problem = usual();
  problem.nodes = 60;
  const ImpactResult fine = solve_impact(problem);
  EXPECT_THAT(texts_of(fine.warnings), Not(Contains(HasSubstr("A time step is"))));
  for (const double steps : {100, 20}) {
    problem.time_step = 400 / steps * fine.time_step;
    const ImpactResult result = solve_impact(problem);
    const bool is_right = std::abs(result.max_force / fine.max_force - 1) < 4e-3;
    EXPECT_EQ(is_right, steps == 100);
    const bool is_told = Value(texts_of(result.warnings), Contains(HasSubstr("A time step is")));
    EXPECT_EQ(is_told, !is_right) << steps;
  }
}

TEST(SolveImpact, WarningsAReboundThatItsDomainDecides) {  // slow
  EXPECT_THAT(texts_of(solve_impact(test::safa_gohar()).warnings),
              testing::Contains(HasSubstr("depend on the domain")));
}

BallFilm small_film() {
  BallFilm ball;
  ball.grid = reynolds::disc_grid(500e-6, 40);
  const Eigen::ArrayXd radius = ball.grid.node.tail(41);
  ball.shape = radius.square() / 0.02;
  ball.compliance = elastic::AxisymmetricHalfSpace(radius, 1e11).matrix().leftCols(40);
  ball.lubricant.viscosity = material::barus_viscosity(0.1, 1e-8);
  ball.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  ball.mass = 0.03;
  ball.length_scale = 10e-6;
  ball.pressure_scale = 1e8;
  return ball;
}

TEST(BallStepper, LosesAsMuchLiquidAsFlowsOut) {
  const BallFilm ball = small_film();
  BallState start;
  start.separation = 5e-6;
  start.speed = -0.2;
  start.pressure = Eigen::ArrayXd::Zero(40);
  start = completed(ball, std::move(start));
  BallStepper stepper(ball);
  const double step = 1e-6;
  const auto next = stepper.step(start, nullptr, step);
  ASSERT_TRUE(next.has_value());
  const reynolds::FilmNode last{
      .pressure = next->pressure[39],
      .film = next->film[39],
      .liquid = {.density = next->film_mass[39] / next->film[39],
                 .viscosity =
                     material::viscosity_at(ball.lubricant.viscosity, next->pressure[39]).value},
      .distance = 500e-6 / 80};
  const reynolds::FilmNode edge{
      .film = next->film[40], .liquid = {.viscosity = 0.1}, .distance = 500e-6 / 80};
  const double outflow = ball.grid.width[40] * reynolds::face_flow(last, edge, 0).flow;
  const double lost = (ball.grid.volume * (start.film_mass - next->film_mass)).sum();
  expect_within("EHL", "one step of an approach", "liquid lost against outflow, relative",
                "conservation", std::abs(lost / (outflow * step) - 1), 1e-9);
  EXPECT_NEAR(next->speed, start.speed + step * next->force / (2 * ball.mass), 1e-9);
}

TEST(BallStepper, RejectsAStepInWhichTheFilmWouldClose) {
  const BallFilm ball = small_film();
  BallState start;
  start.separation = 5e-6;
  start.speed = -1e4;
  start.pressure = Eigen::ArrayXd::Zero(40);
  start = completed(ball, std::move(start));
  EXPECT_FALSE(BallStepper(ball).step(start, nullptr, 1e-5).has_value());
}

TEST(SolveImpact, IsNotConvergedWithoutAFilm) {
  // A heavy ball of a few micrometres: the film between two instants comes out below zero.
  ImpactProblem problem;
  problem.radius = 6.028991899234525e-6;
  problem.mass = 32.5e-3;
  problem.speed = 0.2;
  problem.effective_modulus = 115e9;
  problem.lubricant.viscosity = material::roelands_viscosity(0.1, 1.522e-8);
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.layer = 50e-6;
  const ImpactResult result = solve_impact(problem);
  EXPECT_FALSE(result.convergence.converged() && !(result.min_film > 0));
  EXPECT_EQ(result.convergence.status, Status::stalled);
  EXPECT_THAT(result.reason, HasSubstr("is not above zero"));
  EXPECT_TRUE(std::isnan(result.restitution));
}

}  // namespace
}  // namespace tabor::ehl
