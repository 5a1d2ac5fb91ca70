#include "tabor/elastic/half_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/mirror_images.hpp"

namespace tabor::elastic {
namespace {

constexpr double kModulus = 78.6e9;

Field applied(ElasticOperator& elasticity, const Field& pressure) {
  Field displacement;
  elasticity.apply(pressure, displacement);
  return displacement;
}

Field mode(const Grid& grid, int kx, int ky) {
  Field field(grid.ny, grid.nx);
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      field(y, x) = std::cos(2 * std::numbers::pi *
                             (kx * static_cast<double>(x) / static_cast<double>(grid.nx) +
                              ky * static_cast<double>(y) / static_cast<double>(grid.ny)));
    }
  }
  return field;
}

TEST(PeriodicHalfSpace, MultipliesAModeByTwoOverModulusAndWavevector) {
  const Grid grid{48, 60, 30e-6, 25e-6};
  const auto elasticity = make_periodic(grid, kModulus);
  double amplitude_error = 0;
  double pointwise_error = 0;
  for (const auto& [kx, ky] : {std::pair{1, 0}, {0, 1}, {3, 5}, {7, -4}, {23, 29}}) {
    const Field pressure = mode(grid, kx, ky);
    const double q = 2 * std::numbers::pi * std::hypot(kx / grid.lx, ky / grid.ly);
    const double compliance = 2 / (kModulus * q);
    const Field displacement = applied(*elasticity, pressure);
    const double amplitude = (displacement * pressure).sum() / pressure.square().sum();
    amplitude_error = test::worse(amplitude_error, std::abs(amplitude / compliance - 1));
    pointwise_error =
        test::worse(pointwise_error, (displacement / compliance - pressure).abs().maxCoeff());
  }
  test::expect_within("Elastic operator", "single modes, 48 x 60", "amplitude, relative",
                      "2 / (E* q)", amplitude_error, 1e-14);
  // Rounding errors of a short wave leak into long ones, where the operator is 37 times larger.
  test::expect_within("Elastic operator", "single modes, 48 x 60", "every point, relative",
                      "2 / (E* q)", pointwise_error, 37 * 1e-14);
}

TEST(PeriodicHalfSpace, DropsTheMean) {
  const Grid grid{16, 16, 1e-5, 1e-5};
  const auto elasticity = make_periodic(grid, kModulus);
  EXPECT_LE(applied(*elasticity, Field::Constant(16, 16, 5e6)).abs().maxCoeff(), 1e-25);
}

TEST(PeriodicHalfSpace, InverseUndoesItUpToTheMean) {
  const Grid grid{20, 18, 1e-5, 1e-5};
  const auto elasticity = make_periodic(grid, kModulus);
  const Field pressure = 1e6 * Field::Random(18, 20);
  Field back;
  ASSERT_TRUE(elasticity->apply_inverse(applied(*elasticity, pressure), back));
  EXPECT_LE((back - (pressure - pressure.mean())).abs().maxCoeff(), 1e-12 * 1e6);
}

class BothHalfSpaces : public testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<ElasticOperator> make(const Grid& grid, double modulus = kModulus) const {
    return GetParam() ? make_periodic(grid, modulus) : make_free(grid, modulus);
  }
};

TEST_P(BothHalfSpaces, AreSymmetric) {
  const Grid grid{33, 24, 2e-5, 1.7e-5};
  const auto elasticity = make(grid);
  const Field a = Field::Random(24, 33);
  const Field b = Field::Random(24, 33);
  const double ab = (a * applied(*elasticity, b)).sum();
  const double ba = (b * applied(*elasticity, a)).sum();
  const double size =
      std::sqrt((a * applied(*elasticity, a)).sum() * (b * applied(*elasticity, b)).sum());
  test::expect_within("Elastic operator", GetParam() ? "symmetry, periodic" : "symmetry, free",
                      "<a, S b> - <b, S a>, relative", "identity", std::abs(ab - ba) / size, 1e-12);
}

TEST_P(BothHalfSpaces, StoreEnergy) {
  const Grid grid{32, 21, 2e-5, 2e-5};
  const auto elasticity = make(grid);
  for (int k = 0; k < 5; ++k) {
    Field pressure = Field::Random(21, 32);
    pressure -= pressure.mean();
    EXPECT_GT((pressure * applied(*elasticity, pressure)).sum(), 0);
  }
}

TEST_P(BothHalfSpaces, CommuteWithTransposition) {
  const Grid grid{28, 15, 2e-5, 3e-5};
  const Grid transposed{15, 28, 3e-5, 2e-5};
  const Field pressure = Field::Random(15, 28);
  const Field direct = applied(*make(grid), pressure);
  const Field other = applied(*make(transposed), pressure.transpose());
  EXPECT_LE((direct - other.transpose()).abs().maxCoeff(), 1e-12 * direct.abs().maxCoeff());
}

TEST_P(BothHalfSpaces, DoNotDependOnTheUnitOfLength) {
  const Grid metres{16, 16, 1e-5, 1e-5};
  const Grid nanometres{16, 16, 1e4, 1e4};
  const Field pressure = Field::Random(16, 16);
  const Field a = applied(*make(metres), pressure);
  const Field b = applied(*make(nanometres), pressure);
  EXPECT_LE((a * 1e9 - b).abs().maxCoeff(), 1e-12 * b.abs().maxCoeff());
}

TEST_P(BothHalfSpaces, AgreeInSinglePrecision) {
  const Grid grid{64, 48, 2e-5, 2e-5};
  const auto elasticity = make(grid);
  const Field pressure = 1e8 * Field::Random(48, 64);
  FieldF single;
  elasticity->apply(FieldF(pressure.cast<float>()), single);
  const Field expected = applied(*elasticity, pressure);
  EXPECT_LE((single.cast<double>() - expected).abs().maxCoeff(), 2e-6 * expected.abs().maxCoeff());
}

TEST_P(BothHalfSpaces, RejectModuliThatMakeNoSense) {
  const Grid grid{8, 8, 1e-5, 1e-5};
  EXPECT_THROW(make(grid, 0), InputError);
  EXPECT_THROW(make(grid, -1e9), InputError);
  EXPECT_THROW(make(grid, std::nan("")), InputError);
}

INSTANTIATE_TEST_SUITE_P(PeriodicAndFree, BothHalfSpaces, testing::Bool());

TEST(PeriodicHalfSpace, CommutesWithTranslation) {
  const Grid grid{24, 18, 2e-5, 2e-5};
  const auto elasticity = make_periodic(grid, kModulus);
  const Field pressure = Field::Random(18, 24);
  const auto shifted = [](const Field& field) {
    Field result(field.rows(), field.cols());
    for (Index y = 0; y < field.rows(); ++y) {
      for (Index x = 0; x < field.cols(); ++x) {
        result((y + 5) % field.rows(), (x + 7) % field.cols()) = field(y, x);
      }
    }
    return result;
  };
  const Field expected = shifted(applied(*elasticity, pressure));
  EXPECT_LE((applied(*elasticity, shifted(pressure)) - expected).abs().maxCoeff(),
            1e-12 * expected.abs().maxCoeff());
}

TEST(MirroredHalfSpace, IsThePeriodicOneOfItsImages) {
  for (const auto& [ny, nx] : {std::pair<Index, Index>{12, 20}, {9, 7}, {1, 5}}) {
    const Grid whole{2 * nx, 2 * ny, 3e-6, 2e-6};
    const auto periodic = make_periodic(whole, kModulus);
    ElasticOperator* const mirrored = periodic->of_image();
    ASSERT_NE(mirrored, nullptr);
    EXPECT_EQ(mirrored->border(), Border::mirrors);
    EXPECT_EQ(mirrored->of_image(), nullptr);
    const Field image = Field::Random(ny, nx);
    const Field expected = applied(*periodic, mirror_images(image));
    const double most = expected.abs().maxCoeff();
    EXPECT_LE((mirror_images(applied(*mirrored, image)) - expected).abs().maxCoeff(), 1e-13 * most);

    FieldF single;
    mirrored->apply(image.cast<float>().eval(), single);
    EXPECT_LE((mirror_images<Field>(single.cast<double>()) - expected).abs().maxCoeff(),
              1e-5 * most);

    Field back;
    ASSERT_TRUE(mirrored->apply_inverse(expected.topLeftCorner(ny, nx), back));
    EXPECT_LE((back - (image - image.mean())).abs().maxCoeff(), 1e-12);
  }
}

TEST(MirroredHalfSpace, LiesOnGridsOfTheSameExtent) {
  const Grid grid{24, 16, 3e-6, 2e-6};
  const auto coarse = make_mirrored(grid, kModulus)->on_grid({12, 8, 3e-6, 2e-6});
  const Field image = Field::Random(8, 12);
  const Field expected =
      applied(*make_periodic({24, 16, 6e-6, 4e-6}, kModulus), mirror_images(image));
  EXPECT_LE((mirror_images(applied(*coarse, image)) - expected).abs().maxCoeff(),
            1e-13 * expected.abs().maxCoeff());
}

TEST(MirroredHalfSpace, IsOnlyThereWhereImagesCanBe) {
  EXPECT_EQ(make_periodic({5, 4, 1e-6, 1e-6}, kModulus)->of_image(), nullptr);
  EXPECT_EQ(make_free({4, 4, 1e-6, 1e-6}, kModulus)->of_image(), nullptr);
}

TEST(MirroredHalfSpace, CountsItsTransformsAsThoseOfThePeriodicOne) {
  const auto periodic = make_periodic({64, 64, 1e-6, 1e-6}, kModulus);
  ASSERT_EQ(periodic->fft_seconds(), 0);
  applied(*periodic->of_image(), Field::Random(32, 32));
  EXPECT_GT(periodic->fft_seconds(), 0);
  EXPECT_EQ(periodic->fft_seconds(), periodic->of_image()->fft_seconds());
}

TEST(FreeHalfSpace, IsTheDirectSumOfLovesCoefficients) {
  const Grid grid{9, 6, 9e-6, 8e-6};
  const Field pressure = Field::Random(6, 9);
  const Field result = applied(*make_free(grid, kModulus), pressure);
  for (Index y = 0; y < 6; ++y) {
    for (Index x = 0; x < 9; ++x) {
      double expected = 0;
      for (Index j = 0; j < 6; ++j) {
        for (Index i = 0; i < 9; ++i) {
          expected += pressure(j, i) * love_coefficient(static_cast<double>(x - i) * grid.dx(),
                                                        static_cast<double>(y - j) * grid.dy(),
                                                        grid.dx(), grid.dy(), kModulus);
        }
      }
      EXPECT_NEAR(result(y, x), expected, 1e-13 * result.abs().maxCoeff());
    }
  }
}

// Johnson 1985, eq. 3.27: centre and corner of a uniformly loaded square of side s.
TEST(FreeHalfSpace, LoveSquareHasItsKnownCentreAndCorner) {
  const double side = 3e-6;
  const double corner =
      2 / (std::numbers::pi * kModulus) * side * std::log(1 + std::numbers::sqrt2);
  const double centre_error = love_coefficient(0, 0, side, side, kModulus) / (2 * corner) - 1;
  const double corner_error =
      love_coefficient(side / 2, side / 2, side, side, kModulus) / corner - 1;
  test::expect_within("Elastic operator", "Love patch", "centre and corner, relative",
                      "Johnson 1985, 3.27",
                      test::worse(std::abs(centre_error), std::abs(corner_error)), 1e-14);
}

TEST(FreeHalfSpace, KeepsTheMeanThatAPeriodicOneDrops) {
  const Grid grid{4, 4, 1e-6, 1e-6};
  EXPECT_TRUE(make_periodic(grid, kModulus)->drops_mean());
  EXPECT_FALSE(make_free(grid, kModulus)->drops_mean());
}

TEST(FreeHalfSpace, IsAPointLoadFarAway) {
  const double far = 1e-3;
  const double expected = 1e-12 / (std::numbers::pi * kModulus * far);  // Boussinesq
  EXPECT_NEAR(love_coefficient(far, 0, 1e-6, 1e-6, kModulus) / expected, 1, 1e-6);
}

}  // namespace
}  // namespace tabor::elastic
