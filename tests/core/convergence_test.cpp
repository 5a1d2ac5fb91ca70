#include "tabor/core/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor {
namespace {

TEST(ShareDone, IsLogarithmicInTheCertificate) {
  const Convergence half{.certificate = 1e-3, .tolerance = 1e-6};
  EXPECT_DOUBLE_EQ(share_done(1, half), 0.5);
}

TEST(ShareDone, StaysBetweenNothingAndAll) {
  EXPECT_EQ(share_done(1, {.certificate = 10, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(1, {.certificate = 1e-9, .tolerance = 1e-6}), 1);
  EXPECT_EQ(share_done(1, {.certificate = INFINITY, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(1, {.certificate = NAN, .tolerance = 1e-6}), 0);
}

TEST(Status, OfASolverThatWasStoppedIsNoFailure) {
  const auto of = [](Status status) { return Convergence{.status = status}; };
  EXPECT_TRUE(of(Status::converged).converged());
  EXPECT_FALSE(of(Status::converged).failed());
  EXPECT_TRUE(of(Status::stopped).stopped());
  EXPECT_FALSE(of(Status::stopped).failed());
  EXPECT_FALSE(of(Status::stopped).converged());
  EXPECT_TRUE(of(Status::stalled).failed());
  EXPECT_TRUE(of(Status::iteration_limit).failed());
  EXPECT_TRUE(Convergence().failed());
}

TEST(Status, HasANameForPeople) {
  EXPECT_EQ(name_of(Status::converged), "converged");
  EXPECT_EQ(name_of(Status::stalled), "stalled");
  EXPECT_EQ(name_of(Status::iteration_limit), "iteration limit");
  EXPECT_EQ(name_of(Status::stopped), "stopped");
}

TEST(Convergence, AddsTheWorkOfWhatCameBeforeAndKeepsTheEnd) {
  const Convergence before{3, 7, 2.5, 1e-3, 1e-2, Status::stalled};
  const Convergence both = after(before, {4, 8, 0.25, 1e-9, 1e-8, Status::converged});
  EXPECT_EQ(both.iterations, 7);
  EXPECT_EQ(both.operator_applications, 15);
  EXPECT_EQ(both.fft_pairs, 2.75);
  EXPECT_EQ(both.certificate, 1e-9);
  EXPECT_EQ(both.tolerance, 1e-8);
  EXPECT_EQ(both.status, Status::converged);
}

TEST(Convergence, ThatWasStoppedIsThrownOnRequest) {
  EXPECT_THROW(throw_if_stopped({.status = Status::stopped}), Interrupted);
  for (const Status status : {Status::converged, Status::stalled, Status::iteration_limit}) {
    EXPECT_NO_THROW(throw_if_stopped({.status = status}));
  }
}

}  // namespace
}  // namespace tabor
