#include <cstdlib>

#include "scan/formats/sample.hpp"
#include "support/scans.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/scan/formats/gwy_object.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

class ThroughGwyddion : public ::testing::TestWithParam<const char*> {};

TEST_P(ThroughGwyddion, HeightsAndMaskComeBackEqual) {
  const auto gwyddion = io::find_program("gwyddion");
  if (!gwyddion) {
    GTEST_SKIP() << "Gwyddion is not installed";
  }
  const Folder folder;
  topography::Topography map = test::small_map();
  if (std::string(GetParam()) == ".gsf") {
    map.height = map.height.cast<float>().cast<double>().eval();
  }
  // Gwyddion 2.62 does not know BAD, the standard's word for a hole in ascii SDF.
  if (std::string(GetParam()) == ".asdf") map.height = map.height.isNaN().select(0, map.height);
  const auto file = folder / (std::string("map") + GetParam());
  write(map, file);
  const auto run = io::run_program(
      *gwyddion, {"--convert-to-gwy=" + (folder / "back.gwy").string(), file.string()},
      {{"HOME", folder.path().string()}}, std::chrono::seconds(60));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const topography::Topography back = read(folder / "back.gwy");
  EXPECT_TRUE(test::same_bits(back.height, map.height));
  EXPECT_NEAR(back.grid.dx(), map.grid.dx(), 1e-12 * map.grid.dx());
  EXPECT_NEAR(back.grid.dy(), map.grid.dy(), 1e-12 * map.grid.dy());
}

INSTANTIATE_TEST_SUITE_P(Formats, ThroughGwyddion,
                         ::testing::Values(".gwy", ".gsf", ".x3p", ".sdf", ".asdf"),
                         [](const auto& suite) { return std::string(suite.param).substr(1); });

TEST(Gwyddion, LeavesNoTemporaryFolderBehind) {
  if (!io::find_program("gwyddion")) {
    GTEST_SKIP() << "Gwyddion is not installed";
  }
  const Folder folder;
  std::filesystem::create_directory(folder / "tmp");
  ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
  EXPECT_NE(test::rejection(folder, std::string("\x01\x02\x03", 3)).find("nor Gwyddion"),
            std::string::npos);
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

TEST(Gwyddion, ChannelsOfAnAtomicForceMicroscopeAreListed) {
  TABOR_NEEDS_SHARED_SCAN("afm_10um_bruker.di");
  if (!io::find_program("gwyddion")) {
    GTEST_SKIP() << "Gwyddion is not installed";
  }
  const FileInfo info = inspect(test::shared_scan("afm_10um_bruker.di"));
  EXPECT_EQ(info.channels.size(), 3u);
  EXPECT_NE(test::rejection(test::shared_scan("afm_10um_bruker.di")).find("<channel=0>"),
            std::string::npos);
}

TEST(RunProgram, KillsWhatTakesTooLong) {
  const auto sleep = io::find_program("sleep");
  ASSERT_TRUE(sleep.has_value());
  const auto start = std::chrono::steady_clock::now();
  const io::Completed run = io::run_program(*sleep, {"30"}, {}, std::chrono::milliseconds(100));
  EXPECT_TRUE(run.timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(RunProgram, PassesArgumentsAndEnvironmentUnchanged) {
  const auto shell = io::find_program("sh");
  ASSERT_TRUE(shell.has_value());
  const io::Completed run =
      io::run_program(*shell, {"-c", "echo \"$1|$WORD\"; exit 3", "sh", "a b;$c"},
                      {{"WORD", "x y"}}, std::chrono::seconds(10));
  EXPECT_EQ(run.output, "a b;$c|x y\n");
  EXPECT_EQ(run.exit_code, 3);
}

/// Sets PATH for one test.
class Path {
 public:
  explicit Path(const std::string& path) : before_(std::getenv("PATH")) {
    ::setenv("PATH", path.c_str(), 1);
  }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string before_;
};

void put_program(const std::filesystem::path& file, const std::string& script) {
  test::put_bytes(file, "#!/bin/sh\n" + script);
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

TEST(RunProgram, KeepsItsLimits) {
  const io::Completed run = io::run_program(
      "/bin/sh", {"-c", "ulimit -v; ulimit -t; ulimit -f; pwd"}, {}, std::chrono::seconds(10), {},
      {.address_space = 1 << 30, .processor = 7, .file = 1 << 20}, "/usr");
  EXPECT_EQ(run.output, "1048576\n7\n2048\n/usr\n");
}

TEST(RunProgram, IsFoundInNoFolderOfTheMoment) {
  const Folder folder;
  put_program(folder / "helper", "exit 0\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  for (const char* path : {"", ":", ".", "./", ":/nonexistent", "relative"}) {
    const Path only(path);
    EXPECT_FALSE(io::find_program("helper")) << path;
  }
  const Path absolute(folder.path().string());
  EXPECT_EQ(io::find_program("helper"), folder / "helper");
  std::filesystem::current_path(before);
}

TEST(Gwyddion, MayNotTakeAllMemory) {
  const Folder programs, folder;
  put_program(programs / "gwyddion",
              "ulimit -v > '" + (programs / "limit").string() + "'\nexit 1\n");
  const Path path(programs.path().string());
  EXPECT_NE(test::rejection(folder, std::string("\x01\x02\x03", 3)).find("nor Gwyddion"),
            std::string::npos);
  EXPECT_LT(std::stod(test::bytes_of(programs / "limit")), 4 << 20);  // KiB
}

TEST(Gwyddion, FillsNoDisk) {
  const Folder programs, folder;
  put_program(programs / "gwyddion",
              "out=${1#--convert-to-gwy=}\nhead -c 1000000000 /dev/zero > \"$out\"\n"
              "wc -c < \"$out\" > '" +
                  (programs / "size").string() + "'\n");
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  EXPECT_FALSE(test::rejection(folder, std::string("\x01\x02\x03", 3)).empty());
  EXPECT_LT(std::stod(test::bytes_of(programs / "size")), 1e8);
}

/// A converter that gives this channel whatever it is asked to read.
void put_converter(const Folder& programs, const format::GwyBuilder& field,
                   const std::string& title) {
  format::GwyBuilder root("GwyContainer");
  root.add("/0/data", field);
  root.add("/0/data/title", title);
  test::put_bytes(programs / "made.gwy", "GWYP" + root.bytes());
  put_program(programs / "gwyddion",
              "cp '" + (programs / "made.gwy").string() + "' \"${1#--convert-to-gwy=}\"\n");
}

/// 4 x 3 values, with a size and units if these are given.
format::GwyBuilder converted(const Field& values, double width, double height,
                             const std::string& xy_unit, const std::string& z_unit) {
  const auto unit = [](const std::string& text) {
    format::GwyBuilder builder("GwySIUnit");
    builder.add("unitstr", text);
    return builder;
  };
  format::GwyBuilder field("GwyDataField");
  field.add("xres", std::int32_t{4});
  field.add("yres", std::int32_t{3});
  field.add("xreal", width);
  field.add("yreal", height);
  if (!xy_unit.empty()) field.add("si_unit_xy", unit(xy_unit));
  if (!z_unit.empty()) field.add("si_unit_z", unit(z_unit));
  field.add("data", values);
  return field;
}

Field some_values() {
  Field values(3, 4);
  values << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 200;
  return values;
}

const std::string kOfNoFormat("\x01\x02\x03", 3);

TEST(Gwyddion, GwyconvertStandsInWhereItFails) {
  const Folder programs, folder;
  put_converter(programs, converted(some_values(), 4e-6, 3e-6, "m", "m"), "height");
  put_program(programs / "gwyconvert", "cp '" + (programs / "made.gwy").string() + "' \"$2\"\n");
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  put_program(programs / "gwyddion", "exit 1\n");
  const topography::Topography map = test::read_bytes(folder, kOfNoFormat);
  EXPECT_EQ(map.format, "gwyddion");
  EXPECT_EQ(map.height(2, 3), 200);
}

TEST(Gwyddion, ASizeThatItInventsIsNotKnown) {
  const Folder programs, folder;
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  ReadOptions options;
  options.pixel_x = 2e-6;
  for (const double height : {1.0, 0.75, 0.0}) {  // 0.75: square pixels
    put_converter(programs, converted(1e-9 * some_values(), 1, height, "m", "m"), "Topography");
    EXPECT_THAT(test::rejection(folder, kOfNoFormat),
                testing::AllOf(testing::HasSubstr("no pixel size in the file"),
                               testing::HasSubstr("<pixel")));
    const topography::Topography map = test::read_bytes(folder, kOfNoFormat, options);
    EXPECT_NEAR(map.grid.dx(), 2e-6, 1e-15);
    EXPECT_NEAR(map.grid.dy(), 2e-6, 1e-15);
  }
  // One side that the file states stays.
  put_converter(programs, converted(1e-9 * some_values(), 1, 6e-6, "m", "m"), "Topography");
  EXPECT_NEAR(test::read_bytes(folder, kOfNoFormat, options).grid.dy(), 2e-6, 1e-15);
  options.pixel_x = 1e-6;
  EXPECT_THAT(test::rejection(folder, kOfNoFormat, options), testing::HasSubstr("2 um along y"));
}

TEST(Gwyddion, ASizeThatItInventedInAFileThatItSavedIsNotKnown) {
  const Folder folder;
  format::GwyBuilder root("GwyContainer");
  root.add("/0/data", converted(1e-9 * some_values(), 1, 1, "m", "m"));
  EXPECT_THAT(test::rejection(folder, "GWYP" + root.bytes()),
              testing::HasSubstr("no pixel size in the file"));
  topography::Topography map = test::small_map();
  map.grid.lx = 1;
  map.grid.ly = 1;
  write(map, folder / "map.gwy");
  EXPECT_EQ(read(folder / "map.gwy").grid.lx, 1);
}

TEST(Gwyddion, CountsOfPicturesAreThoseOfTheFile) {
  const Folder programs, folder;
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.z_scale = 10e-9;
  for (const double share : {1.0, 1 / 255.0}) {  // of more than 8 bits, of 8
    put_converter(programs, converted(share * some_values(), 1, 0.75, "", ""), "Gray");
    EXPECT_THAT(test::rejection(folder, kOfNoFormat), testing::HasSubstr("<pixel"));
    EXPECT_TRUE(test::same_bits(test::read_bytes(folder, kOfNoFormat, options).height,
                                10e-9 * some_values()));
  }
  put_converter(programs, converted(some_values() / 255, 1, 0.75, "", ""), "Value (max)");
  EXPECT_THAT(test::rejection(folder, kOfNoFormat), testing::HasSubstr("no channel whose unit"));
}

TEST(Gwyddion, ABrukerFileWithoutScanSizeAsksForThePixel) {
  TABOR_NEEDS_SHARED_SCAN("afm_10um_bruker.di");
  if (!io::find_program("gwyddion")) {
    GTEST_SKIP() << "Gwyddion is not installed";
  }
  std::string bytes = test::bytes_of(test::shared_scan("afm_10um_bruker.di"));
  for (const std::string size : {"\\Scan Size: 10000 nm", "\\Scan Size: 10 10 ~m"}) {
    for (std::size_t at = 0; (at = bytes.find(size, at)) != std::string::npos; ++at) {
      std::replace(&bytes[at], &bytes[at] + size.size(), '1', '0');
    }
  }
  const Folder folder;
  ReadOptions options;
  options.channel = "ZSensor";
  EXPECT_THAT(test::rejection(folder, bytes, options),
              testing::HasSubstr("no pixel size in the file"));
  options.pixel_x = 20e-9;
  EXPECT_NEAR(test::read_bytes(folder, bytes, options).grid.lx, 512 * 20e-9, 1e-12);
}

TEST(RunProgram, RejectsAProgramThatIsNotThere) {
  EXPECT_THROW(io::run_program("/nonexistent", {}, {}, std::chrono::seconds(1)), InputError);
}

}  // namespace
}  // namespace tabor::scan
