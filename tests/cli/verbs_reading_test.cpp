// What the user must say, may say and must not say about a file, from the command line.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <map>

#include "run_tabor.hpp"
#include "support/container_files.hpp"
#include "support/folder.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReadingOptions : public testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& bytes) const {
    put_bytes(folder_ / name, bytes);
    return (folder_ / name).string();
  }
  std::string numbers() const { return put("numbers.txt", "1 2 3\n4 5 6\n7 8 10\n"); }
  std::string grey() const { return put("grey.tif", tiff()); }
  std::string layers() const { return put("layers.plux", two_layer_plux()); }

  Folder folder_;
};

/// `params` with these words rejects in one line that holds these words.
void expect_rejection(std::vector<std::string> words, const std::vector<std::string>& expected) {
  words.insert(words.begin(), "params");
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
  for (const std::string& word : expected) {
    EXPECT_THAT(outcome.err, HasSubstr(word));
  }
}

TEST_F(ReadingOptions, AMissingPixelUnitOrScaleIsAskedForByItsFlag) {
  expect_rejection({numbers()}, {"--pixel 0.67um --unit um"});
  expect_rejection({numbers(), "--pixel", "1um"}, {"--unit um"});
  expect_rejection({grey(), "--pixel", "1um"}, {"--z-scale 1nm"});
  expect_rejection({layers()}, {"--channel 0", "'layer 1' [um]"});
}

TEST_F(ReadingOptions, WhatIsAskedForMakesTheFileReadable) {
  const io::Json text = json_of({"info", numbers(), "--pixel", "1um", "--unit", "nm"});
  EXPECT_DOUBLE_EQ(text.at("height_max_m").get<double>(), 10e-9);
  const io::Json image = json_of({"info", grey(), "--pixel", "1um", "--z-scale", "2nm"});
  EXPECT_DOUBLE_EQ(image.at("height_max_m").get<double>(), 12e-9);
  const io::Json layer = json_of({"info", layers(), "--channel", "layer 1"});
  EXPECT_NEAR(layer.at("height_max_m").get<double>(), 50e-6, 1e-12);
}

TEST_F(ReadingOptions, ContradictingTheFileNeedsTheOverride) {
  expect_rejection({layers(), "--channel", "0", "--pixel", "3um"},
                   {"--pixel 3um", "--override-unit"});
  expect_rejection({layers(), "--channel", "0", "--unit", "nm"}, {"--unit nm", "--override-unit"});
  const io::Json forced = json_of(
      {"info", layers(), "--channel", "0", "--pixel", "3um", "--unit", "nm", "--override-unit"});
  EXPECT_NEAR(forced.at("height_max_m").get<double>(), 5e-9, 1e-15);
  EXPECT_DOUBLE_EQ(forced.at("pixel_x_m").get<double>(), 3e-6);
  EXPECT_THAT(io::to_text(forced.at("doubts")),
              AllOf(HasSubstr("pixel along x overridden"), HasSubstr("height unit overridden")));
}

TEST_F(ReadingOptions, AHeightScaleForAFileThatHasOneIsRejectedOrOverrides) {
  expect_rejection({layers(), "--channel", "0", "--z-scale", "1nm"},
                   {"--z-scale", "--override-unit"});
  const io::Json forced =
      json_of({"info", layers(), "--channel", "0", "--z-scale", "1nm", "--override-unit"});
  EXPECT_NEAR(forced.at("height_max_m").get<double>(), 5e-9, 1e-15);
  EXPECT_THAT(io::to_text(forced.at("doubts")), HasSubstr("overridden"));
}

TEST_F(ReadingOptions, NonsenseIsRejectedNamingTheFlag) {
  expect_rejection({layers(), "--channel", "7"}, {"no channel '7'", "0 'layer 0' [um]"});
  expect_rejection({numbers(), "--pixel", "1um", "--unit", "kg"}, {"--unit kg", "um or nm"});
  expect_rejection({numbers(), "--pixel", "0um", "--unit", "um"}, {"--pixel", "positive"});
  expect_rejection({numbers(), "--pixel=-1um", "--unit", "um"}, {"--pixel", "positive"});
  expect_rejection({grey(), "--pixel", "1um", "--z-scale", "0nm"}, {"--z-scale", "zero"});
  const Outcome without_unit = run_tabor({"params", numbers(), "--pixel", "3", "--unit", "um"});
  EXPECT_EQ(without_unit.code, 2);  // a word of the command line is wrong, not the file
  EXPECT_THAT(without_unit.err, HasSubstr("--pixel"));
}

TEST_F(ReadingOptions, ADirectoryAPipeOrAnEmptyFileIsRejectedAtOnce) {
  expect_rejection({folder_.path().string()}, {"folder, device or pipe"});
  expect_rejection({put("empty.x3p", "")}, {"an empty file"});
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_rejection({pipe}, {"folder, device or pipe"});
  expect_rejection({"/dev/zero"}, {"folder, device or pipe"});
}

TEST(Formats, NameTheirTierAndWhetherGwyddionIsInstalled) {
  const io::Json object = json_of({"formats"});
  const bool installed = scan::gwyddion_program().has_value();
  EXPECT_EQ(object.at("gwyddion").at("installed"), installed);
  std::map<std::string, std::string> tiers;
  for (const io::Json& row : object.at("formats")) {
    tiers[row.at("name").get<std::string>()] = row.at("tier").get<std::string>();
  }
  EXPECT_EQ(tiers.at("x3p"), "read and write");
  for (const char* name : {"plux", "vk", "bcr", "datx", "opdx"}) {
    EXPECT_EQ(tiers.at(name), "read");
  }
  EXPECT_EQ(tiers.at("vti"), "write");
  EXPECT_EQ(tiers.at("gwyddion"), "through gwyddion");
  EXPECT_THAT(run_tabor({"formats"}).out,
              HasSubstr(installed ? "Gwyddion is installed: /" : "sudo apt install gwyddion"));
}

}  // namespace
}  // namespace tabor::test
