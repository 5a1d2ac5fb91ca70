// info, convert, params, psd, generate, formats, cite, options on small generated surfaces.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder with a small periodic rough surface in it.
class ScanVerbs : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", scan(), "--pixels", "32,24",
                                    "--pixel", "1um", "--rms-height", "1um"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string scan() const { return file("scan.sdf"); }

  Folder folder_;
};

std::vector<std::string> keys_of(const io::Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

void expect_keys(const io::Json& object, const std::vector<std::string>& wanted) {
  const std::vector<std::string> keys = keys_of(object);
  for (const std::string& key : wanted) {
    EXPECT_THAT(keys, Contains(key));
  }
}

TEST_F(ScanVerbs, InfoHasTheAgreedKeys) {
  const io::Json info = json_of({"info", scan()});
  expect_keys(info, {"file", "format", "instrument", "channels", "channel", "nx", "ny", "pixel_x_m",
                     "pixel_y_m", "size_x_m", "size_y_m", "missing_pixels", "missing_fraction",
                     "height_min_m", "height_max_m", "height_rms_m", "height_quantum_m", "doubts",
                     "warnings"});
  expect_keys(info.at("channels").at(0), {"index", "name", "unit", "is_height", "nx", "ny"});
  EXPECT_EQ(info.at("nx"), 32);
  EXPECT_EQ(info.at("ny"), 24);
  EXPECT_DOUBLE_EQ(info.at("pixel_x_m").get<double>(), 1e-6);
  EXPECT_DOUBLE_EQ(info.at("size_y_m").get<double>(), 24e-6);
  EXPECT_NEAR(info.at("height_rms_m").get<double>(), 1e-6, 1e-12);
}

TEST_F(ScanVerbs, JsonBeginsWithVersionAndCommandAndScan) {
  const io::Json params = json_of({"params", scan()});
  const std::vector<std::string> keys = keys_of(params);
  ASSERT_GE(keys.size(), 3u);
  EXPECT_THAT(std::vector<std::string>(keys.begin(), keys.begin() + 3),
              ElementsAre("tabor_version", "command", "scan"));
  EXPECT_EQ(params.at("scan").at("path"), scan());
  EXPECT_EQ(params.at("scan").at("sha256").get<std::string>().size(), 64u);
}

TEST_F(ScanVerbs, ParamsCarryValueUnitAndDefinition) {
  const io::Json params = json_of({"params", scan(), "--level", "plane"});
  EXPECT_THAT(params.at("treatment"), ElementsAre("level=plane"));
  for (const char* symbol : {"Sq", "Sa", "Sdq"}) {
    expect_keys(params.at("parameters").at(symbol), {"value", "unit", "definition"});
  }
}

TEST_F(ScanVerbs, TreatmentIsAppliedInTheOrderGiven) {
  const io::Json cropped_first =
      json_of({"params", scan(), "--crop", "0,0,16,24", "--level", "plane"});
  const io::Json levelled_first =
      json_of({"params", scan(), "--level", "plane", "--crop", "0,0,16,24"});
  EXPECT_THAT(cropped_first.at("treatment"), ElementsAre("crop=0,0,16,24", "level=plane"));
  EXPECT_THAT(levelled_first.at("treatment"), ElementsAre("level=plane", "crop=0,0,16,24"));
  // A plane fitted to the crop itself leaves less than one fitted to the whole scan.
  EXPECT_LT(cropped_first.at("parameters").at("Sq").at("value").get<double>(),
            levelled_first.at("parameters").at("Sq").at("value").get<double>());
}

TEST_F(ScanVerbs, UnlevelledScansAreWarnedAbout) {
  const Words part = {"params", scan(), "--crop", "0,0,20,16"};  // the whole of it tiles
  EXPECT_THAT(io::to_text(json_of(part).at("warnings")), HasSubstr("--level plane"));
  EXPECT_THAT(io::to_text(json_of(part + Words{"--level", "plane"}).at("warnings")),
              testing::Not(HasSubstr("--level plane")));
}

TEST_F(ScanVerbs, PsdHasTheAgreedKeys) {
  const io::Json psd = json_of({"psd", scan(), "--level", "plane"});
  expect_keys(psd, {"convention", "window", "x", "y", "radial", "rms_height_m", "rms_slope"});
  expect_keys(psd.at("x"), {"q_rad_per_m", "c1d_m3", "hurst"});
  expect_keys(psd.at("radial"), {"q_rad_per_m", "c2d_m4", "hurst"});
  EXPECT_EQ(psd.at("convention"), "jacobs");
  EXPECT_EQ(psd.at("x").at("q_rad_per_m").size(), psd.at("x").at("c1d_m3").size());
}

TEST_F(ScanVerbs, PsdWithoutWindowHasTheSurfacesRmsHeight) {
  const io::Json psd = json_of({"psd", scan(), "--window", "none"});
  EXPECT_NEAR(psd.at("rms_height_m").get<double>(), 1e-6, 1e-9);
}

TEST_F(ScanVerbs, ConvertKeepsTheHeights) {
  const Outcome converted = run_tabor({"convert", scan(), file("copy.gwy")});
  ASSERT_EQ(converted.code, 0) << converted.err;
  const io::Json before = json_of({"info", scan()});
  const io::Json after = json_of({"info", file("copy.gwy")});
  EXPECT_EQ(after.at("format"), "gwy");
  for (const char* key : {"nx", "ny", "height_min_m", "height_max_m"}) {
    EXPECT_EQ(after.at(key), before.at(key)) << key;
  }
}

TEST_F(ScanVerbs, PixelMayDifferAlongXAndY) {
  put_bytes(folder_ / "plain.txt", "1 2 3\n4 5 6\n7 8 10\n");
  const io::Json info = json_of({"info", file("plain.txt"), "--pixel", "5um,4um", "--unit", "nm"});
  EXPECT_DOUBLE_EQ(info.at("pixel_x_m").get<double>(), 5e-6);
  EXPECT_DOUBLE_EQ(info.at("pixel_y_m").get<double>(), 4e-6);
  EXPECT_DOUBLE_EQ(info.at("height_max_m").get<double>(), 10e-9);
}

TEST_F(ScanVerbs, InfoOfAFileThatLacksAUnitSaysWhatToGive) {
  put_bytes(folder_ / "plain.txt", "1 2 3\n4 5 6\n7 8 10\n");
  const io::Json info = json_of({"info", file("plain.txt")});
  EXPECT_TRUE(info.at("pixel_x_m").is_null());
  EXPECT_EQ(info.at("nx"), 3);
  EXPECT_EQ(info.at("ny"), 3);
  EXPECT_THAT(run_tabor({"info", file("plain.txt")}).out, HasSubstr("3 x 3"));
  EXPECT_EQ(info.at("channels").size(), 1u);
  EXPECT_THAT(info.at("doubts").at(0).get<std::string>(), HasSubstr("--pixel 0.67um --unit um"));
  // Everything that needs heights still rejects.
  EXPECT_EQ(run_tabor({"params", file("plain.txt")}).code, 3);
}

TEST_F(ScanVerbs, TableIsForPeopleAndJsonForPrograms) {
  const Outcome table = run_tabor({"params", scan(), "--level", "plane"});
  EXPECT_THAT(table.out, AllOf(HasSubstr("Sq"), HasSubstr("µm"), HasSubstr("level=plane")));
  const Outcome json = run_tabor({"params", scan(), "--level", "plane", "--json"});
  EXPECT_EQ(json.out.front(), '{');
  EXPECT_EQ(json.err, "");
}

TEST_F(ScanVerbs, GenerateIsReproducibleBySeed) {
  const auto made = [&](const std::string& name, const std::string& seed) {
    run_tabor({"generate", "edt", "-o", file(name), "--pixels", "64", "--seed", seed});
    return json_of({"info", file(name)}).at("height_max_m");
  };
  EXPECT_EQ(made("a.sdf", "5"), made("b.sdf", "5"));
  EXPECT_NE(made("a.sdf", "5"), made("c.sdf", "6"));
}

TEST_F(ScanVerbs, GenerateRejectsOptionsOfAnotherKind) {
  const Outcome outcome = run_tabor({"generate", "edt", "-o", file("x.sdf"), "--radius", "1mm"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--radius does not belong"));
}

TEST_F(ScanVerbs, GenerateNamesTheNearestKind) {
  const Outcome outcome = run_tabor({"generate", "sinusiod", "-o", file("x.sdf")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'sinusoid'"));
}

TEST_F(ScanVerbs, MissingFileIsBadInput) {
  const Outcome outcome = run_tabor({"info", file("absent.x3p")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(count_lines(outcome.err), 1u);
  EXPECT_THAT(outcome.err, HasSubstr("absent.x3p"));
}

TEST_F(ScanVerbs, ConvertSeparatesAsTheNameSays) {
  for (const auto& [name, separator] : {std::pair{"m.csv", ','}, {"m.CSV", ','}, {"m.txt", '\t'}}) {
    ASSERT_EQ(run_tabor({"convert", scan(), file(name)}).code, 0) << name;
    const std::string text = bytes_of(folder_ / name);
    const std::string row = text.substr(text.rfind('\n', text.size() - 2) + 1);
    const io::Json read = json_of({"info", file(name)});
    EXPECT_EQ(std::count(row.begin(), row.end(), separator), read.at("nx").get<int>() - 1) << name;
    EXPECT_EQ(read.at("height_rms_m"), json_of({"info", file("m.csv")}).at("height_rms_m")) << name;
  }
}

TEST_F(ScanVerbs, OutputInAnAbsentFolderCannotBeWritten) {
  const Outcome outcome = run_tabor({"convert", scan(), file("absent/out.h5")});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("absent"));
}

TEST_F(ScanVerbs, TheMeasurementIsNeverWrittenOver) {
  const std::string before = bytes_of(folder_ / "scan.sdf");
  std::filesystem::create_symlink("scan.sdf", folder_ / "link.sdf");
  for (const std::string& target : {scan(), file("./scan.sdf"), file("link.sdf")}) {
    const Outcome outcome = run_tabor({"convert", scan(), target, "--level", "plane"});
    EXPECT_EQ(outcome.code, 5) << target;
    EXPECT_THAT(outcome.err, HasSubstr("never written over"));
  }
  EXPECT_EQ(bytes_of(folder_ / "scan.sdf"), before);
}

TEST_F(ScanVerbs, AnUnknownOutputIsRejectedBeforeTheScanIsRead) {
  const Outcome outcome = run_tabor({"convert", file("absent.x3p"), file("out.xyzzy")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("extension '.xyzzy'"));
}

TEST_F(ScanVerbs, ParamsDescribeAProfileOfOneRow) {
  std::string text = "# x_um z_um\n";
  for (int i = 0; i < 400; ++i) {
    text += std::to_string(i) + " " + std::to_string(1 + 0.01 * i + std::sin(0.5 * i)) + "\n";
  }
  put_bytes(folder_ / "profile.txt", text);
  for (const char* level : {"none", "plane"}) {
    const Outcome outcome =
        run_tabor({"params", file("profile.txt"), "--set", "profile", "--level", level});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Ra_x"));
  }
}

TEST_F(ScanVerbs, WarningsSpeakOfTheSurfaceAsItWasTreated) {
  ASSERT_EQ(run_tabor({"generate", "self-affine", "-o", file("flat.txt"), "--pixels", "64,64",
                       "--pixel", "1um", "--rms-height", "10nm"})
                .code,
            0);
  topography::Topography tilted = scan::read(file("flat.txt"));
  for (Index x = 0; x < 64; ++x) tilted.height.col(x) += 1e-6 * static_cast<double>(x);
  scan::write(tilted, folder_ / "tilted.sdf");
  EXPECT_THAT(run_tabor({"params", file("tilted.sdf")}).err, HasSubstr("not levelled"));
  EXPECT_THAT(run_tabor({"params", file("tilted.sdf"), "--level", "plane"}).err,
              testing::Not(HasSubstr("tilt")));
}

TEST_F(ScanVerbs, ChannelsWithoutAUnitSayWhatMakesThemHeights) {
  put_bytes(folder_ / "plain.txt", "1 2 3\n4 7 6\n7 8 10\n");
  EXPECT_THAT(run_tabor({"info", file("plain.txt"), "--pixel", "1um", "--unit", "nm"}).out,
              HasSubstr("[?], unit as given"));
  EXPECT_THAT(run_tabor({"info", file("plain.txt"), "--pixel", "1um"}).out,
              HasSubstr("[?], a height with --unit or --z-scale only"));
}

TEST_F(ScanVerbs, PsdRejectsAFitOverNoRange) {
  const Outcome outcome = run_tabor({"psd", scan(), "--fit-min", "5/um", "--fit-max", "1/um"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the smaller one first"));
}

TEST_F(ScanVerbs, AnOptionWithoutItsValueSaysWhatIsMissing) {
  const Outcome outcome = run_tabor({"params", scan(), "--set"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("  ")));
}

TEST_F(ScanVerbs, HolesAreRejectedByPsdWithTheOptionThatFillsThem) {
  put_bytes(folder_ / "holes.txt", "1 2 3\n4 NaN 6\n7 8 10\n");
  const std::vector<std::string> words = {"psd", file("holes.txt"), "--pixel", "1um", "--unit",
                                          "nm",  "--window",        "none"};
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("--fill harmonic"));
}

TEST(Formats, ListsWhatIsReadAndWritten) {
  const io::Json formats = json_of({"formats"}).at("formats");
  ASSERT_GT(formats.size(), 5u);
  expect_keys(formats.at(0), {"name", "description", "extensions", "reads", "writes"});
  EXPECT_THAT(run_tabor({"formats"}).out, HasSubstr("x3p"));
}

TEST(Cite, WithoutAFileGivesEveryEntryOnce) {
  const io::Json entries = json_of({"cite"}).at("bibtex");
  for (const auto& [key, text] : entries.items()) {
    EXPECT_THAT(text.get<std::string>(), AllOf(HasSubstr("{" + key + ","), testing::EndsWith("}")));
  }
  EXPECT_TRUE(entries.contains("polonsky1999"));
}

TEST(Cite, RejectsAFileThatIsNoResult) {
  const Folder folder;
  put_bytes(folder / "x.h5", "not a result");
  EXPECT_EQ(run_tabor({"cite", (folder / "x.h5").string()}).code, 3);
  EXPECT_THAT(run_tabor({"cite", (folder / "y.h5").string()}).err, HasSubstr("no such file"));
}

}  // namespace
}  // namespace tabor::test
