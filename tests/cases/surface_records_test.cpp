// Records of a surface itself: its summary, its roughness parameters, its spectra, and their means.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tabor/cases/spectra.hpp"
#include "tabor/cases/surface_parameters.hpp"
#include "tabor/cases/surface_summary.hpp"
#include "tabor/core/error.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::cases::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kAmplitude = 1e-6;  // [m]

/// Whole waves along x: Sq is amplitude / sqrt(2).
topography::Topography wave(double amplitude = kAmplitude) {
  topography::Topography surface;
  surface.grid = {64, 32, 64e-6, 32e-6};
  surface.height = Field(32, 64);
  for (Index j = 0; j < 64; ++j) {
    surface.height.col(j) = amplitude * std::sin(2 * std::numbers::pi * 4 * double(j) / 64);
  }
  surface.source = "wave.h5";
  surface.periodic = true;
  return surface;
}

topography::Topography holed() {
  topography::Topography surface = wave();
  surface.height(3, 5) = std::nan("");
  return surface;
}

TEST(SurfaceSummary, OfAWave) {
  const SurfaceRecord record = summary_of(wave());
  EXPECT_EQ(record.grid.nx, 64);
  EXPECT_TRUE(record.periodic);
  EXPECT_EQ(record.missing_pixels, 0);
  EXPECT_NEAR(record.max, kAmplitude, 1e-12 * kAmplitude);
  EXPECT_NEAR(record.min, -kAmplitude, 1e-12 * kAmplitude);
  EXPECT_NEAR(record.rms, kAmplitude / std::sqrt(2), 1e-9 * kAmplitude);
}

TEST(SurfaceSummary, MeasuresTheTiltOverBothSides) {
  topography::Topography surface = wave();
  for (Index x = 0; x < surface.grid.nx; ++x) {
    surface.height.col(x) =
        3e-6 * (static_cast<double>(x) + 0.5) / static_cast<double>(surface.grid.nx);
  }
  for (Index y = 0; y < surface.grid.ny; ++y) {
    surface.height.row(y) +=
        4e-6 * (static_cast<double>(y) + 0.5) / static_cast<double>(surface.grid.ny);
  }
  EXPECT_NEAR(summary_of(surface).tilt, 5e-6, 1e-15);  // 3 along x, 4 along y
}

TEST(SurfaceSummary, LeavesHolesOut) {
  const SurfaceRecord record = summary_of(holed());
  EXPECT_EQ(record.missing_pixels, 1);
  EXPECT_DOUBLE_EQ(record.missing_fraction(), 1.0 / 2048);
  topography::Topography none = wave();
  none.height.setConstant(std::nan(""));
  const SurfaceRecord nothing = summary_of(none);
  EXPECT_DOUBLE_EQ(nothing.missing_fraction(), 1);
  EXPECT_TRUE(std::isnan(nothing.min) && std::isnan(nothing.rms));
}

TEST(SurfaceParameters, OfAWave) {
  const ParametersRecord record =
      parameters_of(holed(), {.sets = {metrology::ParameterSet::height}});
  EXPECT_EQ(record.path, "wave.h5");
  EXPECT_EQ(record.treatment, "none");
  EXPECT_EQ(record.valid_points, 2047);
  ASSERT_NE(record.find("Sq"), nullptr);
  EXPECT_NEAR(record.find("Sq")->value, kAmplitude / std::sqrt(2), 1e-3 * kAmplitude);
  EXPECT_EQ(record.find("Sqq"), nullptr);
}

/// Mirror images add no peaks, and no waves that are longer.
TEST(SurfaceParameters, OfACutOutAreThoseOfTheScan) {
  topography::Topography scan = wave();
  scan.height(7, 9) = 3 * kAmplitude;
  scan.periodic = false;
  const topography::Topography cut = topography::mirror(scan);
  const auto alone = parameters_of(scan);
  const auto found = parameters_of(cut);
  EXPECT_EQ(found.valid_points, alone.valid_points);
  ASSERT_EQ(found.parameters.size(), alone.parameters.size());
  for (std::size_t i = 0; i < alone.parameters.size(); ++i) {
    EXPECT_EQ(found.parameters[i].symbol, alone.parameters[i].symbol);
    if (!std::isnan(alone.parameters[i].value)) {
      EXPECT_EQ(found.parameters[i].value, alone.parameters[i].value) << found.parameters[i].symbol;
    }
  }
  EXPECT_EQ(spectra_of(cut, {}).trusted.longest, spectra_of(scan, {}).trusted.longest);
}

TEST(SurfaceParameters, OfAGroupLeaveFailuresOut) {
  const metrology::ParameterOptions options{.sets = {metrology::ParameterSet::height}};
  const ParametersRecord small = parameters_of(wave(), options);
  ParametersRecord large = parameters_of(wave(3 * kAmplitude), options);
  large.path = "large.h5";
  const ParametersRecord failed{.path = "gone.h5", .treatment = "none", .failure = "no such file"};
  const GroupParameters mean = mean_of("all", {&small, &failed, &large});
  EXPECT_THAT(mean.scans, ElementsAre("wave.h5", "large.h5"));
  EXPECT_TRUE(mean.has(large));
  EXPECT_FALSE(mean.has(failed));
  for (const metrology::ParameterMean& one : mean.means) {
    if (one.symbol != "Sq") continue;
    EXPECT_EQ(one.value.n, 2u);
    EXPECT_NEAR(one.value.mean, 2 * kAmplitude / std::sqrt(2), 1e-9 * kAmplitude);
  }
  const std::vector<ParametersRecord> all{failed, small, large};
  EXPECT_EQ(distinct_parameters(all).size(), small.parameters.size());
}

TEST(Spectra, HaveTheVarianceOfTheHeights) {
  const SpectraRecord record = spectra_of(wave(), {});
  ASSERT_TRUE(record.spectra);
  EXPECT_NEAR(record.spectra->rms_height, kAmplitude / std::sqrt(2), 1e-9 * kAmplitude);
  EXPECT_FALSE(record.acf || record.hdf);
  EXPECT_THAT(record.references, ElementsAre("jacobs2017", spectral::transform_reference()));
}

TEST(Spectra, OfASurfaceWithHolesAreAnErrorUnlessMoreIsAskedFor) {
  EXPECT_THROW(spectra_of(holed(), {}), InputError);
  SpectraSettings settings;
  settings.autocorrelation = true;
  settings.height_differences = true;
  const SpectraRecord record = spectra_of(holed(), settings);
  EXPECT_FALSE(record.spectra);
  EXPECT_TRUE(record.acf && record.hdf);
  EXPECT_NEAR(record.mean_square, kAmplitude * kAmplitude / 2, 1e-3 * kAmplitude * kAmplitude);
  EXPECT_THAT(record.references, IsEmpty());
  EXPECT_THROW(mean_of("all", {"wave.h5"}, {&record}), InputError);
}

TEST(Spectra, OfAGroupAverageHeights) {
  const SpectraRecord small = spectra_of(wave(), {});
  const SpectraRecord large = spectra_of(wave(3 * kAmplitude), {});
  const GroupSpectra mean = mean_of("all", {"a", "b"}, {&small, &large});
  EXPECT_NEAR(mean.rms_height.mean, 2 * kAmplitude / std::sqrt(2), 1e-9 * kAmplitude);
  ASSERT_TRUE(mean.x && mean.radial);
  const std::size_t at = 3;  // the fourth wavevector, that of the wave
  EXPECT_NEAR(mean.x->density[at].mean,
              (small.spectra->x.density[at] + large.spectra->x.density[at]) / 2,
              1e-12 * large.spectra->x.density[at]);
}

}  // namespace
}  // namespace tabor::cases::test
