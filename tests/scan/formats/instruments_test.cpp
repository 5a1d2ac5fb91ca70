// Instrument files made byte by byte from their published layouts.
#include <functional>

#include "scan/formats/sample.hpp"
#include "support/container_files.hpp"
#include "support/exchange_files.hpp"
#include "support/instrument_files.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

Field expected(double step) {
  Field field(2, 3);
  field << 1, 2, 3, 4, 5, test::kNaN;
  return field * step;
}

::testing::AssertionResult close(const Field& a, const Field& b) {
  const bool same_holes = (a.isNaN() == b.isNaN()).all();
  const double worst = (a - b).isNaN().select(0, (a - b).abs()).maxCoeff();
  if (same_holes && worst <= 1e-6 * b.isNaN().select(0, b.abs()).maxCoeff()) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << a << "\nagainst\n" << b;
}

struct Case {
  const char* format;
  std::function<std::string()> bytes;
  Field heights;  ///< [m]
};

class Instrument : public ::testing::TestWithParam<Case> {};

TEST_P(Instrument, GivesHeightsHolesAndPixelsOfItsLayout) {
  const Folder folder;
  const topography::Topography map = test::read_bytes(folder, GetParam().bytes());
  EXPECT_EQ(map.format, GetParam().format);
  EXPECT_TRUE(close(map.height, GetParam().heights));
  const std::string format = GetParam().format;
  const double dy = format == "metropro" || format == "zygo-text" ? 2e-6 : 4e-6;
  EXPECT_NEAR(map.grid.dx(), 2e-6, 1e-12);
  EXPECT_NEAR(map.grid.dy(), dy, 1e-12);
}

TEST_P(Instrument, TruncatedAnywhereIsRejected) {
  const Folder folder;
  const std::string bytes = GetParam().bytes();
  // What follows the heights may be missing: Sensofar's file ends with its range, NanoFocus's with
  // a grey image.
  const std::string format = GetParam().format;
  const std::size_t tail = format == "plu" ? 8 : format == "nms" ? 6 : 0;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  for (std::size_t size = 0; size + tail < bytes.size(); ++size) {
    EXPECT_NE(test::rejection(folder, bytes.substr(0, size)), "") << size;
  }
  ::setenv("PATH", path.c_str(), 1);
}

TEST_P(Instrument, WithAFlippedBitNeverBreaksTheProgram) {
  const Folder folder;
  const std::string bytes = GetParam().bytes();
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 7) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, flipped)) << bit;
  }
  ::setenv("PATH", path.c_str(), 1);
}

Field without_hole(double step) {
  Field field(2, 3);
  field << 1, 2, 3, 4, 5, 6;
  return field * step;
}

INSTANTIATE_TEST_SUITE_P(
    Formats, Instrument,
    ::testing::Values(
        Case{"sur", test::plain_sur, expected(0.5e-9)},
        Case{"sur", test::compressed_sur, expected(0.5e-9)}, Case{"al3d", test::al3d, expected(1)},
        Case{"opd", test::opd, expected(0.5e-9)}, Case{"plu", test::plu, expected(1e-6)},
        Case{"metropro", test::metropro, expected(0.5 * 600e-9 / 4096)},
        Case{"tmd", test::tmd, expected(1e-3)}, Case{"plux", test::plux, expected(1e-6)},
        Case{"vk", test::vk4, without_hole(0.5e-9)}, Case{"vk", test::vk6, without_hole(0.5e-9)},
        Case{"bcr", test::bcr, expected(0.5e-9)},
        Case{"bcr", [] { return test::bcrf(false); }, expected(1e-9)},
        Case{"bcr", [] { return test::bcrf(true); }, expected(1e-9)},
        Case{"opdx", test::opdx, expected(0.5e-9)},
        Case{"zygo-text", test::zygo_counts, expected(0.5 * 600e-9 / 4096)},
        Case{"nc", [] { return test::netcdf(); }, expected(1e-6)},
        Case{"ce", [] { return test::container("index.json"); }, expected(1e-6)},
        Case{"nms", test::nms, without_hole(1e-6)}),
    [](const auto& suite) {
      std::string name = suite.param.format;
      std::erase(name, '-');
      return name + std::to_string(suite.index);
    });

TEST(DigitalSurf, LayersWithoutHeightsAreRejected) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, test::sur("DIGITAL SURF", 16, 10)).find("type 10"),
            std::string::npos);
  std::string percent = test::plain_sur();
  percent.replace(212, 2, "% ");
  EXPECT_NE(test::rejection(folder, percent).find("[%]"), std::string::npos);
}

TEST(DigitalSurf, LyingStreamSizesAreRejected) {
  const Folder folder;
  std::string bytes = test::compressed_sur();
  const std::uint32_t huge = 0xFFFFFFFF;
  std::memcpy(bytes.data() + 518 + 4, &huge, sizeof huge);
  EXPECT_NE(test::rejection(folder, bytes), "");
  std::memcpy(bytes.data() + 518, &huge, sizeof huge);
  EXPECT_NE(test::rejection(folder, bytes), "");
}

}  // namespace
}  // namespace tabor::scan
