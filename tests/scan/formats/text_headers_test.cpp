// Headers of programs that export text.
#include <fmt/format.h>

#include "scan/formats/sample.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kNumbers = "1 2 3 4\n5 6 7 8\n9 10 11 13\n";

Field heights(double factor) {
  Field field(3, 4);
  field << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13;
  return field * factor;
}

std::string nova(const std::string& x, const std::string& scale, const std::string& needed,
                 const std::string& more = "") {
  return "File Format = ASCII\r\nCreated by Nova\r\nNX = 4\r\nNY = 3\r\nScale X = " + x +
         "\r\nScale Y = 0.25\r\nUnit X = um\r\nUnit Data = nm\r\nScale Data = " + scale + "\r\n" +
         (needed.empty() ? "" : "DataScaleNeeded = " + needed + "\r\n") + more +
         "Start of Data :\r\n" + kNumbers;
}

void expect_close(const Field& found, const Field& wanted) {
  ASSERT_EQ(found.rows(), wanted.rows());
  ASSERT_EQ(found.cols(), wanted.cols());
  EXPECT_LT((found - wanted).abs().maxCoeff(), 1e-12 * wanted.abs().maxCoeff());
}

TEST(NovaText, ScaleDataIsAppliedWhereItIsNeeded) {
  const Folder folder;
  for (const char* needed : {"yes", "Yes", ""}) {
    const topography::Topography map = test::read_bytes(folder, nova("0.5", "0.5", needed));
    expect_close(map.height, heights(0.5e-9));
    EXPECT_NEAR(map.grid.dx(), 0.5e-6, 1e-15);
    EXPECT_NEAR(map.grid.dy(), 0.25e-6, 1e-15);
  }
  expect_close(test::read_bytes(folder, nova("0,5", "0,5", "yes", "Bias Data = 2\r\n")).height,
               heights(0.5e-9) + 2e-9);
  expect_close(test::read_bytes(folder, nova("0.5", "0.5", "no")).height, heights(1e-9));
}

TEST(NovaText, AStepOfZeroIsNoPixelAndANegativeOneIsNamed) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, nova("0", "1", "no")),
              AllOf(HasSubstr("no pixel size in the file (Scale X 0)"), HasSubstr("<pixel")));
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.pixel_y = 0.25e-6;
  EXPECT_NEAR(test::read_bytes(folder, nova("0", "1", "no"), options).grid.dx(), 1e-6, 1e-15);
  EXPECT_THAT(test::rejection(folder, nova("-0.5", "1", "no"), options),
              AllOf(HasSubstr("Scale X -0.5"), HasSubstr("<override_unit")));
}

TEST(NovaText, WithoutAllItsNumbersIsRejected) {
  const Folder folder;
  const std::string text = nova("0.5", "1", "no");
  EXPECT_THAT(test::rejection(folder, text.substr(0, text.size() - 4)),
              HasSubstr("expected 4 x 3 as its header says"));
}

std::string spip(const std::string& more, char sign = '=', const std::string& unit = "nm") {
  std::string text = "# File Format = ASCII\n# Created by SPIP 6.3.2.0\n";
  for (const char* item : {"x-pixels4", "y-pixels3", "x-length2000", "y-length1500", "x-offset0"}) {
    const std::string line = item;
    const std::size_t digit = line.find_first_of("0123456789");
    text += fmt::format("# {}{} {}\n", line.substr(0, digit), sign, line.substr(digit));
  }
  if (!unit.empty()) text += fmt::format("# z-unit{} {}\n", sign, unit);
  return text + more + "# Start of Data:\n" + kNumbers;
}

TEST(SpipText, LengthsAreInNanometresAndHeightsAsStated) {
  const Folder folder;
  for (const auto& [text, unit] : {std::pair(spip("# voidpixels =0\n"), 1e-9),
                                   {spip("", '=', "[um]"), 1e-6},
                                   {spip("# Bit2nm = 0.5\n", '=', ""), 0.5e-9}}) {
    const topography::Topography map = test::read_bytes(folder, text);
    expect_close(map.height, heights(unit));
    EXPECT_NEAR(map.grid.dx(), 500e-9, 1e-16);
    EXPECT_NEAR(map.grid.dy(), 500e-9, 1e-16);
  }
  const std::string attocube = spip("# x-unit: um\n# y-unit: um\n", ':');
  EXPECT_NEAR(test::read_bytes(folder, attocube).grid.dx(), 500e-6, 1e-12);
}

TEST(SpipText, AMapBehindTheHeightsTellsVoidPixels) {
  const Folder folder;
  const topography::Topography map =
      test::read_bytes(folder, spip("# voidpixels = 2\n") + "1 1 1 1\n1 0 1 1\n1 1 1 0\n");
  EXPECT_EQ(map.grid.ny, 3);
  EXPECT_EQ(topography::count_holes(map), 2);
  EXPECT_TRUE(std::isnan(map.height(1, 1)));
  EXPECT_TRUE(std::isnan(map.height(2, 3)));
  EXPECT_NEAR(map.height(0, 3), 4e-9, 1e-18);
}

TEST(SpipText, OfAnotherSizeOrWithoutLengthSaysSo) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, spip("# x-pixels = 5\n")), HasSubstr("5 x 3"));
  EXPECT_THAT(test::rejection(folder, spip("# x-length = 0\n")),
              HasSubstr("no pixel size in the file (x-length 0)"));
}

TEST(GwyddionText, IsUnderstoodInTheLanguagesOfItsExports) {
  const Folder folder;
  for (const auto& [channel, width, height, unit] :
       {std::tuple("Kanál:", "Šířka:", "Výška:", "Jednotky hodnot:"),
        {"Kanal:", "Breite:", "Höhe:", "Einheiten:"},
        {"Canal :", "Largeur :", "Hauteur :", "Unités :"},
        {"Canale:", "Larghezza:", "Altezza:", "unità valore:"},
        {"Canal:", "Anchura:", "Altura:", "Unidades de valor:"},
        {"チャネル：", "幅:", "高さ：", "値の単位:"},
        {"Канал:", "Ширина:", "Высота:", "Единицы измерения:"}}) {
    const topography::Topography map =
        test::read_bytes(folder, fmt::format("# {} Topo\n# {} 4.000 µm\n# {} 3.000 µm\n# {} nm\n{}",
                                             channel, width, height, unit, kNumbers));
    EXPECT_EQ(map.channel, "Topo") << width;
    EXPECT_NEAR(map.grid.dy(), 1e-6, 1e-15) << width;
    expect_close(map.height, heights(1e-9));
  }
}

TEST(GwyddionText, AWidthWithoutAUnitIsAskedFor) {
  const Folder folder;
  const std::string text = std::string("# Width: 4 px\n# Height: 3 px\n# Value units: nm\n");
  EXPECT_THAT(test::rejection(folder, text + kNumbers),
              AllOf(HasSubstr("'4 px', no length"), HasSubstr("<pixel")));
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_NEAR(test::read_bytes(folder, text + kNumbers, options).grid.dx(), 1e-6, 1e-15);
}

TEST(QuotedText, IsReadWithoutItsQuotes) {
  const Folder folder;
  Field expected(2, 2);
  expected << 1.5, 2, -3.25, 4;
  expected *= 1e-6;
  for (const char* text :
       {"\"1.5\",\"2\"\n\"-3.25\",\"4\"\n", "\"1,5\";\"2\"\r\n\"-3,25\";\"4\"\r\n",
        "\"1,5\",\"2\"\n\"-3,25\",\"4\"\n", "\"1.5\"\t2\n-3.25\t\"4\"\n"}) {
    EXPECT_TRUE(
        test::same_bits(test::read_bytes(folder, text, test::micrometres()).height, expected))
        << text;
  }
  const topography::Topography profile = test::read_bytes(
      folder,
      "\"x [um]\",\"z, smoothed [um]\"\n\"0\",\"1\"\n\"2\",\"5\"\n\"4\",\"3\"\n\"6\",\"2\"\n");
  EXPECT_EQ(profile.format, "profile");
  EXPECT_NEAR(profile.height(0, 1), 5e-6, 1e-15);
  EXPECT_THAT(test::rejection(folder, "\"1,234.5\",\"2\"\n\"3\",\"4\"\n", test::micrometres()),
              HasSubstr("\"1"));
}

}  // namespace
}  // namespace tabor::scan
