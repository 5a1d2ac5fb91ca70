// psd with its curves, despike and combine, on small generated surfaces.
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class SignalVerbs : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, seed] : {std::pair{"a.sdf", "1"}, {"b.sdf", "2"}}) {
      const Outcome made =
          run_tabor({"generate", "self-affine", "-o", file(name), "--pixels", "128,96", "--pixel",
                     "1um", "--rms-height", "1um", "--seed", seed});
      ASSERT_EQ(made.code, 0) << made.err;
    }
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// The first surface with a pit and a hole, cut so that x = 0 is at -5 um of the first.
  std::string worn() const {
    topography::Topography scan = scan::read(file("a.sdf"));
    scan.height.block(30, 40, 20, 25) -= 5e-6;
    scan.height(5, 9) = std::numeric_limits<double>::quiet_NaN();
    const Field part = scan.height.block(0, 5, 96, 123);
    scan.height = part;
    scan.grid = {123, 96, 123e-6, 96e-6};
    scan.periodic = false;
    scan::write(scan, folder_ / "worn.sdf");
    return file("worn.sdf");
  }

  Folder folder_;
};

std::size_t count_of(const std::string& word, const std::string& text) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST_F(SignalVerbs, PsdGivesAutocorrelationAndDifferencesWhenAsked) {
  const io::Json plain = json_of({"psd", file("a.sdf")});
  EXPECT_FALSE(plain.contains("acf"));
  EXPECT_DOUBLE_EQ(plain.at("trusted").at("shortest_wavelength_m").get<double>(), 4e-6);
  EXPECT_DOUBLE_EQ(plain.at("trusted").at("longest_wavelength_m").get<double>(), 24e-6);
  const io::Json psd = json_of({"psd", file("a.sdf"), "--acf", "--hdf", "--tip-radius", "5um"});
  EXPECT_NEAR(psd.at("acf").at("acf_x").at(0).get<double>(), 1, 1e-6);
  EXPECT_EQ(psd.at("acf").at("lag_y_m").size(), 96u);
  EXPECT_GT(psd.at("acf").at("sal_m").get<double>(), 1e-6);
  for (const char* direction : {"x", "y", "radial"}) {
    const io::Json& curve = psd.at("hdf").at(direction);
    EXPECT_EQ(curve.at("lag_m").size(), curve.at("mean_square_m2").size());
    EXPECT_NEAR(curve.at("hurst").get<double>(), 0.8, 0.25);
    EXPECT_EQ(curve.at("hurst_standard_error_is_lower_bound"), true);
  }
  EXPECT_FALSE(psd.at("x").contains("hurst_standard_error_is_lower_bound"));
  const std::string shown = run_tabor({"psd", file("a.sdf"), "--hdf"}).out;
  EXPECT_EQ(count_of(" or more ", shown), 3u);  // of x, y and radial height differences alone
  EXPECT_EQ(psd.at("trusted").at("shortest_is_limited_by"), "tip");
  EXPECT_DOUBLE_EQ(psd.at("trusted").at("shortest_wavelength_m").get<double>(), 6e-6);
}

TEST_F(SignalVerbs, PsdOfAProfileHasOneDirection) {
  topography::Topography scan = scan::read(file("a.sdf"));
  const Field row = scan.height.topRows(1);
  scan.height = row;
  scan.grid = {128, 1, 128e-6, 2e-6};
  scan::write(scan, folder_ / "row.sdf");
  const std::vector<std::string> words = {"psd",   file("row.sdf"), "--level",      "plane",
                                          "--acf", "--hdf",         "--tip-radius", "5um"};
  const io::Json psd = json_of(words);
  EXPECT_EQ(psd.at("x").at("q_rad_per_m").size(), 64u);
  EXPECT_TRUE(psd.at("y").is_null());
  EXPECT_TRUE(psd.at("radial").is_null());
  EXPECT_EQ(psd.at("hdf").at("x").at("lag_m").size(), 127u);
  EXPECT_TRUE(psd.at("hdf").at("y").is_null());
  EXPECT_TRUE(psd.at("hdf").at("radial").is_null());
  EXPECT_GT(psd.at("acf").at("sal_m").get<double>(), 1e-6);
  EXPECT_TRUE(psd.at("acf").at("str_below").is_null());
  EXPECT_DOUBLE_EQ(psd.at("trusted").at("longest_wavelength_m").get<double>(),
                   32e-6);  // of the length alone
  const Outcome outcome = run_tabor(words);
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("nan")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("along y")));
}

TEST_F(SignalVerbs, PsdWarningsExponentsOfNoSelfAffineSurface) {
  ASSERT_EQ(
      run_tabor({"convert", file("a.sdf"), file("smooth.sdf"), "--lowpass", "gauss:20um"}).code, 0);
  const Outcome outcome =
      run_tabor({"psd", file("smooth.sdf"), "--fit-min", "0.3/um", "--fit-max", "0.6/um"});
  EXPECT_THAT(outcome.err, HasSubstr("Hurst exponent is outside 0 to 1 (C1D"));
  EXPECT_THAT(run_tabor({"psd", file("a.sdf")}).err, testing::Not(HasSubstr("Hurst")));
}

TEST_F(SignalVerbs, PsdSaysWhatToTrust) {
  EXPECT_THAT(run_tabor({"psd", file("a.sdf")}).out, HasSubstr("wavelengths 4 µm to 24 µm"));
  const Outcome blunt = run_tabor({"psd", file("a.sdf"), "--tip-radius", "200um"});
  EXPECT_THAT(blunt.out, HasSubstr("no wavelength: from"));
}

TEST_F(SignalVerbs, PsdWritesItsCurvesWithUnits) {
  ASSERT_EQ(run_tabor({"psd", file("a.sdf"), "--acf", "--hdf", "-o", file("c.csv")}).code, 0);
  const io::CsvTable table = io::read_csv(file("c.csv"));
  EXPECT_EQ(table.columns.front(), "q_x_rad_per_m");
  for (const char* column :
       {"psd_x_m3", "psd_radial_m4", "lag_hdf_y_m", "hdf_radial_m2", "acf_y"}) {
    EXPECT_TRUE(table.find(column)) << column;
  }
  EXPECT_EQ(table.number(0, "acf_x"), 1);
  ASSERT_EQ(
      run_tabor({"psd", file("a.sdf"), "--psd-convention", "gwyddion", "-o", file("c.h5")}).code,
      0);
  const io::Hdf5Reader reader(folder_ / "c.h5");
  EXPECT_EQ(reader.text("/curves/psd_radial_m3", "units"), "m^3");
  EXPECT_EQ(reader.numbers("/curves/q_x_rad_per_m").size(), 64u);
  EXPECT_NE(run_tabor({"psd", file("a.sdf"), "-o", file("c.txt")}).code, 0);
}

TEST_F(SignalVerbs, PsdLeavesSpectraOutWhereThereAreHoles) {
  const std::string scan = worn();
  EXPECT_EQ(run_tabor({"psd", scan}).code, 3);
  const io::Json psd = json_of({"psd", scan, "--acf", "--hdf"});
  EXPECT_FALSE(psd.contains("radial"));
  EXPECT_TRUE(psd.contains("acf"));
  EXPECT_THAT(io::to_text(psd.at("warnings")), HasSubstr("--fill harmonic"));
}

TEST_F(SignalVerbs, TheirFilesSayWhatToCite) {
  ASSERT_EQ(run_tabor({"psd", file("a.sdf"), "--tip-radius", "1um", "-o", file("c.h5")}).code, 0);
  const io::Json psd = json_of({"cite", file("c.h5")}).at("bibtex");
  EXPECT_TRUE(psd.contains("jacobs2017"));
  EXPECT_TRUE(psd.contains("sanner2022"));
  EXPECT_FALSE(psd.contains("padfield2012"));
  ASSERT_EQ(run_tabor({"combine", file("a.sdf"), worn(), "-o", file("loss.h5")}).code, 0);
  ASSERT_EQ(run_tabor({"convert", file("loss.h5"), file("again.h5")}).code, 0);
  for (const char* map : {"loss.h5", "again.h5"}) {
    EXPECT_TRUE(json_of({"cite", file(map)}).at("bibtex").contains("padfield2012")) << map;
  }
  const std::vector<std::string> given = {"combine", file("a.sdf"), file("a.sdf"),   "--shift",
                                          "1um,0um", "-o",          file("moved.h5")};
  ASSERT_EQ(run_tabor(given).code, 0);
  EXPECT_FALSE(json_of({"cite", file("moved.h5")}).at("bibtex").contains("padfield2012"));
}

TEST_F(SignalVerbs, DespikeSaysHowManyItTook) {
  topography::Topography scan = scan::read(file("a.sdf"));
  scan.height(40, 60) += 20e-6;
  scan::write(scan, folder_ / "spike.sdf");
  const Outcome told = run_tabor({"params", file("spike.sdf"), "--despike", "auto"});
  EXPECT_THAT(told.err, HasSubstr("despike took 1 spike out of 12288 heights"));
  EXPECT_EQ(run_tabor({"params", file("spike.sdf"), "--despike", "6,4"}).code, 2);
}

TEST_F(SignalVerbs, CombineFindsTheShiftAndTheVolumeGone) {
  const io::Json wear = json_of({"combine", file("a.sdf"), worn(), "-o", file("loss.sdf")});
  EXPECT_NEAR(wear.at("shift_x_m").get<double>(), -5e-6, 0.02e-6);
  EXPECT_NEAR(wear.at("shift_y_m").get<double>(), 0, 0.02e-6);
  const double pit = 500 * 5e-6 * 1e-12;
  EXPECT_NEAR(wear.at("wear").at("worn").at("volume_m3").get<double>() / pit, 1, 0.02);
  EXPECT_GT(wear.at("registration").at("correlation").get<double>(), 0.5);
  EXPECT_TRUE(wear.contains("second_scan"));
  const auto map = scan::read(file("loss.sdf"));
  EXPECT_EQ(map.grid.nx, wear.at("nx").get<Index>());
  EXPECT_NEAR(map.height(40, 55), 5e-6, 0.1e-6);
}

TEST_F(SignalVerbs, CombineRejectsOptionsThatWouldDoNothing) {
  const auto refusal = [&](const Words& options) {
    const Outcome outcome = run_tabor(Words{"combine", file("a.sdf"), file("a.sdf")} + options);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal({"--no-register", "--shift", "1um,0um"}), HasSubstr("give one of them"));
  for (const Words& one :
       {Words{"--threshold", "8"}, Words{"--match", "plane"}, Words{"--no-register"}}) {
    EXPECT_THAT(refusal(Words{"--mode", "composite"} + one), HasSubstr(one.front() + " needs"));
  }
  EXPECT_EQ(run_tabor({"combine", file("a.sdf"), file("a.sdf"), "--mode", "difference",
                       "--threshold", "8"})
                .code,
            0);
  EXPECT_EQ(
      json_of({"combine", file("a.sdf"), file("a.sdf"), "--mode", "composite"}).at("level_match"),
      "none");
}

TEST_F(SignalVerbs, CombineSaysHowMuchHolesLeaveOut) {
  topography::Topography scan = scan::read(worn());
  EXPECT_THAT(run_tabor({"combine", file("a.sdf"), file("worn.sdf")}).err,
              testing::Not(HasSubstr("left out of the volumes")));
  for (Index y = 3; y < 90; y += 9) {
    for (Index x = 4; x < 120; x += 7) scan.height(y, x) = std::numeric_limits<double>::quiet_NaN();
  }
  scan::write(scan, folder_ / "holes.sdf");
  EXPECT_THAT(run_tabor({"combine", file("a.sdf"), file("holes.sdf")}).err,
              testing::ContainsRegex("[0-9.]+ % of the overlap lies in or beside holes"));
}

TEST_F(SignalVerbs, CombineShowsATableToPeople) {
  const Outcome told = run_tabor({"combine", file("a.sdf"), worn()});
  EXPECT_EQ(told.code, 0) << told.err;
  for (const char* text : {"worn (A above B)", "piled up", "noise floor", "correlation"}) {
    EXPECT_THAT(told.out, HasSubstr(text));
  }
}

TEST_F(SignalVerbs, CombineAddsFacesAndSubtractsAtAGivenShift) {
  const io::Json sum = json_of({"combine", file("a.sdf"), file("b.sdf"), "--mode", "composite"});
  EXPECT_EQ(sum.at("nx"), 128);
  EXPECT_FALSE(sum.contains("wear"));
  EXPECT_NEAR(sum.at("rms_height_m").get<double>(), 1.41e-6, 0.4e-6);
  const io::Json difference = json_of(
      {"combine", file("a.sdf"), file("a.sdf"), "--mode", "difference", "--shift", "3um,-2um"});
  EXPECT_EQ(difference.at("nx"), 125);
  EXPECT_TRUE(difference.at("registration").is_null());
}

TEST_F(SignalVerbs, CombineRejectsWhatDoesNotMatch) {
  const Outcome other = run_tabor({"combine", file("a.sdf"), file("b.sdf")});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("--no-register"));
  EXPECT_EQ(run_tabor({"combine", file("a.sdf"), file("b.sdf"), "--no-register"}).code, 0);
  EXPECT_EQ(run_tabor({"combine", file("a.sdf"), file("b.sdf"), "--shift", "1um"}).code, 2);
  EXPECT_EQ(run_tabor({"combine", file("a.sdf"), file("b.sdf"), "--shift", "1mm,0um"}).code, 3);
  EXPECT_EQ(run_tabor({"combine", file("a.sdf"), file("a.sdf"), "--threshold", "0"}).code, 3);
}

}  // namespace
}  // namespace tabor::test
