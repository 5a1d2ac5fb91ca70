#include "tabor/cli/ehl_kept.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>

#include "support/folder.hpp"
#include "tabor/cli/ehl_cases.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/digest.hpp"

namespace tabor::cli {
namespace {

using testing::HasSubstr;

/// A program whose answer to each case is that of the case before, plus a number of its own.
EhlProgram adding_program() {
  EhlProgram program{.name = "add",
                     .summary = "",
                     .keys = {{.name = "number"}, {.name = "file"}},
                     .files = {"file"},
                     .columns = {{"sum", "sum", ""}},
                     .studies = {},
                     .methods = {},
                     .solve = {}};
  program.make_chain = [] {
    const auto sum = std::make_shared<double>(0);
    EhlChain chain;
    chain.solve = [sum](const io::Config& config, Context& context) {
      const double number = config.number("number");
      if (number == 13) throw InputError("unlucky");
      *sum += 1 / number;
      context.warn("numbers are added");
      return EhlAnswer{
          .scalars = {{"sum", *sum}}, .text = "", .converged = number < 5, .warnings = {"a sum"}};
    };
    chain.write_start = [sum](io::Hdf5Writer& writer) { writer.attribute("/", "sum", *sum); };
    chain.read_start = [sum](const io::Hdf5Reader& reader) { *sum = reader.number("/", "sum"); };
    return chain;
  };
  return program;
}

class EhlKept : public testing::Test {
 protected:
  EhlKept() { std::ofstream(file_) << "number = 1\n"; }

  /// Solves the first cases of a sweep, as a run that was killed behind them would have.
  std::vector<EhlAnswer> run(std::size_t n_cases) {
    const EhlSeries series{program_, io::Config::read(file_), file_, output_};
    const std::vector<SweepAxis> axes = {parse_axis("number=" + numbers_)};
    EhlCases cases(series, axes, combinations(axes));
    cases.order.resize(n_cases);
    err_.str("");
    Context context{.out = err_, .err = err_};
    context.seed = seed_;
    KeptCases kept = kept_cases(series, cases, context);
    std::vector<EhlAnswer> answers = solve_cases(series, cases, &kept, context);
    EXPECT_EQ(kept.n_kept(), n_cases);
    warnings_ = context.warnings;
    answers.resize(n_cases);
    return answers;
  }

  std::vector<io::Json> scalars(std::size_t n_cases) {
    std::vector<io::Json> all;
    for (const EhlAnswer& answer : run(n_cases)) all.push_back(answer.scalars);
    return all;
  }

  /// What an uninterrupted sweep says.
  std::vector<io::Json> expected() {
    std::filesystem::remove_all(cases_);
    std::vector<io::Json> all = scalars(kAll);
    std::filesystem::remove_all(cases_);
    return all;
  }

  std::vector<std::filesystem::path> files(const std::string& prefix) const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(cases_)) {
      if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
    }
    return found;
  }

  static constexpr std::size_t kAll = 5;
  test::Folder folder_;
  std::string file_ = folder_ / "case.toml";
  std::string output_ = folder_ / "out.h5";
  std::filesystem::path cases_ = output_ + ".cases";
  EhlProgram program_ = adding_program();
  std::string numbers_ = "3,7,13,0.1,11";
  std::optional<std::uint64_t> seed_;
  std::ostringstream err_;
  std::vector<std::string> warnings_;
};

TEST_F(EhlKept, ASweepGoesOnWhereverItWasKilled) {
  const std::vector<io::Json> whole = expected();
  ASSERT_EQ(whole[2]["refused"], "unlucky");
  for (std::size_t n = 1; n <= kAll; ++n) {
    run(n);
    EXPECT_EQ(files("case-").size(), n);
    EXPECT_EQ(files("start-").size(), 1u);
    EXPECT_EQ(scalars(kAll), whole) << n;
    EXPECT_THAT(err_.str(), HasSubstr(std::to_string(n) + " of 5 cases were done"));
    EXPECT_EQ(warnings_, std::vector<std::string>{});  // each is a case's own
    std::filesystem::remove_all(cases_);
  }
}

TEST_F(EhlKept, WarningsAndConvergenceAreKept) {
  run(2);
  const std::vector<EhlAnswer> answers = run(2);
  EXPECT_TRUE(answers[0].converged);
  EXPECT_FALSE(answers[1].converged);
  EXPECT_EQ(answers[1].warnings, (std::vector<std::string>{"numbers are added", "a sum"}));
}

TEST_F(EhlKept, WhatIsDamagedIsComputedAgain) {
  const std::vector<io::Json> whole = expected();
  for (const char* prefix : {"case-", "start-"}) {
    for (const char* bytes : {"", "{}", "[1, 2]", "\x89HDF\r\n\x1a\n", "{\"a\": 1e999}"}) {
      run(3);
      for (const auto& file : files(prefix)) test::put_bytes(file, bytes);
      EXPECT_EQ(scalars(kAll), whole) << prefix << bytes;
      EXPECT_THAT(err_.str(), HasSubstr("computed again"));
      std::filesystem::remove_all(cases_);
    }
  }
  run(3);
  for (const auto& file : files("start-")) std::filesystem::remove(file);
  EXPECT_EQ(scalars(kAll), whole);
}

TEST_F(EhlKept, ABitThatTurnedOverInACaseIsFound) {
  const std::vector<io::Json> whole = expected();
  run(1);
  const auto file = files("case-").front();
  const std::string bytes = test::bytes_of(file);
  for (std::size_t at = 0; at < bytes.size(); at += 37) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] ^ (1 << (at % 7)));
    test::put_bytes(file, other);
    EXPECT_EQ(scalars(1).front(), whole.front()) << at;
  }
}

TEST_F(EhlKept, ACaseIsNotKeptUnderTheDigestOfAnotherScan) {
  std::ofstream(file_) << "number = 1\nfile = \"scan.txt\"\n";
  test::put_bytes(folder_ / "scan.txt", "rough");
  program_.make_chain = {};
  program_.solve = [this](const io::Config& config, Context& context) {
    if (config.number("number") == 7) test::put_bytes(folder_ / "scan.txt", "smooth");
    context.files.holds(folder_ / "scan.txt", io::sha256_of_file(folder_ / "scan.txt"));
    return EhlAnswer{.scalars = {{"sum", 0}}, .text = "", .converged = true};
  };
  EXPECT_THAT([&] { run(kAll); }, testing::ThrowsMessage<Error>(HasSubstr("replaced or changed")));
  EXPECT_EQ(files("case-").size(), 1u);
}

TEST_F(EhlKept, ACaseWithoutNumbersIsDamaged) {
  const std::vector<io::Json> whole = expected();
  run(3);
  for (const auto& file : files("case-")) {
    io::Json json = io::read_json(file);
    json["scalars"] = {1, 2};
    test::put_bytes(file, io::to_text(json));
  }
  EXPECT_EQ(scalars(kAll), whole);
}

TEST_F(EhlKept, NothingOfAnotherCaseSweepOrSeedIsUsed) {
  run(3);
  std::ofstream(file_) << "number = 1  # a comment\n";
  run(3);
  EXPECT_THAT(err_.str(), HasSubstr("3 cases in " + cases_.string() + " are not used"));
  EXPECT_THAT(err_.str(), testing::Not(HasSubstr("were done")));
  numbers_ = "3,8,13,0.1,11";
  run(3);
  EXPECT_THAT(err_.str(), testing::Not(HasSubstr("were done")));
  EXPECT_THAT(err_.str(), testing::Not(HasSubstr("damaged")));
  seed_ = 2;
  run(3);
  EXPECT_THAT(err_.str(), testing::Not(HasSubstr("were done")));
}

TEST_F(EhlKept, OneMoreValueBehindASweepThatWasStoppedGoesOnFromIt) {
  run(kAll);
  numbers_ += ",17";
  run(kAll + 1);
  EXPECT_THAT(err_.str(), HasSubstr("5 of 6 cases were done"));
}

TEST_F(EhlKept, ACaseDependsOnTheBytesOfItsFiles) {
  std::ofstream(file_) << "number = 1\nfile = \"scan.txt\"\n";
  const EhlProgram program = adding_program();
  const Context context{.out = err_, .err = err_};
  const auto text = [&] { return canonical_text(program, io::Config::read(file_), context, ""); };
  test::put_bytes(folder_ / "scan.txt", "rough");
  const std::string before = text();
  EXPECT_EQ(text(), before);
  test::put_bytes(folder_ / "scan.txt", "smooth");
  EXPECT_NE(text(), before);
}

TEST_F(EhlKept, RemovesOnlyWhatItMade) {
  const auto remove = [&] { KeptCases(cases_, {}).remove(); };
  run(3);
  remove();
  EXPECT_FALSE(std::filesystem::exists(cases_));
  run(3);
  test::put_bytes(cases_ / "notes.txt", "mine");
  remove();
  EXPECT_EQ(files("").size(), 1u);
}

TEST_F(EhlKept, AnInterruptedCaseIsNoCase) {
  program_.make_chain = {};
  program_.solve = [](const io::Config& config, Context&) {
    if (config.number("number") == 7) throw Interrupted();
    return EhlAnswer{.scalars = {{"sum", 0}}, .text = "", .converged = true};
  };
  EXPECT_THROW(run(kAll), Interrupted);
  EXPECT_EQ(files("case-").size(), 1u);
  EXPECT_TRUE(files("start-").empty());
}

TEST_F(EhlKept, ASecondSweepOfTheSameResultIsRejectedWhileTheFirstRuns) {
  {
    const KeptCases first(cases_, {});
    EXPECT_THAT([&] { run(1); },
                testing::ThrowsMessage<InputError>(HasSubstr("another sweep keeps its cases")));
  }
  EXPECT_FALSE(std::filesystem::exists(cases_));
  EXPECT_NO_THROW(run(1));
}

TEST_F(EhlKept, AFolderThatCannotBeMadeIsSaid) {
  test::put_bytes(cases_, "a file where the folder should be");
  EXPECT_THROW(run(1), OutputError);
}

}  // namespace
}  // namespace tabor::cli
