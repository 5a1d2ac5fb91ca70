// tabor params: one scan, several side by side, batches.
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cli/params_text.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Two small periodic surfaces, the second twice as rough, and a file that is none.
class Params : public testing::Test {
 protected:
  void SetUp() override {
    make("a.sdf", "1um");
    make("b.sdf", "2um");
    put_bytes(folder_ / "broken.sdf", "not a scan");
  }
  void make(const std::string& name, const std::string& rms) {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", file(name), "--pixels",
                                    "32,24", "--pixel", "1um", "--rms-height", rms});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  Folder folder_;
};

TEST_F(Params, OfOneScanAreGroupedBySet) {
  const Outcome one =
      run_tabor({"params", file("a.sdf"), "--level", "plane", "--set", "volume,height"});
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.out, AllOf(HasSubstr("768 of 768 pixels"), HasSubstr("µm³/µm²")));
  const std::size_t volume = one.out.find("\nVmp");
  const std::size_t height = one.out.find("\nSq");
  ASSERT_NE(volume, std::string::npos) << one.out;
  EXPECT_LT(volume, height) << one.out;
  EXPECT_THAT(one.out, testing::Not(HasSubstr("\nSdq")));
}

TEST_F(Params, OfOneScanKeepTheContract) {
  const io::Json one = json_of({"params", file("a.sdf"), "--level", "plane"});
  EXPECT_EQ(one.at("valid_points"), 768);
  EXPECT_EQ(one.at("parameters").at("Sq").at("set"), "height");
  EXPECT_FALSE(one.contains("scans"));
  for (const auto& [symbol, parameter] : one.at("parameters").items()) {
    EXPECT_TRUE(!parameter.at("value").is_null() || parameter.contains("note")) << symbol;
  }
}

TEST_F(Params, OfTwoScansStandSideBySideWithTheirRatio) {
  const Outcome two = run_tabor({"params", file("a.sdf"), file("b.sdf"), "--set", "height"});
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_THAT(two.out,
              AllOf(HasSubstr("a.sdf"), HasSubstr("b.sdf"), HasSubstr("change"), HasSubstr("x 2")));
}

TEST_F(Params, OfSeveralScansAreAListInJson) {
  const io::Json two = json_of({"params", file("a.sdf"), file("b.sdf"), "--set", "height"});
  ASSERT_EQ(two.at("scans").size(), 2u);
  const auto sq = [&](std::size_t i) {
    return two.at("scans").at(i).at("parameters").at("Sq").at("value").get<double>();
  };
  EXPECT_NEAR(sq(1) / sq(0), 2, 1e-6);
  EXPECT_EQ(two.at("scans").at(1).at("scan").at("path"), file("b.sdf"));
}

TEST_F(Params, AsCsvHaveOneRowPerScanInSiUnits) {
  const Outcome outcome =
      run_tabor({"params", file("a.sdf"), file("b.sdf"), "--set", "height,hybrid", "--csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvTable table = io::parse_csv(outcome.out, "stdout");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.text(1, "scan"), file("b.sdf"));
  EXPECT_NEAR(table.number(0, "Sq [m]"), 1e-6, 1e-9);
  EXPECT_GT(table.number(0, "Sdr [%]"), 0);
}

TEST_F(Params, InAFileAreTheCsvThatIsPrinted) {
  const std::vector<std::string> words{"params", file("a.sdf"), file("b.sdf"), "--set", "height"};
  auto printed = words, written = words;
  printed.emplace_back("--csv");
  written.insert(written.end(), {"-o", file("out.csv")});
  EXPECT_EQ(run_tabor(written).code, 0);
  EXPECT_EQ(io::read_text(folder_ / "out.csv"), run_tabor(printed).out);
}

TEST_F(Params, OfABatchAreDoneEvenIfOneScanCannotBeRead) {
  const Outcome outcome = run_tabor(
      {"params", file("a.sdf"), file("broken.sdf"), file("b.sdf"), "--set", "height", "--csv"});
  EXPECT_EQ(outcome.code, 3);
  const io::CsvTable table = io::parse_csv(outcome.out, "stdout");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_THAT(table.text(1, "failure"), HasSubstr("broken.sdf"));
  EXPECT_EQ(table.text(1, "Sq [m]"), "");
  EXPECT_EQ(table.text(2, "failure"), "");
  EXPECT_THAT(outcome.err, HasSubstr("not measured"));
}

TEST_F(Params, OfScansSideBySideStandInTheOrderAskedFor) {
  Words files;
  for (const char* name : {"a.sdf", "broken.sdf", "b.sdf", "a.sdf", "b.sdf", "missing.sdf"}) {
    files.push_back(file(name));
  }
  for (const char* verb : {"params", "psd"}) {
    const auto run = [&](const char* threads) {
      Words words{verb};
      words.insert(words.end(), files.begin(), files.end());
      words.insert(words.end(), {"--threads", threads, "--csv"});
      return run_tabor(words);
    };
    const Outcome one = run("1");
    const Outcome several = run("3");
    EXPECT_EQ(one.code, 3) << verb;
    EXPECT_EQ(several.code, 3) << verb;
    EXPECT_EQ(one.out, several.out) << verb;
    EXPECT_EQ(one.err, several.err) << verb;
  }
}

TEST_F(Params, OfSpectraNameTheFirstScanThatFails) {
  const Outcome outcome =
      run_tabor({"psd", file("a.sdf"), file("broken.sdf"), file("missing.sdf"), "--threads", "3"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("broken.sdf"), testing::Not(HasSubstr("missing.sdf"))));
}

TEST_F(Params, NameTheNearestSet) {
  const Outcome outcome = run_tabor({"params", file("a.sdf"), "--set", "heigth"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'height'"));
}

TEST_F(Params, RejectOneMaterialRatio) {
  EXPECT_EQ(run_tabor({"params", file("a.sdf"), "--material-ratios", "10"}).code, 2);
  EXPECT_EQ(run_tabor({"params", file("a.sdf"), "--material-ratios", "80,10"}).code, 3);
}

TEST(ReadableUnit, MakesANumberFromOne) {
  EXPECT_EQ(cli::readable_unit("m", 3.4e-6).name, "µm");
  EXPECT_EQ(cli::readable_unit("m^2", 2e-8).name, "µm²");
  EXPECT_EQ(cli::readable_unit("1/m^2", 5e7).name, "1/mm²");
  EXPECT_EQ(cli::readable_unit("m^3/m^2", 2e-8).name, "nm³/nm²");
  EXPECT_EQ(cli::readable_unit("%", 3).name, "%");
  EXPECT_EQ(cli::readable_unit("1", 3).name, "");
  EXPECT_NEAR(cli::readable_unit("m^2", 2e-8).factor * 2e-8, 2e4, 1e-6);
}

}  // namespace
}  // namespace tabor::test
