// What the user says about a file against what the file says itself.
#include "scan/formats/sample.hpp"
#include "tabor/scan/read_parameters.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

std::string gsf(const std::string& title, const char* z_unit = "m") {
  std::string text = "Gwyddion Simple Field 1.0\nXRes = 1\nYRes = 1\nXReal = 2e-6\nYReal = 2e-6\n";
  text += std::string("XYUnits = m\nZUnits = ") + z_unit + "\nTitle = " + title + "\n";
  text.resize((text.size() / 4 + 1) * 4, '\0');
  test::ByteFile file;
  file.text(0, text).append(1.0f);
  return file.bytes();
}

TEST(UserOptions, RepeatingWhatTheFileSaysIsFine) {
  const Folder folder;
  ReadOptions options;
  options.pixel_x = 2e-6;
  options.unit = "m";
  EXPECT_EQ(test::read_bytes(folder, gsf("h"), options).height(0, 0), 1);
}

TEST(UserOptions, ContradictingTheFileIsRejectedUnlessOverridden) {
  const Folder folder;
  ReadOptions options;
  options.pixel_x = 3e-6;
  options.unit = "um";
  EXPECT_NE(test::rejection(folder, gsf("h"), options).find("<override_unit"), std::string::npos);
  options.pixel_x.reset();
  EXPECT_NE(test::rejection(folder, gsf("h"), options).find("<override_unit"), std::string::npos);
  options.pixel_x = 3e-6;
  options.override_unit = true;
  const topography::Topography map = test::read_bytes(folder, gsf("h"), options);
  EXPECT_DOUBLE_EQ(map.height(0, 0), 1e-6);
  EXPECT_DOUBLE_EQ(map.grid.dx(), 3e-6);
  EXPECT_GE(map.warnings.size(), 3u);  // two pixel sides and the unit
}

TEST(UserOptions, ChannelsThatAreNoLengthAreRejected) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, gsf("phase", "deg")).find("'phase' [deg]"), std::string::npos);
  ReadOptions options;
  options.channel = "phase";
  EXPECT_NE(test::rejection(folder, gsf("phase", "deg"), options).find("in 'deg'"),
            std::string::npos);
  options.unit = "nm";
  options.override_unit = true;
  EXPECT_DOUBLE_EQ(test::read_bytes(folder, gsf("phase", "deg"), options).height(0, 0), 1e-9);
}

TEST(UserOptions, UnknownChannelIsRejectedWithTheList) {
  const Folder folder;
  ReadOptions options;
  options.channel = "top";
  EXPECT_NE(test::rejection(folder, gsf("height"), options).find("0 'height' [m]"),
            std::string::npos);
  options.channel = "0";
  EXPECT_EQ(test::read_bytes(folder, gsf("height"), options).channel, "height");
}

TEST(UserOptions, NonsenseIsRejected) {
  const Folder folder;
  ReadOptions options = test::micrometres();
  options.pixel_x = -1e-6;
  EXPECT_NE(test::rejection(folder, "1 2\n3 4\n", options), "");
  options = test::micrometres();
  options.unit = "kg";
  EXPECT_NE(test::rejection(folder, "1 2\n3 4\n", options).find("kg"), std::string::npos);
}

TEST(Inspect, ListsChannelsWithoutChoosingOne) {
  const Folder folder;
  test::put_bytes(folder / "a.gsf", gsf("phase", "deg"));
  const FileInfo info = inspect(folder / "a.gsf");
  ASSERT_EQ(info.channels.size(), 1u);
  EXPECT_EQ(info.format, "gsf");
  EXPECT_EQ(info.channels[0].name, "phase");
  EXPECT_FALSE(info.channels[0].is_height);
}

/// Lengths that are given.
class Lengths : public Given {
 public:
  explicit Lengths(std::vector<double> lengths) : lengths_(std::move(lengths)) {}
  double number(const Dimension&) const override { return lengths_.front(); }
  std::vector<double> numbers(const Dimension&) const override { return lengths_; }
  std::uint64_t count() const override { return 0; }
  bool flag() const override { return true; }
  std::string word(const std::vector<std::string>&) const override { return ""; }
  std::string text() const override { return "um"; }
  std::vector<std::string> texts() const override { return {"um"}; }
  bool is_word(const std::string&) const override { return false; }

 private:
  std::vector<double> lengths_;
};

TEST(ReadParameters, KeepOneSideOfAPixelOrTwo) {
  const auto& pixel = parameter_of(read_parameters(), "pixel");
  ReadOptions options;
  EXPECT_TRUE(pixel.numbers(options).empty());
  pixel.read(options, Lengths({2e-6, 3e-6}));
  EXPECT_EQ(options.pixel_x, 2e-6);
  EXPECT_EQ(options.pixel_y, 3e-6);
  EXPECT_EQ(pixel.numbers(options), std::vector<double>({2e-6, 3e-6}));
  pixel.read(options, Lengths({4e-6}));
  EXPECT_EQ(options.pixel_x, 4e-6);
  EXPECT_FALSE(options.pixel_y);
  EXPECT_THROW(pixel.read(options, Lengths({1, 2, 3})), InputError);
}

TEST(ReadParameters, AreGivenOnceSomethingIsSaid) {
  for (const Parameter<ReadOptions>& one : read_parameters()) {
    ReadOptions options;
    EXPECT_FALSE(one.is_given(options)) << one.name;
    one.read(options, Lengths({2e-6}));
    EXPECT_TRUE(one.is_given(options)) << one.name;
  }
}

}  // namespace
}  // namespace tabor::scan
