#include "tabor/study/ehl_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/engine/checkpoint.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/digest.hpp"

// Sweeps of a program that adds numbers, stopped, damaged, shared out and repeated in all ways.
namespace tabor::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const ColumnHead kSum{"sum", "", "sum", ehl::kInTable};

/// A result that converged.
ehl::CaseResult result_of(double sum) {
  return {.numbers = {{kSum, sum}}, .status = ehl::CaseStatus::converged};
}

/// A program whose result of each case is that of the case before, plus a number of its own. "kind"
/// ends the chain.
ehl::Program adding_program(std::atomic<int>& n_solved) {
  ehl::Program program{.name = "add",
                       .summary = "",
                       .keys = {{.name = "number"}, {.name = "kind"}, {.name = "file"}},
                       .files = {"file"},
                       .columns = {kSum},
                       .studies = {},
                       .methods = {},
                       .solve = {}};
  program.chain_ends = {"kin"};
  program.make_chain = [&n_solved] {
    const auto sum = std::make_shared<double>(0);
    ehl::CaseChain chain;
    chain.solve = [sum, &n_solved](const io::Config& config, const ehl::CaseSetting& setting) {
      report_progress(setting.observer, "add", 0.5);
      ++n_solved;
      const double number = config.number("number");
      if (number == 13) throw InputError("unlucky");
      *sum += 1 / number;
      ehl::CaseResult result = result_of(*sum);
      if (number >= 5) result.status = ehl::CaseStatus::not_converged;
      result.warnings = {{"spikes", "a sum"}};
      return result;
    };
    chain.write_start = [sum](io::Hdf5Writer& writer) { writer.attribute("/", "sum", *sum); };
    chain.read_start = [sum](const io::Hdf5Reader& reader) { *sum = reader.number("/", "sum"); };
    return chain;
  };
  return program;
}

class EhlSweep : public testing::Test {
 protected:
  EhlSweep() { std::ofstream(file_) << "number = 1\nkind = 1\n"; }

  EhlSeries series() const {
    std::vector<SweepAxis> axes = {{.key = "number", .values = numbers_, .is_range = true}};
    if (!kinds_.empty()) axes.insert(axes.begin(), {.key = "kind", .values = kinds_});
    EhlSeries series = ehl_sweep(program_, io::Config::read(file_), axes, seed_);
    if (surfaces_.read) series.surfaces = surfaces_;
    return series;
  }

  /// What all cases amount to, and what the folder holds afterwards.
  EhlResults run(engine::RunOptions options = {}) {
    EhlSeries cases = series();
    give_tasks(cases);
    n_solved_ = 0;
    const EhlStore store(folder_of_cases_,
                         options.shard ? engine::Store::Use::shared : engine::Store::Use::alone);
    outcome_ = run_ehl(cases, &store, options, [this](const EhlFound& found) { found_ = found; });
    return outcome_.results;
  }

  /// As a run leaves it that is stopped while it solves the case behind the first ones.
  void run_first(int n_cases) {
    engine::RunOptions options;
    options.jobs = 1;
    options.observer = [this, n_cases](const Progress& progress) {
      return progress.stage == "look at the store" || n_solved_ < n_cases;
    };
    run(options);
  }

  std::vector<io::Json> numbers(const engine::RunOptions& options = {}) {
    std::vector<io::Json> all;
    for (const auto& result : run(options)) {
      all.push_back(result ? io::json_of(result->numbers) : io::Json());
    }
    return all;
  }

  /// What an uninterrupted sweep says.
  std::vector<io::Json> expected() {
    std::filesystem::remove_all(folder_of_cases_);
    std::vector<io::Json> all = numbers();
    std::filesystem::remove_all(folder_of_cases_);
    return all;
  }

  std::vector<std::filesystem::path> files(const std::string& prefix) const {
    std::vector<std::filesystem::path> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder_of_cases_, ignored)) {
      if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
    }
    return found;
  }

  /// Contents of all kept cases by name.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& file : files("case-")) all[file.filename()] = test::bytes_of(file);
    return all;
  }

  static engine::RunOptions with_shard(int index, int count) {
    engine::RunOptions options;
    options.shard = engine::Shard{index, count};
    return options;
  }
  static engine::RunOptions retrying() {
    engine::RunOptions options;
    options.retry = true;
    return options;
  }

  test::Folder folder_;
  std::string file_ = folder_ / "case.toml";
  std::filesystem::path folder_of_cases_ = folder_ / "out.h5.cases";
  std::atomic<int> n_solved_ = 0;
  ehl::Program program_ = adding_program(n_solved_);
  ehl::SurfaceSource surfaces_;
  std::vector<std::string> numbers_ = {"3", "7", "13", "0.1", "11"};
  std::vector<std::string> kinds_;
  std::uint64_t seed_ = 1;
  EhlOutcome outcome_;
  EhlFound found_;
};

TEST_F(EhlSweep, GoesOnWhereverItWasStopped) {
  const std::vector<io::Json> whole = expected();
  ASSERT_TRUE(whole[2].empty());  // rejected
  for (int n = 1; n <= 4; ++n) {
    run_first(n);
    EXPECT_THROW(std::rethrow_exception(outcome_.ended_by), Interrupted);
    EXPECT_EQ(outcome_.n_kept, static_cast<std::size_t>(n));
    EXPECT_EQ(files("case-").size(), static_cast<std::size_t>(n));
    EXPECT_EQ(files("start-").size(), 1u);
    EXPECT_EQ(numbers(), whole) << n;
    EXPECT_EQ(found_.n_kept, static_cast<std::size_t>(n));
    EXPECT_EQ(n_solved_, 5 - n);
    EXPECT_EQ(files("start-").size(), 1u);
    std::filesystem::remove_all(folder_of_cases_);
  }
}

TEST_F(EhlSweep, SaysTheSameWithoutAFolder) {
  const std::vector<io::Json> whole = expected();
  const EhlOutcome outcome = run_ehl(series(), nullptr, {});
  ASSERT_TRUE(outcome.is_complete());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(io::json_of(outcome.all()[i].numbers), whole[i]);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_of_cases_));
}

TEST_F(EhlSweep, AnyNumberOfJobsGivesTheSameFiles) {
  kinds_ = {"1", "2", "3", "4"};
  const std::vector<io::Json> whole = expected();
  run();
  const auto kept = contents();
  EXPECT_EQ(kept.size(), 20u);
  for (const int jobs : {1, 2, 3, 16}) {
    std::filesystem::remove_all(folder_of_cases_);
    engine::RunOptions options;
    options.jobs = jobs;
    EXPECT_EQ(numbers(options), whole) << jobs;
    EXPECT_EQ(contents(), kept) << jobs;
  }
}

TEST_F(EhlSweep, ShardsTakeWholeChainsAndTogetherAreTheWhole) {
  kinds_ = {"1", "2", "3"};
  const std::vector<io::Json> whole = expected();
  const std::vector<io::Json> first = numbers(with_shard(1, 2));
  EXPECT_EQ(n_solved_, 10);
  EXPECT_FALSE(outcome_.is_complete());
  EXPECT_TRUE(first[5].is_null());
  EXPECT_EQ(numbers(with_shard(2, 2)), whole);
  EXPECT_EQ(n_solved_, 5);
  EXPECT_EQ(numbers(), whole);
  EXPECT_EQ(n_solved_, 0);
}

TEST_F(EhlSweep, AChainEndsWhereAKeyThatNeighboursShareChanges) {
  kinds_ = {"1", "2"};
  const EhlSeries cases = series();
  std::vector<bool> starts;
  for (const EhlCase& one : cases.cases) starts.push_back(one.starts_anew);
  EXPECT_EQ(starts, (std::vector<bool>{true, false, false, false, false, true, false, false, false,
                                       false}));
  const std::vector<io::Json> whole = expected();
  EXPECT_EQ(whole[0], whole[5]);
  program_.chain_ends = {};
  EXPECT_NE(expected()[5], whole[5]);
}

TEST_F(EhlSweep, RetryComputesWhatDidNotConvergeAndAllBehindItAgain) {
  const std::vector<io::Json> whole = expected();
  run();
  const auto kept = contents();
  EXPECT_EQ(numbers(retrying()), whole);  // 7, the second, does not converge
  EXPECT_EQ(n_solved_, 5);                // and only the last start is there
  EXPECT_EQ(contents(), kept);
  numbers_ = {"3", "0.1"};
  expected();
  run();
  run(retrying());
  EXPECT_EQ(n_solved_, 0);
}

TEST_F(EhlSweep, RetryInAShardBeginsTheChainAgainWhoseStartIsGone) {
  const std::vector<io::Json> whole = expected();
  run(with_shard(1, 1));
  engine::RunOptions options = with_shard(1, 1);
  options.retry = true;
  EXPECT_EQ(numbers(options), whole);
  EXPECT_FALSE(outcome_.ended_by);
  EXPECT_EQ(n_solved_, 5);
}

TEST_F(EhlSweep, WarningsAndConvergenceAreKept) {
  run();
  const EhlResults results = run();
  EXPECT_EQ(n_solved_, 0);
  EXPECT_TRUE(results[0]->converged());
  EXPECT_FALSE(results[1]->converged());
  EXPECT_THAT(texts_of(results[1]->warnings), ElementsAre("a sum"));
  EXPECT_EQ(results[2]->error, "unlucky");
  EXPECT_THAT(codes_of(results[2]->warnings), ElementsAre("rejected"));
}

TEST_F(EhlSweep, WhatIsDamagedIsComputedAgain) {
  const std::vector<io::Json> whole = expected();
  for (const char* prefix : {"case-", "start-"}) {
    for (const char* bytes : {"", "{}", "[1, 2]", "\x89HDF\r\n\x1a\n", "{\"a\": 1e999}"}) {
      run_first(3);
      for (const auto& file : files(prefix)) test::put_bytes(file, bytes);
      EXPECT_EQ(numbers(), whole) << prefix << bytes;
      ASSERT_FALSE(found_.damaged.empty());
      EXPECT_THAT(found_.damaged.front(), HasSubstr(prefix));
      EXPECT_THAT(found_.damaged.front(), HasSubstr("damaged"));
      std::filesystem::remove_all(folder_of_cases_);
    }
  }
  run_first(3);
  for (const auto& file : files("start-")) std::filesystem::remove(file);
  EXPECT_EQ(numbers(), whole);
}

TEST_F(EhlSweep, ABitThatTurnedOverInACaseIsFound) {
  const std::vector<io::Json> whole = expected();
  run_first(1);
  const auto file = files("case-").front();
  const std::string bytes = test::bytes_of(file);
  for (std::size_t at = 0; at < bytes.size(); at += 37) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] ^ (1 << (at % 7)));
    test::put_bytes(file, other);
    EXPECT_EQ(numbers().front(), whole.front()) << at;
    EXPECT_EQ(n_solved_, 5);
    std::filesystem::remove_all(folder_of_cases_);
    run_first(1);
  }
}

TEST_F(EhlSweep, ACaseWithoutNumbersIsDamaged) {
  const std::vector<io::Json> whole = expected();
  run_first(3);
  for (const auto& file : files("case-")) {
    io::Json json = io::read_json(file);
    json["numbers"] = {1, 2};
    test::put_bytes(file, io::to_text(json));
  }
  EXPECT_EQ(numbers(), whole);
}

TEST_F(EhlSweep, CasesOfAnEarlierVersionAreKept) {
  const std::vector<io::Json> whole = expected();
  run_first(3);
  {
    const EhlStore store(folder_of_cases_, engine::Store::Use::shared);
    EhlSeries cases = series();
    give_tasks(cases);
    for (const EhlCase& one : cases.cases) {
      if (!store.store().has(one.task)) continue;
      io::Json json = engine::read_checkpoint(store.store(), one.task);
      io::Json earlier = {{"scalars", json["numbers"]},
                          {"converged", json["status"] == "converged"},
                          {"warnings", {"a sum"}}};
      if (json.contains("start_sha256")) earlier["start_sha256"] = json["start_sha256"];
      if (json["status"] != "rejected") engine::write_checkpoint(store.store(), one.task, earlier);
    }
  }
  EXPECT_EQ(numbers(), whole);
  EXPECT_LT(n_solved_, 5);
  EXPECT_THAT(texts_of(outcome_.results[0]->warnings), ElementsAre("a sum"));
  EXPECT_TRUE(outcome_.results[0]->converged());
}

TEST_F(EhlSweep, ACaseIsNotKeptUnderTheDigestOfAnotherScan) {
  const std::string scan = folder_ / "scan.txt";
  std::ofstream(file_) << "number = 1\nkind = 1\nfile = \"scan.txt\"\n";
  test::put_bytes(scan, "rough");
  surfaces_.read = [](const ehl::NamedScan& named, const Observer&) {
    return ehl::Surface{.grid = {}, .height = {}, .sha256 = io::sha256_of_file(named.file)};
  };
  program_.make_chain = {};
  program_.solve = [&](const io::Config& config, const ehl::CaseSetting& setting) {
    if (config.number("number") == 7) test::put_bytes(scan, "smooth");
    setting.surfaces.read({.file = scan}, {});
    return result_of(0);
  };
  engine::RunOptions one_by_one;
  one_by_one.jobs = 1;
  run(one_by_one);
  EXPECT_THAT([&] { std::rethrow_exception(outcome_.ended_by); },
              testing::ThrowsMessage<Error>(HasSubstr("replaced or changed")));
  EXPECT_EQ(files("case-").size(), 1u);
}

TEST_F(EhlSweep, NothingOfAnotherCaseSweepOrSeedIsUsed) {
  run_first(3);
  std::ofstream(file_) << "number = 1  # a comment\nkind = 1\n";
  run_first(3);
  EXPECT_EQ(found_.n_unused, 3u);
  EXPECT_EQ(found_.n_kept, 0u);
  numbers_[1] = "8";
  run_first(3);
  EXPECT_EQ(found_.n_kept, 0u);
  EXPECT_THAT(found_.damaged, IsEmpty());
  seed_ = 2;
  run_first(3);
  EXPECT_EQ(found_.n_kept, 0u);
}

TEST_F(EhlSweep, OneMoreValueBehindASweepThatIsDoneGoesOnFromIt) {
  run();
  numbers_.emplace_back("17");
  run();
  EXPECT_EQ(found_.n_kept, 5u);
  EXPECT_EQ(n_solved_, 1);
}

TEST_F(EhlSweep, ACaseDependsOnTheBytesOfItsFiles) {
  std::ofstream(file_) << "number = 1\nkind = 1\nfile = \"scan.txt\"\n";
  const auto key = [&] {
    EhlSeries cases = series();
    give_tasks(cases);
    return cases.cases.front().task.key;
  };
  test::put_bytes(folder_ / "scan.txt", "rough");
  const std::string before = key();
  EXPECT_EQ(key(), before);
  test::put_bytes(folder_ / "scan.txt", "smooth");
  EXPECT_NE(key(), before);
}

TEST_F(EhlSweep, RemovesOnlyWhatItMade) {
  const auto finish = [&] { EhlStore(folder_of_cases_, engine::Store::Use::alone).finish(); };
  run_first(3);
  finish();
  EXPECT_FALSE(std::filesystem::exists(folder_of_cases_));
  run(with_shard(1, 2));
  finish();
  EXPECT_FALSE(std::filesystem::exists(folder_of_cases_));
  run_first(3);
  test::put_bytes(folder_of_cases_ / "notes.txt", "mine");
  finish();
  EXPECT_EQ(files("").size(), 1u);
}

TEST_F(EhlSweep, AnInterruptedCaseIsNoCase) {
  program_.make_chain = {};
  program_.solve = [](const io::Config& config, const ehl::CaseSetting&) {
    if (config.number("number") == 7) throw Interrupted();
    return result_of(0);
  };
  engine::RunOptions one_by_one;
  one_by_one.jobs = 1;
  run(one_by_one);
  EXPECT_THROW(std::rethrow_exception(outcome_.ended_by), Interrupted);
  EXPECT_EQ(files("case-").size(), 1u);
  EXPECT_TRUE(files("start-").empty());
}

TEST_F(EhlSweep, ASecondSweepOfTheSameResultIsRejectedWhileTheFirstRuns) {
  {
    const EhlStore first(folder_of_cases_, engine::Store::Use::alone);
    EXPECT_THAT([&] { run(); },
                testing::ThrowsMessage<InputError>(HasSubstr("another sweep keeps its cases")));
    EXPECT_THROW(run(with_shard(1, 2)), InputError);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_of_cases_));
  EXPECT_NO_THROW(run());
}

TEST_F(EhlSweep, AFolderThatCannotBeMadeIsSaid) {
  test::put_bytes(folder_of_cases_, "a file where the folder should be");
  EXPECT_THROW(run(), OutputError);
}

TEST_F(EhlSweep, OfWhichNoCaseMakesSenseEndsWithTheReason) {
  numbers_ = {"13", "13.0"};
  run();
  EXPECT_THAT([&] { outcome_.all(); }, testing::ThrowsMessage<InputError>("unlucky"));
}

TEST_F(EhlSweep, UnknownKeysAreRejectedBeforeAnything) {
  EXPECT_THROW(ehl_sweep(program_, io::Config::read(file_), {{.key = "numbr", .values = {"1"}}}, 1),
               InputError);
}

TEST(SolvingOrder, ComesDownFromTheLargestValue) {
  const std::vector<SweepAxis> axes = {{.key = "speed", .values = {"1", "3", "2"}},
                                       {.key = "kind", .values = {"a", "b"}}};
  EXPECT_THAT(solving_order(axes, combinations(axes), {"speed"}), ElementsAre(2, 4, 0, 3, 5, 1));
  EXPECT_THAT(solving_order(axes, combinations(axes), {}), ElementsAre(0, 1, 2, 3, 4, 5));
}

/// Numbers of a program without chains tend to 3 with the first order.
TEST(EhlStudy, FindsLimitAndOrderOfEachColumn) {
  static const ColumnHead kValue{"value", "m", "value", ehl::kInTable};
  static const ColumnHead kSteps{"steps", "", "steps", ehl::kCountInTable};
  static const ColumnHead kNodes{"nodes", "", "nodes", ehl::kAlone};
  ehl::Program program{.name = "limit",
                       .summary = "",
                       .keys = {{.name = "nodes"}},
                       .columns = {kValue, kSteps},
                       .studies = {{"grid", "nodes", "nodes", "", {0.5, 1, 2}}},
                       .methods = {},
                       .solve = [](const io::Config& config, const ehl::CaseSetting&) {
                         const double n = config.has("nodes") ? config.number("nodes") : 64;
                         return ehl::CaseResult{
                             .numbers = {{kValue, 3 + 1 / n}, {kNodes, n}, {kSteps, 7.0}},
                             .status = ehl::CaseStatus::converged};
                       }};
  const io::Config config = io::Config::parse("", "case.toml");
  const ehl::CaseStudy& study = find_study(program, "grid");
  const EhlStudyOutcome outcome = run_ehl_study(program, config, study, 1, {});
  EXPECT_THAT(outcome.axis.values, ElementsAre("32", "64", "128"));
  const auto limits = limits_of(program.columns, study, outcome.axis.numbers(), outcome.results);
  EXPECT_NEAR(limits[0].value, 3, 1e-9);
  EXPECT_NEAR(limits[0].order, 1, 1e-6);
  EXPECT_TRUE(std::isnan(limits[1].value));
  EXPECT_THROW(find_study(program, "gird"), UsageError);
}

}  // namespace
}  // namespace tabor::study
