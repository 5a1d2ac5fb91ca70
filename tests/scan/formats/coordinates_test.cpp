// What looks like coordinates is never a height; what stands in one file beside another map is no
// part of it.
#include <fmt/format.h>

#include <functional>

#include "scan/formats/sample.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A height that is no straight line in anything.
double bump(int i) { return std::round(1e4 * std::sin(0.7 * i * i + i)) / 1e4; }

constexpr int kLength = 40;

/// Lines of a profile, x in steps of 0.5 beside z, but for the places that `is_missing`.
std::string profile(const std::function<std::string(int i, double x, double z)>& line,
                    const std::function<bool(int i)>& is_missing = {}) {
  std::string text;
  for (int i = 0; i < kLength; ++i) {
    if (is_missing && is_missing(i)) continue;
    text += line(i, 0.5 * i, bump(i)) + "\n";
  }
  return text;
}

std::string x_z(int, double x, double z) { return fmt::format("{:.4f}\t{:.6f}", x, z); }

bool in_gap(int i) { return i > 10 && i < 22; }

/// The profile [um] with holes where lines are missing.
Field expected(const std::function<bool(int i)>& is_missing = {}) {
  Field field(1, kLength);
  for (int i = 0; i < kLength; ++i) {
    field(0, i) = is_missing && is_missing(i) ? test::kNaN : 1e-6 * bump(i);
  }
  return field;
}

void expect_profile(const topography::Topography& map, const Field& heights) {
  EXPECT_EQ(map.format, "profile");
  EXPECT_TRUE(test::same_bits(map.height, heights));
}

constexpr const char* kNames = "x [um]\tz [um]\n";

/// What completes a file, if its header names no unit.
ReadOptions options_for(const std::string& header) {
  return header.find("um") == std::string::npos ? test::micrometres() : ReadOptions{};
}

TEST(TextProfile, AGapIsHoles) {
  const Folder folder;
  for (const std::string header : {kNames, "# x_um z_um\n", ""}) {
    const topography::Topography map =
        test::read_bytes(folder, header + profile(x_z, in_gap), options_for(header));
    expect_profile(map, expected(in_gap));
    EXPECT_NEAR(map.grid.dx(), header.empty() ? 1e-6 : 0.5e-6, 1e-15) << header;
  }
}

TEST(TextProfile, FallingCoordinatesAreReadBackwards) {
  const Folder folder;
  const auto falling = [](int, double x, double z) { return x_z(0, 100 - x, z); };
  for (const std::string header : {kNames, ""}) {
    const topography::Topography map =
        test::read_bytes(folder, header + profile(falling), options_for(header));
    expect_profile(map, expected().rowwise().reverse());
  }
}

TEST(TextProfile, NumbersOfTheLinesAreNoHeights) {
  const Folder folder;
  const auto numbered = [](int i, double x, double z) {
    return fmt::format("{}\t{}", i + 1, x_z(i, x, z));
  };
  for (const std::string header : {"No\tx [um]\tz [um]\n", "# Index;x;z\n", ""}) {
    expect_profile(test::read_bytes(folder, header + profile(numbered), options_for(header)),
                   expected());
  }
}

TEST(TextProfile, CoordinatesMayStandBehindHeights) {
  const Folder folder;
  const auto behind = [](int, double x, double z) { return fmt::format("{};{}", z, x); };
  for (const std::string header : {"z [um];x [um]\n", ""}) {
    expect_profile(test::read_bytes(folder, header + profile(behind), options_for(header)),
                   expected());
  }
}

TEST(TextProfile, ColumnsMayBeNamedXAndY) {
  const Folder folder;
  const topography::Topography map =
      test::read_bytes(folder, "x [mm]\ty [um]\n" + profile(x_z, in_gap));
  expect_profile(map, expected(in_gap));
  EXPECT_NEAR(map.grid.dx(), 0.5e-3, 1e-12);
}

TEST(TextProfile, EveryColumnBesideANamedXIsAChannel) {
  const Folder folder;
  const std::string text =
      "# x [um];before [um];after [um]\n" +
      profile([](int, double x, double z) { return fmt::format("{};{};{}", x, z, 2 * z); });
  EXPECT_THAT(test::rejection(folder, text), HasSubstr("2 height channels"));
  ReadOptions options;
  options.channel = "column 2";
  options.unit = "um";
  expect_profile(test::read_bytes(folder, text, options), expected());
}

TEST(TextProfile, OfUnevenCoordinatesIsRejectedNotAMap) {
  const Folder folder;
  const auto uneven = [](int i, double, double z) { return x_z(i, std::pow(i, 1.7), z); };
  const auto repeated = [](int i, double, double z) { return x_z(i, 0.5 * (i % 13), z); };
  EXPECT_THAT(test::rejection(folder, kNames + profile(repeated), test::micrometres()),
              HasSubstr("not evenly spaced, each once"));
  for (const std::string header : {kNames, "position;z [um]\n", ""}) {
    EXPECT_THAT(test::rejection(folder, header + profile(uneven), test::micrometres()),
                HasSubstr("not evenly spaced"))
        << header;
  }
}

TEST(TextPoints, AlongASlantedLineAreNotTakenForAMap) {
  const Folder folder;
  const auto slanted = [](int i, double x, double z) {
    return fmt::format("{} {}", 3 * x, x_z(i, x, z));
  };
  EXPECT_THAT(test::rejection(folder, profile(slanted), test::micrometres()),
              HasSubstr("two columns of evenly spaced coordinates"));
}

TEST(TextPoints, OfAGridThatIsMostlyEmptyAreNotTakenForAMap) {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 24; ++i) {
    text += fmt::format("{} {} {}\n", 0.5 * (7 * i % 11), 2.0 * (5 * i % 12), bump(i));
  }
  EXPECT_THAT(test::rejection(folder, text, test::micrometres()), HasSubstr("regular grid"));
}

/// A NumPy array of two columns.
std::string npy(const std::function<double(int i)>& first) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 2), }}", kLength);
  header.resize(117, ' ');
  test::ByteFile file;
  file.text(0, "\x93NUMPY\x01" + std::string(1, '\0'));
  file.append(static_cast<std::uint16_t>(header.size() + 1)).text(10, header + "\n");
  for (int i = 0; i < kLength; ++i) file.append(first(i)).append(bump(i));
  return file.bytes();
}

TEST(NpyTable, OfCoordinatesAndHeightsIsNoMap) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, npy([](int i) { return 50 - 0.5 * i; }), test::micrometres()),
              HasSubstr("evenly spaced coordinates"));
  EXPECT_EQ(test::rejection(folder, npy([](int i) { return bump(i + 3); }), test::micrometres()),
            "");
}

constexpr int kRows = 9, kColumns = 7;

/// A matrix of bumps; with a row of x and a column of y if these are given their steps.
std::string matrix(double x_step, double y_step, const std::string& corner = "0") {
  std::string text;
  for (int row = x_step != 0 ? -1 : 0; row < kRows; ++row) {
    for (int column = y_step != 0 ? -1 : 0; column < kColumns; ++column) {
      text += row < 0 && column < 0 ? corner
              : row < 0             ? fmt::format("{}", x_step * column)
              : column < 0          ? fmt::format("{}", y_step * row)
                                    : fmt::format("{}", bump(row * kColumns + column));
      text += column + 1 < kColumns ? ";" : "\n";
    }
  }
  return text;
}

Field bumps() {
  Field field(kRows, kColumns);
  for (int i = 0; i < kRows * kColumns; ++i) field.data()[i] = 1e-6 * bump(i);
  return field;
}

TEST(TextMatrix, CoordinatesInTheFirstRowOrColumnAreNoHeightsAndSaid) {
  const Folder folder;
  for (const auto& [x_step, y_step] :
       {std::pair(0.5, 0.25), {0.5, 0.0}, {0.0, 0.25}, {-2.0, -3.0}}) {
    const topography::Topography map =
        test::read_bytes(folder, matrix(x_step, y_step), test::micrometres());
    EXPECT_TRUE(test::same_bits(map.height, bumps())) << x_step << " " << y_step;
    EXPECT_THAT(texts_of(map.warnings), Contains(HasSubstr("evenly spaced")));
  }
  const topography::Topography both =
      test::read_bytes(folder, matrix(0.5, 0.25, "NaN"), test::micrometres());
  EXPECT_TRUE(test::same_bits(both.height, bumps()));
  EXPECT_NEAR(both.grid.dy(), 0.5e-6, 1e-15);  // as high as the steps say
}

TEST(TextMatrix, KeepsARowAndColumnThatAreLikeTheNext) {
  const Folder folder;
  std::string plane;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) plane += fmt::format("{} ", 3 * column - row);
    plane += '\n';
  }
  for (const std::string& text : {plane, matrix(0, 0)}) {
    const topography::Topography map = test::read_bytes(folder, text, test::micrometres());
    EXPECT_EQ(map.grid.nx, kColumns);
    EXPECT_EQ(map.grid.ny, kRows);
    EXPECT_THAT(texts_of(map.warnings), Not(Contains(HasSubstr("evenly spaced"))));
  }
}

TEST(TextMatrix, OfAStatedWidthHasNoCoordinates) {
  const Folder folder;
  const topography::Topography map = test::read_bytes(
      folder, "# Width: 8 um\n# Height: 10 um\n# Value units: um\n" + matrix(0.5, 0.25));
  EXPECT_EQ(map.grid.nx, kColumns + 1);
  EXPECT_EQ(map.grid.ny, kRows + 1);
}

std::string block(const std::string& channel, const std::string& unit, double factor) {
  return fmt::format(
      "# Channel: {}\n# Width: 4.000 µm\n# Height: 1.000 µm\n# Value units: {}\n{} {}\n{} {}\n\n",
      channel, unit, factor, 2 * factor, 3 * factor, 5 * factor);
}

TEST(TextBlocks, WithAHeaderEachAreChannels) {
  const Folder folder;
  const Field heights = 1e-9 * (Field(2, 2) << 1, 2, 3, 5).finished();
  const topography::Topography map =
      test::read_bytes(folder, block("Height", "nm", 1) + block("Phase", "deg", 7));
  EXPECT_TRUE(test::same_bits(map.height, heights));
  EXPECT_NEAR(map.grid.dx(), 2e-6, 1e-15);
  EXPECT_NEAR(map.grid.dy(), 0.5e-6, 1e-15);
  EXPECT_EQ(map.channel, "Height");
  const std::string three =
      block("Height", "nm", 1) + block("Phase", "deg", 7) + block("Zoom", "nm", 4);
  EXPECT_THAT(test::rejection(folder, three),
              HasSubstr("got 2 height channels: 0 'Height' [nm], 2 'Zoom' [nm]; expected one"));
  ReadOptions options;
  options.channel = "Zoom";
  EXPECT_TRUE(test::same_bits(test::read_bytes(folder, three, options).height, 4 * heights));
}

TEST(TextBlocks, WithoutHeadersAreRejected) {
  const Folder folder;
  for (const char* between : {"\n", "\n\n", "# the second map\n"}) {
    EXPECT_THAT(test::rejection(folder, matrix(0, 0) + between + matrix(0, 0), test::micrometres()),
                HasSubstr("2 blocks of numbers, the first one of 9 rows up to line 9"));
  }
}

TEST(TextBlocks, ThatAreBadlyMadeNameTheLineOfTheFile) {
  const Folder folder;
  const std::string text = block("Height", "nm", 1) + block("Phase", "deg", 7);
  EXPECT_THAT(test::rejection(folder, text + "1 x\n"), HasSubstr("'x' on line 15"));
}

}  // namespace
}  // namespace tabor::scan
