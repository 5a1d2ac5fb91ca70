#include "tabor/numerics/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace tabor::numerics {
namespace {

constexpr double kTolerance = 1e-12;

/// atan(x) = 0, whose whole steps go astray from |x| > 1.39: steps must bring x nearer to zero.
struct Arctangent {
  double x = 0;
  bool believes = true;
  Convergence account = {.tolerance = kTolerance};

  double& state() { return x; }
  Convergence& convergence() { return account; }
  Eigen::VectorXd step() const { return Eigen::VectorXd::Constant(1, -std::atan(x) * (1 + x * x)); }
  double largest_share(const Eigen::VectorXd&) const { return 1; }
  bool move(double old, const Eigen::VectorXd& step, double share) {
    x = old + share * step[0];
    return believes && std::abs(x) < std::abs(old);
  }
  bool settle() const { return true; }
  bool measure() {
    account.certificate = std::abs(std::atan(x));
    return account.certificate <= kTolerance;
  }
};

/// x >= 0, x - b >= 0, x (x - b) = 0 at every node: x = max(b, 0).
struct Obstacle {
  Eigen::VectorXd x, b;
  std::vector<bool> held;  // at x = 0
  Convergence account = {.tolerance = kTolerance};

  explicit Obstacle(const Eigen::VectorXd& bound)
      : x(Eigen::VectorXd::Zero(bound.size())),
        b(bound),
        held(static_cast<std::size_t>(bound.size()), false) {}

  Eigen::VectorXd& state() { return x; }
  Convergence& convergence() { return account; }
  Eigen::VectorXd step() const {
    Eigen::VectorXd step = b - x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (held[static_cast<std::size_t>(i)]) step[i] = -x[i];
    }
    return step;
  }
  double largest_share(const Eigen::VectorXd&) const { return 1; }
  bool move(const Eigen::VectorXd& old, const Eigen::VectorXd& step, double share) {
    x = old + share * step;
    return true;
  }
  bool settle() {
    const std::vector<bool> before = held;
    for (std::size_t i = 0; i < held.size(); ++i) {
      const auto node = static_cast<Eigen::Index>(i);
      held[i] = before[i] ? b[node] <= 0 : x[node] < 0;
    }
    return held == before;
  }
  bool measure() {
    account.certificate = step().norm();
    return account.certificate <= kTolerance;
  }
};

TEST(Newton, HalvesStepsThatLeadAstray) {
  Arctangent far{.x = 20};
  newton(far, {.max_iterations = 30});
  EXPECT_TRUE(far.account.converged());
  EXPECT_LE(std::abs(far.x), 2 * kTolerance);
  // Near the root whole steps are taken, and the error is cubed in each.
  Arctangent near{.x = 0.5};
  newton(near, {.max_iterations = 4, .max_halvings = 0});
  EXPECT_TRUE(near.account.converged());
}

TEST(Newton, StallsWhereItWasWhenNothingCanBeBelieved) {
  Arctangent lost{.x = 20, .believes = false};
  newton(lost, {.max_iterations = 30});
  EXPECT_EQ(lost.account.status, Status::stalled);
  EXPECT_EQ(lost.account.iterations, 1);
  EXPECT_EQ(lost.x, 20);
  Arctangent nowhere{.x = std::nan("")};
  newton(nowhere, {.max_iterations = 30});
  EXPECT_EQ(nowhere.account.status, Status::stalled);
}

TEST(Newton, SaysThatItsIterationsWereNotEnough) {
  Arctangent slow{.x = 20};
  newton(slow, {.max_iterations = 2});
  EXPECT_EQ(slow.account.status, Status::iteration_limit);
  EXPECT_EQ(slow.account.iterations, 2);
  EXPECT_LT(slow.account.certificate, std::atan(20.0));
}

TEST(Newton, GoesOnUntilTheActiveSetIsAtRest) {
  const Eigen::Vector4d bound(1, -2, 3, -0.5);
  Obstacle obstacle(bound);
  newton(obstacle, {.max_iterations = 10});
  ASSERT_TRUE(obstacle.account.converged());
  EXPECT_EQ(obstacle.account.iterations, 2);
  EXPECT_EQ(obstacle.x, bound.cwiseMax(0));
}

TEST(Newton, StopsAtAnyQuestion) {
  for (int answer = 0; answer < 3; ++answer) {
    int n_asked = 0;
    Arctangent watched{.x = 20};
    newton(watched, {.max_iterations = 30, .stage = "arctangent"}, [&](const Progress& progress) {
      EXPECT_EQ(progress.stage, "arctangent");
      EXPECT_EQ(progress.convergence == nullptr, n_asked == 0);
      return n_asked++ < answer;
    });
    EXPECT_TRUE(watched.account.stopped());
    EXPECT_EQ(watched.account.iterations, answer);
    EXPECT_EQ(n_asked, answer + 1);
  }
}

}  // namespace
}  // namespace tabor::numerics
