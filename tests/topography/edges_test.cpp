// What lies beyond the edges: looked at in the heights, or said.
#include "tabor/topography/edges.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "support/sample_surfaces.hpp"
#include "support/scans.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

const Grid kGrid{192, 128, 192e-6, 128e-6};

struct Named {
  std::string name;
  Field height;
};

synthesis::SelfAffine self_affine(double hurst, double stretch, std::uint64_t seed) {
  synthesis::SelfAffine recipe;
  recipe.grid = kGrid;
  recipe.hurst = hurst;
  recipe.stretch = stretch;
  recipe.rms_height = 1e-6;
  recipe.short_cutoff_wavelength = 6e-6;
  recipe.seed = seed;
  return recipe;
}

/// cos along x, times cos along y; a square wave where `steep`.
Field waves(double periods_x, double periods_y, bool steep = false) {
  const Field cosines = surface(kGrid, [&](double x, double y) {
                          return std::cos(2 * pi * periods_x * x / kGrid.lx) *
                                 std::cos(2 * pi * periods_y * y / kGrid.ly);
                        }).height;
  return steep ? Field((cosines > 0).cast<double>()) : cosines;
}

/// The map moved round by some rows and columns: as much a tile as before.
Field rolled(const Field& height, Index rows, Index columns) {
  Field moved(height.rows(), height.cols());
  for (Index y = 0; y < height.rows(); ++y) {
    for (Index x = 0; x < height.cols(); ++x) {
      moved((y + rows) % height.rows(), (x + columns) % height.cols()) = height(y, x);
    }
  }
  return moved;
}

std::vector<Named> tiles() {
  std::vector<Named> all;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string number = std::to_string(seed);
    all.push_back({"smooth " + number, synthesis::self_affine(self_affine(0.8, 1, seed)).height});
    all.push_back({"rough " + number, synthesis::self_affine(self_affine(0.3, 1, seed)).height});
    all.push_back({"grooved " + number, synthesis::self_affine(self_affine(0.8, 8, seed)).height});
    synthesis::Edt sheet;
    sheet.grid = kGrid;
    sheet.seed = seed;
    all.push_back({"edt " + number, synthesis::edt(sheet).height});
    synthesis::Ground ground;
    ground.grid = kGrid;
    ground.seed = seed;
    all.push_back({"ground " + number, synthesis::ground(ground).height});
    Topography part;
    part.grid = {60, 40, 60e-6, 40e-6};
    part.height = synthesis::self_affine(self_affine(0.8, 1, seed)).height.block(10, 20, 40, 60);
    all.push_back({"mirrored cut-out " + number, mirror(part).height});
  }
  all.push_back({"wave along x", waves(6, 0)});
  all.push_back({"wave along y", waves(0, 4)});
  all.push_back({"both", waves(3, 2)});
  all.push_back({"ridges along y", waves(6, 0, true)});
  all.push_back({"ridges along x", waves(0, 4, true)});
  all.push_back({"flat", Field::Constant(kGrid.ny, kGrid.nx, 3.1e-6)});
  return all;
}

TEST(EdgesMatch, OfTilesWhereverTheyBegin) {
  for (const Named& tile : tiles()) {
    for (const auto& [rows, columns] : {std::pair<Index, Index>{0, 0}, {17, 40}, {64, 3}}) {
      EXPECT_TRUE(edges_match(rolled(tile.height, rows, columns))) << tile.name << ' ' << rows;
      EXPECT_TRUE(edges_match(rolled(tile.height, rows, columns).transpose())) << tile.name;
    }
  }
}

TEST(EdgesMatch, NotOfCutOuts) {
  std::vector<Named> cut_outs;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Field smooth = synthesis::self_affine(self_affine(0.8, 1, seed)).height;
    cut_outs.push_back({"part", smooth.block(5, 7, 60, 80)});
    cut_outs.push_back({"whole rows", smooth.topRows(50)});
    synthesis::Edt sheet;
    sheet.grid = kGrid;
    sheet.periodic = false;
    sheet.seed = seed;
    cut_outs.push_back({"edt", synthesis::edt(sheet).height});
  }
  cut_outs.push_back({"part of a wave", waves(6.3, 0)});
  Field half = waves(1, 0);
  half.leftCols(kGrid.nx / 2) = 0;
  half.rightCols(kGrid.nx / 2) = 1;
  cut_outs.push_back({"a step", half});
  cut_outs.push_back({"a tilted tile", waves(6, 4) + surface(kGrid, [](double x, double) {
                                                       return 1e5 * x;
                                                     }).height});
  // Its edges have one height, but a row of domes has creases.
  cut_outs.push_back(
      {"a dome", synthesis::sphere({.grid = {128, 128, 128e-6, 128e-6}, .radius = 1e-3}).height});
  for (const Named& one : cut_outs) {
    EXPECT_FALSE(edges_match(one.height)) << one.name;
    EXPECT_FALSE(edges_match(one.height.transpose())) << one.name;
  }
}

TEST(EdgesMatch, HasNoUnitAndNoLevel) {
  for (const double scale : {1e-9, 1.0, 1e6}) {
    EXPECT_TRUE(edges_match(scale * (waves(3, 2) + 100)));
    EXPECT_FALSE(edges_match(scale * (waves(3.3, 2) + 100)));
  }
}

TEST(EdgesMatch, IsNotHiddenByOneBadRowOrAFewSpikes) {
  Field part = synthesis::self_affine(self_affine(0.8, 1, 1)).height.block(5, 7, 60, 80);
  part.row(20) += 5e-6;
  part.col(31) += 5e-6;
  for (Index k = 0; k < 12; ++k) part(5 * k, (7 * k) % 80) += 50e-6;
  EXPECT_FALSE(edges_match(part));
}

TEST(EdgesMatch, NeedsHeightsAtTheEdges) {
  Field tile = waves(3, 2);
  tile.col(0).head(50) = kHole;  // of 128
  EXPECT_TRUE(edges_match(tile));
  tile.col(0).head(70) = kHole;
  EXPECT_FALSE(edges_match(tile));
  EXPECT_FALSE(edges_match(Field::Constant(20, 20, kHole)));
  EXPECT_FALSE(edges_match(Field::Zero(5, 5)));
  EXPECT_TRUE(edges_match(waves(3, 0).row(0)));  // a profile
  EXPECT_FALSE(edges_match(waves(3.3, 0).row(0)));
}

TEST(EdgesMatch, NotOfMeasuredScans) {
  for (const char* name :
       {"afm_10um_bruker.di", "afm_1um_park.tiff", "afm_20um_asylum.ibw",
        "confocal_tilted_flat.plu", "gelsight_dime.tmd", "polished_cyl_missing.sur",
        "confocal_bullet_land.x3p", "rubber_alicona.x3p", "wli_milled1.opd", "wli_smooth.opd",
        "zygo_metropro.dat"}) {
    TABOR_NEEDS_SHARED_SCAN(name);
    scan::ReadOptions options;
    if (std::string(name) == "afm_10um_bruker.di") options.channel = "ZSensor";
    if (std::string(name) == "afm_20um_asylum.ibw") options.channel = "0";  // of four
    const auto one = scan::read(tabor::test::shared_scan(name), options);
    EXPECT_FALSE(repeats(one)) << name;
    EXPECT_FALSE(repeats(apply({"level=plane"}, one))) << name;
  }
}

TEST(Edges, AreLookedAtInFilesOfAnyFormat) {
  const Folder folder;
  const Topography tile = synthesis::self_affine(self_affine(0.8, 1, 2));
  const Topography part = crop(tile, {5, 7, 80, 60});
  for (const char* name : {"a.x3p", "a.npy", "a.gsf", "a.txt", "a.sdf", "a.h5"}) {
    scan::write(tile, folder / name);
    scan::ReadOptions options;
    options.unit = "m";
    options.pixel_x = options.pixel_y = 1e-6;
    options.override_unit = true;
    EXPECT_TRUE(repeats(scan::read(folder / name, options))) << name;
    EXPECT_EQ(metrology::power_spectra(scan::read(folder / name, options), {}).window,
              metrology::PsdWindow::none)
        << name;
    scan::write(part, folder / name);
    EXPECT_FALSE(repeats(scan::read(folder / name, options))) << name;
    EXPECT_EQ(metrology::power_spectra(scan::read(folder / name, options), {}).window,
              metrology::PsdWindow::hann)
        << name;
  }
}

TEST(Edges, OfATileThatIsLevelledStillRepeatButTransformsSeeTheStep) {
  Topography tile = synthesis::edt({});
  tile.periodic = false;  // as a file that cannot say so
  look_at_edges(tile);
  const Topography level = apply({"level=plane"}, tile);
  EXPECT_TRUE(repeats(level));
  EXPECT_FALSE(tiles_as_it_is(level));
  EXPECT_FALSE(repeats(apply({"level=plane", "crop=0,0,200,200"}, tile)));
  EXPECT_TRUE(repeats(apply({"crop=0,0,512,512"}, tile)));
}

TEST(Edges, AreWhatTheUserSays) {
  const Topography part = crop(synthesis::self_affine(self_affine(0.8, 1, 2)), {5, 7, 80, 60});
  const Topography tile = apply({"edges=tile"}, part);
  EXPECT_TRUE(repeats(tile));
  EXPECT_TRUE(tiles_as_it_is(tile));
  EXPECT_TRUE(same_bits(tile.height, part.height));
  EXPECT_TRUE(same_bits(apply({"edges=cut"}, part).height, mirror(part).height));
  EXPECT_TRUE(same_bits(apply({"mirror", "edges=cut"}, part).height, mirror(part).height));
  const Topography end = apply({"edges=end"}, synthesis::self_affine(self_affine(0.8, 1, 2)));
  EXPECT_FALSE(repeats(end));
  EXPECT_FALSE(tiles_as_it_is(end));
  EXPECT_FALSE(repeats(apply({"edges=tile", "crop=0,0,40,40"}, part)));
}

TEST(Edges, AreSaidOnce) {
  for (const Treatment& steps :
       {Treatment{"edges=tile", "edges=end"}, {"edges=end", "mirror"}, {"mirror", "edges=tile"}}) {
    EXPECT_THAT(rejection([&] { check(steps); }), HasSubstr("edges: got"));
  }
  check({"edges=cut", "mirror"});
  for (const Treatment& steps : {Treatment{"edges=cut", "mirror"}, {"mirror", "mirror"}}) {
    EXPECT_TRUE(same_bits(apply(steps, noise(kGrid)).height, mirror(noise(kGrid)).height));
  }
  EXPECT_THAT(rejection([] { check({"edges=tiled"}); }), HasSubstr("did you mean 'tile'"));
  const Topography tile = apply({"edges=tile"}, noise(kGrid));
  EXPECT_THAT(rejection([&] { apply({"edges=end"}, tile); }), HasSubstr("has 'tile'"));
  EXPECT_THAT(rejection([&] { apply({"mirror"}, tile); }), HasSubstr("edges=tile"));
  EXPECT_EQ(edges_of({"level=plane", "edges=cut"}), Edges::cut);
  EXPECT_EQ(edges_of({"level=plane", "mirror"}), std::nullopt);
}

// Mirror images hide a tilt and rows that jump from the fit, and would double what they hold.
TEST(Edges, LevelTheScanWhereverItWasCut) {
  Topography tilted = noise(kGrid);
  for (Index y = 0; y < kGrid.ny; ++y) {
    for (Index x = 0; x < kGrid.nx; ++x) {
      tilted.height(y, x) += 1e-7 * static_cast<double>(3 * x + y * y);
    }
  }
  tilted.height(2, 3) = kHole;
  for (const std::string form : {"level=plane", "level=poly2", "level=mean", "level=rows"}) {
    SCOPED_TRACE(form);
    const Topography before = apply({form, "edges=cut"}, tilted);
    const Topography after = apply({"edges=cut", form}, tilted);
    EXPECT_TRUE(same_bits(after.height, before.height));
    EXPECT_EQ(after.grid.nx, before.grid.nx);
    EXPECT_EQ(after.tiles, 2);
    EXPECT_TRUE(repeats(after));
    EXPECT_THAT(after.history.back(), testing::StartsWith(form));
  }
  const auto is_tilt = [](const Warning& warning) { return warning.code == "tilt"; };
  const Topography cut = apply({"edges=cut"}, tilted);
  EXPECT_TRUE(std::any_of(cut.warnings.begin(), cut.warnings.end(), is_tilt));
}

// A filter that wraps round makes opposite edges match, whatever they were.
TEST(Edges, AreNotMadeToMatchByAFilter) {
  const auto codes = [](const Topography& surface) { return codes_of(surface.warnings); };
  const Topography part =
      level(crop(synthesis::self_affine(self_affine(0.8, 1, 2)), {5, 7, 80, 60}), Form::plane);
  const Topography filtered = apply({"lowpass=hann:6um"}, part);
  EXPECT_FALSE(repeats(filtered));
  EXPECT_FALSE(tiles_as_it_is(filtered));
  EXPECT_THAT(codes(filtered), testing::Contains("filter-wraps"));
  EXPECT_EQ(metrology::power_spectra(filtered).window, metrology::PsdWindow::hann);
  const Topography twice = apply({"lowpass=hann:6um", "level=mean"}, filtered);
  EXPECT_FALSE(repeats(twice));
  for (const Treatment& steps : {Treatment{"lowpass=gauss:6um"},
                                 {"edges=cut", "lowpass=hann:6um"},
                                 {"mirror", "lowpass=hann:6um"}}) {
    EXPECT_THAT(codes(apply(steps, part)), testing::Not(testing::Contains("filter-wraps")));
  }
  const Topography tile = synthesis::self_affine(self_affine(0.8, 1, 2));
  EXPECT_TRUE(repeats(apply({"lowpass=hann:6um"}, tile)));
  EXPECT_THAT(codes(apply({"lowpass=hann:6um"}, tile)),
              testing::Not(testing::Contains("filter-wraps")));
}

TEST(Edges, AreCutLast) {
  for (const std::string step : {"crop=0,0,8,8", "trim=2"}) {
    EXPECT_THAT(rejection([&] { check({"edges=cut", step}); }), HasSubstr("before <edges=cut>"));
    EXPECT_THAT(rejection([&] { check({"recipe=part", step}); }), HasSubstr("before <edges=cut>"));
    check({step, "edges=cut"});
    check({"mirror", step});
  }
}

TEST(Edges, KnowTheScanThatImagesContinue) {
  const Topography scan = noise(kGrid);
  EXPECT_FALSE(scan_of_images(scan));
  Topography cut = mirror(scan);
  ASSERT_TRUE(scan_of_images(cut));
  EXPECT_TRUE(same_bits(scan_of_images(cut)->height, scan.height));
  EXPECT_DOUBLE_EQ(scan_of_images(cut)->grid.dx(), scan.grid.dx());
  EXPECT_FALSE(repeats(*scan_of_images(cut)));
  const Folder folder;
  scan::write(cut, folder / "cut.h5");
  const Topography again = scan::read(folder / "cut.h5");
  ASSERT_TRUE(scan_of_images(again));
  EXPECT_EQ(mirror(again).grid.nx, cut.grid.nx);
  cut.height(0, 0) += 1e-6;
  EXPECT_FALSE(scan_of_images(cut));
}

TEST(Edges, SayWhichStepsMirror) {
  for (const Treatment& steps :
       {Treatment{"level=plane", "mirror"}, {"edges=cut"}, {"recipe=part"}}) {
    EXPECT_TRUE(mirrors(steps)) << steps.back();
  }
  EXPECT_FALSE(mirrors({"level=plane", "edges=tile"}));
  EXPECT_FALSE(mirrors({}));
}

}  // namespace
}  // namespace tabor::topography::test
