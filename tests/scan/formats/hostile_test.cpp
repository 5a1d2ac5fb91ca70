// Files made to mislead, archives aside: each is rejected (or read) in one clear line, soon, and in
// little memory.
#include <sys/stat.h>

#include <cstdlib>
#include <ctime>

#include "scan/formats/sample.hpp"
#include "support/container_files.hpp"
#include "support/instrument_files.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using test::x3p_xml;

/// No converter: what no reader of tabor's own takes is rejected at once. Every test checks the
/// time that the processor spent on it, which a busy machine does not change.
class Hostile : public ::testing::Test {
 protected:
  Hostile() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nonexistent", 1); }
  ~Hostile() override { ::setenv("PATH", path_.c_str(), 1); }
  void TearDown() override { EXPECT_LT(seconds_of_processor(), kLimit); }

  std::string rejection(const std::string& bytes, const ReadOptions& options = {}) const {
    const std::string message = test::rejection(folder_, bytes, options);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 600u) << message;
    return message;
  }

  Folder folder_;

 private:
  static constexpr double kLimit = 20;  // with sanitizers; two seconds are far more than needed
  double seconds_of_processor() const {
    return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

  std::clock_t start_ = std::clock();
  std::string path_;
};

std::string x3p(const std::string& nx, const std::string& increment,
                const std::string& link = "data.bin") {
  return io::zip(
      {{"main.xml", x3p_xml({.nx = nx, .ny = "1", .increment = increment, .link = link})},
       {"data.bin", std::string(16, '\0')}});
}

TEST_F(Hostile, TheHonestFileIsRead) { EXPECT_EQ(rejection(x3p("2", "1e-6")), ""); }

TEST_F(Hostile, AbsurdCountsAreRejected) {
  for (const char* nx : {"0", "-2", "2.5", "1e300", "99999999999999999999", "nan", "two", ""}) {
    EXPECT_NE(rejection(x3p(nx, "1e-6")), "") << nx;
  }
}

TEST_F(Hostile, PixelsThatAreNoLengthAreRejected) {
  for (const char* pixel : {"0", "-1e-6", "nan", "inf", "1e-6 m"}) {
    EXPECT_NE(rejection(x3p("2", pixel)), "") << pixel;
  }
}

TEST_F(Hostile, LayersThatAreAllHolesAreRejected) {
  std::string holes = test::bcrf(false);
  const std::string last = holes.substr(holes.size() - 4);
  holes.resize(holes.size() - 24);
  for (int i = 0; i < 6; ++i) holes += last;
  EXPECT_NE(rejection(holes).find("no valid height"), std::string::npos);
}

TEST_F(Hostile, ScalesThatAreNoNumbersAreRejected) {
  for (const char* scale : {"bit2nm = nan", "bit2nm = 0  ", "bit2nm = inf", "bit2nm = two"}) {
    std::string bytes = test::bcr();
    bytes.replace(bytes.find("bit2nm = 0.5"), 12, scale);
    EXPECT_NE(rejection(bytes), "") << scale;
  }
}

TEST_F(Hostile, TextIsReadInEveryEncodingAndWithEveryLineEnd) {
  const auto wide = [](const std::string& text) {
    std::string bytes = "\xFF\xFE";
    for (const char c : text) bytes += {c, '\0'};
    return bytes;
  };
  for (const std::string& bytes : {std::string("# from an old Macintosh\r1 2\r3 4\r"),
                                   std::string("\xEF\xBB\xBF"
                                               "1 2\r\n3 4\r\n"),
                                   wide("1\t2\r\n3\t4\r\n"), wide("1 2\n3 4")}) {
    const topography::Topography map = test::read_bytes(folder_, bytes, test::micrometres());
    EXPECT_EQ(map.grid.nx, 2);
    EXPECT_EQ(map.height(1, 1), 4e-6);
  }
}

TEST_F(Hostile, LinesWithoutEndAreReadOrRejectedInLittleMemory) {
  constexpr std::size_t kSize = std::size_t{32} << 20;
  std::string numbers;
  while (numbers.size() < kSize) numbers += "1 ";
  const std::size_t before = peak_memory_bytes();
  const ReadOptions options = test::micrometres();
  EXPECT_EQ(test::read_bytes(folder_, numbers, options).grid.nx, std::ssize(numbers) / 2);
  // Eight bytes for each of the numbers, which take two, twice; and what `info` needs.
  EXPECT_LT(peak_memory_bytes() - before, 12 * kSize);
  EXPECT_NE(rejection(std::string(kSize, '7') + "x", options), "");
  EXPECT_NE(rejection(std::string(kSize, 'x'), options), "");
  EXPECT_NE(rejection("# " + std::string(kSize, 'x'), options), "");
}

TEST_F(Hostile, PipesAndDevicesAreRejectedWithoutWaiting) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const std::filesystem::path& file :
       {folder_ / "pipe", folder_.path(), std::filesystem::path("/dev/zero")}) {
    EXPECT_NE(test::rejection(file).find("folder, device or pipe"), std::string::npos) << file;
  }
}

/// Another program copies, exports or deletes while tabor reads: pages of the file that are gone
/// would end the program by a signal.
TEST_F(Hostile, FilesThatChangeWhileTheyAreOpenAreRejected) {
  topography::Topography map = test::small_map();
  map.height = 1e-6 * Field::Random(200, 100);
  map.grid = {100, 200, 1e-4, 2e-4};
  ReadOptions generous = test::micrometres();
  generous.override_unit = true;
  for (const char* extension : {".gsf", ".sdf", ".gwy", ".npy", ".x3p", ".h5"}) {
    const std::filesystem::path file = folder_ / (std::string("map") + extension);
    write(map, file);
    const ScanFile scan(file);
    EXPECT_NO_THROW(scan.read(generous)) << extension;
    std::filesystem::resize_file(file, 5000);
    try {
      scan.read(generous);
      ADD_FAILURE() << extension << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("map"), std::string::npos) << error.what();
    }
    EXPECT_THROW(scan.sha256(), InputError) << extension;
    EXPECT_THROW(scan.sha256([] { throw Interrupted(); }), Interrupted) << extension;
  }
}

}  // namespace
}  // namespace tabor::scan
