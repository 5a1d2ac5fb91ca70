#include "tabor/reference/ehl_films.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "tabor/reference/bearings.hpp"

namespace tabor::reference {
namespace {

// HDPE on steel in glycerol-water.
const LineContactFilm kPolymer{.radius = 2.5e-3,
                               .effective_modulus = 1.05e9 / (1 - 0.35 * 0.35),
                               .load = 5000,
                               .entrainment_speed = 0.0079,
                               .viscosity = 0.3638,
                               .pressure_coefficient = 5.9e-9};

TEST(LineContactFilm, OfThePolymerPinHasItsKnownGroups) {
  EXPECT_NEAR(kPolymer.speed_group(), 4.80e-10, 0.005e-10);
  EXPECT_NEAR(kPolymer.load_group(), 8.36e-4, 0.005e-4);
  EXPECT_NEAR(kPolymer.material_group(), 14.1, 0.05);
}

TEST(LineContactFilm, OfThePolymerPinHasItsKnownFilms) {
  EXPECT_NEAR(kPolymer.elastic_isoviscous(), 82.2e-9, 0.05e-9);
  EXPECT_NEAR(kPolymer.dowson_higginson_min_film(), 20.8e-9, 0.1e-9);  // of rounded groups
  EXPECT_NEAR(kPolymer.grubin_film(), 10.6e-9, 0.05e-9);
  LineContactFilm slow = kPolymer;
  slow.entrainment_speed /= 2;
  EXPECT_NEAR(slow.elastic_isoviscous(), 54.2e-9, 0.05e-9);
}

// A converged solution of the coupled equations gives 83.4 nm.
TEST(LineContactFilm, MoesCurveIsNearTheSolvedFilmOfThePolymerPin) {
  EXPECT_NEAR(kPolymer.moes_min_film() / 83.4e-9, 1, 0.05);
}

LineContactFilm at_moes(double M, double L) {
  LineContactFilm film{1, 0.5, 0, 0.5e-8, 1, 0};  // E' = 1, U = 0.5e-8, 2 U = 1e-8
  film.load = M * 1e-4;
  film.pressure_coefficient = L / 1e-2;
  return film;
}

TEST(LineContactFilm, MoesCurveTendsToItsLimits) {
  EXPECT_NEAR(at_moes(0.01, 0).moes_min_film() / at_moes(0.01, 0).rigid_isoviscous(), 1, 1e-4);
  EXPECT_NEAR(at_moes(1e5, 0).moes_min_film() / at_moes(1e5, 0).elastic_isoviscous(), 1, 1e-4);
  EXPECT_NEAR(at_moes(1e6, 60).moes_min_film() / at_moes(1e6, 60).elastic_piezoviscous(), 1, 2e-3);
  // Between, it joins the rigid piezoviscous limit without reaching it exactly.
  EXPECT_NEAR(at_moes(2, 20).moes_min_film() / at_moes(2, 20).rigid_piezoviscous(), 1, 0.1);
}

TEST(LineContactFilm, MoesRigidLimitIsMartins) {
  const LineContactFilm film = at_moes(0.01, 0);
  const CylinderFilm cylinder{1, film.rigid_isoviscous(), film.entrainment_speed, film.viscosity};
  EXPECT_NEAR(cylinder.martin_load() / film.load, 1, 2e-3);
}

TEST(LineContactFilm, MoesAgreesWithDowsonAndHigginsonForSteelAndOil) {
  // U = 1e-11, W = 1e-4, G = 5000.
  LineContactFilm steel{.radius = 10e-3, .effective_modulus = 115e9};
  steel.load = 1e-4 * 230e9 * 10e-3;
  steel.viscosity = 0.1;
  steel.entrainment_speed = 1e-11 * 230e9 * 10e-3 / 0.1;
  steel.pressure_coefficient = 5000 / 230e9;
  EXPECT_NEAR(steel.moes_min_film() / steel.dowson_higginson_min_film(), 1, 0.15);
}

TEST(Grubin, GapIsThatOutsideAHertzContact) {
  EXPECT_EQ(grubin_gap(1), 0);
  EXPECT_NEAR(grubin_gap(-2), 2 * (2 * std::sqrt(3.) - std::log(2 + std::sqrt(3.))), 1e-14);
}

// Worked outside tabor by adaptive quadrature.
TEST(Grubin, InletIntegralHasItsKnownValues) {
  constexpr std::array<std::pair<double, double>, 6> kTable{
      {{1e-3, .0830}, {3e-3, .0868}, {1e-2, .0909}, {3e-2, .0945}, {.1, .0978}, {.3, .0998}}};
  for (const auto& [film, expected] : kTable) {
    EXPECT_NEAR(grubin_inlet_integral(film) * std::pow(film, 11. / 8), expected, 6e-5) << film;
  }
}

// Hertz units H = h Rx / a^2 are Moes' film over (3 M / 2)^(2/3).
TEST(NijenbanningVennerMoes, HasItsKnownFilms) {
  const auto hertz_units = [](double M, double L) {
    return nijenbanning_central_film(M, L, 1) / std::pow(1.5 * M, 2. / 3);
  };
  EXPECT_NEAR(hertz_units(20, 10), 0.4876, 5e-5);
  EXPECT_NEAR(hertz_units(1892, 12.61), 0.0225, 5e-5);
}

TEST(NijenbanningVennerMoes, TendsToItsLimits) {
  EXPECT_NEAR(nijenbanning_central_film(1e-3, 0, 1) * 1e-6, 145 * std::pow(1.796, -15. / 7), 1e-3);
  EXPECT_NEAR(nijenbanning_central_film(1e6, 0, 1) * std::pow(1e6, 2. / 15),
              3.18 * std::pow(1.63, -14. / 25), 0.05);
  const double ep = 1.48 * std::pow(1.63, -7. / 20) * std::pow(1e6, -1. / 12) * std::pow(50, 0.75);
  EXPECT_NEAR(nijenbanning_central_film(1e6, 50, 1) / ep, 1, 0.02);
}

// A long ellipse is Martin's line everywhere: F = 4.895 sqrt(2) pi eta u Rx sqrt(Ry / h).
TEST(NijenbanningVennerMoes, LiesAboveTheExactFilmOfLongRigidEllipses) {
  const double ratio = 1e-9, M = 1e-3;
  const double exact = std::pow(6 * std::pow(std::cos(martin_exit_angle()), 2) *
                                    std::numbers::sqrt2 * std::numbers::pi,
                                2) /
                       (4 * ratio * M * M);
  EXPECT_NEAR(nijenbanning_central_film(M, 0, ratio) / exact, 1.23, 0.01);
}

// Steel ball of 1.5 mm radius, E' = 230.8 GPa: U = 2.16e-11, W = 3.188e-5, G = 4918.
PointContactFilm steel_ball(double speed) {
  return {.radius_x = 1.5e-3,
          .radius_y = 1.5e-3,
          .effective_modulus = 115.4e9,
          .load = 3.188e-5 * 230.8e9 * 2.25e-6,
          .entrainment_speed = speed,
          .viscosity = 2.16e-11 * 230.8e9 * 1.5e-3 / 0.05,
          .pressure_coefficient = 4918 / 230.8e9};
}

TEST(PointContactFilm, OfTheSteelBallHasItsKnownGroups) {
  const PointContactFilm ball = steel_ball(0.05);
  EXPECT_NEAR(ball.moes_viscosity(), 12.608, 5e-4);
  EXPECT_NEAR(ball.moes_load(), 1891.9, 0.05);
}

TEST(PointContactFilm, OfTheSteelBallHasItsKnownHamrockDowsonFilms) {
  const PointContactFilm ball = steel_ball(0.05);
  // In Hertz units, H = h Rx / a^2 with a / Rx = 0.036297.
  const double unit = 0.036297 * 0.036297 * 1.5e-3;
  EXPECT_NEAR(ball.hamrock_dowson_central() / unit, 0.01866, 5e-5);
  EXPECT_NEAR(ball.hamrock_dowson_min() / unit, 0.01042, 5e-5);
  EXPECT_NEAR(ball.nijenbanning_central() / unit, 0.0225, 5e-5);
  EXPECT_NEAR(ball.hamrock_dowson_central(), 36.9e-9, 0.05e-9);
  EXPECT_NEAR(steel_ball(0.5).hamrock_dowson_central(), 172e-9, 0.5e-9);
  EXPECT_NEAR(steel_ball(5).hamrock_dowson_central(), 807e-9, 0.5e-9);
  EXPECT_NEAR(ball.hamrock_dowson_min(), 20.6e-9, 0.05e-9);
  EXPECT_NEAR(steel_ball(0.5).hamrock_dowson_min(), 98.6e-9, 0.1e-9);
  EXPECT_NEAR(steel_ball(5).hamrock_dowson_min(), 472e-9, 0.5e-9);
}

}  // namespace
}  // namespace tabor::reference
