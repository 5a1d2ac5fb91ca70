// What the fuzzer once found, and every seed, in the ordinary tests: neither may break the program.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "fuzz/png.hpp"
#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"
#include "support/folder.hpp"
#include "tabor/io/image/png.hpp"

namespace tabor::fuzz {
namespace {

namespace fs = std::filesystem;

TEST(Fuzz, EveryTargetHasASeed) {
  std::set<std::string> seeded;
  for (const Seed& seed : seeds()) seeded.insert(seed.target);
  for (const Target& one : targets()) {
    EXPECT_TRUE(seeded.contains(one.name)) << one.name;
  }
}

TEST(Fuzz, SeedsRun) {
  for (const Seed& seed : seeds()) {
    EXPECT_NO_THROW(target(seed.target).run(seed.bytes)) << seed.target << "/" << seed.name;
  }
}

/// Else the fuzzer would see nothing but libpng's rejections.
TEST(Fuzz, ARepairedPngIsRead) {
  const test::Folder folder;
  for (const int interlace : {0, 1}) {
    test::put_bytes(folder / "a.png", repaired_png(plain_png(16, 0, interlace)));
    const io::GreyImage image = io::read_png(folder / "a.png");
    EXPECT_EQ(image.bits, 16);
    EXPECT_EQ(image.counts.rows(), 3);
    EXPECT_TRUE((image.counts == 0).all());
  }
}

/// A folder per target, a file per mistake that was found.
TEST(Fuzz, EarlierFindingsStayFixed) {
  const fs::path folder = fs::path(TABOR_SOURCE_DIR) / "tests/fuzz/regressions";
  int n = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().parent_path().filename();
    EXPECT_NO_THROW(target(name).run(test::bytes_of(entry.path()))) << entry.path();
    ++n;
  }
  EXPECT_GT(n, 0);
}

}  // namespace
}  // namespace tabor::fuzz
