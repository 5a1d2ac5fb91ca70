// Offsets between the lines of a scan: seen, and taken out.
#include "tabor/topography/row_offsets.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "support/rejection.hpp"
#include "support/rough_recipe.hpp"
#include "support/sample_surfaces.hpp"
#include "support/scans.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const Grid kGrid{200, 160, 200e-6, 160e-6};

std::vector<double> offsets(double size, Index n, std::uint64_t seed = 3) {
  const CounterRandom random(seed);
  std::vector<double> all(static_cast<std::size_t>(n));
  for (std::size_t y = 0; y < all.size(); ++y) all[y] = size * random.normal(y);
  return all;
}

Topography with_offsets(Topography surface, const std::vector<double>& each) {
  for (Index y = 0; y < surface.grid.ny; ++y) {
    surface.height.row(y) += each[static_cast<std::size_t>(y)];
  }
  surface.periodic = false;
  return surface;
}

Topography grooves_along_y() {
  return surface(kGrid, [](double x, double) {
    return 1e-6 * std::cos(2 * pi * x / 25e-6) + 0.3e-6 * std::sin(2 * pi * x / 7e-6);
  });
}

std::vector<std::string> codes_of(const Topography& one) {
  std::vector<std::string> codes;
  for (const Warning& warning : warnings(one)) codes.push_back(warning.code);
  return codes;
}

/// What a constant does not explain.
double rest(const Field& a, const Field& b) {
  const Field difference = a - b;
  const double middle = difference.isNaN().select(0, difference).sum() /
                        static_cast<double>((!difference.isNaN()).count());
  return difference.isNaN().select(0, (difference - middle).abs()).maxCoeff();
}

TEST(LevelRows, TakesExactOffsetsUpToAConstant) {
  const Topography clean = grooves_along_y();
  for (const double size : {1e-9, 0.1e-6, 5e-6}) {
    const auto level = level_rows(with_offsets(clean, offsets(size, kGrid.ny)));
    EXPECT_LT(rest(level.height, clean.height), 1e-19 + 1e-13 * size) << size;
    EXPECT_THAT(level.history.back(), HasSubstr("level=rows: offsets taken"));
  }
}

TEST(LevelRows, LeavesHolesAlone) {
  const Topography clean = grooves_along_y();
  Topography scan = with_offsets(clean, offsets(1e-6, kGrid.ny));
  punch_holes(scan, 0.3);
  scan.height.row(40) = kHole;
  scan.height.middleRows(90, 5) = kHole;
  const Field before = scan.height;
  const auto level = apply({"level=rows"}, scan);
  EXPECT_TRUE((level.height.isNaN() == before.isNaN()).all());
  EXPECT_LT(rest(level.height, before.isNaN().select(kHole, clean.height)), 1e-18);
}

TEST(LevelRows, DoesNotDependOnTheOffsetsWhereTheyAreLarge) {
  const auto rough = synthesis::self_affine(rough_recipe(128, 0.8, 4));
  const double rms = std::sqrt(rough.height.square().mean());
  const auto once = level_rows(with_offsets(rough, offsets(rms, 128, 1)));
  const auto twice = level_rows(with_offsets(rough, offsets(3 * rms, 128, 2)));
  EXPECT_LT(rest(once.height, twice.height), 1e-12 * rms);
  EXPECT_NEAR(once.height.mean(), with_offsets(rough, offsets(rms, 128, 1)).height.mean(),
              1e-12 * rms);
}

TEST(LevelRows, LeavesSurfacesAloneWhoseRowsDoNotJump) {
  synthesis::Edt sheet;
  sheet.grid = {256, 256, 256 * 0.67e-6, 256 * 0.67e-6};
  for (const auto stage : {synthesis::EdtStage::before, synthesis::EdtStage::after}) {
    sheet.stage = stage;
    const auto clean = synthesis::edt(sheet);
    const auto level = apply({"level=rows"}, clean);
    EXPECT_TRUE(same_bits(level.height, clean.height));
    EXPECT_THAT(level.history.back(), HasSubstr("rows do not jump"));
  }
  for (const double hurst : {0.3, 0.8}) {
    const auto rough = synthesis::self_affine(rough_recipe(256, hurst, 1));
    EXPECT_TRUE(same_bits(level_rows(rough).height, rough.height));
  }
  EXPECT_TRUE(same_bits(level_rows(noise({300, 1, 3e-4, 1e-6})).height,
                        noise({300, 1, 3e-4, 1e-6}).height));
}

TEST(LevelRows, RejectsAColumnWhichItWouldFlatten) {
  EXPECT_THAT(rejection([] {
                level_rows(noise({1, 300, 1e-6, 3e-4}));
              }),
              HasSubstr("a profile of one column"));
}

TEST(RowJumps, AreWarnedAboutWithBothSizes) {
  // White noise of 1 um, whose rows are 2 um apart.
  auto scan = with_offsets(noise({256, 256, 256e-6, 256e-6}), offsets(2e-6, 256));
  ASSERT_THAT(codes_of(scan), Contains("row-jumps"));
  for (const Warning& warning : warnings(scan)) {
    if (warning.code != "row-jumps") continue;
    EXPECT_THAT(warning.text, testing::ContainsRegex("Rows jump by (1.9|2.0|2.1|2)[0-9]* (u|µ)m"));
    EXPECT_THAT(warning.text, HasSubstr("<level=rows>"));
  }
  EXPECT_THAT(codes_of(apply({"level=rows"}, scan)), Not(Contains("row-jumps")));
  for (const double hurst : {0.3, 0.8}) {
    const auto rough = synthesis::self_affine(rough_recipe(256, hurst, 2));
    EXPECT_THAT(codes_of(with_offsets(rough, offsets(0.3e-6, 256))), Contains("row-jumps"));
  }
}

TEST(RowJumps, AreNotSeenInCleanSurfaces) {
  std::vector<Topography> clean{synthesis::edt({}), grooves_along_y(), transpose(grooves_along_y()),
                                synthesis::sphere({.grid = kGrid, .radius = 1e-3})};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double hurst : {0.2, 0.5, 0.8}) {
      clean.push_back(synthesis::self_affine(rough_recipe(128, hurst, seed)));
      synthesis::Ground ground;
      ground.grid = kGrid;
      ground.hurst = hurst;
      ground.seed = seed;
      clean.push_back(synthesis::ground(ground));  // grooves along x
      clean.push_back(transpose(clean.back()));
    }
    clean.push_back(noise({96, 64, 96e-6, 64e-6}, seed));
  }
  for (const Topography& one : clean) {
    EXPECT_THAT(codes_of(one), Not(Contains("row-jumps"))) << one.source << one.grid.nx;
  }
}

class RowsOfCleanScans : public testing::TestWithParam<const char*> {};

TEST_P(RowsOfCleanScans, DoNotJump) {
  TABOR_NEEDS_SHARED_SCAN(GetParam());
  scan::ReadOptions options;
  if (std::string(GetParam()) == "afm_20um_asylum.ibw") options.channel = "0";  // of four
  EXPECT_THAT(codes_of(scan::read(tabor::test::shared_scan(GetParam()), options)),
              Not(Contains("row-jumps")));
}

INSTANTIATE_TEST_SUITE_P(Scans, RowsOfCleanScans,
                         testing::Values("rubber_alicona.x3p", "focusvar_rough.al3d",
                                         "wli_ds_nonsquare.x3p", "wli_smooth.opd",
                                         "wli_milled1.opd", "zygo_metropro.dat",
                                         "confocal_tilted_flat.plu", "gelsight_dime.tmd",
                                         "polished_cyl_missing.sur", "afm_20um_asylum.ibw"));

TEST(RowJumps, GiveTheSameBitsOnAnyNumberOfThreads) {
  const auto scan = with_offsets(noise(kGrid), offsets(2e-6, kGrid.ny));
  expect_same_bits_on_any_threads([&] { return level_rows(scan).height; });
}

}  // namespace
}  // namespace tabor::topography::test
