// Real measurements against published values (expected.csv beside the scans).
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "support/scans.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/csv.hpp"
#include "tabor/io/subprocess.hpp"
#include "tabor/topography/parameters.hpp"
#include "topography/formats/sample.hpp"

namespace tabor::topography {
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

struct Row {
  std::string quantity;
  double value = 0;
  double tolerance = 0;  ///< absolute
};

/// Half a unit of the last printed digit, at least one part in 10^9 (rounding of other programs).
double tolerance_of(const std::string& text, double value) {
  const std::string digits = text.substr(0, text.find_first_of("eE"));
  const std::size_t point = digits.find('.');
  const auto decimals = point == std::string::npos ? 0 : digits.size() - point - 1;
  const double mantissa = std::abs(std::stod(digits));
  const double half = 0.5 * std::pow(10.0, -static_cast<double>(decimals));
  return std::abs(value) * std::max(1e-9, half / mantissa);
}

/// The NanoFocus row was computed with a full scale of 65534 counts; raw 0 and 65535 each occur
/// exactly once in that scan, so 65535 it is.
double corrected(const std::string& file, const std::string& quantity, double value) {
  const bool is_height = quantity == "Sq_raw";
  return file == "confocal_nanofocus1.nms" && is_height ? value * 65534 / 65535 : value;
}

/// Rows a reader alone must reproduce, in SI: sizes, holes, and Sq of the heights as read.
std::vector<Row> rows_of(const io::CsvTable& table, const std::string& file) {
  static const std::set<std::string> names{"nx", "ny",      "size_x", "size_y", "dx",
                                           "dy", "missing", "Sq",     "Sq_raw"};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string& convention = table.text(i, "convention");
    const std::string& quantity = table.text(i, "quantity");
    const bool as_read = quantity != "Sq" || convention.starts_with("population std");
    if (table.text(i, "file") != file || !names.contains(quantity) || !as_read) continue;
    const std::string& unit = table.text(i, "unit");
    const double factor = unit == "px" ? 1 : unit_factor(unit, dimension::length).value_or(1);
    const std::string& text = table.text(i, "value");
    if (text == "nan") continue;  // the pixel of a file that has none
    const double value = corrected(file, quantity, std::stod(text) * factor);
    // These Sq come from another program; expected.csv notes differences up to 3.4e-8 from its own.
    const double least = quantity == "Sq" ? 1e-7 * value : 0;
    rows.push_back({quantity, value, std::max(least, tolerance_of(text, value))});
  }
  return rows;
}

double measured(const Topography& map, const std::string& quantity) {
  if (quantity == "nx") return static_cast<double>(map.grid.nx);
  if (quantity == "ny") return static_cast<double>(map.grid.ny);
  if (quantity == "size_x") return map.grid.lx;
  if (quantity == "size_y") return map.grid.ly;
  if (quantity == "dx") return map.grid.dx();
  if (quantity == "dy") return map.grid.dy();
  if (quantity == "missing") return static_cast<double>(count_holes(map));
  return rms_height(map);
}

class Scan : public ::testing::TestWithParam<const char*> {};

TEST_P(Scan, HasThePublishedSizesHolesAndRoughness) {
  const std::string file = GetParam();
  TABOR_NEEDS_SHARED_SCAN(file);
  if (needs_gwyddion(file) && !io::find_program("gwyddion")) GTEST_SKIP() << "no Gwyddion";
  const auto rows = rows_of(io::read_csv(test::shared_scan("expected.csv")), file);
  ASSERT_FALSE(rows.empty());
  const Topography map = read(test::shared_scan(file), options_for(file));
  for (const Row& row : rows) {
    EXPECT_NEAR(measured(map, row.quantity), row.value, row.tolerance) << row.quantity;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, Scan,
    ::testing::Values("rubber_alicona.x3p", "wli_milled1.opd", "wli_smooth.opd",
                      "confocal_tilted_flat.plu", "confocal_nanofocus1.nms",
                      "confocal_bullet_land.x3p", "focusvar_rough.al3d", "polished_cyl_missing.sur",
                      "wli_ds_nonsquare.x3p", "zygo_metropro.dat", "wli_matrix_rad.txt",
                      "afm_gwyddion_export.txt", "frt_microprof2.frt", "gelsight_dime.tmd",
                      "afm_10um_bruker.di", "afm_1um_park.tiff", "afm_512_nm_matrix.txt",
                      "nanovea_xyz1.txt", "nanovea_xyz2.txt", "tiny_iso_example.sdf"),
    [](const auto& suite) {
      std::string name = suite.param;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

TEST(SharedScans, AreAllReadOrRefusedForAReason) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  const bool has_gwyddion = io::find_program("gwyddion").has_value();
  for (const auto& entry : std::filesystem::directory_iterator(test::shared_scan(""))) {
    const std::string name = entry.path().filename().string();
    if (name == "expected.csv" || (needs_gwyddion(name) && !has_gwyddion)) continue;
    const std::string reason = test::refusal(entry.path(), options_for(name));
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
    EXPECT_NE(test::refusal(test::shared_scan(file)).find("--unit"), std::string::npos) << file;
  }
  EXPECT_NE(test::refusal(test::shared_scan("afm_512_nm_matrix.txt")).find("--pixel"),
            std::string::npos);
  EXPECT_EQ(test::refusal(test::shared_scan("afm_512_nm_matrix.txt")).find("--unit"),
            std::string::npos);
}

}  // namespace
}  // namespace tabor::topography
