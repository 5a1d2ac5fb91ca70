// Which of the real measurements are read, and why the others are not; their numbers are compared
// in
// ../expected.
#include "support/scans.hpp"
#include "scan/formats/sample.hpp"
#include "tabor/io/files/subprocess.hpp"

namespace tabor::scan {
namespace {

/// What these files leave open: needed to read them at all.
ReadOptions options_for(const std::string& file) {
  ReadOptions options;
  if (file == "afm_512_nm_matrix.txt") options.pixel_x = 1e-6;
  if (file.starts_with("nanovea")) {
    options.pixel_x = 5e-6;
    options.unit = "um";
  }
  if (file.starts_with("tiny_xyz") || file == "tiny_matrix_nounit.txt") {
    options = test::micrometres();
  }
  if (file == "afm_10um_bruker.di" || file == "afm_20um_asylum.ibw") options.channel = "0";
  return options;
}

bool needs_gwyddion(const std::string& file) {
  return file.ends_with(".frt") || file.ends_with(".di") || file.ends_with(".ibw") ||
         file.ends_with(".tiff");
}

TEST(SharedScans, AreAllReadOrRejectedForAReason) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  const bool has_gwyddion = io::find_program("gwyddion").has_value();
  for (const auto& entry : std::filesystem::directory_iterator(test::shared_scan(""))) {
    const std::string name = entry.path().filename().string();
    if (name == "expected.csv" || (needs_gwyddion(name) && !has_gwyddion)) continue;
    const std::string reason = test::rejection(entry.path(), options_for(name));
    if (name == "tiny_iso5436_sample2.x3p") {
      EXPECT_NE(reason.find("point cloud"), std::string::npos) << reason;
    } else if (name == "tiny_iso5436_sample3.x3p") {
      EXPECT_NE(reason.find("evenly spaced"), std::string::npos) << reason;
    } else {
      EXPECT_EQ(reason, "") << name;
    }
  }
}

TEST(SharedScans, WithoutUnitOrPixelNameTheFlag) {
  TABOR_NEEDS_SHARED_SCAN("tiny_xyz.txt");
  for (const char* file : {"tiny_xyz.txt", "tiny_matrix_nounit.txt", "nanovea_xyz1.txt"}) {
    EXPECT_NE(test::rejection(test::shared_scan(file)).find("<unit"), std::string::npos) << file;
  }
  EXPECT_NE(test::rejection(test::shared_scan("afm_512_nm_matrix.txt")).find("<pixel"),
            std::string::npos);
  EXPECT_EQ(test::rejection(test::shared_scan("afm_512_nm_matrix.txt")).find("<unit"),
            std::string::npos);
}

}  // namespace
}  // namespace tabor::scan
