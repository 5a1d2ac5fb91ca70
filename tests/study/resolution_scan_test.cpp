// Wet share and friction with larger pixels and behind low-passes.
#include "tabor/study/resolution_scan.hpp"

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "tabor/study/scan_friction.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::study {
namespace {

using testing::Contains;
using testing::HasSubstr;

topography::Topography sheet(Index n) {
  synthesis::Edt recipe;
  recipe.grid = {n, n, static_cast<double>(n) * 0.67e-6, static_cast<double>(n) * 0.67e-6};
  recipe.plateau_roughness = 80e-9;
  return synthesis::edt(recipe);
}

cases::CaseSettings settings() {
  cases::CaseSettings settings;
  cases::take_material("aluminium-6016", settings);
  settings.mean_pressures = {7e6, 15e6};
  settings.film.lubricant_densities = {0.45e-3};
  settings.film.model = deposition::Model::limit;
  return settings;
}

std::vector<cases::FrictionRecord> measured(const topography::Topography& surface) {
  std::vector<cases::FrictionRecord> records;
  friction_of(surface, settings(),
              [&](const FrictionState& state) { records.push_back(state.friction); });
  return records;
}

TEST(ResolutionScan, IsTheSheetWithLargerPixelsItselfAndBehindLowPasses) {
  const auto surface = sheet(128);
  auto records = measured(surface);
  const auto scan = resolution_scan(surface, settings(), records);
  ASSERT_EQ(scan.size(), 6 * records.size());
  const double pixel = surface.grid.dx();
  const std::vector<double> pixels = {4 * pixel, 2 * pixel, pixel, pixel, pixel, pixel};
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(scan[i].pixel_x, pixels[i / 2], 1e-18);
    EXPECT_EQ(scan[i].friction.mean_pressure, records[i % 2].mean_pressure);
  }
  EXPECT_EQ(scan[4].step, "");
  EXPECT_EQ(scan[4].friction.friction_lubricated, records[0].friction_lubricated);
  // The pockets that hold the oil are small: larger pixels and low-passes lose them.
  EXPECT_LT(scan[0].friction.lubricated_share, scan[4].friction.lubricated_share);
  EXPECT_LT(scan.back().friction.lubricated_share, scan[5].friction.lubricated_share);
}

TEST(ResolutionScan, WarnsWhereThePixelDecides) {
  const auto surface = sheet(128);
  auto records = measured(surface);
  const auto before = records;
  const auto scan = resolution_scan(surface, settings(), records);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double fine = records[i].lubricated_share;
    const double coarse = scan[2 + i].friction.lubricated_share;
    const bool decides = std::abs(fine - coarse) > 0.2 * std::max(fine, coarse);
    EXPECT_EQ(records[i].warnings.size(), before[i].warnings.size() + (decides ? 1 : 0));
  }
  EXPECT_THAT(codes_of(records[0].warnings), Contains("pixel"));
}

TEST(ResolutionScan, NeedsPixelsAndOilAtRest) {
  std::vector<cases::FrictionRecord> records;
  EXPECT_THAT(test::rejection([&] { resolution_scan(sheet(63), settings(), records); }),
              HasSubstr("got 63 x 63 pixels; expected 64 x 64 or more"));
  cases::CaseSettings flowing = settings();
  flowing.fluid.fluid = cases::Fluid::reynolds;
  EXPECT_THAT(test::rejection([&] { resolution_scan(sheet(64), flowing, records); }),
              HasSubstr("oil that flows"));
}

}  // namespace
}  // namespace tabor::study
