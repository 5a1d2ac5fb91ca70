#include "tabor/numerics/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tabor::numerics {
namespace {

/// What a solution cost.
struct Account {
  Convergence convergence;
};

Account operator+(const Account& before, Account now) {
  now.convergence = after(before.convergence, now.convergence);
  return now;
}

Account account(Status status) { return {.convergence = {.iterations = 1, .status = status}}; }

/// A state is the share that it solves; it can be led no further than `reach` at once.
struct Leash {
  double reach;
  std::vector<double> starts = {};

  Account operator()(double& state, double share) {
    starts.push_back(state);
    const bool is_near = share - state <= reach;
    state = is_near ? share : state - 0.125;
    return account(is_near ? Status::converged : Status::stalled);
  }
};

TEST(Continuation, GetsToTheEndByStepsThatGrowAndShrink) {
  double state = 0;
  Leash leash{.reach = 0.3};
  const Account all = follow(state, {.first = 0.5}, leash);
  EXPECT_TRUE(all.convergence.converged());
  EXPECT_EQ(state, 1);
  // 0.5 fails; 0.25; 0.375 more fails; 0.1875; 0.28125; what is left.
  EXPECT_EQ(leash.starts, (std::vector<double>{0, 0, 0.25, 0.25, 0.4375, 0.71875}));
  EXPECT_EQ(all.convergence.iterations, 6);
}

TEST(Continuation, GivesUpWhereStepsBecomeTooShort) {
  double state = 0;
  Leash leash{.reach = 0};
  const Account all = follow(state, {.first = 1, .smallest = 0.2}, leash);
  EXPECT_EQ(all.convergence.status, Status::stalled);
  EXPECT_EQ(all.convergence.iterations, 3);
  EXPECT_EQ(state, 0);
}

TEST(Continuation, BeginsWhereATryAtTheEndFailedIfAsked) {
  double state = 0;
  Leash leash{.reach = 0};
  follow(state, {.first = 1, .smallest = 0.2, .keeps_end = true}, leash);
  EXPECT_EQ(leash.starts, (std::vector<double>{0, -0.125, -0.125}));
  EXPECT_EQ(state, -0.125);
}

TEST(Continuation, StopsWhenItIsTold) {
  double state = 0;
  int n_tries = 0;
  const Account all = follow(state, {}, [&](double&, double) {
    return account(++n_tries == 2 ? Status::stopped : Status::converged);
  });
  EXPECT_TRUE(all.convergence.stopped());
  EXPECT_EQ(n_tries, 2);
}

}  // namespace
}  // namespace tabor::numerics
