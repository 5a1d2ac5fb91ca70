#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/validation.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/elastic/line.hpp"
#include "tabor/reference/hertz_line.hpp"

namespace tabor::elastic {
namespace {

// The contact solvers were written for maps; the line operator makes them solvers of line contacts.
TEST(LineContact, OfACylinderIsHertz) {
  const double radius = 2.5e-3;
  const auto hertz = reference::hertz_line_at_load(radius, 1.2e9, 5000);
  for (const Index n : {128, 1024}) {
    const Grid grid{n, 1, 6 * hertz.half_width, 1e-3};
    contact::Problem problem{.height = Field(1, n),
                             .control = contact::MeanPressure{hertz.load / grid.lx}};
    for (Index i = 0; i < n; ++i) {
      const double x = (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1)) * grid.dx();
      problem.height(0, i) = -x * x / (2 * radius);
    }
    for (const auto solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
      const auto elasticity = make_line(grid, hertz.effective_modulus);
      const contact::State state = contact::solve(*elasticity, problem, solver);
      EXPECT_TRUE(state.convergence.converged());
      const double width = static_cast<double>((state.pressure > 0).count()) * grid.dx();
      EXPECT_NEAR(width, 2 * hertz.half_width, 2 * grid.dx()) << n;
      test::expect_within("Contact", fmt::format("Hertz line contact, {} nodes", n),
                          "peak pressure, relative", "Hertz 1882",
                          std::abs(state.pressure.maxCoeff() / hertz.max_pressure - 1), 1e-4);
    }
  }
}

TEST(LineContact, SaturatesWhereThePressureIsCapped) {
  const double radius = 2.5e-3;
  const auto hertz = reference::hertz_line_at_load(radius, 1.2e9, 5000);
  const Grid grid{512, 1, 6 * hertz.half_width, 1e-3};
  contact::Problem problem{.height = Field(1, 512),
                           .control = contact::MeanPressure{hertz.load / grid.lx},
                           .bounds = {.upper = 0.7 * hertz.max_pressure}};
  for (Index i = 0; i < 512; ++i) {
    const double x = (static_cast<double>(i) - 255.5) * grid.dx();
    problem.height(0, i) = -x * x / (2 * radius);
  }
  const auto elasticity = make_line(grid, hertz.effective_modulus);
  const contact::State state = contact::solve(*elasticity, problem);
  EXPECT_TRUE(state.convergence.converged());
  EXPECT_LE(state.pressure.maxCoeff(), problem.bounds.upper);
  EXPECT_NEAR(state.pressure.mean() * grid.lx / hertz.load, 1, 1e-9);
  EXPECT_GT((state.pressure >= problem.bounds.upper).count(), 50);
}

}  // namespace
}  // namespace tabor::elastic
