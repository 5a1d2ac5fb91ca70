#include "tabor/comparison/combine.hpp"

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "support/rough_recipe.hpp"
#include "support/sample_surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/comparison/robust_fit.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"

namespace tabor::comparison::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

constexpr double kPixel = 1e-6;

topography::Topography self_affine_surface(Index n, double hurst, double cutoff,
                                           std::uint64_t seed) {
  synthesis::SelfAffine recipe = rough_recipe(n, hurst, seed);
  recipe.short_cutoff_wavelength = cutoff;
  return synthesis::self_affine(recipe);
}

void add_noise(topography::Topography& surface, double rms, std::uint64_t seed) {
  const CounterRandom random(seed);
  for (Index i = 0; i < surface.height.size(); ++i) {
    surface.height.data()[i] += rms * random.normal(static_cast<std::uint64_t>(i));
  }
}

/// Two scans of n * n pixels of one large surface: what is at x in the first is at x + shift in the
/// second. The surface has no waves below 4 pixels, so that splines between pixels are good.
struct Pair {
  topography::Topography a;
  topography::Topography b;
};

Pair scans_of(const topography::Topography& large, Index n, double shift_x, double shift_y,
              double step = 1) {
  const double origin = 60;  // pixels
  const auto cut = [&](double x0, double y0, double pitch) {
    const auto count = static_cast<Index>(static_cast<double>(n) / pitch);
    topography::Topography part;
    part.grid = {count, count, static_cast<double>(count) * pitch * kPixel,
                 static_cast<double>(count) * pitch * kPixel};
    part.height =
        topography::Interpolant(large.height)
            .at({x0 + 0.5 * pitch - 0.5, y0 + 0.5 * pitch - 0.5, pitch, pitch, count, count});
    return part;
  };
  return {cut(origin, origin, 1), cut(origin - shift_x / kPixel, origin - shift_y / kPixel, step)};
}

struct Case {
  double hurst;
  double shift_x;  ///< pixels
  double shift_y;
  double noise;  ///< of the rms height
};

class SubPixelShift : public testing::TestWithParam<Case> {};

TEST_P(SubPixelShift, IsRecovered) {
  const Case c = GetParam();
  const auto large = self_affine_surface(400, c.hurst, 4e-6, 11);
  auto [a, b] = scans_of(large, 256, c.shift_x * kPixel, c.shift_y * kPixel);
  add_noise(a, c.noise * 1e-6, 5);
  add_noise(b, c.noise * 1e-6, 6);
  const auto found = register_scans(a, b);
  const double error =
      std::hypot(found.shift_x - c.shift_x * kPixel, found.shift_y - c.shift_y * kPixel) / kPixel;
  tabor::test::expect_within(
      "Two scans",
      fmt::format("H {}, shift {}, {} pixels, noise {} Sq", c.hurst, c.shift_x, c.shift_y, c.noise),
      "shift [pixels]", "shift that was made", error, 0.02);
  EXPECT_GT(found.correlation, 0.9);
  EXPECT_LT(found.uncertainty_x, 0.02 * kPixel);
  EXPECT_GE(found.iterations, 2);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SubPixelShift,
                         testing::Values(Case{0.8, 0.25, -0.4, 0}, Case{0.8, 12.37, 7.81, 0.02},
                                         Case{0.3, -33.5, 20.13, 0.05}, Case{1.0, 3.3, -41.7, 0.01},
                                         Case{0.5, 0, 0, 0.1}, Case{0.6, -55.25, -48.6, 0.02}));

TEST(Registration, HasAnUncertaintyThatCoversItsErrors) {  // slow
  const auto large = self_affine_surface(240, 0.7, 10e-6, 3);
  double squares = 0;
  constexpr int n = 8;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    auto [a, b] = scans_of(large, 128, 2.6 * kPixel, -1.3 * kPixel);
    add_noise(a, 0.1e-6, 2 * seed);
    add_noise(b, 0.1e-6, 2 * seed + 1);
    const auto found = register_scans(a, b);
    squares += std::pow((found.shift_x - 2.6 * kPixel) / found.uncertainty_x, 2) +
               std::pow((found.shift_y + 1.3 * kPixel) / found.uncertainty_y, 2);
  }
  // Chi square of 16 over 16 lies between these but twice in 1000 times.
  EXPECT_GT(squares / (2 * n), 0.24);
  EXPECT_LT(squares / (2 * n), 2.46);
}

TEST(Registration, IsNotMisledByHolesTiltAndAPit) {
  const auto large = self_affine_surface(400, 0.8, 4e-6, 8);
  auto [a, b] = scans_of(large, 256, 9.4 * kPixel, -5.7 * kPixel);
  for (Index y = 0; y < 256; ++y) {
    for (Index x = 0; x < 256; ++x) {
      const double r = std::hypot(static_cast<double>(x - 150), static_cast<double>(y - 100));
      b.height(y, x) += 2e-6 + 1e-9 * static_cast<double>(x) - (r < 40 ? 3e-6 : 0);
    }
  }
  punch_holes(a, 0.02, 3);
  punch_holes(b, 0.02, 4);
  const auto found = register_scans(a, b);
  EXPECT_NEAR(found.shift_x / kPixel, 9.4, 0.02);
  EXPECT_NEAR(found.shift_y / kPixel, -5.7, 0.02);
}

TEST(Registration, WorksAcrossPixelSizes) {  // slow
  const auto large = self_affine_surface(400, 0.9, 12e-6, 21);
  for (const double step : {0.8, 1.3, 2.5}) {
    const auto [a, b] = scans_of(large, 256, 14.3 * kPixel, 6.2 * kPixel, step);
    const auto found = register_scans(a, b);
    EXPECT_NEAR(found.shift_x / kPixel, 14.3, 0.02) << step;
    EXPECT_NEAR(found.shift_y / kPixel, 6.2, 0.02) << step;
  }
}

TEST(Registration, OfAScanWithItselfIsNothing) {
  const auto rough = self_affine_surface(128, 0.8, 4e-6, 1);
  const auto found = register_scans(rough, rough);
  EXPECT_NEAR(found.shift_x, 0, 1e-6 * kPixel);
  EXPECT_NEAR(found.shift_y, 0, 1e-6 * kPixel);
  EXPECT_NEAR(found.correlation, 1, 1e-12);
  EXPECT_NEAR(found.overlap, 1, 1e-12);
}

TEST(Registration, RejectsOtherPlaces) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto a = self_affine_surface(192, 0.8, 4e-6, seed);
    const auto b = self_affine_surface(192, 0.8, 4e-6, seed + 100);
    EXPECT_THAT(tabor::test::rejection([&] { register_scans(a, b); }), HasSubstr("<no_register>"))
        << seed;
  }
}

TEST(Registration, RejectsPiecesThatDoNotOverlap) {
  const auto large = self_affine_surface(512, 0.8, 4e-6, 2);
  const auto a = topography::crop(large, {0, 0, 200, 200});
  const auto b = topography::crop(large, {300, 300, 200, 200});
  EXPECT_THAT(tabor::test::rejection([&] { register_scans(a, b); }), HasSubstr("registration"));
}

TEST(Registration, RejectsScansOfAFewPixels) {
  const auto small = noise({10, 10, 1e-5, 1e-5});
  EXPECT_THAT(tabor::test::rejection([&] { register_scans(small, small); }),
              HasSubstr("16 common pixels"));
}

TEST(Registration, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto large = self_affine_surface(256, 0.8, 4e-6, 2);
  const auto scans = scans_of(large, 150, 3.3 * kPixel, 2.2 * kPixel);
  expect_same_bits_on_any_threads([&] {
    const auto found = register_scans(scans.a, scans.b);
    return Field{{found.shift_x, found.shift_y, found.uncertainty_x, found.correlation}};
  });
}

/// A spherical cap of the given depth and radius [m] is gone around (x, y).
double carve(topography::Topography& surface, double x, double y, double radius, double depth) {
  double volume = 0;
  const Grid& grid = surface.grid;
  for (Index j = 0; j < grid.ny; ++j) {
    for (Index i = 0; i < grid.nx; ++i) {
      const double r = std::hypot((static_cast<double>(i) + 0.5) * grid.dx() - x,
                                  (static_cast<double>(j) + 0.5) * grid.dy() - y);
      const double loss = r < radius ? depth * (1 - r * r / (radius * radius)) : 0;
      surface.height(j, i) -= loss;
      volume += loss * grid.pixel_area();
    }
  }
  return volume;
}

TEST(WearVolume, OfACarvedPitIsRecovered) {
  const auto large = self_affine_surface(400, 0.8, 4e-6, 8);
  auto [a, b] = scans_of(large, 256, 9.4 * kPixel, -5.7 * kPixel);
  const double pit = carve(b, 150e-6, 110e-6, 40e-6, 2e-6);
  const double pile = -carve(b, 70e-6, 180e-6, 15e-6, -0.8e-6);
  for (Index i = 0; i < b.height.size(); ++i) {
    b.height.data()[i] += 4e-6 + 2e-9 * static_cast<double>(i % 256);  // levelled otherwise
  }
  add_noise(a, 0.02e-6, 1);
  add_noise(b, 0.02e-6, 2);
  const auto result = combine(a, b);
  ASSERT_TRUE(result.wear);
  tabor::test::expect_within("Two scans", "carved pit", "worn volume, relative", "volume carved",
                             std::abs(result.wear->worn.value / pit - 1), 1e-3);
  // Not a bound on the relative error alone: noise of 0.028 um on each of 707 pixels is 0.27 % of
  // this volume, so that a smaller error is a matter of the seed.
  EXPECT_LT(result.wear->piled_up.uncertainty, 0.003 * pile);
  tabor::test::expect_within(
      "Two scans", "pile", "piled-up volume, in standard deviations", "volume piled up",
      std::abs(result.wear->piled_up.value - pile) / result.wear->piled_up.uncertainty, 2);
  EXPECT_NEAR(result.wear->net.value / (pit - pile), 1, 0.03);
  EXPECT_LT(std::abs(result.wear->worn.value - pit),
            4 * result.wear->worn.uncertainty + 0.02 * pit);
  EXPECT_GT(result.wear->worn.uncertainty, 0);
  EXPECT_LT(result.wear->noise_floor, 0.01 * pit);
  EXPECT_NEAR(result.wear->noise, 0.028e-6, 0.006e-6);  // two noises
}

struct Scar {
  double depth;  ///< [m]
  double width;  ///< standard deviation of its Gaussian [pixels]
};

class GaussianScar : public testing::TestWithParam<Scar> {};

/// Much of a scar without an edge is shallower than the noise of a pixel.
TEST_P(GaussianScar, HasItsVolumeWithItsRim) {  // slow
  const auto [depth, width] = GetParam();
  const auto rough = self_affine_surface(192, 0.8, 5e-6, 8);
  double sum = 0, squares = 0;
  constexpr int n = 16;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    auto before = rough, after = rough;
    double volume = 0;
    for (Index y = 0; y < 192; ++y) {
      for (Index x = 0; x < 192; ++x) {
        const double r = std::hypot(static_cast<double>(x - 100), static_cast<double>(y - 90));
        const double loss = depth * std::exp(-r * r / (2 * width * width));
        after.height(y, x) -=
            loss + 1e-6 + 1e-9 * static_cast<double>(x - y);  // and levelled otherwise
        volume += loss * kPixel * kPixel;
      }
    }
    add_noise(before, 3.5e-9, 2 * seed);
    add_noise(after, 3.5e-9, 2 * seed + 1);
    CombineOptions options;
    options.search = false;
    const auto wear = combine(before, after, options).wear;
    const double z = (wear->worn.value - volume) / wear->worn.uncertainty;
    sum += z;
    squares += z * z;
    EXPECT_LT(wear->worn.uncertainty, 0.05 * volume);
  }
  EXPECT_LE(std::abs(sum / n), 1);
  EXPECT_LT(squares / n, 3);
  EXPECT_GT(squares / n, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Scars, GaussianScar,
                         testing::Values(Scar{20e-9, 15}, Scar{100e-9, 15}, Scar{300e-9, 15},
                                         Scar{20e-9, 25}, Scar{100e-9, 25}, Scar{300e-9, 25}));

TEST(WearVolume, OfNothingIsWithinItsUncertainty) {
  double squares = 0;
  constexpr int n = 20;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    auto flat = surface({128, 96, 128e-6, 96e-6}, [](double, double) { return 0; });
    add_noise(flat, 1e-9, seed);
    const Field loss = remove_plane(flat.height, fit_robust_plane(flat.height));
    const auto volumes = wear_volumes(loss, flat.grid);
    squares += std::pow(volumes.net.value / volumes.net.uncertainty, 2);
    EXPECT_LT(volumes.worn.value, 5 * volumes.noise_floor + 1e-9 * 20 * flat.grid.pixel_area());
    EXPECT_NEAR(volumes.noise / 1e-9, 1, 0.05);
    EXPECT_NEAR(volumes.noise_area / flat.grid.pixel_area(), 1, 0.5);
  }
  EXPECT_LT(squares / n, 2);
}

/// A rough surface before and after a pit of 200 nm, to the left of the middle.
struct Pit {
  topography::Topography before = self_affine_surface(96, 0.8, 1e-6, 3);
  topography::Topography after = before;
  double volume;

  explicit Pit(Index width) : volume(static_cast<double>(80 * width) * kPixel * kPixel * 200e-9) {
    after.height.block(8, 4, 80, width) -= 200e-9;
  }
};

TEST(WearVolume, ItsNetScattersAsItSaysWhateverIsMatched) {
  for (const LevelMatch level : {LevelMatch::none, LevelMatch::offset, LevelMatch::plane}) {
    double squares = 0;
    constexpr int n = 24;
    for (std::uint64_t seed = 1; seed <= n; ++seed) {
      Pit pit(seed % 2 == 0 ? 5 : 35);
      add_noise(pit.before, 5e-9, 2 * seed);
      add_noise(pit.after, 5e-9, 2 * seed + 1);
      CombineOptions options;
      options.search = false;
      options.level = level;
      const auto net = combine(pit.before, pit.after, options).wear->net;
      squares += std::pow((net.value - pit.volume) / net.uncertainty, 2);
    }
    EXPECT_LT(squares / n, 2) << name_of(level);
    EXPECT_GT(squares / n, 0.4) << name_of(level);
  }
}

TEST(WearVolume, DoesNotCountTheRoundingOfHeights) {
  Pit pit(20);
  for (topography::Topography* each : {&pit.before, &pit.after}) {
    each->height += 3e-7;  // other last digits
    each->height = each->height.cast<float>().cast<double>();
  }
  CombineOptions options;
  options.search = false;
  const auto wear = combine(pit.before, pit.after, options).wear;
  EXPECT_NEAR(wear->worn.value / pit.volume, 1, 1e-4);
  EXPECT_LE(wear->worn.area, 88 * 28 * kPixel * kPixel);  // smoothed, it has a rim
  EXPECT_EQ(wear->piled_up.area, 0);
}

TEST(RobustPlane, RestsOnWhatIsExactlyEqual) {
  auto loss = surface({60, 50, 60e-6, 50e-6}, [](double, double) { return 0; });
  loss.height.block(10, 5, 20, 36) += 1e-6;  // 24 % of the map
  const auto plane = fit_robust_plane(loss.height);
  EXPECT_NEAR(plane.offset, 0, 1e-12);
  EXPECT_NEAR(plane.tilt_x, 0, 1e-12);
  EXPECT_NEAR(plane.spread, 0, 1e-12);
}

TEST(WearVolume, CountsKnownBlocks) {
  auto loss = surface({100, 80, 200e-6, 80e-6}, [](double, double) { return 0; });
  add_noise(loss, 1e-9, 4);
  loss.height.block(20, 30, 20, 25) += 1e-6;
  loss.height.block(60, 70, 10, 10) -= 0.5e-6;
  const auto volumes = wear_volumes(loss.height, loss.grid);
  EXPECT_NEAR(volumes.worn.value / (500 * 2e-12 * 1e-6), 1, 0.005);
  EXPECT_NEAR(volumes.piled_up.value / (100 * 2e-12 * 0.5e-6), 1, 0.01);
}

TEST(WearVolume, RejectsAThresholdThatIsNone) {
  const auto rough = noise({32, 32, 1e-3, 1e-3});
  EXPECT_THAT(
      tabor::test::rejection([&] { wear_volumes(rough.height, rough.grid, {.threshold = 0}); }),
      HasSubstr("threshold"));
}

TEST(Combine, OfOneScanWithItselfIsZero) {
  const auto rough = self_affine_surface(96, 0.8, 4e-6, 1);
  CombineOptions options;
  options.mode = CombineMode::difference;
  options.search = false;
  const auto result = combine(rough, rough, options);
  EXPECT_LT(result.map.height.abs().maxCoeff(), 1e-18);
  EXPECT_EQ(result.map.grid, rough.grid);
  EXPECT_NEAR(result.correlation, 1, 1e-12);
}

/// What registration finds for two scans in register is zero but for rounding, or noise.
TEST(Combine, KeepsAllRowsOfScansInRegister) {
  auto rough = self_affine_surface(128, 0.8, 4e-6, 1);
  rough.periodic = false;
  auto other = rough;
  for (const double noise : {0.0, 5e-9, 20e-9}) {
    add_noise(other, noise, 3);
    const auto result = combine(rough, other);
    ASSERT_TRUE(result.registration);
    EXPECT_EQ(result.map.grid, rough.grid) << noise;
    EXPECT_EQ(result.n_common, 128 * 128) << noise;
  }
}

TEST(Combine, KeepsATiltThatIsAskedFor) {
  const auto flat = surface({64, 48, 64e-6, 48e-6}, [](double, double) { return 0; });
  const auto tilted = surface(flat.grid, [](double x, double) { return -3e-6 - 0.01 * x; });
  CombineOptions options{.mode = CombineMode::difference, .search = false};
  options.level = LevelMatch::none;
  EXPECT_NEAR(combine(flat, tilted, options).map.height.mean(), 3e-6 + 0.32e-6, 1e-12);
  options.level = LevelMatch::offset;
  const auto centred = combine(flat, tilted, options);
  EXPECT_NEAR(centred.map.height.mean(), 0, 1e-12);
  EXPECT_NEAR(centred.map.height(0, 63), 0.01 * 31.5e-6, 1e-12);
  options.level = LevelMatch::plane;
  EXPECT_LT(combine(flat, tilted, options).map.height.abs().maxCoeff(), 1e-15);
}

TEST(Combine, CutsToTheOverlapOfAGivenShift) {
  const auto rough = self_affine_surface(96, 0.8, 4e-6, 1);
  CombineOptions options{.mode = CombineMode::difference, .search = true};
  options.shift_x = 10 * kPixel;
  options.shift_y = -4 * kPixel;
  options.level = LevelMatch::none;
  const auto result = combine(rough, rough, options);
  EXPECT_FALSE(result.registration);
  EXPECT_EQ(result.map.grid.nx, 86);
  EXPECT_EQ(result.map.grid.ny, 92);
  EXPECT_NEAR(result.map.height(0, 0), rough.height(4, 0) - rough.height(0, 10), 1e-15);
  options.shift_x = 1e-3;
  EXPECT_THAT(tabor::test::rejection([&] { combine(rough, rough, options); }),
              HasSubstr("scans that overlap"));
}

TEST(Combine, AddsTwoFacesTurnedTowardsEachOther) {
  const auto a = self_affine_surface(96, 0.8, 4e-6, 1), b = self_affine_surface(96, 0.6, 4e-6, 2);
  CombineOptions options;
  options.mode = CombineMode::composite;
  const auto result = combine(a, b, options);
  EXPECT_LT((result.map.height - a.height - b.height.rowwise().reverse()).abs().maxCoeff(), 1e-18);
  EXPECT_NEAR(result.rms_map,
              std::sqrt(result.rms_a * result.rms_a + result.rms_b * result.rms_b +
                        2 * result.correlation * result.rms_a * result.rms_b),
              1e-15);
  EXPECT_FALSE(result.wear);
}

TEST(Combine, TakesTheLargerPixels) {
  const auto large = self_affine_surface(400, 0.9, 12e-6, 21);
  const auto [fine, coarse] = scans_of(large, 256, 14.3 * kPixel, 6.2 * kPixel, 2.5);
  for (const auto& result : {combine(fine, coarse), combine(coarse, fine)}) {
    EXPECT_NEAR(result.map.grid.dx() / (2.5 * kPixel), 1, 1e-9);
    EXPECT_LT(result.rms_map, 0.02 * result.rms_a);
    EXPECT_NEAR(std::abs(result.shift_x) / kPixel, 14.3, 0.03);
  }
}

}  // namespace
}  // namespace tabor::comparison::test
