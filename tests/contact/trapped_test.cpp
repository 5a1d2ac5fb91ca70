// Trapped liquid: pockets, seals, the problem against a general solver, and its properties.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>

#include "contact/trapped.hpp"
#include "support/rejection.hpp"
#include "tabor/contact/trapped/seals.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {
namespace {

using contact::kIncompressible;
using contact::kNoPocket;
using contact::kNoSaturation;
using contact::Pockets;
using contact::TrappedState;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kFullPressure = std::numbers::pi * kUnitAmplitude;

/// Maps of digits, row by row.
Field digits(std::initializer_list<const char*> rows) {
  Field map(static_cast<Index>(rows.size()), static_cast<Index>(std::strlen(*rows.begin())));
  Index y = 0;
  for (const char* row : rows) {
    for (Index x = 0; x < map.cols(); ++x) map(y, x) = row[x] - '0';
    ++y;
  }
  return map;
}

TEST(Pockets, AreClosedRegionsOfGapAndWetContactWithLiquid) {
  // Two pits that oil under the contact between them joins; gap around.
  const Field contact = digits({"000000", "011111", "010101", "011111", "000000", "000000"});
  const Field film = digits({"300000", "000000", "001200", "000000", "000000", "000000"});
  const Grid grid{6, 6, 6, 6};
  const Pockets pockets = contact::find_pockets(contact > 0, film, grid, elastic::Border::ends);
  ASSERT_EQ(pockets.size(), 1U);
  EXPECT_THAT(pockets.pixels, ElementsAre(14, 15, 16));  // with the wet contact
  EXPECT_THAT(pockets.volume, ElementsAre(3));
  EXPECT_EQ(pockets.open_volume, 3);
  EXPECT_EQ(pockets.of[14], 0);
  EXPECT_EQ(pockets.of[0], kNoPocket);
  EXPECT_EQ(pockets.open[0], 1);
  EXPECT_EQ(pockets.open[16], 0);
}

TEST(Pockets, OfAPeriodicCellAreOpenWhereTheyRunThrough) {
  const Field contact = digits({"1111", "0000", "1111", "1001"});
  const Field film = digits({"0000", "0100", "0000", "0110"});
  const Grid grid{4, 4, 4, 4};
  const Pockets pockets = contact::find_pockets(contact > 0, film, grid, elastic::Border::repeats);
  ASSERT_EQ(pockets.size(), 1U);
  EXPECT_THAT(pockets.pixels, ElementsAre(13, 14));
  EXPECT_EQ(pockets.open[4], 1);
  EXPECT_EQ(contact::find_pockets(contact > 0, film, grid, elastic::Border::ends).size(),
            0U);  // it ends there
}

TEST(Pockets, AreNotOilOnContactBesideOpenGap) {
  const Field contact = digits({"0000", "0110", "0110", "0000"});
  const Field film = digits({"0000", "0110", "0000", "0000"});
  EXPECT_EQ(contact::find_pockets(contact > 0, film, {4, 4, 4, 4}, elastic::Border::ends).size(),
            0U);
}

TEST(Seals, AreTheLowestBarriersOnTheWayOut) {
  // A ring of pressures around a pit, whose lowest gate is 4; behind it 5 stands in the way.
  const Field pressure = digits({"000000", "099990", "090459", "099990", "000000", "000000"});
  Field film = Field::Zero(6, 6);
  film(2, 2) = 1;
  const Grid grid{6, 6, 6, 6};
  const Pockets pockets = contact::find_pockets(pressure > 0, film, grid, elastic::Border::ends);
  ASSERT_EQ(pockets.size(), 1U);
  const auto seal = [&](bool periodic, double cap) {
    return contact::seals_of(pressure, pockets, {0}, grid, periodic, cap);
  };
  EXPECT_THAT(seal(false, kNoSaturation), ElementsAre(9));  // row 2 ends with 9 at the border
  EXPECT_THAT(seal(false, 8), ElementsAre(8));
}

TEST(Seals, CrossOtherPocketsAtThePressureOfTheirLiquid) {
  // Left pit, gate 2, middle pit, gate 3, open gap.
  const Field pressure = digits({"9999990", "9020300", "9999990"});
  Field film = Field::Zero(3, 7);
  film(1, 1) = film(1, 3) = 1;
  const Grid grid{7, 3, 7, 3};
  const Pockets pockets = contact::find_pockets(pressure > 0, film, grid, elastic::Border::ends);
  ASSERT_EQ(pockets.size(), 2U);
  const auto seals = [&](double middle) {
    return contact::seals_of(pressure, pockets, {0, middle}, grid, false, kNoSaturation);
  };
  EXPECT_THAT(seals(0), ElementsAre(3, 3));
  EXPECT_THAT(seals(5), ElementsAre(5, 3));
}

/// Minimises the energy of p and pi by the alternating direction method of multipliers on dense
/// matrices, which shares nothing with the solver.
struct DenseSolution {
  Eigen::VectorXd pressure, levels;
};
DenseSolution solve_dense(const UnitContact& contact, const Pockets& pockets, double bulk_modulus,
                          double cap, const std::vector<double>& seals) {
  const Index n = contact.grid.size();
  const auto m = static_cast<Index>(pockets.size());
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(n + m, n + m);
  Field unit = Field::Zero(contact.grid.ny, contact.grid.nx);
  Field moved(unit.rows(), unit.cols());
  for (Index i = 0; i < n; ++i) {
    unit(i) = 1;
    contact.elasticity->apply(unit, moved);
    for (Index j = 0; j < n; ++j) q(j, i) = moved(j);
    unit(i) = 0;
  }
  Eigen::VectorXd linear = Eigen::VectorXd::Zero(n + m);
  for (Index i = 0; i < n; ++i) linear(i) = -contact.problem.height(i);
  const auto n_rows = n + m + static_cast<Index>(pockets.pixels.size()) + 1;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n_rows, n + m);
  Eigen::VectorXd low = Eigen::VectorXd::Zero(n_rows);
  Eigen::VectorXd high = Eigen::VectorXd::Constant(n_rows, cap);
  for (Index i = 0; i < n; ++i) a(i, i) = 1;
  Index row = n + m;
  for (Index k = 0; k < m; ++k) {
    const auto pocket = static_cast<std::size_t>(k);
    linear(n + k) = -pockets.volume[pocket];
    q(n + k, n + k) = pockets.volume[pocket] / bulk_modulus;
    a(n + k, n + k) = 1;
    high(n + k) = std::min(seals[pocket], cap);
    for (std::size_t j = pockets.first[pocket]; j < pockets.first[pocket + 1]; ++j, ++row) {
      a(row, pockets.pixels[j]) = 1;
      a(row, n + k) = -1;
    }
  }
  a.row(row).head(n).setConstant(1 / std::sqrt(static_cast<double>(n)));
  low(row) = high(row) = contact.dry.mean_pressure * std::sqrt(static_cast<double>(n));
  const double rho = 0.1;
  const double sigma = 1e-6;
  const Eigen::LLT<Eigen::MatrixXd> solver(q + sigma * Eigen::MatrixXd::Identity(n + m, n + m) +
                                           rho * a.transpose() * a);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + m);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n_rows);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n_rows);
  for (int i = 0; i < 60000; ++i) {
    x = solver.solve(sigma * x - linear + a.transpose() * (rho * z - y));
    const Eigen::VectorXd wanted = a * x + y / rho;
    z = wanted.cwiseMax(low).cwiseMin(high);
    y += rho * (a * x - z);
  }
  return {x.head(n), x.tail(m)};
}

/// Heights of 8 x 8 pixels with several closed pits, and oil in them.
Field pitted() {
  Field height = digits({"98989898", "90890819", "98989898", "90190898", "98989089", "98089898",
                         "91989019", "98989898"});
  for (Index i = 0; i < height.size(); ++i) height(i) += 0.1 * std::sin(static_cast<double>(7 * i));
  return kUnitAmplitude / 9 * height;
}

TEST(TrappedLiquid, OfSeveralPocketsIsThatOfAGeneralSolver) {  // slow with sanitizers
  const Field height = pitted();
  for (const double cap : {kNoSaturation, 4 * kUnitAmplitude}) {
    for (const double bulk_modulus : {kIncompressible, 2 * kUnitAmplitude}) {
      const UnitContact contact(height, 2 * kUnitAmplitude, cap, 1e-10);
      const Field film = 0.95 * kUnitAmplitude * (height < 0.3 * kUnitAmplitude).cast<double>();
      const Pockets pockets = contact::find_pockets(contact::contact_mask(contact.dry), film,
                                                    contact.grid, elastic::Border::repeats);
      ASSERT_GT(pockets.size(), 3U);
      const auto seals =
          contact::seals_of(contact.dry.pressure, pockets, std::vector<double>(pockets.size(), 0),
                            contact.grid, true, cap);
      const TrappedState state = contact.with(film, bulk_modulus);
      ASSERT_EQ(state.liquid.seal_rounds, 1);
      const DenseSolution dense = solve_dense(contact, pockets, bulk_modulus, cap, seals);
      EXPECT_GT(state.liquid.n_squeezed, 3);
      for (Index i = 0; i < height.size(); ++i) {
        EXPECT_NEAR(state.contact.pressure(i), dense.pressure(i), 1e-5 * kUnitAmplitude) << i;
      }
      for (std::size_t k = 0; k < pockets.size(); ++k) {
        EXPECT_NEAR(state.liquid_pressure(pockets.pixels[pockets.first[k]]),
                    dense.levels(static_cast<Index>(k)), 1e-5 * kUnitAmplitude);
      }
    }
  }
}

constexpr double kRoughPressure = 4e-3;

/// A rough surface of 64 x 64 pixels with oil in its valleys.
struct Rough {
  explicit Rough(double cap = kNoSaturation, bool periodic = true)
      : height(0.01 * self_affine(64, 0.8, 2, 16, 3)),
        film(oil_in(height)),
        contact(height, kRoughPressure, cap, 1e-8, periodic) {}

  static Field oil_in(const Field& height) {
    const double middle = height.mean();
    return (middle - height).max(0.0) * 0.8;
  }

  Field height;
  Field film;
  UnitContact contact;
};

TEST(TrappedLiquid, KeepsItsBooks) {
  for (const bool periodic : {true, false}) {
    for (const double cap : {kNoSaturation, 6e-3}) {
      const Rough rough(cap, periodic);
      const double modulus = 0.01;
      const TrappedState state = rough.contact.with(rough.film, modulus);
      ASSERT_TRUE(state.contact.convergence.converged());
      EXPECT_TRUE(state.liquid.seals_settled);
      EXPECT_GT(state.liquid.n_squeezed, 0);
      const double pixel = rough.contact.grid.pixel_area();
      // Dosed = with a way out + in pockets (of these, leaked).
      EXPECT_NEAR(rough.film.sum() * pixel, state.liquid.open_volume + state.liquid.pocket_volume,
                  1e-16);
      EXPECT_LE(state.liquid.leaked_volume, state.liquid.pocket_volume);
      // The load is exact, bounds hold, and the gap over each pocket holds its liquid.
      EXPECT_NEAR(state.contact.pressure.mean() / kRoughPressure, 1, 1e-9);
      EXPECT_TRUE((state.contact.pressure >= 0).all());
      EXPECT_TRUE((state.contact.pressure <= cap).all());
      EXPECT_TRUE((state.contact.pressure >= state.liquid_pressure * (1 - 1e-12)).all());
      const Pockets pockets = contact::find_pockets(
          contact::contact_mask(rough.contact.dry), rough.film, rough.contact.grid,
          periodic ? elastic::Border::repeats : elastic::Border::ends);
      double leaked = 0;
      for (std::size_t k = 0; k < pockets.size(); ++k) {
        double gap = 0;
        const double level = state.liquid_pressure(pockets.pixels[pockets.first[k]]);
        for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
          gap += std::max(state.contact.gap(pockets.pixels[j]), 0.0);
        }
        const double left = gap / (1 - level / modulus);  // at no pressure
        if (level == 0 && gap > 0) {
          EXPECT_GE(left, pockets.volume[k] * (1 - 2e-3));
        } else {
          EXPECT_LE(left, pockets.volume[k] * (1 + 2e-3));
          leaked += std::max(pockets.volume[k] - left, 0.0) * pixel;
        }
      }
      EXPECT_NEAR(leaked, state.liquid.leaked_volume, 2e-3 * state.liquid.pocket_volume);
    }
  }
}

TEST(TrappedLiquid, RisesWithItsVolumeAndItsStiffness) {
  const Rough rough(6e-3);
  double before = 0;
  for (const double factor : {0.25, 0.5, 1.0}) {
    const TrappedState state = rough.contact.with(factor * rough.film, 0.01);
    EXPECT_GE(state.liquid.load_share, before);
    before = state.liquid.load_share;
  }
  EXPECT_GE(rough.contact.with(rough.film, kIncompressible).liquid.load_share, before);
  const TrappedState soft = rough.contact.with(rough.film, 1e-12);
  EXPECT_TRUE((soft.contact.pressure == rough.contact.dry.pressure).all());
}

TEST(TrappedLiquid, WithoutOilHasTheBitsOfTheDryContact) {
  const Rough rough;
  const TrappedState state = rough.contact.with(Field::Zero(64, 64), kIncompressible);
  EXPECT_TRUE((state.contact.pressure == rough.contact.dry.pressure).all());
  EXPECT_TRUE((state.contact.gap == rough.contact.dry.gap).all());
  EXPECT_EQ(state.contact.convergence.fft_pairs, rough.contact.dry.convergence.fft_pairs);
  EXPECT_EQ(state.liquid.n_pockets, 0);
}

/// A sheet with oil in the hollows of single pixels: hundreds of pockets that leak, on more pixels
/// than one thread takes at once.
TrappedState leaking() {
  synthesis::Edt recipe;
  recipe.grid = {256, 256, 256 * 0.67e-6, 256 * 0.67e-6};
  const Field height = synthesis::edt(recipe).height;
  Field film(256, 256);
  for (Index y = 0; y < 256; ++y) {
    for (Index x = 0; x < 256; ++x) {
      const double around = height(y, (x + 1) % 256) + height(y, (x + 255) % 256) +
                            height((y + 1) % 256, x) + height((y + 255) % 256, x);
      film(y, x) = std::max(0.0, around / 4 - height(y, x));
    }
  }
  const auto elasticity = elastic::make_periodic(recipe.grid, 78.5e9);
  const contact::Problem problem{
      .height = height, .control = contact::MeanPressure{30e6}, .bounds = {.upper = 240e6}};
  return contact::solve_trapped(*elasticity, problem, {.film = film},
                                contact::solve(*elasticity, problem));
}

// Where the gap of a pocket has closed no oil is left: the solids carry the load there.
TEST(TrappedLiquid, CarriesNothingWhereNoneIsLeft) {
  const Rough rough(6e-3, false);
  for (const double modulus : {0.01, 0.1, kIncompressible}) {
    const TrappedState state = rough.contact.with(rough.film, modulus);
    const Pockets pockets =
        contact::find_pockets(contact::contact_mask(rough.contact.dry), rough.film,
                              rough.contact.grid, elastic::Border::ends);
    double carried = 0;
    Index n_empty = 0;
    for (std::size_t k = 0; k < pockets.size(); ++k) {
      double gap = 0;
      for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
        const std::uint32_t i = pockets.pixels[j];
        gap += std::max(state.contact.gap.data()[i], 0.0);
        const double level = state.liquid_pressure.data()[i];
        if (level > 0 && state.contact.pressure.data()[i] == level) carried += level;
      }
      if (gap > 0) continue;
      ++n_empty;
      EXPECT_EQ(state.liquid_pressure.data()[pockets.pixels[pockets.first[k]]], 0);
    }
    EXPECT_GT(n_empty, 0);
    EXPECT_LT(state.liquid.n_squeezed, state.liquid.n_pockets);
    EXPECT_NEAR(state.liquid.load_share, carried / state.contact.pressure.sum(), 1e-9);
  }
}

TEST(TrappedLiquid, LeaksWhereItsPressureOpensASeal) {
  const TrappedState state = leaking();
  EXPECT_TRUE(state.contact.convergence.converged());
  EXPECT_TRUE(state.liquid.seals_settled);
  EXPECT_GT(state.liquid.n_pockets, 64);
  EXPECT_GT(state.liquid.n_at_seal, 0);
  EXPECT_LT(state.liquid.n_at_seal, state.liquid.n_pockets);
  EXPECT_GT(state.liquid.leaked_volume, 0);
  EXPECT_GT(state.liquid.seal_rounds, 1);
}

TEST(TrappedLiquid, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto pressure = [](int threads) {
    set_thread_count(threads);
    return leaking().contact.pressure;
  };
  const Field one = pressure(1);
  EXPECT_TRUE((pressure(2) == one).all());
  EXPECT_TRUE((pressure(3) == one).all());
  set_thread_count(0);
}

TEST(TrappedLiquid, FollowsTheSurfaceWhereItIsTurnedOrShifted) {
  const Rough rough(6e-3);
  const TrappedState state = rough.contact.with(rough.film, 0.01);
  const auto compare = [&](const auto& moved) {
    const UnitContact contact(moved(rough.height), kRoughPressure, 6e-3, 1e-7);
    const TrappedState other = contact.with(moved(rough.film), 0.01);
    EXPECT_NEAR(other.liquid.load_share, state.liquid.load_share, 1e-4);
    EXPECT_EQ(other.liquid.n_pockets, state.liquid.n_pockets);
    EXPECT_NEAR(area_of(contact::solid_contact(other)), area_of(contact::solid_contact(state)),
                2.0 / 4096);
  };
  compare([](const Field& map) -> Field { return map.colwise().reverse(); });
  compare([](const Field& map) -> Field {
    Field shifted(map.rows(), map.cols());
    for (Index y = 0; y < map.rows(); ++y) {
      for (Index x = 0; x < map.cols(); ++x) {
        shifted(y, x) = map((y + 5) % map.rows(), (x + 17) % map.cols());
      }
    }
    return shifted;
  });
}

TEST(TrappedLiquid, IsRejectedWhereItCannotBe) {
  const Rough rough;
  const auto message = [&](const Field& film, double bulk_modulus) {
    return rejection([&] { rough.contact.with(film, bulk_modulus); });
  };
  Field wrong = rough.film;
  wrong(3, 3) = std::nan("");
  EXPECT_THAT(message(wrong, 1), HasSubstr("NaN"));
  wrong(3, 3) = -1e-9;
  EXPECT_THAT(message(wrong, 1), HasSubstr("negative"));
  EXPECT_THAT(message(Field::Zero(3, 3), 1), HasSubstr("3 x 3"));
  EXPECT_THAT(message(rough.film, 0), HasSubstr("bulk modulus"));
  EXPECT_THAT(message(rough.film, std::nan("")), HasSubstr("bulk modulus"));
  contact::Problem problem = rough.contact.problem;
  problem.control = contact::Separation{rough.contact.dry.separation};
  EXPECT_THAT(rejection([&] {
                contact::solve_trapped(*rough.contact.elasticity, problem, {rough.film, 1, true},
                                       rough.contact.dry);
              }),
              HasSubstr("separation"));
}

TEST(TrappedLiquid, StopsWhereItsObserverSaysSo) {
  const Rough rough(6e-3);
  const TrappedState state = contact::solve_trapped(
      *rough.contact.elasticity, rough.contact.problem, {rough.film, 0.01, true}, rough.contact.dry,
      [](const Progress&) { return false; });
  EXPECT_TRUE(state.contact.convergence.stopped());
}

}  // namespace
}  // namespace tabor::test
