#include "tabor/results/combination.hpp"

#include <gmock/gmock.h>

#include "support/folder.hpp"
#include "support/sample_surfaces.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::results {
namespace {

using comparison::Combination;
using comparison::CombineMode;

/// A surface and the same with a pit of known volume [m^3].
Combination worn(CombineMode mode) {
  const topography::Topography before = test::noise({64, 48, 64e-6, 48e-6});
  topography::Topography after = before;
  after.height.block(10, 20, 4, 5) -= 3e-6;
  comparison::CombineOptions options;
  options.mode = mode;
  options.search = false;
  options.level = comparison::LevelMatch::none;
  return comparison::combine(before, after, options);
}

void write(const Combination& combination, CombineMode mode, const ResultHead& head,
           const std::filesystem::path& file) {
  write_combination(
      {combination.map, std::string(comparison::name_of(mode)), values_of(combination)}, head, {},
      file);
}

TEST(Combination, IsKeptWithItsNumbers) {
  const test::Folder folder;
  const Combination combination = worn(CombineMode::wear);
  write(combination, CombineMode::wear,
        {.command = "tabor combine a b", .config_toml = "", .methods = {}}, folder / "worn.h5");
  const io::Hdf5Reader file(folder / "worn.h5");
  EXPECT_EQ(file.text("/", "command"), "tabor combine a b");
  EXPECT_EQ(file.text("/combination", "mode"), "wear");
  EXPECT_EQ(file.number("/combination", "worn_volume_m3"), combination.wear->worn.value);
  EXPECT_EQ(file.number("/combination", "rms_height_m"), combination.rms_map);
  EXPECT_EQ(file.integer("/combination", "common_points"), 64 * 48);
  EXPECT_NEAR(file.number("/combination", "worn_volume_m3"), 20 * 1e-12 * 3e-6, 1e-18);
  EXPECT_EQ(file.field("/surface/height").rows(), 48);
}

TEST(Combination, HasNoVolumesWithoutWear) {
  const test::Folder folder;
  write(worn(CombineMode::difference), CombineMode::difference, {}, folder / "less.h5");
  const io::Hdf5Reader file(folder / "less.h5");
  EXPECT_EQ(file.text("/combination", "mode"), "difference");
  EXPECT_FALSE(file.has_attribute("/combination", "worn_volume_m3"));
}

}  // namespace
}  // namespace tabor::results
