// Every line of expected.csv, the list of published and independently computed numbers beside the
// measured scans, against ours.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "claims.hpp"
#include "support/rejection.hpp"
#include "support/scans.hpp"
#include "support/synthetic.hpp"
#include "support/validation.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::scan::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

std::vector<const Claim*> claims_of(const Row& row) {
  std::vector<const Claim*> found;
  for (const Claim& claim : claims()) {
    if (claim.applies(row)) found.push_back(&claim);
  }
  return found;
}

/// The list reads this NanoFocus file with a full scale of 65534 counts; raw 0 and 65535 each occur
/// exactly once in it, so 65535 it is. Its numbers are compared at the list's scale.
topography::Topography as_listed(const std::string& file) {
  topography::Topography scan = read_shared_scan(file);
  if (file == "confocal_nanofocus1.nms") scan.height *= 65535.0 / 65534;
  return scan;
}

/// Largest difference allowed, in SI.
double allowed(const Row& row, const Claim& claim, double expected) {
  if (expected == 0) return 1e-9;  // a moment of order one, or a count
  const double asked = claim.tolerance > 0 ? claim.tolerance : 1e-9;
  const double relative = row.unit == "px" ? asked : asked + half_digit(row.text);
  // Where the list says by how much the published number differs from its own, right one.
  const bool is_other = claim.true_value || claim.against_recomputed;
  const double noted = is_other ? 0 : row.noted_difference;
  return std::max(claim.absolute_tolerance, std::abs(expected) * (relative + noted));
}

void expect_row(const Row& row, const Claim& claim, Subject& subject) {
  const double ours = claim.ours(subject);
  const double expected = claim.against_recomputed
                              ? std::strtod(row.recomputed.c_str(), nullptr) * row.factor
                              : row.value;
  const double tolerance = allowed(row, claim, expected);
  tabor::test::record_comparison({row.file, row.quantity, row.convention, row.unit,
                                  expected / row.factor, ours / row.factor,
                                  tolerance / row.factor});
  EXPECT_NEAR(ours, expected, tolerance) << row.name();
  if (claim.true_value) {
    EXPECT_GT(std::abs(claim.true_value(subject) - expected), 100 * tolerance)
        << row.name() << " is known to be wrong";
  }
}

/// Checks all lines about one file.
void expect_rows(const std::string& file, Subject& subject) {
  int n_rows = 0;
  for (const Row& row : expected_rows()) {
    if (row.file != file || !unclaimed_reason(row).empty()) continue;
    const auto found = claims_of(row);
    ASSERT_EQ(found.size(), 1u) << row.name();
    expect_row(row, *found.front(), subject);
    ++n_rows;
  }
  EXPECT_GT(n_rows, 0) << file;
}

class MeasuredScan : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredScan, HasTheExpectedNumbers) {
  const std::string file = GetParam();
  TABOR_NEEDS_SHARED_SCAN(file);
  if (needs_gwyddion(file) && !io::find_program("gwyddion")) {
    GTEST_SKIP() << "no Gwyddion";
  }
  Subject subject(as_listed(file));
  expect_rows(file, subject);
}

constexpr const char* kMeasured[] = {
    "rubber_alicona.x3p",       "wli_milled1.opd",          "wli_smooth.opd",
    "confocal_tilted_flat.plu", "confocal_nanofocus1.nms",  "confocal_bullet_land.x3p",
    "focusvar_rough.al3d",      "polished_cyl_missing.sur", "wli_ds_nonsquare.x3p",
    "zygo_metropro.dat",        "wli_matrix_rad.txt",       "afm_gwyddion_export.txt",
    "frt_microprof2.frt",       "gelsight_dime.tmd",        "afm_10um_bruker.di",
    "afm_20um_asylum.ibw",      "afm_1um_park.tiff",        "afm_512_nm_matrix.txt",
    "profile_mitutoyo_2.txt",   "nanovea_xyz1.txt",         "nanovea_xyz2.txt",
    "tiny_iso_example.sdf"};

INSTANTIATE_TEST_SUITE_P(Files, MeasuredScan, testing::ValuesIn(kMeasured), [](const auto& suite) {
  std::string name = suite.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST(ExpectedNumbers, OfTheSyntheticSurface) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  Subject subject(published_surface());
  expect_rows("synthetic_surfalize(seed 0)", subject);
}

TEST(ExpectedNumbers, OfTheSyntheticProfile) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  topography::Topography profile = published_profile();
  profile.height -= profile.height.mean();
  Subject subject(std::move(profile));
  expect_rows("synthetic_profile(seed 0)", subject);
}

TEST(ExpectedNumbers, OfTheAnalyticSine) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  Subject subject(analytic_sine(200000));
  expect_rows("analytic sine", subject);
}

bool is_subject(const std::string& file) {
  return std::find(std::begin(kMeasured), std::end(kMeasured), file) != std::end(kMeasured) ||
         file == "synthetic_surfalize(seed 0)" || file == "synthetic_profile(seed 0)" ||
         file == "analytic sine";
}

TEST(ExpectedNumbers, LeaveNoRowOut) {
  TABOR_NEEDS_SHARED_SCAN("expected.csv");
  for (const Row& row : expected_rows()) {
    if (!unclaimed_reason(row).empty()) continue;
    EXPECT_EQ(claims_of(row).size(), 1u) << row.name();
    EXPECT_TRUE(is_subject(row.file)) << row.name();
  }
}

TEST(ExpectedNumbers, WithoutALateralScaleDoNotExist) {
  TABOR_NEEDS_SHARED_SCAN("afm_512_nm_matrix.txt");
  const std::string rejected =
      tabor::test::rejection([] { read(tabor::test::shared_scan("afm_512_nm_matrix.txt")); });
  EXPECT_THAT(rejected, HasSubstr("<pixel"));
}

// What the list says beside numbers that it knows to be wrong.
TEST(ExpectedNumbers, BesideWrongOnesAreOurs) {
  Subject synthetic(published_surface());
  const auto sdr = [&](metrology::AreaTriangles triangles) {
    return metrology::developed_area_ratio(synthetic.as_read(), triangles);
  };
  EXPECT_NEAR(sdr(metrology::AreaTriangles::two), 275.201045, 1e-6);
  EXPECT_NEAR(sdr(metrology::AreaTriangles::four), 234.28, 5e-3);
  EXPECT_NEAR(metrology::rms_slope(synthetic.as_read()), 4.082139680093371, 1e-12);  // with NumPy
  TABOR_NEEDS_SHARED_SCAN("wli_smooth.opd");
  EXPECT_NEAR(metrology::rms_height(read_shared_scan("wli_smooth.opd")), 8.356451e-9, 5e-16);
}

}  // namespace
}  // namespace tabor::scan::test
