// PLUX, VK, BCR, DATX and TIFF beyond what holds for every instrument's file.
#include "support/container_files.hpp"

#include <cstdlib>

#include "scan/formats/sample.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

ReadOptions counts_of(double metres) {
  ReadOptions options;
  options.pixel_x = 2e-6;
  options.pixel_y = 4e-6;
  options.z_scale = metres;
  return options;
}

Field one_to_six() {
  Field field(2, 3);
  field << 1, 2, 3, 4, 5, 6;
  return field;
}

TEST(Plux, LayersAreChannels) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, test::two_layer_plux()).find("<channel=0>"), std::string::npos);
  ReadOptions options;
  options.channel = "1";
  const topography::Topography map = test::read_bytes(folder, test::two_layer_plux(), options);
  EXPECT_NEAR(map.height(0, 1), 20e-6, 1e-12);
  EXPECT_EQ(map.instrument, "Sensofar S neox");
}

TEST(Plux, AnArchiveWithAnotherIndexIsNotPlux) {
  const Folder folder;
  const std::string bytes = io::zip({{"index.xml", "<html/>"}});
  EXPECT_NE(test::rejection(folder, bytes).find("index.xml without an image size"),
            std::string::npos);
}

TEST(Vk, LightIsListedButHoldsNoHeights) {
  const Folder folder;
  test::put_bytes(folder / "a.vk4", test::vk4());
  const FileInfo info = inspect(folder / "a.vk4");
  ASSERT_EQ(info.channels.size(), 2u);
  EXPECT_EQ(info.channels[0].name, "light 1");
  EXPECT_FALSE(info.channels[0].is_height);
  EXPECT_TRUE(info.channels[1].is_height);
}

TEST(Vk, KeepsThePixelAsTheFileGivesIt) {
  const Folder folder;
  // Other programs make the field one pixel shorter: (n - 1) pixels.
  EXPECT_NEAR(test::read_bytes(folder, test::vk4()).grid.lx, 3 * 2e-6, 1e-18);
}

TEST(Bcr, BigEndianAndUtf16HeadersGiveTheSameHeights) {
  const Folder folder;
  const Field narrow = test::read_bytes(folder, test::bcrf(false)).height;
  EXPECT_TRUE(test::same_bits(test::read_bytes(folder, test::bcrf(true)).height, narrow));
  EXPECT_NEAR(test::read_bytes(folder, test::bcr()).height(1, 0), 2e-9, 1e-18);
}

TEST(Datx, FollowsItsTableToHeightsAndScales) {
  const Folder folder;
  test::write_datx(folder / "a.datx");
  const topography::Topography map = read(folder / "a.datx");
  EXPECT_EQ(map.format, "datx");
  EXPECT_EQ(topography::count_holes(map), 1);
  EXPECT_DOUBLE_EQ(map.height(1, 1), 5e-9);
  EXPECT_DOUBLE_EQ(map.grid.dx(), 2e-6);
  EXPECT_DOUBLE_EQ(map.grid.dy(), 4e-6);
}

TEST(Datx, HeightsInFringesAreRejected) {
  const Folder folder;
  test::write_datx(folder / "a.datx", "Fringes");
  EXPECT_NE(test::rejection(folder / "a.datx").find("[Fringes]"), std::string::npos);
}

TEST(Datx, TruncatedOrWithFlippedBitsNeverBreaksTheProgram) {
  const Folder folder;
  test::write_datx(folder / "a.datx");
  const std::string bytes = test::bytes_of(folder / "a.datx");
  for (std::size_t size = 0; size < bytes.size(); size += 499) {
    EXPECT_NE(test::rejection(folder, bytes.substr(0, size)), "") << size;
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 1009) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, flipped)) << bit;
  }
}

TEST(Tiff, CountsNeedPixelAndScale) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, test::tiff()).find("<pixel"), std::string::npos);
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_NE(test::rejection(folder, test::tiff(), options).find("<z_scale"), std::string::npos);
}

TEST(Tiff, EveryGreySampleTypeGivesItsCounts) {
  const Folder folder;
  const Field expected = 1e-9 * one_to_six();
  for (const auto& [bits, format] : {std::pair(8, 1), {16, 1}, {32, 1}, {32, 3}}) {
    const topography::Topography map =
        test::read_bytes(folder, test::tiff(bits, format), counts_of(1e-9));
    EXPECT_TRUE(test::same_bits(map.height, expected)) << bits << " " << format;
    EXPECT_DOUBLE_EQ(map.grid.dy(), 4e-6);
  }
  const topography::Topography below_zero =
      test::read_bytes(folder, test::tiff(16, 2), counts_of(1e-9));
  EXPECT_EQ(below_zero.height(0, 0), -1e-9);
}

TEST(Tiff, SamplesNamedAsMissingAreHoles) {
  const Folder folder;
  for (const auto& [bits, format] : {std::pair(16, 1), {32, 3}}) {
    const topography::Topography map =
        test::read_bytes(folder, test::tiff(bits, format, 1, "2.0"), counts_of(1));
    EXPECT_TRUE(std::isnan(map.height(0, 1)));
    EXPECT_EQ(map.height.isNaN().count(), 1);
  }
  for (const char* other : {"9", "nan", "no"}) {
    const topography::Topography map =
        test::read_bytes(folder, test::tiff(16, 1, 1, other), counts_of(1));
    EXPECT_FALSE(map.height.isNaN().any()) << other;
  }
}

TEST(Tiff, WhereWhiteIsZeroGivesTheCountsOfTheFileAndSaysSo) {
  const Folder folder;
  for (const int bits : {8, 16}) {
    const topography::Topography dark =
        test::read_bytes(folder, test::tiff(bits, 1, 0), counts_of(1e-9));
    const topography::Topography bright =
        test::read_bytes(folder, test::tiff(bits, 1, 1), counts_of(1e-9));
    EXPECT_TRUE(test::same_bits(dark.height, bright.height)) << bits;
    EXPECT_EQ(dark.format, "tiff");
    EXPECT_THAT(texts_of(dark.warnings), testing::Contains(testing::HasSubstr("White is zero")));
  }
}

TEST(Pgm, GreyValuesAreCountsWhateverTheLargestOneIs) {
  const Folder folder;
  Field expected(2, 3);
  expected << 1, 2, 3, 4, 5, 250;
  const std::string large("\0\1\0\2\0\3\0\4\0\5\0\xfa", 12);
  for (const std::string& bytes : {std::string("P5\n3 2\n255\n\1\2\3\4\5\xfa"),
                                   "P5 3 2 65535\n" + large, "P5\n# a remark\n3\n2\n4095\n" + large,
                                   std::string("P2\n3 2 # wide\n250\n1 2 3 4\n5 250\n")}) {
    const topography::Topography map = test::read_bytes(folder, bytes, counts_of(10e-9));
    EXPECT_EQ(map.format, "pgm");
    EXPECT_TRUE(test::same_bits(map.height, 10e-9 * expected)) << bytes;
  }
}

TEST(Pgm, OfAnotherKindOrCutShortIsRejected) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, std::string("P6\n1 1\n255\nabc"), counts_of(1)),
              testing::HasSubstr("a colour picture"));
  EXPECT_THAT(test::rejection(folder, std::string("P4\n8 1\na"), counts_of(1)),
              testing::HasSubstr("black and white"));
  EXPECT_THAT(test::rejection(folder, std::string("P5\n3 2\n255\nabc"), counts_of(1)),
              testing::HasSubstr("3 x 2"));
  EXPECT_THAT(test::rejection(folder, std::string("P5\n3 2\n70000\nabcdef"), counts_of(1)),
              testing::HasSubstr("1 to 65535"));
  EXPECT_THAT(test::rejection(folder, std::string("P2\n2 1\n9\n1 x"), counts_of(1)),
              testing::HasSubstr("'x' where its grey value stands"));
  EXPECT_THAT(test::rejection(folder, std::string("P2\n2 2\n9\n1 2 3 "), counts_of(1)),
              testing::HasSubstr("'' where its grey value stands"));
}

TEST(Tiff, ColoursAreRejected) {
  const Folder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);  // Gwyddion would make grey values of the colours
  EXPECT_NE(
      test::rejection(folder, test::tiff(16, 1, 2), counts_of(1e-9)).find("no plain grey picture"),
      std::string::npos);
  ::setenv("PATH", path.c_str(), 1);
}

TEST(Tiff, TruncatedOrWithFlippedBitsNeverBreaksTheProgram) {
  const Folder folder;
  const std::string bytes = test::tiff();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, bytes.substr(0, size), counts_of(1e-9)));
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 3) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, flipped, counts_of(1e-9))) << bit;
  }
}

/// What Gwyddion makes of the same bytes.
class AgainstGwyddion : public ::testing::TestWithParam<std::pair<const char*, std::string>> {};

TEST_P(AgainstGwyddion, HeightsAreTheSame) {
  const auto gwyddion = io::find_program("gwyddion");
  if (!gwyddion) {
    GTEST_SKIP() << "Gwyddion is not installed";
  }
  const Folder folder;
  const auto& [name, bytes] = GetParam();
  test::put_bytes(folder / name, bytes);
  const auto run = io::run_program(
      *gwyddion, {"--convert-to-gwy=" + (folder / "back.gwy").string(), (folder / name).string()},
      {{"HOME", folder.path().string()}}, std::chrono::seconds(60));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  ReadOptions heights;
  if (std::string(name) == "a.vk4") heights.channel = "0";
  const Field theirs = read(folder / "back.gwy", heights).height;
  const Field ours = read(folder / name).height;
  ASSERT_EQ((theirs.isNaN() != ours.isNaN()).count(), 0) << theirs;
  EXPECT_LE((theirs - ours).isNaN().select(0, (theirs - ours).abs()).maxCoeff(), 1e-15) << theirs;
}

INSTANTIATE_TEST_SUITE_P(
    Formats, AgainstGwyddion,
    ::testing::Values(std::pair{"a.vk4", test::vk4()}, std::pair{"a.bcr", test::bcr()},
                      std::pair{"a.bcrf", test::bcrf(false)}, std::pair{"a.plux", test::plux()}),
    [](const auto& suite) { return std::string(suite.param.first).substr(2); });

}  // namespace
}  // namespace tabor::scan
