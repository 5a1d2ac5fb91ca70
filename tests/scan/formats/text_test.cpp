#include <fmt/format.h>

#include <cstdlib>
#include <functional>

#include "scan/formats/sample.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

Field matrix(Index ny, Index nx, std::initializer_list<double> values) {
  Field field(ny, nx);
  std::copy(values.begin(), values.end(), field.data());
  return field;
}

TEST(TextMatrix, WithoutUnitOrPixelIsRejectedNamingTheFlags) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, "1 2\n3 4\n").find("<pixel=0.67um> <unit=um>"),
            std::string::npos);
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_NE(test::rejection(folder, "1 2\n3 4\n", options).find("<unit"), std::string::npos);
}

TEST(TextMatrix, TakesEveryUsualSeparatorAndLineEnd) {
  const Folder folder;
  const Field expected = 1e-6 * matrix(2, 3, {1.5, 2, -3, 4, 5, 6});
  for (const char* text :
       {"1.5 2 -3\n4 5 6\n", "1.5\t2\t-3\r\n4\t5\t6\r\n", "1.5,2,-3\n4,5,6", "1.5;2;-3;\n4;5;6;\n",
        "1,5;2;-3\n4;5;6\n", "1,5 2 -3\n4,0 5 6\n", "\xEF\xBB\xBF 1.5 2 -3\n\n+4 5e0 6\n\n",
        "# a remark\n1.5, 2, -3\n4, 5, 6\n"}) {
    const topography::Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_TRUE(test::same_bits(map.height, expected)) << text;
  }
}

TEST(TextMatrix, ReadsEveryWordForAHole) {
  const Folder folder;
  for (const char* hole : {"NaN", "nan", "NM", "BAD", "---", "inf"}) {
    const std::string text = std::string("1 2 3\n4 ") + hole + " 6\n";
    const topography::Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_TRUE(std::isnan(map.height(1, 1))) << hole;
    EXPECT_EQ(topography::count_holes(map), 1);
  }
  EXPECT_EQ(topography::count_holes(test::read_bytes(folder, "1,2,3\n4,,6\n", test::micrometres())),
            1);
}

TEST(TextMatrix, WithLinesOfDifferentLengthIsRejectedNamingTheLine) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, "1 2 3\n4 5 6\n7 8\n", test::micrometres()).find("line 3"),
            std::string::npos);
  EXPECT_NE(test::rejection(folder, "1 2 3\n4 x 6\n", test::micrometres()).find("'x' on line 2"),
            std::string::npos);
}

TEST(GwyddionText, EnglishAndGermanHeadersFixSizeAndUnit) {
  const Folder folder;
  const char* english = "# Channel: Main\n# Width: 10 µm\n# Height: 8000 nm\n# Value units: nm\n";
  const char* german = "# Kanal: Main\n# Breite: 10,0 µm\n# Höhe: 8 µm\n# Werteinheiten: nm\n";
  for (const std::string header : {english, german}) {
    const topography::Topography map = test::read_bytes(folder, header + "1 2 3 4\n5 6 7 8\n");
    EXPECT_EQ(map.channel, "Main");
    EXPECT_NEAR(map.grid.dx(), 2.5e-6, 1e-18);
    EXPECT_NEAR(map.grid.dy(), 4e-6, 1e-18);
    EXPECT_DOUBLE_EQ(map.height(1, 3), 8e-9);
  }
}

TEST(GwyddionText, OfThreeColumnsStaysAMatrix) {
  const Folder folder;
  const char* header = "# Channel: a\n# Width: 3 m\n# Height: 4 m\n# Value units: m\n";
  const topography::Topography map =
      test::read_bytes(folder, std::string(header) + "0 0 1\n1 0 2\n0 1 3\n1 1 4\n");
  EXPECT_EQ(map.grid.nx, 3);
  EXPECT_EQ(map.format, "matrix");
}

TEST(WykoText, HeightFactorTurnsPhaseIntoMetres) {
  const Folder folder;
  const std::string header =
      "h=2 w=3\npixel size=2e-007 m\ndata unit=rad\nheight conversion factor (-> m)=1e-007\n";
  const topography::Topography map = test::read_bytes(folder, header + "1 2 3\n4 5 6\n");
  EXPECT_NEAR(map.grid.dx(), 2e-7, 1e-20);
  EXPECT_DOUBLE_EQ(map.height(1, 2), 6e-7);
  EXPECT_NE(test::rejection(folder, header + "1 2 3\n4 5\n").find("3 x 2"), std::string::npos);
}

TEST(NanoscopeText, WithoutLineStructureIsASquare) {
  const Folder folder;
  const std::string header = "\\Exported image units: nm\n";
  ReadOptions options;
  options.pixel_x = 1e-6;
  for (const char* numbers : {"1 2 3 4", "1\n2\n3\n4\n"}) {
    const topography::Topography map = test::read_bytes(folder, header + numbers, options);
    EXPECT_TRUE(test::same_bits(map.height, 1e-9 * matrix(2, 2, {1, 2, 3, 4})));
  }
  EXPECT_NE(test::rejection(folder, header + "1 2 3", options).find("square"), std::string::npos);
}

TEST(TextXyz, IsAMapInEitherScanOrder) {
  const Folder folder;
  const Field expected = matrix(2, 3, {1, 2, 3, 4, 5, 6});
  ReadOptions options = test::micrometres();
  options.unit = "m";
  const char* x_fast = "0 0 1\n.5 0 2\n1 0 3\n0 2 4\n.5 2 5\n1 2 6\n";
  const char* y_fast = "0,0,1\n0,2,4\n\n0.5,0,2\n0.5,2,5\n\n1,0,3\n1,2,6\n";
  const char* serpentine = "0 0 1\n.5 0 2\n1 0 3\n1 2 6\n.5 2 5\n0 2 4\n";
  for (const char* text : {x_fast, y_fast, serpentine}) {
    const topography::Topography map = test::read_bytes(folder, text, options);
    EXPECT_EQ(map.format, "xyz");
    EXPECT_TRUE(test::same_bits(map.height, expected)) << text;
  }
}

TEST(TextXyz, TakesUnitsFromColumnNames) {
  const Folder folder;
  for (const char* names :
       {"x [mm], y [mm], z [um]\n", "# x_mm y_mm z_um\n", "X(mm);Y(mm);Z(um)\n"}) {
    const topography::Topography map =
        test::read_bytes(folder, std::string(names) + "0 0 1\n0.5 0 2\n0 0.5 3\n0.5 0.5 4\n");
    EXPECT_NEAR(map.grid.dx(), 0.5e-3, 1e-15) << names;
    EXPECT_NEAR(map.height(1, 1), 4e-6, 1e-18);
  }
}

TEST(TextXyz, NodesWithoutAPointAreHoles) {
  const Folder folder;
  const topography::Topography map =
      test::read_bytes(folder, "0 0 1\n1 0 2\n2 0 3\n0 1 4\n2 1 6\n", test::micrometres());
  EXPECT_TRUE(std::isnan(map.height(1, 1)));
  EXPECT_EQ(topography::count_holes(map), 1);
}

TEST(TextXyz, ScatteredPointsAreNoMap) {
  const Folder folder;
  const char* scattered = "x_um y_um z_um\n0 0 1\n1.3 0 2\n2 0.4 3\n0.1 1 4\n2.7 1 6\n";
  EXPECT_NE(test::rejection(folder, scattered).find("regular grid"), std::string::npos);
}

TEST(TextProfile, OfTwoColumnsIsOneRow) {
  const Folder folder;
  const topography::Topography map =
      test::read_bytes(folder, "# x_um z_um\n1.5 5\n3 6\n4.5 7\n6 8\n");
  EXPECT_EQ(map.grid.ny, 1);
  EXPECT_EQ(map.grid.nx, 4);
  EXPECT_NEAR(map.grid.dx(), 1.5e-6, 1e-18);
  EXPECT_NEAR(map.height(0, 3), 8e-6, 1e-18);
}

TEST(TextCommas, AreDecimalInFilesLongerThanTheSample) {
  const Folder folder;
  // The first 16384 bytes end in the middle of a number, just behind a comma.
  std::string text = "# Kanal: a\n# Breite: 3 µm\n# Höhe: 3 µm\n# Werteinheiten: µm\n";
  while (text.size() < 20000) text += "1,25\t2,5\t3,75\n";
  for (int shift = 0; shift < 5; ++shift) {
    text.insert(0, shift % 2 == 0 ? "#\n" : "\n");
    const topography::Topography map = test::read_bytes(folder, text);
    EXPECT_EQ(map.grid.nx, 3);
    EXPECT_DOUBLE_EQ(map.height(0, 1), 2.5e-6);
  }
}

TEST(TextCommas, ThatMayBeEitherAreRejected) {
  const Folder folder;
  for (const char* text : {"1.234,5;2.345,6\n3;4\n", "1,234.5\t2,345.6\n1,1\t2,2\n",
                           "1,5;,5\n1;2\n", "1,5\n2,5\n3,5\n"}) {
    EXPECT_NE(test::rejection(folder, text, test::micrometres()).find("write decimal points"),
              std::string::npos)
        << text;
  }
  ReadOptions options;
  options.pixel_x = 1e-6;
  const topography::Topography nanoscope =
      test::read_bytes(folder, "\\Exported image units: nm\n1,5\n2,5\n3,5\n4,5\n", options);
  EXPECT_TRUE(test::same_bits(nanoscope.height, 1e-9 * matrix(2, 2, {1.5, 2.5, 3.5, 4.5})));
}

TEST(TextCommas, OfRemarksDecideNothing) {
  const Folder folder;
  for (const char* text : {"1 2.5\n3 4\n# 1,5 um tip\n", "1,2.5\n3,4\n// a,1,2 b\n",
                           "1;2,5\n3;4\n# done 22.11.2026\n"}) {
    const topography::Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_TRUE(test::same_bits(map.height, 1e-6 * matrix(2, 2, {1, 2.5, 3, 4}))) << text;
  }
}

TEST(TextNumbers, OfOtherProgramsAreUnderstood) {
  const Folder folder;
  const Field expected = 1e-6 * matrix(2, 2, {1.5e-6, -2, test::kNaN, 0});
  const topography::Topography map = test::read_bytes(folder,
                                                      "1.5D-06 \xE2\x88\x92"
                                                      "2\n# a remark\n1e400 1e-400\n",
                                                      test::micrometres());
  EXPECT_TRUE(test::same_bits(map.height, expected));
}

TEST(TextMatrix, WithAnEmptyCellBetweenTabsIsRejected) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, "1\t2\t3\n1\t\t3\n", test::micrometres())
                .find("two tabs in a row on line 2"),
            std::string::npos);
  EXPECT_EQ(test::rejection(folder, "1\t2\t\n1\t2\t\n", test::micrometres()), "");
}

TEST(TextXyz, ColumnsStandWhereTheHeaderSays) {
  const Folder folder;
  const Field expected = 1e-9 * matrix(2, 3, {1, 2, 3, 4, 5, 6});
  for (const char* text : {"y [um];x [um];z [nm]\n0;0;1\n0;1;2\n0;2;3\n1;0;4\n1;1;5\n1;2;6\n",
                           "z_nm x_um y_um\n1 0 0\n2 1 0\n3 2 0\n4 0 1\n5 1 1\n6 2 1\n",
                           "x [um], y [um], light, Höhe "
                           "[nm]\n0,0,7,1\n1,0,7,2\n2,0,7,3\n0,1,7,4\n1,1,7,5\n2,1,7,6\n"}) {
    const topography::Topography map = test::read_bytes(folder, text);
    EXPECT_TRUE(test::same_bits(map.height, expected)) << text;
    EXPECT_NEAR(map.grid.dx(), 1e-6, 1e-15) << text;
  }
  const topography::Topography profile =
      test::read_bytes(folder, "# z_nm x_um of (my, own) profile\n1 0\n2 2\n3 4\n4 6\n");
  EXPECT_TRUE(test::same_bits(profile.height, 1e-9 * matrix(1, 4, {1, 2, 3, 4})));
  EXPECT_NEAR(profile.grid.dx(), 2e-6, 1e-15);
}

TEST(TextXyz, HeightsAreTheColumnThatIsNamedSo) {
  const Folder folder;
  const std::string four = "\n0 0 90 1\n1 0 91 2\n0 1 92 3\n1 1 93 5\n";
  const Field expected = 1e-6 * matrix(2, 2, {1, 2, 3, 5});
  for (const char* header :
       {"X Y Intensity Z", "# x y light height", "# x [um] y [um] light z [um]",
        "# points: x_um y_um light z_um\n# x y light z", "X\tY\tRed light\tHeight"}) {
    const topography::Topography map = test::read_bytes(folder, header + four, test::micrometres());
    EXPECT_TRUE(test::same_bits(map.height, expected)) << header;
  }
  const topography::Topography numbered =
      test::read_bytes(folder, "No;x [um];y [um];z [um]\n1;0;0;1\n2;1;0;2\n3;0;1;3\n4;1;1;5\n");
  EXPECT_TRUE(test::same_bits(numbered.height, expected));
  EXPECT_NE(test::rejection(folder, "X Y Peak Power" + four, test::micrometres()).find("named z"),
            std::string::npos);
}

TEST(TextMatrix, TakesNoUnitFromRemarksOnItsHeight) {
  const Folder folder;
  ReadOptions options;
  options.pixel_x = 1e-6;
  for (const char* header : {"# Width (um): 4\n# Height (um): 3", "# Height[um] = 10",
                             "# height (px): 6", "# Height(512)", "# Height (512 lines)"}) {
    EXPECT_NE(test::rejection(folder, header + std::string("\n1 2 3 4\n5 6 7 9\n"), options)
                  .find("<unit"),
              std::string::npos)
        << header;
  }
}

/// z = 10 ix + iy over 12 x 9 nodes with a given pitch, printed by `place`.
std::string points(const std::function<std::string(double node, int salt)>& place) {
  std::string text;
  for (int iy = 0; iy < 9; ++iy) {
    for (int ix = 0; ix < 12; ++ix) {
      text += place(ix, ix + 5 * iy) + " " + place(iy, 3 * ix + iy) + " " +
              std::to_string(10 * ix + iy) + "\n";
    }
  }
  return text;
}

TEST(TextXyz, CoordinatesMayBeRoundedOrScatterALittle) {
  const Folder folder;
  const auto rounded = [](double pitch) {
    return points(
        [=](double node, int) { return std::to_string(std::round(100 * pitch * node) / 100); });
  };
  const auto scattered = points(
      [](double node, int salt) { return std::to_string(2.5 * (node + 0.02 * std::sin(salt))); });
  for (const auto& [text, pitch] : {std::pair(rounded(1 / 3.0), 1 / 3.0),
                                    {rounded(2.28), 2.28},
                                    {rounded(0.1277), 0.1277},
                                    {scattered, 2.5}}) {
    const topography::Topography map = test::read_bytes(folder, "x_um y_um z_um\n" + text);
    ASSERT_EQ(map.grid.nx, 12) << pitch;
    ASSERT_EQ(map.grid.ny, 9) << pitch;
    EXPECT_NEAR(map.grid.dx() / (pitch * 1e-6), 1, 0.01) << pitch;
    EXPECT_NEAR(map.height(8, 11), 118e-6, 1e-12) << pitch;
    EXPECT_EQ(test::read_bytes(folder, text, test::micrometres()).grid.nx, 12) << pitch;
  }
}

TEST(TextXyz, MissingColumnsAreHolesOfRoundedGrids) {
  const Folder folder;
  std::string text;
  for (int iy = 0; iy < 20; ++iy) {
    for (int ix = 0; ix < 20; ++ix) {
      if (ix > 8 && ix < 15) continue;
      text += fmt::format("{:.2f} {:.2f} {}\n", ix / 3.0, iy / 3.0, ix + 3 * iy);
    }
  }
  const topography::Topography map = test::read_bytes(folder, text, test::micrometres());
  EXPECT_EQ(map.grid.nx, 20);
  EXPECT_EQ(topography::count_holes(map), 6 * 20);
}

TEST(TextXyz, TablesOfPointsAreNeverTakenForAMap) {
  const Folder folder;
  std::string scattered, repeated = "x y z\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n1 1 5\n";
  for (int i = 0; i < 100; ++i) {
    scattered += std::to_string(std::sin(i)) + " " + std::to_string(std::cos(3 * i)) + " 1\n";
  }
  for (const std::string& text : {scattered, repeated}) {
    EXPECT_NE(test::rejection(folder, text, test::micrometres()).find("regular grid"),
              std::string::npos);
  }
}

TEST(TextXyz, KeepsTheRatioOfItsStepsUnderAGivenPixel) {
  const Folder folder;
  const std::string text = "x y z\n0 0 1\n1 0 2\n0 2 3\n1 2 4\n";
  ReadOptions options = test::micrometres();
  EXPECT_NEAR(test::read_bytes(folder, text, options).grid.dy(), 2e-6, 1e-15);
  options.pixel_y = 1e-6;
  EXPECT_NE(test::rejection(folder, text, options).find("as the coordinates have them"),
            std::string::npos);
  options.override_unit = true;
  EXPECT_NEAR(test::read_bytes(folder, text, options).grid.dy(), 1e-6, 1e-15);
}

TEST(TextFile, SaysWhichLineIsNoNumber) {
  const Folder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  EXPECT_NE(test::rejection(folder, "# remark\nLaser scan of 1970\n1 2\n").find("on line 2"),
            std::string::npos);
  const std::string binary("Laser scan of 1970\n\0\1\2", 22);
  EXPECT_EQ(test::rejection(folder, binary).find("line 1"), std::string::npos);
  ::setenv("PATH", path.c_str(), 1);
}

TEST(GwyddionText, UnderstandsLatin1AndTakesNoAmperesForHeights) {
  const Folder folder;
  const topography::Topography map = test::read_bytes(
      folder, "# Kanal: a\n# Breite: 4 um\n# H\xf6he: 8 um\n# Wert: nm\n1 2\n3 4\n");
  EXPECT_NEAR(map.grid.ly, 8e-6, 1e-15);
  EXPECT_NE(test::rejection(folder,
                            "# Channel: Current\n# Width: 4 um\n# Height: 4 um\n# Value units: "
                            "A\n1 2\n3 4\n")
                .find("[A]"),
            std::string::npos);
}

TEST(Sdf, AsciiFollowsTheStandard) {
  const Folder folder;
  const std::string text =
      "aISO-1.0\nManufacID = LAB\nNumPoints = 3\nNumProfiles = 2\nXscale = 1.0E-6\n"
      "Yscale = 2.0E-6\nZscale = 1.0E-9\nZresolution = 1.0E-9\nCompression = 0\nDataType = 5\n"
      "CheckType = 0\n*\n1 2 3\n4 BAD 6\n*\nnotes\n*";
  const topography::Topography map = test::read_bytes(folder, text);
  EXPECT_EQ(map.instrument, "LAB");
  EXPECT_TRUE(test::same_bits(
      map.height, matrix(2, 3, {1.0 * 1e-9, 2 * 1e-9, 3 * 1e-9, 4 * 1e-9, test::kNaN, 6 * 1e-9})));
  EXPECT_NEAR(map.grid.dy(), 2e-6, 1e-18);
}

TEST(Sdf, ProfilesNeedNoSecondSpacing) {
  const Folder folder;
  const topography::Topography map = test::read_bytes(
      folder,
      "aNPL-V1.0\nManuFacID = Softgauges\nNumPoints = 3\nNumProfiles = 1\nXscale = 2.5E-07\n"
      "Yscale = 0\nZscale = 1E-06\nZresolution = -1\nCompression = 0\nDataType = 7\n"
      "CheckType = 0\n*\n-0.5\n0.25\n1\n*\n*\n");
  EXPECT_TRUE(test::same_bits(map.height, matrix(1, 3, {-0.5e-6, 0.25e-6, 1e-6})));
  EXPECT_NEAR(map.grid.dy(), 2.5e-7, 1e-18);
}

TEST(Sdf, ATrailerOfTextIsNoWarning) {
  const Folder folder;
  const auto warnings_behind = [&](const std::string& trailer) {
    test::ByteFile file(81);
    file.text(0, "bISO-1.0").number<std::uint16_t>(42, 2).number<std::uint16_t>(44, 2);
    file.number(46, 1e-6).number(54, 1e-6).number(62, 1e-9).number<std::uint8_t>(79, 5);
    for (const int z : {1, 7, 4, 2}) file.append(static_cast<std::int16_t>(z));
    const auto warnings = texts_of(test::read_bytes(folder, file.bytes() + trailer).warnings);
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("follow the map") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings_behind("Operator = AB\r\n"), 0);
  EXPECT_EQ(warnings_behind(std::string("\x01\x02", 2)), 1);
}

TEST(Sdf, LeastIntegerIsAHole) {
  const Folder folder;
  test::ByteFile file(81);
  file.text(0, "bISO-1.0").number<std::uint16_t>(42, 2).number<std::uint16_t>(44, 1);
  file.number(46, 1e-6).number(54, 1e-6).number(62, 1e-9).number<std::uint8_t>(79, 5);
  file.append<std::int16_t>(-32768).append<std::int16_t>(7);
  const topography::Topography map = test::read_bytes(folder, file.bytes());
  EXPECT_TRUE(test::same_bits(map.height, matrix(1, 2, {test::kNaN, 7 * 1e-9})));
}

}  // namespace
}  // namespace tabor::scan
