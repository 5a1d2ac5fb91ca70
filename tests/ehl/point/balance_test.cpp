#include "tabor/ehl/point/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ehl/point/moes.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/ehl/point/film.hpp"

namespace tabor::ehl {
namespace {

using test::compressible;
using test::moes_case;

constexpr Index kNx = 9;
constexpr Index kNy = 7;

/// A film and pressures without any symmetry.
struct Sample {
  Grid grid{.nx = kNx, .ny = kNy, .lx = 9e-5, .ly = 1.4e-4};
  material::Lubricant lubricant;
  Field pressure{kNy, kNx}, film{kNy, kNx};
  PointStorage storage;
  PointUnits units{.pressure = 3e8, .film = 2e-7, .load = 1};

  Sample() {
    lubricant = {.viscosity = material::roelands_viscosity(0.08, 2e-8),
                 .density = material::relative_density(material::DensityLaw::dowson_higginson),
                 .shear = material::ree_eyring_shear(5e6)};
    for (Index k = 0; k < pressure.size(); ++k) {
      const auto t = static_cast<double>(k);
      pressure.data()[k] = 2e8 * (1.5 + std::sin(1.7 * t));
      film.data()[k] = 2e-7 * (1.3 + std::cos(2.9 * t));
    }
  }
  PointBalance balance() const {
    return point_balance({.grid = grid,
                          .lubricant = lubricant,
                          .speed = 0.3,
                          .sliding_speed = 0.2,
                          .pressure = pressure,
                          .film = film},
                         storage, units);
  }
};

/// Largest difference between the derivatives and central differences, over the largest one.
double error_of_derivatives(Sample& sample) {
  const PointBalance at = sample.balance();
  double worst = 0;
  double largest = 0;
  const auto compare = [&](Field& unknown, double unit, const PointStencil& stencil) {
    for (Index k = 0; k < unknown.size(); ++k) {
      const double before = unknown.data()[k];
      const double step = 1e-5 * unit;
      unknown.data()[k] = before + step;
      const Field above = sample.balance().residual;
      unknown.data()[k] = before - step;
      const Field below = sample.balance().residual;
      unknown.data()[k] = before;
      Field one = Field::Zero(kNy, kNx);
      one.data()[k] = 1;
      Field product = Field::Zero(kNy, kNx);
      stencil.add_product(one, product);
      const Field difference = (above - below) / (2 * step) * unit;
      worst = test::worse(worst, (product - difference).abs().maxCoeff());
      largest = std::max(largest, product.abs().maxCoeff());
    }
  };
  compare(sample.pressure, sample.units.pressure, at.by_pressure);
  compare(sample.film, sample.units.film, at.by_film);
  return worst / largest;
}

TEST(PointBalance, HasTheDerivativesOfDifferences) {
  Sample steady;
  EXPECT_LE(error_of_derivatives(steady), 1e-8);
  Sample transient;
  transient.storage = {.time_step = 1e-4, .old_mass = Field::Constant(kNy, kNx, 1e-7)};
  EXPECT_LE(error_of_derivatives(transient), 1e-8);
}

TEST(PointBalance, WhatHappensInsideNeitherMakesNorLosesMass) {
  Sample sample;
  const double before = sample.balance().residual.sum();
  for (Index j = 3; j < kNy - 3; ++j) {
    for (Index i = 3; i < kNx - 3; ++i) {
      sample.pressure(j, i) *= 1.3;
      sample.film(j, i) *= 0.6;
    }
  }
  const Field after = sample.balance().residual;
  EXPECT_NEAR(after.sum(), before, 1e-12 * after.abs().maxCoeff());
}

TEST(PointBalance, CarriesAPositiveMassOverAnyStep) {
  Sample sample;
  sample.pressure.setZero();
  sample.film.setConstant(1e-6);
  sample.film.rightCols(5).setConstant(1e-12);
  const Field residual = sample.balance().residual;
  EXPECT_LT(residual(3, 4), 0);  // more comes than goes
  EXPECT_TRUE(residual.isFinite().all());
}

/// Largest imbalance of Kapitza's pressure p = -12 eta u x / ((3 + 2 Rx/Ry) h^2), which solves the
/// equation for rigid paraboloids exactly, over the flow in the contact.
double kapitza_imbalance(Index nodes, double radius_ratio) {
  constexpr double kViscosity = 0.1;
  constexpr double kSpeed = 0.5;
  constexpr double kRadius = 0.01;
  constexpr double kFilm = 1e-6;
  const double length = 3 * std::sqrt(2 * kRadius * kFilm);
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(nodes, -length, length);
  const double extent = 2 * length * static_cast<double>(nodes) / static_cast<double>(nodes - 1);
  const Grid grid{.nx = nodes, .ny = nodes, .lx = extent, .ly = extent};
  material::Lubricant lubricant;
  lubricant.viscosity = material::ConstantViscosity{kViscosity};
  Field film(nodes, nodes);
  Field pressure(nodes, nodes);
  for (Index j = 0; j < nodes; ++j) {
    for (Index i = 0; i < nodes; ++i) {
      film(j, i) = kFilm + place[i] * place[i] / (2 * kRadius) +
                   place[j] * place[j] / (2 * kRadius / radius_ratio);
      pressure(j, i) =
          -12 * kViscosity * kSpeed * place[i] / ((3 + 2 * radius_ratio) * film(j, i) * film(j, i));
    }
  }
  const PointBalance balance = point_balance({.grid = grid,
                                              .lubricant = lubricant,
                                              .speed = kSpeed,
                                              .sliding_speed = 0,
                                              .pressure = pressure,
                                              .film = film},
                                             {}, {.pressure = 1, .film = kFilm, .load = 1});
  // Where the domain begins the film is extrapolated from fewer nodes.
  const Field inner = balance.residual.block(2, 3, nodes - 4, nodes - 5);
  return inner.abs().maxCoeff() / grid.dx() * length;
}

TEST(PointBalance, KapitzasPressureBalancesToSecondOrder) {
  for (const double ratio : {1.0, 0.25}) {
    const double coarse = kapitza_imbalance(49, ratio);
    const double fine = kapitza_imbalance(97, ratio);
    EXPECT_LT(fine, 0.3 * coarse);
    test::expect_within("EHL", "Kapitza, rigid point contact", "imbalance, 97 nodes, relative",
                        "Kapitza 1955", fine, 0.05);
  }
}

TEST(PointFilm, ASteadyFilmStaysWhenTimeGoesOn) {
  const PointProblem problem = compressible(moes_case(100, 8, 33));
  const PointFilm film(problem);
  PointState state = film.hertz_start(3 * film.film_scale());
  ASSERT_TRUE(film.solve(state, film.conditions()).convergence.converged());
  const double before = state.film(16, 24);
  const double step = film.grid().dx() / problem.entrainment_speed;
  ASSERT_TRUE(
      film.solve(state, film.conditions(), {.time_step = step, .old_mass = film.mass_of(state)})
          .convergence.converged());
  EXPECT_NEAR(state.film(16, 24) / before, 1, 1e-5);
}

}  // namespace
}  // namespace tabor::ehl
