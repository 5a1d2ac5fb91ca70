#include <cstdlib>

#include "scan/formats/sample.hpp"
#include "support/scans.hpp"
#include "tabor/io/subprocess.hpp"

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
  EXPECT_NE(test::rejection(test::shared_scan("afm_10um_bruker.di")).find("--channel 0"),
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

TEST(RunProgram, RejectsAProgramThatIsNotThere) {
  EXPECT_THROW(io::run_program("/nonexistent", {}, {}, std::chrono::seconds(1)), InputError);
}

}  // namespace
}  // namespace tabor::scan
