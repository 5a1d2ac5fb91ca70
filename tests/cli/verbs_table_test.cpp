// table: decks of a small study and of one scan.
#include <gmock/gmock.h>

#include "forming/deck_parsers.hpp"
#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TableVerb : public testing::Test {
 protected:
  void SetUp() override { write_results({0.2, 0.25, 0.3, 0.1}, {"", "clamp", "", ""}); }

  std::string file(const std::string& name) const { return folder_ / name; }

  /// What a sweep of one scan leaves: each pressure with 0.45 and 0.9 g/m^2.
  void write_results(const std::vector<double>& friction, const std::vector<std::string>& codes,
                     const std::string& command = "tabor sweep study.toml",
                     const std::vector<double>& pressures = {2e6, 7e6}) {
    io::Hdf5Writer writer(folder_ / "results.h5");
    writer.attribute("/", "format", "tabor");
    writer.attribute("/", "command", command);
    writer.attribute("/", "software_version", "0.1.0");
    writer.attribute("/", "created", "2026-01-01T00:00:00Z");
    const std::size_t n = friction.size();
    std::vector<double> pressure, density;
    for (const double one : pressures) {
      pressure.insert(pressure.end(), {one, one});
      density.insert(density.end(), {0.45, 0.9});
    }
    writer.write("/table/scan", std::vector<std::string>(n, "a.gsf"));
    writer.write("/table/group", std::vector<std::string>(n, "before"));
    writer.write("/table/error", std::vector<std::string>(n, ""));
    writer.write("/table/warning_codes", codes);
    writer.write("/table/mean_pressure_Pa", pressure);
    writer.write("/table/lubricant_density_g_per_m2", density);
    writer.write("/table/friction_dry", std::vector<double>(n, 0.3));
    writer.write("/table/friction_lubricated", friction);
    writer.write("/table/converged", std::vector<std::int64_t>(n, 1));
    writer.commit();
  }

  Words table(const std::string& program, const Words& more = {}) const {
    Words words = {"table", file("results.h5"), "--for", program, "--units", "mm,s,t"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  static void expect_one_line(const Words& words, int code, const std::string& part) {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(outcome.out, "");
  }

  Folder folder_;
};

TEST_F(TableVerb, PrintsADeckAndNothingElse) {
  const Outcome outcome = run_tabor(table("abaqus"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::vector<DeckNumber> numbers = parse_abaqus(outcome.out);
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_EQ(numbers[1].friction, 0.3);  // 7 MPa, 0.45 g/m^2
  EXPECT_EQ(numbers[1].pressure, 7);
  EXPECT_DOUBLE_EQ(numbers[1].density, 4.5e-13);
}

TEST_F(TableVerb, WritesTheSameDeckToAFile) {
  const Words words = table("lsdyna", {"-o", file("deck.k")});
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("before"), HasSubstr("deck.k"), HasSubstr("MPa")));
  EXPECT_EQ(parse_lsdyna(bytes_of(file("deck.k"))).size(), 2u);
  EXPECT_THAT(bytes_of(file("deck.k")), HasSubstr("made with: tabor sweep study.toml"));
}

TEST_F(TableVerb, TellsTheNumbersInJson) {
  const io::Json result = json_of(table("csv"));
  ASSERT_EQ(result.at("numbers").size(), 4u);
  EXPECT_EQ(result.at("numbers").at(3).at("friction_coefficient"), 0.1);
  EXPECT_EQ(result.at("numbers").at(3).at("lubricant_density_g_per_m2"), 0.9);
  EXPECT_EQ(result.at("pressure_unit"), "MPa");
  EXPECT_EQ(result.at("left_out").size(), 0u);
  EXPECT_EQ(io::parse_csv(result.at("deck").get<std::string>(), "deck").rows.size(), 4u);
  EXPECT_EQ(json_of(table("csv", {"-o", file("out.csv")})).at("output"), file("out.csv"));
}

TEST_F(TableVerb, NamesWhatItLeavesOut) {
  write_results({0.2, 0.25, 0.3, 0.1}, {"", "", "", "resolution flood"});
  const Outcome outcome = run_tabor(table("csv"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("left out (flood): 7 MPa 0.9 g/m^2"));
  EXPECT_EQ(io::parse_csv(outcome.out, "deck").rows.size(), 3u);
  const io::Json left_out = json_of(table("csv")).at("left_out");
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out.at(0).at("code"), "flood");
  EXPECT_EQ(left_out.at(0).at("mean_pressure_Pa"), 7e6);
  EXPECT_EQ(json_of(table("csv", {"--keep", "flood"})).at("numbers").size(), 4u);
  // At 0.9 g/m^2 one pressure remains: no table over pressure.
  expect_one_line(table("abaqus"), 3, "one pressure alone (2 MPa) at 0.9 g/m^2; left out: flood 1");
  EXPECT_EQ(run_tabor(table("abaqus", {"--density", "0.45g/m^2"})).code, 0);
}

TEST_F(TableVerb, LeavesOutOilThatDoesNotFit) {
  write_results({0.2, 0.25, 0.3, 0.1}, {"", "", "", "spill-over flooded"});
  EXPECT_EQ(json_of(table("csv")).at("left_out").at(0).at("code"), "flooded");
  EXPECT_EQ(json_of(table("csv", {"--keep", "flooded"})).at("numbers").size(), 4u);
}

TEST_F(TableVerb, SaysWhereNothingRemains) {
  write_results({0.2, 0.25, 0.3, 0.1}, std::vector<std::string>(4, "frictionless"));
  const Outcome outcome = run_tabor(table("csv"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(count_lines(outcome.err), 1u);
  EXPECT_THAT(outcome.err, HasSubstr("frictionless 4"));
  EXPECT_EQ(run_tabor(table("csv", {"--density", "0g/m^2"})).code, 0);
}

TEST_F(TableVerb, TellsTheErrorOfTheFit) {
  const Outcome exact = run_tabor(table("openradioss"));
  EXPECT_EQ(exact.code, 0);
  EXPECT_THAT(exact.err, testing::Not(HasSubstr("fitted law")));
  EXPECT_EQ(parse_openradioss(exact.out).size(), 2u);
  const io::Json fits = json_of(table("openradioss")).at("fits");
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_LT(fits.at(0).at("largest_error").get<double>(), 1e-12);  // a line through two points
  write_results({0.3, 0.3, 0.2, 0.2, 0.3, 0.3, 0.1, 0.2}, std::vector<std::string>(8),
                "tabor sweep study.toml", {1e6, 2e6, 4e6, 7e6});
  EXPECT_THAT(run_tabor(table("openradioss")).err, HasSubstr("0.45 g/m^2: the fitted law misses"));
}

TEST_F(TableVerb, CountsFromTheNumberAskedFor) {
  const auto tables = parse_lsdyna(run_tabor(table("lsdyna", {"--id", "500"})).out);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].id, 500);
  EXPECT_EQ(tables[1].id, 503);
  EXPECT_EQ(parse_ansys(run_tabor(table("ansys", {"--id", "7"})).out)[1].first, 8);
}

TEST_F(TableVerb, RejectsUnitsThatAreNone) {
  const auto expect_usage = [&](const Words& words, const std::string& part) {
    expect_one_line(words, 2, part);
  };
  expect_usage({"table", file("results.h5"), "--for", "abaqus"}, "--units L,T,M is missing");
  expect_usage({"table", file("results.h5"), "--units", "mm,s,t"}, "--for");
  expect_usage({"table", file("results.h5"), "--for", "abacus", "--units", "mm,s,t"}, "abaqus");
  expect_usage({"table", file("results.h5"), "--for", "csv", "--units", "mm,s"}, "mass or force");
  expect_usage(table("csv", {"--id", "0"}), "--id");
  expect_usage(table("csv", {"--density", "0.9"}), "without a unit");
}

TEST_F(TableVerb, RejectsWhatItCannotRead) {
  const auto expect_input = [&](const Words& words, const std::string& part) {
    expect_one_line(words, 3, part);
  };
  const Words rest = {"--for", "csv", "--units", "mm,s,t"};
  const auto of = [&](const std::string& results) {
    Words words = {"table", results};
    words.insert(words.end(), rest.begin(), rest.end());
    return words;
  };
  EXPECT_EQ(run_tabor(of(folder_.path())).code, 0);
  EXPECT_EQ(run_tabor({"generate", "bump", "--pixels", "16", "--height", "1um", "--radius", "2um",
                       "-o", file("scan.h5")})
                .code,
            0);
  expect_input(of(file("scan.h5")), "without friction");
  expect_input(of(file("absent.h5")), "absent.h5");
  expect_input(of("/"), "without results.h5");
  expect_input(table("csv", {"--group", "after"}), "before");
  expect_input(table("csv", {"--keep", "clamp"}), "not-converged");
  expect_input(table("csv", {"--density", "2g/m^2"}), "0.45 g/m^2");
  expect_input(table("abaqus", {"-o", file("deck.k")}), ".inp for abaqus");
}

TEST_F(TableVerb, TakesAFileOfFriction) {
  const Outcome made = run_tabor({"generate", "self-affine", "--pixels", "32", "--pixel", "1um",
                                  "--rms-height", "0.3um", "-o", file("scan.gsf")});
  ASSERT_EQ(made.code, 0) << made.err;
  const Words friction = {"friction",
                          file("scan.gsf"),
                          "--pressure",
                          "5MPa,50MPa",
                          "--youngs-modulus",
                          "70GPa",
                          "--poisson-ratio",
                          "0.33",
                          "--density",
                          "0.05g/m^2,0.1g/m^2",
                          "--shear-strength",
                          "70MPa",
                          "-o",
                          file("friction.h5")};
  const io::Json solved = json_of(friction);
  const Words words = {"table",  file("friction.h5"), "--for", "csv", "--units", "m,s,kg",
                       "--keep", "frictionless,flood"};
  const io::Json result = json_of(words);
  EXPECT_EQ(result.at("group"), "");
  for (const io::Json& number : result.at("numbers")) {
    bool is_there = false;
    for (const io::Json& state : solved.at("states")) {
      if (state.at("mean_pressure_Pa") != number.at("mean_pressure_Pa") ||
          state.at("lubricant_density_g_per_m2") != number.at("lubricant_density_g_per_m2")) {
        continue;
      }
      is_there = true;
      EXPECT_EQ(state.at("friction_lubricated"), number.at("friction_coefficient"));
      EXPECT_EQ(number.at("n"), 1);
    }
    EXPECT_TRUE(is_there);
  }
  EXPECT_EQ(result.at("numbers").size(), 4u);
}

TEST_F(TableVerb, OfNoProgramNeedsNoUnits) {
  const Words csv{"table", file("results.h5"), "--for", "csv"};
  const Outcome outcome = run_tabor(csv);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(run_tabor(csv + Words{"--units", "m,s,kg"}).out.substr(0, 40),
            outcome.out.substr(0, 40));
  expect_one_line({"table", file("results.h5"), "--for", "abaqus"}, 2, "--units L,T,M is missing");
}

}  // namespace
}  // namespace tabor::test
