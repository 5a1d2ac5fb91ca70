// What a run without a result leaves on stdout and stderr.
#include "tabor/cli/failure.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::test {
namespace {

using cli::error_json;
using testing::HasSubstr;
using testing::StartsWith;

io::Json null_if_empty(const std::string& text) {
  return text.empty() ? io::Json(nullptr) : io::Json(text);
}

TEST(ErrorObject, GivesBackThePartsOfAnInputError) {
  const Words gots = {"", "'7' without a unit", "'a; b', whose unit does not fit", "12: 3"};
  const Words expectations = {"", "a unit such as MPa", "hann, gauss: one of them"};
  const Words remedies = {"", "give --unit", "e.g. a=b; did you mean 'c'?"};
  for (const std::string& got : gots) {
    for (const std::string& expected : expectations) {
      for (const std::string& remedy : remedies) {
        if (got.empty() && expected.empty()) continue;  // a line of one part, below
        // Only "; expected" tells where text that holds a semicolon ends.
        if (expected.empty() && got.find(';') != std::string::npos) continue;
        const io::Json error =
            error_json(InputError("scan.x3p: --pressure", got, expected, remedy).what());
        EXPECT_EQ(error.at("what"), "scan.x3p: --pressure") << error;
        EXPECT_EQ(error.at("got"), null_if_empty(got)) << error;
        EXPECT_EQ(error.at("expected"), null_if_empty(expected)) << error;
        EXPECT_EQ(error.at("remedy"), null_if_empty(remedy)) << error;
      }
    }
  }
}

TEST(ErrorObject, IsNotPartedInBrackets) {
  const io::Json error = error_json("--output OUT is missing (the file; its name); see --help");
  EXPECT_EQ(error.at("what"), "--output OUT is missing (the file; its name)");
  EXPECT_EQ(error.at("remedy"), "see --help");
}

TEST(ErrorObject, OfALineWithoutPartsHoldsAllOfIt) {
  const io::Json error = error_json("x.h5: No such file; see 'tabor --help'");
  EXPECT_EQ(error.at("what"), "x.h5: No such file");
  EXPECT_TRUE(error.at("got").is_null());
  EXPECT_TRUE(error.at("expected").is_null());
  EXPECT_EQ(error.at("remedy"), "see 'tabor --help'");
  EXPECT_EQ(error.at("text"), "x.h5: No such file; see 'tabor --help'");
}

TEST(Failure, IsOneLineAndNothingOnStandardOutput) {
  std::ostringstream out;
  std::ostringstream err;
  cli::Context context{.out = out, .err = err};
  EXPECT_EQ(cli::fail(context, "two\nlines", 3), 3);
  EXPECT_EQ(err.str(), "tabor: two lines\n");
  EXPECT_EQ(out.str(), "");
}

TEST(Failure, AsksForJsonWhereverTheWordStands) {
  EXPECT_TRUE(cli::asks_for_json({"contact", "--nonsense", "--json"}));
  EXPECT_FALSE(cli::asks_for_json({"contact", "--jason"}));
}

/// One error of a verb: the words that provoke it, --json among them at the end.
void expect_error_object(Words words, int code) {
  words.emplace_back("--json");
  const Outcome outcome = run_tabor(words);
  const std::string line = testing::PrintToString(words);
  EXPECT_EQ(outcome.code, code) << line << outcome.err;
  EXPECT_THAT(outcome.err, StartsWith("tabor: ")) << line;
  io::Json object;
  ASSERT_NO_THROW(object = io::Json::parse(outcome.out))
      << line << " printed '" << outcome.out << "'";
  ASSERT_TRUE(object.contains("error")) << line << object;
  const io::Json& error = object.at("error");
  for (const char* key : {"what", "got", "expected", "remedy"}) {
    EXPECT_TRUE(error.contains(key)) << line << key;
  }
  EXPECT_TRUE(error.at("what").is_string()) << line;
  EXPECT_EQ(error.at("exit_code"), code) << line;
  EXPECT_TRUE(object.at("warnings").is_array()) << line;
  EXPECT_THAT(object.at("command").get<std::string>(), StartsWith("tabor")) << line;
  EXPECT_THAT(outcome.err, HasSubstr(error.at("text").get<std::string>())) << line;
}

class JsonErrors : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "edt", "-o", scan_, "--pixels", "32"});
    ASSERT_EQ(made.code, 0) << made.err;
    io::write_file(study_,
                   "shear_strength = \"70 MPa\"\n[material]\nyoungs_modulus = \"70 "
                   "GPa\"\npoissons_ratio = 0.3\n"
                   "[sweep]\nmean_pressure = [\"7 MPa\"]\nlubricant_density = [\"0.9 g/m^2\"]\n"
                   "[[scan]]\nfile = \"scan.h5\"\n");
    io::write_file(case_,
                   "[ball]\nradius = \"10 mm\"\nmass = \"32.5 g\"\nspeed = \"0.2 m/s\"\n"
                   "[solids]\ne_prime = \"230 GPa\"\n"
                   "[lubricant]\nviscosity = \"0.1 Pa s\"\npressure_viscosity = \"1.5e-8 1/Pa\"\n"
                   "viscosity_law = \"roelands\"\nlayer = \"50 um\"\n[grid]\nnodes = 40\n");
  }

  /// A call of every verb that reads something, of this file.
  static std::map<std::string, Words> calls(const std::string& scan, const std::string& study,
                                            const std::string& ball) {
    const Words contact = {scan,    "--pressure",      "7MPa", "--youngs-modulus",
                           "70GPa", "--poisson-ratio", "0.3"};
    Words friction = contact;
    friction.insert(friction.end(), {"--density", "0.9g/m^2", "--shear-strength", "70MPa"});
    return {{"info", {scan}},
            {"convert", {scan, "converted.h5"}},
            {"params", {scan}},
            {"psd", {scan}},
            {"combine", {scan, scan}},
            {"contact", contact},
            {"lubricate", {scan, "--density", "0.9g/m^2"}},
            {"friction", friction},
            {"sweep", {study}},
            {"ehl", {"impact", ball}},
            {"report", {scan}},
            {"cite", {scan}}};
  }

  static Words words_of(const std::string& verb, const Words& rest, const Words& more = {}) {
    Words words = {verb};
    words.insert(words.end(), rest.begin(), rest.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Folder folder_;
  std::string scan_ = (folder_ / "scan.h5").string();
  std::string study_ = (folder_ / "study.toml").string();
  std::string case_ = (folder_ / "ball.toml").string();
};

TEST_F(JsonErrors, OfWordsThatAreNotUnderstood) {
  expect_error_object({"contcat"}, 2);
  expect_error_object({"contact", scan_, "--pressure", "7"}, 2);
  for (const cli::Verb& verb : cli::verbs()) {
    expect_error_object({verb.name, "--no-such-option"}, 2);
    expect_error_object({verb.name, "--threads", "many"}, 2);
  }
}

TEST_F(JsonErrors, OfInputThatCannotBeRead) {
  const std::string absent = (folder_ / "absent").string();
  for (const auto& [verb, rest] : calls(absent + ".h5", absent + ".toml", absent + ".toml")) {
    expect_error_object(words_of(verb, rest), 3);
  }
  expect_error_object({"generate", "self-affine", "-o", (folder_ / "x.h5").string(), "--rms-height",
                       "1um", "--hurst", "7"},
                      3);
}

TEST_F(JsonErrors, OfResultsThatCannotBeWritten) {
  const std::string nowhere = (folder_ / "absent" / "x.h5").string();
  const std::string no_table = (folder_ / "absent" / "x.csv").string();
  auto all = calls(scan_, study_, case_);
  for (const char* verb : {"info", "cite", "convert", "report", "sweep"}) all.erase(verb);
  for (const auto& [verb, rest] : all) {
    expect_error_object(words_of(verb, rest, {"-o", verb == "params" ? no_table : nowhere}), 5);
  }
  expect_error_object({"convert", scan_, nowhere}, 5);
  expect_error_object({"generate", "edt", "-o", nowhere}, 5);
  expect_error_object({"sweep", study_, "-o", scan_}, 5);
  expect_error_object({"report", scan_, "-o", scan_}, 5);
}

TEST_F(JsonErrors, OfAPageNamedAsAFile) {
  expect_error_object({"report", scan_, "-o", "page.html"}, 2);
  EXPECT_FALSE(std::filesystem::exists("page.html"));
}

TEST_F(JsonErrors, OfRunsThatWereInterrupted) {
  auto all = calls(scan_, study_, case_);
  // These end sooner than anybody can interrupt them, or in a program of their own.
  for (const char* verb : {"info", "cite", "report"}) all.erase(verb);
  all.at("convert") = {scan_, (folder_ / "converted.h5").string()};
  all.at("sweep").insert(all.at("sweep").end(), {"-o", (folder_ / "results").string()});
  for (const auto& [verb, rest] : all) {
    cli::set_interrupted(true);
    expect_error_object(words_of(verb, rest), 130);
    cli::set_interrupted(false);
  }
}

}  // namespace
}  // namespace tabor::test
