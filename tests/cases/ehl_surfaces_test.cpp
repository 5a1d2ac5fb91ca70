#include "tabor/cases/ehl_surfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::cases {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

double rms(const Field& height) { return std::sqrt((height - height.mean()).square().mean()); }

TEST(EhlSurfaces, GenerateTheHeightsThatAreAskedFor) {
  const ehl::SurfaceSource source = ehl_surfaces();
  ehl::GeneratedSurface finish{.grid = {96, 64, 96e-6, 64e-6},
                               .rms_height = 0.2e-6,
                               .roll_off_wavelength = 20e-6,
                               .seed = 5};
  const ehl::Surface isotropic = source.generate(finish);
  EXPECT_EQ(isotropic.height.rows(), 64);
  EXPECT_NEAR(rms(isotropic.height), 0.2e-6, 1e-15);
  finish.groove_length = 400e-6;
  const ehl::Surface grooves = source.generate(finish);
  EXPECT_NEAR(rms(grooves.height), 0.2e-6, 1e-15);
  // Grooves along x: heights hardly change along them.
  const auto slope = [](const Field& a, const Field& b) { return (a - b).square().mean(); };
  const Field& h = grooves.height;
  EXPECT_LT(slope(h.rightCols(95), h.leftCols(95)), slope(h.bottomRows(63), h.topRows(63)) / 3);
  finish.seed = 6;
  EXPECT_FALSE((source.generate(finish).height == h).all());
}

TEST(EhlSurfaces, ReadATreatedScanWithItsDigest) {
  const test::Folder folder;
  const std::string file = folder / "scan.asc";
  test::put_bytes(file,
                  "# Channel: Z\n# Width: 4 um\n# Height: 2 um\n# Value units: um\n"
                  "1\t2\t3\t4\n2\t3\t4\t5\n");
  const ehl::SurfaceSource source = ehl_surfaces();
  const ehl::Surface raw = source.read({.file = file}, {});
  EXPECT_EQ(raw.height.cols(), 4);
  EXPECT_NEAR(raw.height(1, 3), 5e-6, 1e-15);
  EXPECT_EQ(raw.sha256, io::sha256_of_file(file));
  const ehl::Surface level = source.read({.file = file, .treatment = {"level=plane"}}, {});
  EXPECT_LT(level.height.abs().maxCoeff(), 1e-15);
  EXPECT_THROW(source.read({.file = folder / "nowhere.asc"}, {}), InputError);
  EXPECT_THROW(source.read({.file = file, .treatment = {"level=sphere5"}}, {}), InputError);
}

TEST(EhlSurfaces, RejectHolesWhereTheyAreTold) {
  const test::Folder folder;
  const std::string file = folder / "scan.asc";
  test::put_bytes(file,
                  "# Channel: Z\n# Width: 4 um\n# Height: 2 um\n# Value units: um\n"
                  "1\t2\tnan\t4\n2\t3\t4\t5\n");
  const ehl::SurfaceSource source = ehl_surfaces();
  EXPECT_NO_THROW(source.read({.file = file}, {}));
  EXPECT_THAT(
      [&] { source.read({.file = file, .rejects_holes_at = "case.toml:3: roughness.file"}, {}); },
      ThrowsMessage<InputError>(HasSubstr("case.toml:3")));
}

}  // namespace
}  // namespace tabor::cases
