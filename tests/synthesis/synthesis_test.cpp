#include "tabor/synthesis/synthesis.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "support/rejection.hpp"
#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/metrology/spectra/psd.hpp"

namespace tabor::synthesis::test {

using namespace tabor::test;
namespace {

SelfAffine recipe_of(Index n = 128) {
  SelfAffine recipe;
  recipe.grid = {n, n, 128e-6, 128e-6};
  recipe.rms_height = 1e-6;
  return recipe;
}

double parameter(const topography::Topography& topography, const std::string& symbol) {
  for (const metrology::Parameter& p : metrology::parameters(topography)) {
    if (p.symbol == symbol) return p.value;
  }
  return kHole;
}

TEST(SelfAffine, HasExactlyTheRmsHeightAskedFor) {
  EXPECT_NEAR(metrology::rms_height(self_affine(recipe_of())) / 1e-6, 1, 1e-12);
  auto odd = recipe_of();
  odd.grid = {81, 120, 1e-4, 2e-4};
  odd.random_amplitudes = true;
  EXPECT_NEAR(metrology::rms_height(self_affine(odd)) / 1e-6, 1, 1e-12);
}

TEST(SelfAffine, HasExactlyTheSpectralRmsSlopeAskedFor) {
  auto recipe = recipe_of();
  recipe.rms_height.reset();
  recipe.rms_slope = 0.2;
  EXPECT_NEAR(metrology::power_spectra(self_affine(recipe)).rms_slope, 0.2, 1e-12);
}

TEST(SelfAffine, HasTheSamePointsAtTwiceTheResolution) {
  auto coarse = recipe_of(64), fine = recipe_of(128);
  coarse.short_cutoff_wavelength = fine.short_cutoff_wavelength = 8e-6;
  const Field a = self_affine(coarse).height, b = self_affine(fine).height;
  for (Index y = 0; y < 64; ++y) {
    for (Index x = 0; x < 64; ++x) {
      ASSERT_NEAR(a(y, x), b(2 * y, 2 * x), 1e-18);
    }
  }
}

TEST(SelfAffine, DependsOnTheSeedAndNotOnThreads) {
  auto recipe = recipe_of();
  recipe.random_amplitudes = true;
  expect_same_bits_on_any_threads([&] { return self_affine(recipe).height; });
  const Field first = self_affine(recipe).height;
  recipe.seed = 2;
  EXPECT_GT(largest_difference(self_affine(recipe).height, first), 1e-7);
}

TEST(SelfAffine, HasNoPowerOutsideItsCutoffs) {
  auto recipe = recipe_of();
  recipe.short_cutoff_wavelength = 8e-6;
  recipe.long_cutoff_wavelength = 32e-6;
  const auto spectrum = metrology::power_spectra(self_affine(recipe)).radial;
  double inside = 0, outside = 0;
  for (std::size_t i = 0; i < spectrum.q.size(); ++i) {
    const double wavelength = 2 * pi / spectrum.q[i];
    const bool within = wavelength > 9e-6 && wavelength < 28e-6;
    const bool beyond = wavelength < 7e-6 || wavelength > 40e-6;
    (within ? inside : beyond ? outside : inside) += spectrum.density[i];
  }
  EXPECT_GT(inside, 0);
  EXPECT_LT(outside, 1e-20 * inside);
}

TEST(SelfAffine, IsFlatBelowTheRollOff) {
  auto recipe = recipe_of();
  recipe.roll_off_wavelength = 16e-6;
  const auto spectrum = metrology::power_spectra(self_affine(recipe)).radial;
  EXPECT_NEAR(spectrum.density[1] / spectrum.density[5], 1, 1e-9);
  EXPECT_LT(spectrum.density[31], 0.02 * spectrum.density[5]);
}

TEST(SelfAffine, IsLongerAlongXWhenStretched) {
  auto recipe = recipe_of();
  recipe.stretch = 4;
  const auto spectra = metrology::power_spectra(self_affine(recipe));
  EXPECT_GT(spectra.y.rms_slope, 2 * spectra.x.rms_slope);
}

TEST(SelfAffine, IsPeriodicAndRecordsItsRecipe) {
  const auto surface = self_affine(recipe_of());
  EXPECT_TRUE(surface.periodic);
  EXPECT_THAT(surface.history.front(), testing::HasSubstr("H = 0.8"));
  EXPECT_THAT(surface.source, testing::HasSubstr("seed 1"));
}

TEST(SelfAffine, RejectsRecipesThatMakeNoSense) {
  auto recipe = recipe_of();
  recipe.rms_slope = 0.1;
  EXPECT_THROW(self_affine(recipe), InputError);  // two amplitudes
  recipe.rms_slope.reset();
  recipe.rms_height.reset();
  EXPECT_THROW(self_affine(recipe), InputError);  // none
  recipe = recipe_of();
  recipe.hurst = 1.5;
  EXPECT_THROW(self_affine(recipe), InputError);
  recipe = recipe_of();
  recipe.rms_height = -1e-6;
  EXPECT_THROW(self_affine(recipe), InputError);
  recipe = recipe_of();
  recipe.short_cutoff_wavelength = 1;  // longer than the scan
  EXPECT_THROW(self_affine(recipe), InputError);
  recipe = recipe_of();
  recipe.grid.lx = 0;
  EXPECT_THROW(self_affine(recipe), InputError);
}

Edt edt_recipe(Index n = 512, std::uint64_t seed = 1) {
  Edt recipe;
  const double side = static_cast<double>(n) * 0.67e-6;
  recipe.grid = {n, n, side, side};
  recipe.seed = seed;
  return recipe;
}

TEST(EdtSurface, HasTheSaOfTheSheet) {  // slow
  EXPECT_NEAR(parameter(edt(edt_recipe()), "Sa") / 0.9e-6, 1, 1e-12);
}

TEST(EdtSurface, FallsAsAPowerLawWithHBetween7And8Tenths) {  // slow
  // So few craters fit on 512 pixels that one sheet scatters by 0.06 about the mean.
  constexpr int kSeeds = 12;
  double along_x = 0, along_y = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto spectra = metrology::power_spectra(edt(edt_recipe(512, seed)));
    along_x += spectra.x.hurst.hurst / kSeeds;
    along_y += spectra.y.hurst.hurst / kSeeds;
    EXPECT_GT(spectra.x.hurst.q_max / spectra.x.hurst.q_min, 10);
  }
  for (const double hurst : {along_x, along_y}) {
    EXPECT_GT(hurst, 0.7);
    EXPECT_LT(hurst, 0.8);
  }
}

TEST(EdtSurface, HasPlateausAndPocketsAndALay) {  // slow
  const auto surface = edt(edt_recipe());
  EXPECT_LT(parameter(surface, "Ssk"), -0.2);
  const auto spectra = metrology::power_spectra(surface);
  EXPECT_GT(spectra.y.rms_slope, 1.05 * spectra.x.rms_slope);  // longer along x
}

TEST(EdtSurface, IsPeriodicOrNot) {
  auto recipe = edt_recipe(256);
  const auto tiled = edt(recipe);
  recipe.periodic = false;
  const auto cut = edt(recipe);
  EXPECT_TRUE(tiled.periodic);
  EXPECT_FALSE(cut.periodic);
  const auto seam = [](const Field& z) {
    return std::sqrt((z.col(0) - z.col(z.cols() - 1)).square().mean());
  };
  EXPECT_LT(seam(tiled.height), 0.3e-6);
  EXPECT_GT(seam(cut.height), 0.5e-6);
  EXPECT_NEAR(parameter(cut, "Sa") / 0.9e-6, 1, 1e-12);
}

TEST(EdtSurface, AfterSlidingHasFlatTopsWithGroovesAlongX) {  // slow
  auto recipe = edt_recipe();
  const auto before = edt(recipe);
  recipe.stage = EdtStage::after;
  const auto after = edt(recipe);
  EXPECT_LT(parameter(after, "Ssk"), parameter(before, "Ssk"));
  EXPECT_LT(parameter(after, "Sp"), parameter(before, "Sp"));
  EXPECT_LT(parameter(after, "Spk"), 0.3 * parameter(before, "Spk"));     // no peaks above the core
  EXPECT_NEAR(parameter(after, "Sv") / parameter(before, "Sv"), 1, 0.1);  // pockets stay
  // On the tops of both, slopes along y exceed those along x by more than before sliding.
  const auto anisotropy = [](const topography::Topography& surface) {
    const Field& z = surface.height;
    double along_x = 0, along_y = 0;
    std::vector<double> sorted(z.data(), z.data() + z.size());
    const auto rank = sorted.size() * 9 / 10;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                     sorted.end());
    const double tops = sorted[rank];
    for (Index y = 0; y + 1 < z.rows(); ++y) {
      for (Index x = 0; x + 1 < z.cols(); ++x) {
        if (z(y, x) > tops && z(y, x + 1) > tops && z(y + 1, x) > tops) {
          along_x += std::pow(z(y, x + 1) - z(y, x), 2);
          along_y += std::pow(z(y + 1, x) - z(y, x), 2);
        }
      }
    }
    return along_y / along_x;
  };
  EXPECT_GT(anisotropy(after), 1.2 * anisotropy(before));
}

/// Mean square of the waves of a square map that are longer than `shortest` [m].
double long_wave_power(const topography::Topography& map, double shortest) {
  const double side = map.grid.lx;
  const int highest = static_cast<int>(side / shortest);
  const Index n = map.grid.nx;
  const auto wave = [&](int mode) {
    Eigen::ArrayXcd factors(n);
    for (Index i = 0; i < n; ++i) {
      const double phase =
          2 * std::numbers::pi * mode * static_cast<double>(i) / static_cast<double>(n);
      factors(i) = std::polar(1.0, -phase);
    }
    return factors;
  };
  double power = 0;
  for (int ky = -highest; ky <= highest; ++ky) {
    const Eigen::ArrayXcd column =
        (map.height.cast<std::complex<double>>().colwise() * wave(ky)).colwise().sum();
    for (int kx = -highest; kx <= highest; ++kx) {
      const double modes = std::hypot(kx, ky);
      if (modes == 0 || modes * shortest >= side) continue;
      power += std::norm((column * wave(kx)).sum() / static_cast<double>(n * n));
    }
  }
  return power;
}

TEST(EdtSurface, HasWavesThatDoNotGrowWithTheSheet) {
  double share = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Edt recipe;
    recipe.grid = {160, 160, 2.3e-3, 2.3e-3};
    recipe.waviness = 0.8e-6;  // most of Sa
    recipe.seed = seed;
    const topography::Topography sheet = edt(recipe);
    share += long_wave_power(sheet, 1.1e-3) / long_wave_power(sheet, 250e-6) / 4;
  }
  // Waves whose spectrum is q^-4 from 250 um to 1.1 mm and level beyond, with pressed crests, have
  // 0.43 of their power beyond, the mean of four sheets within 0.06 of it; craters take a little of
  // that. A spectrum that goes on as q^-4 to the size of the sheet has 0.84 there.
  EXPECT_GT(share, 0.25);
  EXPECT_LT(share, 0.65);
}

TEST(EdtSurface, DependsOnTheSeedAndNotOnThreads) {
  expect_same_bits_on_any_threads([] { return edt(edt_recipe(200)).height; });
  EXPECT_GT(largest_difference(edt(edt_recipe(200, 1)).height, edt(edt_recipe(200, 2)).height),
            1e-7);
}

TEST(EdtSurface, HasAnySize) {
  for (const auto& [nx, ny] : {std::pair<Index, Index>{16, 16}, {100, 33}, {37, 250}}) {
    Edt recipe;
    recipe.grid = {nx, ny, static_cast<double>(nx) * 0.67e-6, static_cast<double>(ny) * 0.67e-6};
    for (const bool periodic : {true, false}) {
      recipe.periodic = periodic;
      const auto surface = edt(recipe);
      EXPECT_EQ(surface.height.cols(), nx);
      EXPECT_EQ(surface.height.rows(), ny);
      EXPECT_FALSE(surface.height.hasNaN());
      EXPECT_NEAR(parameter(surface, "Sa") / 0.9e-6, 1, 1e-12);
    }
  }
}

TEST(EdtSurface, RejectsRecipesThatMakeNoSense) {
  auto recipe = edt_recipe();
  recipe.mean_abs_height = 0;
  EXPECT_THROW(edt(recipe), InputError);
  recipe = edt_recipe();
  recipe.grid.nx = 1;
  EXPECT_THROW(edt(recipe), InputError);
}

// The spectrum would be flat, whatever the Hurst exponent.
TEST(SelfAffineSurface, RejectsARollOffThatItsPixelsDoNotShow) {
  SelfAffine recipe;
  recipe.grid = {64, 64, 64e-6, 64e-6};
  recipe.rms_height = 1e-6;
  recipe.roll_off_wavelength = 1.4e-6;
  EXPECT_THAT(rejection([&] { self_affine(recipe); }),
              testing::HasSubstr("got a roll-off wavelength of 1.4 µm; expected more than the "
                                 "shortest wave, 1.414 µm"));
  recipe.roll_off_wavelength = 1.5e-6;
  EXPECT_NO_THROW(self_affine(recipe));
  recipe.stretch = 16;  // the spectrum falls for waves along x below 6 um
  EXPECT_NO_THROW(self_affine(recipe));
}

/// Craters that are smaller than pixels would be without number.
TEST(EdtSurface, RejectsPixelsThatShowNoCraters) {
  Edt recipe;
  recipe.grid = {512, 512, 512 * 1.5, 512 * 1.5};
  EXPECT_THAT(rejection([&] { edt(recipe); }),
              testing::HasSubstr("EDT surface: got craters of 50 µm; expected at least two pixels "
                                 "(3 m); take smaller pixels"));
  recipe.grid = {8, 8, 200e-6, 208e-6};
  EXPECT_THAT(rejection([&] { edt(recipe); }), testing::HasSubstr("two pixels (52 µm)"));
  recipe.grid.ly = recipe.grid.lx;
  recipe.waviness = 0;
  EXPECT_TRUE(edt(recipe).height.isFinite().all());
}

TEST(EdtSurface, RejectsACutOutWhoseCratersHaveNoRoom) {
  Edt recipe;
  recipe.grid = {64, 64, 64e-12, 64e-12};
  EXPECT_NO_THROW(edt(recipe));
  recipe.periodic = false;
  EXPECT_THAT(rejection([&] { edt(recipe); }), testing::HasSubstr("300000064 x 300000064 pixels"));
}

TEST(GroundSurface, RejectsGroovesFinerThanItsPixels) {
  EXPECT_THAT(rejection([] {
                ground({.grid = {64, 64, 64.0, 64.0}});
              }),
              testing::HasSubstr("a groove spacing of 20 µm"));
  EXPECT_THAT(rejection([] {
                ground({.grid = {64, 64, 64e-3, 64e-6}});
              }),
              testing::HasSubstr("a groove length of 400 µm"));
}

TEST(GeneratedSurface, HasPixelsAndHeightsThatAScanMayHave) {
  const Grid vast{16, 16, 1e9, 1e9}, tiny{16, 16, 1e-20, 1e-20}, usual{16, 16, 16e-6, 16e-6};
  for (const Grid& grid : {vast, tiny}) {
    SelfAffine rough;
    rough.grid = grid;
    rough.rms_height = 1e-6;
    EXPECT_THAT(rejection([&] { self_affine(rough); }), testing::HasSubstr("pixels of"));
    EXPECT_THAT(rejection([&] { edt({.grid = grid}); }), testing::HasSubstr("pixels of"));
    EXPECT_THAT(rejection([&] { ground({.grid = grid}); }), testing::HasSubstr("pixels of"));
    EXPECT_THAT(rejection([&] { sinusoid({.grid = grid, .wavelength_x = 1e-6}); }),
                testing::HasSubstr("pixels of"));
    EXPECT_THAT(rejection([&] { sphere({.grid = grid}); }), testing::HasSubstr("pixels of"));
    EXPECT_THAT(rejection([&] { bump({.grid = grid}); }), testing::HasSubstr("pixels of"));
  }
  const double nan = std::nan("");
  for (const double height : {1e7, nan}) {
    SelfAffine rough;
    rough.grid = usual;
    rough.rms_height = height;
    EXPECT_NE(rejection([&] { self_affine(rough); }), "accepted");
    EXPECT_NE(rejection([&] { edt({.grid = usual, .mean_abs_height = height}); }), "accepted");
    EXPECT_NE(rejection([&] { ground({.grid = usual, .rms_height = height}); }), "accepted");
    EXPECT_NE(
        rejection([&] { sinusoid({.grid = usual, .amplitude = height, .wavelength_x = 8e-6}); }),
        "accepted");
    EXPECT_NE(rejection([&] { bump({.grid = usual, .height = height}); }), "accepted");
  }
  SelfAffine steep;
  steep.grid = usual;
  steep.rms_slope = 1e300;
  EXPECT_NE(rejection([&] { self_affine(steep); }), "accepted");
}

TEST(GeneratedSurface, ShowsWhatItIsOf) {
  const Grid grid{16, 16, 16e-6, 16e-6};
  EXPECT_THAT(rejection([&] { sphere({.grid = grid, .radius = 0.5e-6}); }),
              testing::HasSubstr("sphere: got a diameter of 1 µm; expected at least two pixels"));
  EXPECT_THAT(rejection([&] { bump({.grid = grid, .radius = 0.5e-6}); }),
              testing::HasSubstr("bump: got a diameter of 1 µm"));
  EXPECT_NE(rejection([&] { sinusoid({.grid = grid, .wavelength_x = std::nan("")}); }), "accepted");
  SelfAffine rough;
  rough.grid = grid;
  rough.rms_height = 1e-6;
  for (double SelfAffine::*wavelength :
       {&SelfAffine::roll_off_wavelength, &SelfAffine::long_cutoff_wavelength,
        &SelfAffine::short_cutoff_wavelength}) {
    SelfAffine wrong = rough;
    wrong.*wavelength = -1e-6;
    EXPECT_THAT(rejection([&] { self_affine(wrong); }), testing::HasSubstr("zero or more"));
  }
}

TEST(GroundSurface, HasGroovesAlongX) {
  const auto surface = ground({.grid = {256, 256, 256e-6, 256e-6}});
  EXPECT_NEAR(metrology::rms_height(surface) / 0.3e-6, 1, 1e-12);
  const auto spectra = metrology::power_spectra(surface);
  EXPECT_GT(spectra.y.rms_slope, 5 * spectra.x.rms_slope);
}

TEST(Sinusoid, HasACrestOnTheFirstPixel) {
  const auto wave =
      sinusoid({.grid = {64, 32, 64e-6, 32e-6}, .amplitude = 2e-6, .wavelength_x = 16e-6});
  EXPECT_DOUBLE_EQ(wave.height(0, 0), 2e-6);
  EXPECT_NEAR(wave.height(5, 8), -2e-6, 1e-20);
  EXPECT_NEAR(metrology::rms_height(wave), 2e-6 / std::numbers::sqrt2, 1e-18);
  EXPECT_TRUE(wave.periodic);
}

TEST(Sinusoid, IsNotPeriodicWithHalfAWavelength) {
  EXPECT_FALSE(sinusoid({.grid = {64, 32, 72e-6, 32e-6}, .wavelength_x = 16e-6}).periodic);
  EXPECT_THROW(sinusoid({.grid = {64, 32, 72e-6, 32e-6}}), InputError);
}

TEST(Sinusoid, HasTwoPixelsAWave) {
  const Grid grid{64, 32, 64e-6, 32e-6};
  EXPECT_GT(sinusoid({.grid = grid, .amplitude = 1e-6, .wavelength_x = 2e-6}).height.maxCoeff(), 0);
  EXPECT_THROW(sinusoid({.grid = grid, .amplitude = 1e-6, .wavelength_x = 1e-7}), InputError);
  EXPECT_THROW(sinusoid({.grid = grid, .amplitude = 1e-6, .wavelength_y = 1.9e-6}), InputError);
}

TEST(SphereSurface, HasItsCurvatureAtThePole) {
  const double radius = 1e-3;
  const auto cap = sphere({.grid = {101, 101, 101e-7, 101e-7}, .radius = radius});
  EXPECT_EQ(cap.height(50, 50), 0);
  const double r = 50 * 1e-7;
  EXPECT_NEAR(cap.height(50, 100) / (std::sqrt(radius * radius - r * r) - radius), 1, 1e-6);
  EXPECT_NEAR(-2 * cap.height(50, 60) / 1e-12, 1 / radius, 1e-3 / radius);
}

TEST(Surfaces, LargerThanTheMemoryAreRejectedBeforeTheyAreMade) {
  for (const Index n : {Index{1} << 20, Index{1} << 30}) {
    EXPECT_THROW(self_affine(recipe_of(n)), InputError) << n;
    EXPECT_THROW(sphere({.grid = {n, n, 1, 1}, .radius = 10}), InputError) << n;
  }
}

TEST(BumpSurface, RisesSmoothlyFromAFlat) {
  const auto hill = bump({.grid = {101, 101, 101e-7, 101e-7}, .height = 1e-6, .radius = 3e-6});
  EXPECT_DOUBLE_EQ(hill.height(50, 50), 1e-6);
  EXPECT_NEAR(hill.height(50, 65), 0.5e-6, 1e-18);  // half the radius
  EXPECT_EQ(hill.height(0, 0), 0);
}

}  // namespace
}  // namespace tabor::synthesis::test
