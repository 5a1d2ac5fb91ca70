#include "topography/formats/sample.hpp"

namespace tabor::topography {
namespace {

using test::Folder;

Field matrix(Index ny, Index nx, std::initializer_list<double> values) {
  Field field(ny, nx);
  std::copy(values.begin(), values.end(), field.data());
  return field;
}

TEST(TextMatrix, WithoutUnitOrPixelIsRefusedNamingTheFlags) {
  const Folder folder;
  EXPECT_NE(test::refusal(folder, "1 2\n3 4\n").find("--pixel 0.67um --unit um"),
            std::string::npos);
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_NE(test::refusal(folder, "1 2\n3 4\n", options).find("--unit"), std::string::npos);
}

TEST(TextMatrix, TakesEveryUsualSeparatorAndLineEnd) {
  const Folder folder;
  const Field expected = 1e-6 * matrix(2, 3, {1.5, 2, -3, 4, 5, 6});
  for (const char* text :
       {"1.5 2 -3\n4 5 6\n", "1.5\t2\t-3\r\n4\t5\t6\r\n", "1.5,2,-3\n4,5,6", "1.5;2;-3;\n4;5;6;\n",
        "1,5;2;-3\n4;5;6\n", "1,5 2 -3\n4,0 5 6\n", "\xEF\xBB\xBF 1.5 2 -3\n\n+4 5e0 6\n\n",
        "# a remark\n1.5, 2, -3\n4, 5, 6\n"}) {
    const Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_TRUE(test::same_bits(map.height, expected)) << text;
  }
}

TEST(TextMatrix, ReadsEveryWordForAHole) {
  const Folder folder;
  for (const char* hole : {"NaN", "nan", "NM", "BAD", "---", "inf"}) {
    const std::string text = std::string("1 2 3\n4 ") + hole + " 6\n";
    const Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_TRUE(std::isnan(map.height(1, 1))) << hole;
    EXPECT_EQ(count_holes(map), 1);
  }
  EXPECT_EQ(count_holes(test::read_bytes(folder, "1,2,3\n4,,6\n", test::micrometres())), 1);
}

TEST(TextMatrix, WithLinesOfDifferentLengthIsRefusedNamingTheLine) {
  const Folder folder;
  EXPECT_NE(test::refusal(folder, "1 2 3\n4 5 6\n7 8\n", test::micrometres()).find("line 3"),
            std::string::npos);
  EXPECT_NE(test::refusal(folder, "1 2 3\n4 x 6\n", test::micrometres()).find("'x' on line 2"),
            std::string::npos);
}

TEST(GwyddionText, EnglishAndGermanHeadersFixSizeAndUnit) {
  const Folder folder;
  const char* english = "# Channel: Main\n# Width: 10 µm\n# Height: 8000 nm\n# Value units: nm\n";
  const char* german = "# Kanal: Main\n# Breite: 10,0 µm\n# Höhe: 8 µm\n# Werteinheiten: nm\n";
  for (const std::string header : {english, german}) {
    const Topography map = test::read_bytes(folder, header + "1 2 3 4\n5 6 7 8\n");
    EXPECT_EQ(map.channel, "Main");
    EXPECT_NEAR(map.grid.dx(), 2.5e-6, 1e-18);
    EXPECT_NEAR(map.grid.dy(), 4e-6, 1e-18);
    EXPECT_DOUBLE_EQ(map.height(1, 3), 8e-9);
  }
}

TEST(GwyddionText, OfThreeColumnsStaysAMatrix) {
  const Folder folder;
  const char* header = "# Channel: a\n# Width: 3 m\n# Height: 4 m\n# Value units: m\n";
  const Topography map =
      test::read_bytes(folder, std::string(header) + "0 0 1\n1 0 2\n0 1 3\n1 1 4\n");
  EXPECT_EQ(map.grid.nx, 3);
  EXPECT_EQ(map.format, "matrix");
}

TEST(WykoText, HeightFactorTurnsPhaseIntoMetres) {
  const Folder folder;
  const std::string header =
      "h=2 w=3\npixel size=2e-007 m\ndata unit=rad\nheight conversion factor (-> m)=1e-007\n";
  const Topography map = test::read_bytes(folder, header + "1 2 3\n4 5 6\n");
  EXPECT_NEAR(map.grid.dx(), 2e-7, 1e-20);
  EXPECT_DOUBLE_EQ(map.height(1, 2), 6e-7);
  EXPECT_NE(test::refusal(folder, header + "1 2 3\n4 5\n").find("3 x 2"), std::string::npos);
}

TEST(NanoscopeText, WithoutLineStructureIsASquare) {
  const Folder folder;
  const std::string header = "\\Exported image units: nm\n";
  ReadOptions options;
  options.pixel_x = 1e-6;
  for (const char* numbers : {"1 2 3 4", "1\n2\n3\n4\n"}) {
    const Topography map = test::read_bytes(folder, header + numbers, options);
    EXPECT_TRUE(test::same_bits(map.height, 1e-9 * matrix(2, 2, {1, 2, 3, 4})));
  }
  EXPECT_NE(test::refusal(folder, header + "1 2 3", options).find("square"), std::string::npos);
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
    const Topography map = test::read_bytes(folder, text, options);
    EXPECT_EQ(map.format, "xyz");
    EXPECT_TRUE(test::same_bits(map.height, expected)) << text;
  }
}

TEST(TextXyz, TakesUnitsFromColumnNames) {
  const Folder folder;
  for (const char* names :
       {"x [mm], y [mm], z [um]\n", "# x_mm y_mm z_um\n", "X(mm);Y(mm);Z(um)\n"}) {
    const Topography map =
        test::read_bytes(folder, std::string(names) + "0 0 1\n0.5 0 2\n0 0.5 3\n0.5 0.5 4\n");
    EXPECT_NEAR(map.grid.dx(), 0.5e-3, 1e-15) << names;
    EXPECT_NEAR(map.height(1, 1), 4e-6, 1e-18);
  }
}

TEST(TextXyz, NodesWithoutAPointAreHoles) {
  const Folder folder;
  const Topography map =
      test::read_bytes(folder, "0 0 1\n1 0 2\n2 0 3\n0 1 4\n2 1 6\n", test::micrometres());
  EXPECT_TRUE(std::isnan(map.height(1, 1)));
  EXPECT_EQ(count_holes(map), 1);
}

TEST(TextXyz, ScatteredPointsAreNoMap) {
  const Folder folder;
  const char* scattered = "x_um y_um z_um\n0 0 1\n1.3 0 2\n2 0.4 3\n0.1 1 4\n2.7 1 6\n";
  EXPECT_NE(test::refusal(folder, scattered).find("regular grid"), std::string::npos);
}

TEST(TextProfile, OfTwoColumnsIsOneRow) {
  const Folder folder;
  const Topography map = test::read_bytes(folder, "# x_um z_um\n1.5 5\n3 6\n4.5 7\n6 8\n");
  EXPECT_EQ(map.grid.ny, 1);
  EXPECT_EQ(map.grid.nx, 4);
  EXPECT_NEAR(map.grid.dx(), 1.5e-6, 1e-18);
  EXPECT_NEAR(map.height(0, 3), 8e-6, 1e-18);
}

TEST(Sdf, AsciiFollowsTheStandard) {
  const Folder folder;
  const std::string text =
      "aISO-1.0\nManufacID = LAB\nNumPoints = 3\nNumProfiles = 2\nXscale = 1.0E-6\n"
      "Yscale = 2.0E-6\nZscale = 1.0E-9\nZresolution = 1.0E-9\nCompression = 0\nDataType = 5\n"
      "CheckType = 0\n*\n1 2 3\n4 BAD 6\n*\nnotes\n*";
  const Topography map = test::read_bytes(folder, text);
  EXPECT_EQ(map.instrument, "LAB");
  EXPECT_TRUE(test::same_bits(
      map.height, matrix(2, 3, {1.0 * 1e-9, 2 * 1e-9, 3 * 1e-9, 4 * 1e-9, test::kNaN, 6 * 1e-9})));
  EXPECT_NEAR(map.grid.dy(), 2e-6, 1e-18);
}

TEST(Sdf, LeastIntegerIsAHole) {
  const Folder folder;
  test::ByteFile file(81);
  file.text(0, "bISO-1.0").number<std::uint16_t>(42, 2).number<std::uint16_t>(44, 1);
  file.number(46, 1e-6).number(54, 1e-6).number(62, 1e-9).number<std::uint8_t>(79, 5);
  file.append<std::int16_t>(-32768).append<std::int16_t>(7);
  const Topography map = test::read_bytes(folder, file.bytes());
  EXPECT_TRUE(test::same_bits(map.height, matrix(1, 2, {test::kNaN, 7 * 1e-9})));
}

}  // namespace
}  // namespace tabor::topography
