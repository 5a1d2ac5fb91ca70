#include "tabor/topography/levelling.hpp"

#include <gmock/gmock.h>

#include <array>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

const Grid kGrid{61, 47, 61e-6, 30e-6};

double polynomial(double x, double y, int degree) {
  double sum = 0;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; i + j <= degree; ++j) {
      sum += (1 + i - 2 * j) * std::pow(x / 60e-6, i) * std::pow(y / 60e-6, j);
    }
  }
  return 1e-6 * sum;
}

TEST(LevelPlane, RemovesAnExactPlane) {
  const auto tilted = surface(kGrid, [](double x, double y) { return 1e-3 + 0.2 * x - 0.7 * y; });
  EXPECT_LT(level(tilted, Form::plane).height.abs().maxCoeff(), 1e-18);
}

TEST(FitForm, KnowsTheTiltOfAPlane) {
  const auto tilted = surface(kGrid, [](double x, double y) { return 1e-3 + 0.2 * x - 0.7 * y; });
  for (const int degree : {1, 3}) {
    const auto [along_x, along_y] = tilt_of(fit_form(tilted.height, degree), kGrid);
    EXPECT_NEAR(along_x, 0.2, 1e-12) << degree;
    EXPECT_NEAR(along_y, -0.7, 1e-12) << degree;
  }
}

TEST(LevelMean, LeavesTheTilt) {
  const auto tilted = surface(kGrid, [](double x, double) { return 1e-3 + 0.2 * x; });
  const auto levelled = level(tilted, Form::mean);
  EXPECT_NEAR(levelled.height.mean(), 0, 1e-18);
  EXPECT_NEAR(levelled.height(0, 60) - levelled.height(0, 0), 0.2 * 60e-6, 1e-16);
}

TEST(LevelNone, LeavesTheHeights) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(same_bits(level(rough, Form::none).height, rough.height));
}

TEST(LevelPlane, FitsALineToOneRowOrColumn) {
  for (const Grid& grid : {Grid{61, 1, 61e-6, 1e-6}, Grid{1, 47, 1e-6, 47e-6}}) {
    const auto tilted = surface(grid, [](double x, double y) { return 1e-3 + 0.2 * x - 0.7 * y; });
    EXPECT_LT(level(tilted, Form::plane).height.abs().maxCoeff(), 1e-18);
    const auto bent = surface(grid, [](double x, double y) { return x * x + y * y; });
    EXPECT_LT(level(bent, Form::poly4).height.abs().maxCoeff(), 1e-18);
  }
  EXPECT_FALSE(try_fit_form(Field::Constant(1, 7, kHole), 1).has_value());
}

class LevelPolynomial : public testing::TestWithParam<int> {};

TEST_P(LevelPolynomial, RemovesAnExactPolynomialOfItsTotalDegree) {
  const int degree = GetParam();
  auto form = surface(kGrid, [&](double x, double y) { return polynomial(x, y, degree); });
  const Field whole = remove_form(form.height, fit_form(form.height, degree));
  EXPECT_LT(whole.abs().maxCoeff(), 1e-19);
  punch_holes(form, 0.3);
  const Field with_holes = remove_form(form.height, fit_form(form.height, degree));
  EXPECT_LT(with_holes.maxCoeff<Eigen::PropagateNumbers>(), 1e-19);
  EXPECT_GT(with_holes.minCoeff<Eigen::PropagateNumbers>(), -1e-19);
}

TEST_P(LevelPolynomial, LeavesAHigherDegree) {
  const int degree = GetParam();
  const auto form =
      surface(kGrid, [&](double x, double y) { return polynomial(x, y, degree + 1); });
  EXPECT_GT(remove_form(form.height, fit_form(form.height, degree)).abs().maxCoeff(), 1e-8);
}

TEST_P(LevelPolynomial, TheRestHasTheHeightItHadAsAField) {
  auto rough = noise(kGrid);
  punch_holes(rough, 0.2);
  const auto fit = fit_form(rough.height, GetParam());
  const double before = metrology::rms_height(rough);
  rough.height = remove_form(rough.height, fit);
  const double after = metrology::rms_height(rough);
  rough = noise(kGrid);
  punch_holes(rough, 0.2);
  EXPECT_LT(after, before);
  EXPECT_NEAR(rms_without_form(rough.height, fit), after, 1e-12 * after);
}

TEST(LevelPlane, TheHeightOfTheRestIsAboutItsMeanWhateverFormIsTaken) {
  const auto rough = noise(kGrid);
  const double height = metrology::rms_height(level(rough, Form::mean));
  FormFit elsewhere = fit_form(rough.height, 0);
  elsewhere.coefficients[0] += 3 * height;
  EXPECT_NEAR(rms_without_form(rough.height, elsewhere), height, 1e-10 * height);
}

INSTANTIATE_TEST_SUITE_P(Degrees, LevelPolynomial, testing::Values(1, 2, 3, 4));

TEST(LevelPlane, FindsTheTiltFromTheValidPointsOfOneHalf) {
  auto tilted = surface(kGrid, [](double x, double y) { return 2e-6 + 0.2 * x - 0.7 * y; });
  tilted.height.rightCols(40) = kHole;
  const auto fit = fit_form(tilted.height, 1);
  EXPECT_EQ(fit.n_valid, 21 * 47);
  EXPECT_NEAR(2 * fit.coefficients[1] / kGrid.lx, 0.2, 1e-12);
  EXPECT_NEAR(2 * fit.coefficients[2] / kGrid.ly, -0.7, 1e-12);
}

TEST(LevelPlane, KeepsAPicometreUnderAMillimetre) {
  const auto tilted = surface(kGrid, [](double x, double y) {
    return 1e-3 + x + 1e-12 * std::cos(2 * pi * 5 * x / kGrid.lx) + 0 * y;
  });
  EXPECT_NEAR(metrology::rms_height(level(tilted, Form::plane)), 1e-12 / std::numbers::sqrt2,
              2e-14);
}

TEST(LevelPlane, LeavesAResidualOrthogonalToThePlane) {
  const auto levelled = level(noise(kGrid), Form::plane);
  double with_x = 0, with_y = 0;
  for (Index y = 0; y < kGrid.ny; ++y) {
    for (Index x = 0; x < kGrid.nx; ++x) {
      with_x += levelled.height(y, x) * static_cast<double>(x);
      with_y += levelled.height(y, x) * static_cast<double>(y);
    }
  }
  EXPECT_NEAR(levelled.height.sum(), 0, 1e-16);
  EXPECT_NEAR(with_x, 0, 1e-14);
  EXPECT_NEAR(with_y, 0, 1e-14);
}

TEST(Level, ChangesNothingASecondTime) {
  const auto once = level(noise(kGrid), Form::poly3);
  EXPECT_LT(largest_difference(level(once, Form::poly3).height, once.height), 1e-20);
}

TEST(Level, CommutesWithUnitsAndTransposition) {
  auto rough = noise(kGrid);
  punch_holes(rough, 0.2);
  const Field levelled = level(rough, Form::poly2).height;
  auto scaled = rough;
  scaled.height *= 1e9;
  EXPECT_LT(largest_difference(level(scaled, Form::poly2).height, 1e9 * levelled), 1e-11);
  EXPECT_LT(largest_difference(level(transpose(rough), Form::poly2).height, levelled.transpose()),
            1e-19);
}

TEST(Level, DoesNotSeeWhatIsInAHole) {
  auto rough = noise(kGrid);
  rough.height(20, 20) = kHole;
  const Field expected = level(rough, Form::poly2).height;
  EXPECT_TRUE(std::isnan(expected(20, 20)));
  EXPECT_EQ(expected.isNaN().count(), 1);
}

TEST(Level, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto rough = noise({300, 200, 1e-3, 1e-3});
  expect_same_bits_on_any_threads([&] { return level(rough, Form::poly4).height; });
}

TEST(LevelPlane, EndsPeriodicityButTheMeanDoesNot) {
  auto rough = noise(kGrid);
  rough.periodic = true;
  EXPECT_TRUE(level(rough, Form::mean).periodic);
  EXPECT_FALSE(level(rough, Form::plane).periodic);
}

TEST(Level, WritesItsNumbersIntoTheHistory) {
  const auto tilted = surface(kGrid, [](double x, double y) { return 0.25 * x - 0.5 * y; });
  EXPECT_THAT(level(tilted, Form::plane).history.back(),
              testing::AllOf(testing::StartsWith("level=plane: 2867 valid points"),
                             testing::HasSubstr("tilt x 0.25, y -0.5")));
}

TEST(LevelMean, WritesTheMeanAndTakesASinglePoint) {
  auto point = surface(kGrid, [](double, double) { return kHole; });
  point.height(3, 4) = 2.5e-6;
  const auto levelled = level(point, Form::mean);
  EXPECT_NEAR(levelled.height(3, 4), 0, 1e-20);
  EXPECT_THAT(levelled.history.back(), testing::HasSubstr("1 valid points, mean 2.5 µm"));
}

// P_2 = (3 u^2 - 1) / 2, u = -1 and 1 at the outer edges of the outer pixels.
TEST(FitForm, HasTheCoefficientsOfLegendresPolynomials) {
  Field height(30, 20);
  for (Index y = 0; y < 30; ++y) {
    for (Index x = 0; x < 20; ++x) {
      const double u = (2 * static_cast<double>(x) + 1) / 20 - 1;
      const double v = (2 * static_cast<double>(y) + 1) / 30 - 1;
      height(y, x) = 5 + 2 * u - 3 * v + 0.5 * (3 * u * u - 1) / 2 + 0.25 * u * v;
    }
  }
  const auto fit = fit_form(height, 2);
  const std::array expected{5.0, 2.0, -3.0, 0.5, 0.25, 0.0};
  for (std::size_t t = 0; t < expected.size(); ++t) {
    EXPECT_NEAR(fit.coefficients[t], expected[t], 1e-13) << t;
  }
}

TEST(Level, RejectsPointsThatDoNotDetermineTheForm) {
  auto rough = noise(kGrid);
  const Field column = rough.height.col(3);
  rough.height = kHole;
  EXPECT_THROW(level(rough, Form::mean), InputError);  // holes only
  rough.height.col(3) = column;                        // one line
  EXPECT_NO_THROW(level(rough, Form::mean));
  EXPECT_THROW(level(rough, Form::plane), InputError);
  rough.height.col(40) = column;  // two parallel lines determine a plane, not a parabola
  EXPECT_NO_THROW(level(rough, Form::plane));
  EXPECT_THROW(level(rough, Form::poly2), InputError);
}

}  // namespace
}  // namespace tabor::topography::test
