// --csv of the verbs, and what several scans and groups of them add to psd and params.
#include <gmock/gmock.h>

#include <cmath>

#include "run_tabor.hpp"
#include "small_ball.hpp"
#include "support/folder.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class Csv : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<std::vector<std::string>> scans = {
        {"a_1.h5", "0.2um"}, {"a_2.h5", "0.4um"}, {"b_1.h5", "0.8um"}};
    for (const auto& scan : scans) {
      const Outcome made = run_tabor({"generate", "self-affine", "--pixels", "24", "--pixel", "1um",
                                      "--rms-height", scan[1], "-o", file(scan[0])});
      ASSERT_EQ(made.code, 0) << made.err;
    }
    put_bytes(folder_ / "ball.toml", kBall);
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  /// What --csv writes, which is what it prints without a name.
  io::CsvTable csv_of(const Words& words) const {
    const Outcome written = run_tabor(words + Words{"--csv", file("out.csv")});
    EXPECT_LE(written.code, 4) << written.err;
    EXPECT_THAT(written.out, testing::Not(testing::IsEmpty()));
    const Outcome printed = run_tabor(words + Words{"--csv"});
    const io::CsvTable table = io::read_csv(file("out.csv"));
    EXPECT_EQ(io::parse_csv(printed.out, "printed").columns, table.columns);
    return table;
  }

  /// Each state of --json is a row with the same numbers under the same keys.
  static void expect_rows(const io::CsvTable& table, const io::Json& rows) {
    ASSERT_EQ(table.rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& [key, value] : rows[i].items()) {
        if (key.ends_with("seconds") || key.ends_with("bytes") || !value.is_number()) continue;
        EXPECT_EQ(table.number(i, key), value.get<double>()) << key;
      }
    }
  }

  /// Of a table of groups; as many rows as there are where it has none.
  static std::size_t row_of(const io::CsvTable& table, const std::string& group,
                            const std::string& parameter) {
    std::size_t row = 0;
    while (row < table.rows.size() &&
           !(table.text(row, "group") == group && table.text(row, "parameter") == parameter)) {
      ++row;
    }
    EXPECT_LT(row, table.rows.size()) << group << ' ' << parameter;
    return row;
  }

  static void expect_one_line(const Words& words, int code, const std::string& part) {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  }

  Words contact() const {
    return {file("a_1.h5"), "--pressure",      "1MPa,2MPa", "--youngs-modulus",
            "70GPa",        "--poisson-ratio", "0.33"};
  }
  Words oil() const { return {"--density", "0.1g/m^2,0.2g/m^2"}; }
  Words both() const { return {file("a_1.h5"), file("a_2.h5"), file("b_1.h5")}; }

  Folder folder_;
};

TEST_F(Csv, HasTheNumbersOfEveryState) {
  for (const Words& words :
       {Words{"contact"} + contact(), Words{"lubricate", file("a_1.h5")} + oil(),
        Words{"friction"} + contact() + oil() + Words{"--shear-strength", "70MPa"},
        Words{"contact"} + contact() + Words{"--lowpass-scan", "2,4"}}) {
    expect_rows(csv_of(words), json_of(words).at("states"));
  }
}

TEST_F(Csv, HasTheCasesOfFilms) {
  const Words words = {"ehl", "point", file("ball.toml")};
  expect_rows(csv_of(words), io::Json::array({[&] {
                io::Json shown = io::Json::object();
                const io::Json all = json_of(words);
                for (const char* key : {"min_film_m", "central_film_m", "max_pressure_Pa"}) {
                  shown[key] = all.at(key);
                }
                return shown;
              }()}));
  const io::CsvTable swept = csv_of(words + Words{"--set", "motion.speed=100mm/s,0.2m/s"});
  ASSERT_EQ(swept.rows.size(), 2u);
  EXPECT_EQ(swept.columns.front(), "motion.speed [m/s]");
  EXPECT_EQ(swept.number(0, "motion.speed [m/s]"), 0.1);
  EXPECT_EQ(swept.number(1, "motion.speed [m/s]"), 0.2);
  EXPECT_LT(swept.number(0, "min_film_m"), swept.number(1, "min_film_m"));
  expect_one_line(words + Words{"--set", "motion.speed=0.1m/s,0.2m/s", "-o", file("o.h5"),
                                "--shard", "1/2", "--csv"},
                  2, "without --shard");
}

TEST_F(Csv, NeverReplacesAnInputOrTakesAnotherExtension) {
  put_bytes(folder_ / "scan.csv", "1 2\n3 4\n");
  const Words psd = {"psd", file("scan.csv"), "--pixel", "1um", "--unit", "um"};
  expect_one_line(psd + Words{"--csv", file("scan.csv")}, 5, "never written over");
  expect_one_line(Words{"contact"} + contact() + Words{"--csv", file("out.txt")}, 3,
                  "expected a name that ends in .csv");
  expect_one_line(Words{"contact"} + contact() + Words{"--csv=out.txt"}, 3, ".csv");
}

TEST_F(Csv, HasTheSpectraOfSeveralScansSideBySide) {
  const io::CsvTable table = csv_of(Words{"psd"} + both() + Words{"--group", "a=a_*"});
  const io::Json object = json_of(Words{"psd"} + both() + Words{"--group", "a=a_*"});
  ASSERT_EQ(object.at("scans").size(), 3u);
  ASSERT_EQ(object.at("groups").size(), 1u);
  const io::Json& mean = object.at("groups").at(0);
  EXPECT_EQ(mean.at("scans").size(), 2u);
  // The second is the first, twice as high: densities c and 4 c.
  for (std::size_t i = 0; i < 5; ++i) {
    const double c = table.number(i, "a_1.h5 psd_x_m3");
    EXPECT_NEAR(table.number(i, "a_2.h5 psd_x_m3"), 4 * c, 1e-9 * c);
    EXPECT_NEAR(table.number(i, "a psd_x_m3_mean"), 2.5 * c, 1e-9 * c);
    EXPECT_NEAR(table.number(i, "a psd_x_m3_std"), 3 / std::sqrt(2.0) * c, 1e-9 * c);
    EXPECT_NEAR(mean.at("x").at("mean").at(i).get<double>(), 2.5 * c, 1e-9 * c);
  }
  EXPECT_NEAR(mean.at("rms_height_m").at("mean").get<double>(), 0.3e-6, 1e-9);
}

TEST_F(Csv, StandsBesideAFileOfSpectra) {
  const Words words = Words{"psd"} + both() + Words{"--group", "all=*", "--group", "b=b_*"};
  EXPECT_EQ(run_tabor(words + Words{"-o", file("psd.h5")}).code, 0);
  const io::Hdf5Reader reader(file("psd.h5"));
  EXPECT_EQ(reader.text("/scans/0002", "file"), file("b_1.h5"));
  EXPECT_EQ(reader.text("/groups/0000", "group"), "all");
  EXPECT_EQ(reader.attribute_texts("/groups/0000", "scans").size(), 3u);
  EXPECT_EQ(reader.numbers("/scans/0000/psd_radial_m4").size(),
            reader.numbers("/groups/0000/psd_radial_m4_mean").size());
}

TEST_F(Csv, HasMeansOfParametersPerGroup) {
  const Words words = Words{"params"} + both() +
                      Words{"--set", "height", "--group", "a=a_*", "--group", "b=b_?.h5"};
  const io::CsvTable table = csv_of(words);
  EXPECT_EQ(table.columns, (Words{"group", "parameter", "unit", "n", "mean", "std", "sem", "a_1.h5",
                                  "a_2.h5", "b_1.h5"}));
  const io::Json object = json_of(words);
  const io::Json& sq = object.at("groups").at(0).at("parameters").at("Sq");
  EXPECT_EQ(sq.at("n"), 2);
  EXPECT_NEAR(sq.at("mean").get<double>(), 0.3e-6, 1e-9);
  EXPECT_NEAR(sq.at("std").get<double>(), 0.2e-6 / std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(object.at("groups").at(1).at("parameters").at("Sq").at("std").is_null());
  EXPECT_EQ(table.text(0, "group"), "a");
  const std::size_t row = row_of(table, "a", "Sq");
  EXPECT_NEAR(table.number(row, "a_1.h5"), 0.2e-6, 1e-9);
  EXPECT_NEAR(table.number(row, "a_2.h5"), 2 * table.number(row, "a_1.h5"), 1e-12);
  EXPECT_EQ(table.text(row, "b_1.h5"), "");
  EXPECT_EQ(table.text(row_of(table, "b", "Sq"), "a_2.h5"), "");
  EXPECT_THAT(run_tabor(words).out, HasSubstr("standard deviation"));
}

TEST_F(Csv, NamesAGroupThatNoScanFits) {
  for (const char* verb : {"psd", "params"}) {
    expect_one_line(Words{verb} + both() + Words{"--group", "c=c_*"}, 3, "which no scan fits");
    expect_one_line(Words{verb} + both() + Words{"--group", "c"}, 2, "NAME=PATTERN");
  }
}

}  // namespace
}  // namespace tabor::test
