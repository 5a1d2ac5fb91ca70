// Loads, heights, caps and pixels at the edges of what doubles carry.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "contact/surfaces.hpp"

namespace tabor::test {
namespace {

constexpr double kModulus = 7e10;  // [Pa]
constexpr double kNoCap = contact::kNoSaturation;

/// Heights of random signs and sizes, the largest 1.
Field unit_roughness(Index ny, Index nx) {
  Field height(ny, nx);
  for (Index i = 0; i < height.size(); ++i) {
    height(i) = CounterRandom(3).normal(static_cast<std::uint64_t>(i));
  }
  return height / height.abs().maxCoeff();
}

Solved solve_on(const Grid& grid, const Field& height, double mean_pressure, double cap,
                bool periodic = true, int max_iterations = 5000) {
  const auto elasticity =
      periodic ? elastic::make_periodic(grid, kModulus) : elastic::make_free(grid, kModulus);
  contact::Problem problem{.height = height, .control = contact::MeanPressure{mean_pressure}};
  problem.bounds.upper = cap;
  problem.max_iterations = max_iterations;
  Solved solved;
  solved.state = contact::solve(*elasticity, problem);
  solved.summary = contact::summarise(solved.state, problem, grid, periodic);
  return solved;
}

void expect_sound(const Solved& solved, double mean_pressure, double cap) {
  EXPECT_TRUE(solved.state.convergence.converged()) << solved.state.convergence.certificate;
  EXPECT_NEAR(solved.state.pressure.mean() / mean_pressure, 1, 1e-10);
  EXPECT_LE(solved.state.pressure.maxCoeff(), cap);
  EXPECT_GE(solved.summary.contact_area_fraction_pixels, mean_pressure / cap * (1 - 1e-12));
  EXPECT_TRUE(solved.state.gap.isFinite().all());
}

const Grid kGrid{16, 16, 16e-6, 16e-6};

TEST(ExtremeContact, ConvergesFromMicropascalsToPetapascals) {
  const Field rough = unit_roughness(16, 16);
  for (const bool periodic : {true, false}) {
    for (const double amplitude : {1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
      for (const double pressure : {1e-6, 1e-3, 1.0, 1e6, 1e9, 1e12, 1e15}) {
        SCOPED_TRACE(fmt::format("{} m, {} Pa, periodic {}", amplitude, pressure, periodic));
        expect_sound(solve_on(kGrid, rough * amplitude, pressure, kNoCap, periodic), pressure,
                     kNoCap);
      }
    }
  }
}

TEST(ExtremeContact, ConvergesAtAnyShareOfTheCap) {
  const Field rough = unit_roughness(16, 16);
  for (const double amplitude : {1e-9, 1e-6, 1e-3}) {
    for (const double pressure : {1e-6, 1e6, 1e9}) {
      for (const double share : {1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
        SCOPED_TRACE(fmt::format("{} m, {} Pa, P / p_sat = {}", amplitude, pressure, share));
        expect_sound(solve_on(kGrid, rough * amplitude, pressure, pressure / share), pressure,
                     pressure / share);
      }
    }
  }
}

// Of 256 pixels at most a few can be below the cap when all but a millionth of the load it could
// carry is on them.
TEST(ExtremeContact, IsSaturatedWhereTheLoadIsNextToTheCap) {
  const Field rough = unit_roughness(16, 16) * 1e-6;
  for (const bool periodic : {true, false}) {
    for (const double missing : {1e-15, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5}) {
      SCOPED_TRACE(fmt::format("1 - P / p_sat = {}, periodic {}", missing, periodic));
      const double cap = 1e7;
      const Solved solved = solve_on(kGrid, rough, (1 - missing) * cap, cap, periodic);
      expect_sound(solved, (1 - missing) * cap, cap);
      EXPECT_GE(solved.summary.saturated_area_fraction, 1 - 8.0 / 256);
    }
  }
}

TEST(ExtremeContact, DoesNotFeelTheLevelOfTheHeights) {
  const Field rough = unit_roughness(16, 16) * 1e-9;
  for (const double cap : {kNoCap, 5e6}) {
    const Solved level = solve_on(kGrid, rough, 1e6, cap);
    for (const double offset : {-1e3, -5.0, 1e-3, 5.0, 1e3}) {
      const Field high = rough + offset;
      const double rounding = 3e-16 * std::abs(offset);  // of the heights themselves
      const Solved solved = solve_on(kGrid, high, 1e6, cap);
      SCOPED_TRACE(offset);
      expect_sound(solved, 1e6, cap);
      EXPECT_NEAR(solved.summary.mean_gap, level.summary.mean_gap, 2e-14 + rounding);
      EXPECT_NEAR(solved.state.separation - offset, level.state.separation, 2e-14 + rounding);
    }
  }
}

TEST(ExtremeContact, OfLongPixelsEndsWithOrWithoutACap) {
  const Field rough = unit_roughness(16, 16) * 1e-6;
  for (const double aspect : {1e-12, 1e-5, 1e-3, 1e3, 1e5, 1e12}) {
    for (const bool periodic : {true, false}) {
      for (const double cap : {kNoCap, 3e6, 1.01e6}) {
        SCOPED_TRACE(fmt::format("aspect {}, p_sat {}, periodic {}", aspect, cap, periodic));
        const Grid grid{16, 16, 16e-6 * aspect, 16e-6};
        const Solved solved = solve_on(grid, rough, 1e6, cap, periodic, 300);
        EXPECT_TRUE(solved.state.gap.isFinite().all());
        EXPECT_NEAR(solved.state.pressure.mean() / 1e6, 1, 1e-6);
        if (aspect < 1) {  // stiff: each pixel acts for itself
          expect_sound(solved, 1e6, cap);
        }
      }
    }
  }
}

TEST(ExtremeContact, OfFewPixelsConverges) {
  for (const auto& [ny, nx] :
       {std::pair<Index, Index>{1, 1}, {1, 2}, {2, 2}, {3, 1}, {1, 16}, {16, 1}, {2, 64}}) {
    const Grid grid{nx, ny, static_cast<double>(nx) * 1e-6, static_cast<double>(ny) * 1e-6};
    for (const Field& height : {Field(unit_roughness(ny, nx) * 1e-6), Field(Field::Zero(ny, nx)),
                                Field(Field::Constant(ny, nx, 5.0))}) {
      for (const double pressure : {1e-3, 1e12}) {
        for (const double factor : {kNoCap, 1.01, 1 + 1e-9}) {
          for (const bool periodic : {true, false}) {
            SCOPED_TRACE(fmt::format("{} x {}, z {}, P {}, cap {} P, periodic {}", nx, ny,
                                     height(0), pressure, factor, periodic));
            expect_sound(solve_on(grid, height, pressure, factor * pressure, periodic), pressure,
                         factor * pressure);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace tabor::test
