// What all verbs that write have in common: no input is written over, nothing is half-written.
#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <set>

#include "run_tabor.hpp"
#include "small_ball.hpp"
#include "support/folder.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

constexpr const char* kStudy = R"(shear_strength = "70 MPa"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
[sweep]
mean_pressure = ["5 MPa"]
lubricant_density = ["0.9 g/m^2"]
[experiment]
file = "measured.csv"
[[scan]]
file = "in.h5"
)";

class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    const Words make = {"generate", "self-affine", "--pixels", "24", "--pixel", "1um"};
    for (const auto& [name, seed] : {std::pair{"in.h5", "1"}, {"second.h5", "2"}}) {
      const Outcome made =
          run_tabor(make + Words{"--rms-height", "0.2um", "-o", folder_ / name, "--seed", seed});
      ASSERT_EQ(made.code, 0) << made.err;
    }
    const Outcome solved =
        run_tabor({"friction", file("in.h5"), "--level", "mean", "--pressure", "1MPa",
                   "--youngs-modulus", "70GPa", "--poisson-ratio", "0.33", "--density", "0g/m^2",
                   "--shear-strength", "70MPa", "-o", file("friction.h5")});
    ASSERT_EQ(solved.code, 0) << solved.err;
    put_bytes(folder_ / "case.toml", kBall);
    put_bytes(folder_ / "study.toml", kStudy);
    put_bytes(folder_ / "measured.csv", "mean_pressure_Pa,friction\n5e6,0.1\n");
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  struct Call {
    Words words;        ///< without the output
    std::string input;  ///< that they name; "" for none
    std::string output = "out.h5";
    bool is_option = true;  ///< behind a flag
    std::string flag = "-o";
  };

  /// One working call or more of every verb that writes a file.
  std::multimap<std::string, Call> calls() const {
    const std::string scan = file("in.h5");
    const Words contact = {scan,   "--level",          "mean",  "--pressure",
                           "1MPa", "--youngs-modulus", "70GPa", "--poisson-ratio",
                           "0.33"};
    const Words oil = {"--density", "0.9g/m^2"};
    return {
        {"convert", {{"convert", scan}, "in.h5", "out.gsf", false}},
        {"params", {{"params", file("second.h5"), scan}, "in.h5", "out.csv"}},
        {"psd", {{"psd", scan}, "in.h5"}},
        {"psd", {{"psd", scan}, "in.h5", "out.csv"}},
        {"combine", {{"combine", scan, file("second.h5"), "--no-register"}, "in.h5"}},
        {"combine", {{"combine", scan, file("second.h5"), "--no-register"}, "second.h5"}},
        {"generate",
         {{"generate", "bump", "--pixels", "24", "--height", "1um", "--radius", "2um"}, ""}},
        {"convert",
         {{"convert", file("friction.h5"), "--field", "all"}, "friction.h5", "out.gwy", false}},
        {"contact", {Words{"contact"} + contact, "in.h5"}},
        {"contact", {Words{"contact"} + contact, "in.h5", "out.vti"}},
        {"lubricate", {Words{"lubricate", scan} + oil, "in.h5"}},
        {"friction",
         {Words{"friction"} + contact + oil + Words{"--shear-strength", "70MPa"}, "in.h5"}},
        {"slide",
         {Words{"slide"} + contact +
              Words{"--saturation-pressure", "100MPa", "--shear-strength", "70MPa", "--tool",
                    "ground:Sa=10nm,groove-length=10um", "--distance", "2um"},
          "in.h5", "out.h5", true, "--after"}},
        {"slide",
         {Words{"slide"} + contact +
              Words{"--saturation-pressure", "100MPa", "--shear-strength", "70MPa", "--tool",
                    "ground:Sa=10nm,groove-length=10um", "--distance", "2um"},
          "in.h5"}},
        {"table",
         {{"table", file("friction.h5"), "--for", "csv", "--units", "mm,s,t"},
          "friction.h5",
          "out.csv"}},
        {"ehl", {{"ehl", "point", file("case.toml")}, "case.toml"}},
        {"ehl",
         {{"ehl", "point", file("case.toml"), "--set", "motion.speed=0.1m/s,0.2m/s"}, "case.toml"}},
    };
  }

  static Words with_output(const Call& call, const std::string& output) {
    return call.words + (call.is_option ? Words{call.flag, output} : Words{output});
  }

  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      all[entry.path()] = entry.is_regular_file() ? bytes_of(entry.path()) : "";
    }
    return all;
  }

  /// Rejected in one line, and nothing in the folder is other than before.
  void expect_rejected(const Words& words, int code, const std::string& part) const {
    const auto before = contents();
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, code) << words.front() << ' ' << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part)) << words.front();
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(contents(), before) << words.front();
  }

  Folder folder_;
};

constexpr const char* kOver = "never written over";

/// Verbs that write into a folder have tests of their own below.
const std::set<std::string> kFolderVerbs = {"report", "sweep", "man"};

TEST_F(Outputs, OfEveryVerbAreTriedHere) {
  const auto known = calls();
  for (const cli::Verb& verb : cli::verbs()) {
    const cli::OptionSet set = cli::options_of(verb);
    for (const cli::Option& option : set.options()) {
      const bool writes = option.names == cli::FileRole::output;
      EXPECT_TRUE(!writes || known.contains(verb.name)) << verb.name << " has no call here";
      const bool fills = option.names == cli::FileRole::folder;
      EXPECT_TRUE(!fills || kFolderVerbs.contains(verb.name)) << verb.name;
    }
  }
}

TEST_F(Outputs, AndInputsAreDeclaredByEveryVerb) {
  const std::set<std::string> words = {"ehl PROGRAM", "generate KIND", "completion SHELL",
                                       "man VERB"};
  for (const cli::Verb& verb : cli::verbs()) {
    const cli::OptionSet set = cli::options_of(verb);
    for (const cli::Option& option : set.options()) {
      const std::string name = verb.name + " " + option.flag;
      const bool is_output = option.flag == "--output" || option.flag == "OUT" ||
                             option.flag == "--csv" || option.flag == "--after";
      const bool writes =
          option.names == cli::FileRole::output || option.names == cli::FileRole::folder;
      EXPECT_EQ(is_output, writes) << name;
      EXPECT_EQ(option.names == cli::FileRole::output, !option.extensions.empty()) << name;
      if (!option.is_positional() || is_output || words.contains(name)) continue;
      EXPECT_EQ(option.names, cli::FileRole::input) << name;
    }
  }
}

TEST_F(Outputs, OfManGoIntoAFolderAndNotOverAFile) {
  const std::string folder = file("man1");
  EXPECT_EQ(run_tabor({"man", "contact", "-o", folder}).code, 0);
  EXPECT_EQ(bytes_of(folder + "/tabor-contact.1"), run_tabor({"man", "contact"}).out);
  expect_rejected({"man", "-o", file("in.h5")}, 5, "in.h5");
}

TEST_F(Outputs, NeverReplaceAnInputByWhateverName) {
  for (const auto& [verb, call] : calls()) {
    if (call.input.empty()) continue;
    const std::string input = file(call.input);
    const std::string extension = fs::path(call.output).extension();
    fs::create_symlink(call.input, file("link" + extension));
    fs::create_symlink("link" + extension, file("link_of_link" + extension));
    fs::create_hard_link(input, file("hard" + extension));
    fs::create_directory_symlink(".", file("here"));
    for (const std::string& output :
         {input, file("./" + call.input), file("here/" + call.input), file("link" + extension),
          file("link_of_link" + extension), file("hard" + extension)}) {
      expect_rejected(with_output(call, output), 5, kOver);
    }
    for (const char* name : {"link", "link_of_link", "hard"}) fs::remove(file(name + extension));
    fs::remove(file("here"));
  }
}

TEST_F(Outputs, OfAnExtensionThatAVerbDoesNotWriteAreRejectedWithThoseItDoes) {
  for (const auto& [verb, call] : calls()) {
    for (const char* name : {"out.docx", "out", "out.h5.bak"}) {
      expect_rejected(with_output(call, file(name)), 3, fs::path(call.output).extension());
    }
  }
  for (const char* verb : {"contact", "friction", "lubricate", "ehl"}) {
    expect_rejected(with_output(calls().find(verb)->second, file("out.csv")), 3, ".h5 .hdf5");
  }
  expect_rejected(with_output(calls().find("ehl")->second, file("out.vti")), 3, ".h5 .hdf5");
}

TEST_F(Outputs, NeverReplaceAScanThatACaseNames) {
  for (const std::string line : {"[roughness]\nfile = \"in.h5\"\n", ""}) {
    put_bytes(file("case.toml"), kBall + line);
    Words words = {"ehl", "point", file("case.toml")};
    if (line.empty()) words = words + Words{"--set", "roughness.file=second.h5,in.h5"};
    expect_rejected(words + Words{"-o", file("in.h5")}, 5, kOver);
    fs::create_directory(file("out.h5.cases"));
    fs::create_symlink("../in.h5", file("out.h5.cases/start-0123456789abcdef.h5"));
    expect_rejected(words + Words{"--set", "motion.speed=0.1m/s,0.2m/s", "-o", file("out.h5")}, 5,
                    kOver);
    fs::remove_all(file("out.h5.cases"));
  }
}

TEST_F(Outputs, NeverReplaceACaseAmongTheKeptOnes) {
  fs::create_directory(file("out.h5.cases"));
  for (const char* name : {"lock", "case-0.json", ".x.1-0.tabor-tmp"}) {
    const std::string inside = file("out.h5.cases/") + name;
    put_bytes(inside, kBall);
    expect_rejected(
        {"ehl", "point", inside, "--set", "motion.speed=0.1m/s,0.2m/s", "-o", file("out.h5")}, 5,
        kOver);
    fs::remove(inside);
  }
}

TEST_F(Outputs, NeverTakeAnInputForALeftover) {
  fs::rename(file("in.h5"), file(".out.h5.1-0.tabor-tmp"));
  expect_rejected({"psd", file(".out.h5.1-0.tabor-tmp"), "-o", file("out.h5")}, 5, kOver);
}

TEST_F(Outputs, OfASweepNeverReplaceItsInputs) {
  const Words sweep = {"sweep", file("study.toml"), "-o"};
  expect_rejected(sweep + Words{file("study.toml")}, 5, kOver);
  for (const std::string input : {"in.h5", "measured.csv"}) {
    for (const std::string table : {"results.h5", "results.csv", "averages.csv", "store/x"}) {
      fs::create_directories(file("out/store"));
      fs::create_hard_link(file(input), file("out/" + table));
      expect_rejected(sweep + Words{file("out")}, 5, kOver);
      fs::remove(file("out/" + table));
      fs::create_symlink(file(input), file("out/" + table));
      expect_rejected(sweep + Words{file("out")}, 5, kOver);
      fs::remove_all(file("out"));
    }
  }
  // Beside its inputs it may write.
  const Outcome beside = run_tabor(sweep + Words{folder_.path()});
  EXPECT_EQ(beside.code, 0) << beside.err;
}

TEST_F(Outputs, OfAReportNeverReplaceTheResult) {
  expect_rejected({"report", file("in.h5"), "-o", file("in.h5")}, 5, kOver);
}

/// LLVM's OpenMP writes a file of this size in every copy of the process, as HDF5 is read in.
#if defined(__clang__)
constexpr rlim_t kRuntimeFile = 1024;
#else
constexpr rlim_t kRuntimeFile = 0;
#endif

TEST_F(Outputs, OnAFullDiskAreWholeOrAbsent) {
  for (const auto& [verb, call] : calls()) {
    const std::string output = file(call.output);
    ASSERT_LE(run_tabor(with_output(call, output)).code, 4) << verb;
    const auto size = fs::file_size(output);
    fs::remove(output);
    fs::remove_all(output + ".cases");
    const auto before = contents();
    for (const rlim_t limit : {rlim_t{0}, rlim_t{1}, rlim_t{size / 3}, rlim_t{size - 1}}) {
      if (limit < kRuntimeFile) continue;
      Outcome outcome;
      {
        const FullDisk full(limit);
        outcome = run_tabor(with_output(call, output));
      }
      EXPECT_EQ(outcome.code, 5) << verb << ' ' << limit << ' ' << outcome.err;
      fs::remove_all(output + ".cases");  // whole cases may stay, and the next run takes them
      EXPECT_EQ(contents(), before) << verb << ' ' << limit;
    }
  }
}

TEST_F(Outputs, ReplaceWhatTheyReplacedBeforeAndClearAwayWhatAKilledProgramLeft) {
  for (const auto& [verb, call] : calls()) {
    const std::string output = file(call.output);
    const std::string leftover = file("." + call.output + ".4194305-3.tabor-tmp");
    put_bytes(output, "an older result");
    put_bytes(leftover, "half a result");
    EXPECT_LE(run_tabor(with_output(call, output)).code, 4) << verb;
    EXPECT_NE(bytes_of(output), "an older result") << verb;
    EXPECT_FALSE(fs::exists(leftover)) << verb;
  }
}

TEST_F(Outputs, InterruptedBeforeTheFirstStateAreNotMade) {
  for (const auto& [verb, call] : calls()) {
    if (verb != "contact" && verb != "friction" && verb != "lubricate" && verb != "ehl") continue;
    cli::set_interrupted(true);
    expect_rejected(with_output(call, file(call.output)), 130, "interrupted");
    cli::set_interrupted(false);
  }
}

TEST_F(Outputs, WithoutAStateAreNotMade) {
  const topography::Topography surface = scan::read(file("in.h5"));
  for (const bool has_state : {false, true}) {
    results::FieldsFile fields(file("out.h5"), {}, {}, surface, {});
    if (has_state) fields.add_state(0, {}, {{"gap", "m", "gap", surface.height}});
    fields.commit({});
    EXPECT_EQ(fs::exists(file("out.h5")), has_state);
  }
}

}  // namespace
}  // namespace tabor::test
