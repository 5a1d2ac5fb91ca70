#include "tabor/engine/engine.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/engine/checkpoint.hpp"

// The engine with jobs that add numbers: a job's result is its own number and those it needs.
namespace tabor::engine {
namespace {

using test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Engine : public testing::Test {
 protected:
  Store alone() const { return {folder_ / "store", Store::Use::alone, "busy"}; }
  Store shared() const { return {folder_ / "store", Store::Use::shared, "busy"}; }

  static Task task(int number) { return make_task("sum", "json", text_line("number", number)); }

  static io::Json stored(const Store& store, int number) {
    return read_checkpoint(store, task(number));
  }

  static Quality quality_of(const io::Json& stored) {
    if (stored.contains("error")) return Quality::failed;
    return stored.at("converged").get<bool>() ? Quality::converged : Quality::not_converged;
  }

  /// Numbers of jobs are their places in the list.
  Job job(const Store& store, int number, std::vector<std::size_t> needs) {
    Job job;
    job.task = task(number);
    job.kind = "sum";
    job.stage = "sum " + std::to_string(number);
    job.needs = std::move(needs);
    job.defect = [&store, number] { return defect_of_checkpoint(store, task(number)); };
    job.quality = [&store, number] { return quality_of(stored(store, number)); };
    job.compute = [this, &store, number, needs = job.needs](const Monitor& monitor) {
      report_progress(monitor.own, "", 0.5);
      ++n_computed_;
      if (failing_.contains(number)) throw InputError("number " + std::to_string(number));
      int sum = number;
      for (const std::size_t need : needs) {
        sum += stored(store, static_cast<int>(need)).at("sum").get<int>();
      }
      const bool converged = !unfinished_.contains(number);
      write_checkpoint(store, task(number), {{"sum", sum}, {"converged", converged}});
    };
    return job;
  }

  /// The same job, which keeps why it failed.
  Job row(const Store& store, int number, std::vector<std::size_t> needs) {
    Job row = job(store, number, std::move(needs));
    row.kind = "row";
    row.record_failure = [&store, number](const std::string& error) {
      write_checkpoint(store, task(number), {{"error", error}});
    };
    return row;
  }

  /// Two pairs: 0 and 1 make the row 2, 3 and 1 the row 4; 5 is on its own.
  std::vector<Job> example(const Store& store) {
    std::vector<Job> jobs = {job(store, 0, {}), job(store, 1, {}),     row(store, 2, {0, 1}),
                             job(store, 3, {}), row(store, 4, {3, 1}), job(store, 5, {})};
    const std::vector<std::optional<std::size_t>> parts = {0, std::nullopt, 0, 1, 1, 2};
    for (std::size_t i = 0; i < jobs.size(); ++i) jobs[i].part = parts[i];
    return jobs;
  }

  Report run_example(const RunOptions& options = {}) {
    const Store store = options.shard ? shared() : alone();
    n_computed_ = 0;
    return run_jobs(example(store), &store, options);
  }

  /// Contents of all files by name, without the locks of shards.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "store")) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with("lock")) files[name] = test::bytes_of(entry.path());
    }
    return files;
  }

  static RunOptions retrying() {
    RunOptions options;
    options.retry = true;
    return options;
  }

  Folder folder_;
  std::set<int> failing_;     // fail
  std::set<int> unfinished_;  // do not converge
  std::atomic<int> n_computed_ = 0;
};

TEST_F(Engine, DoesWhatAJobNeedsBeforeIt) {
  const Report report = run_example();
  EXPECT_FALSE(report.ended_by);
  EXPECT_EQ(report.computed("sum"), 4u);
  EXPECT_EQ(report.computed("row"), 2u);
  const Store store = alone();
  EXPECT_EQ(stored(store, 2)["sum"], 0 + 1 + 2);
  EXPECT_EQ(stored(store, 4)["sum"], 3 + 1 + 4);
}

TEST_F(Engine, DoesNothingTwice) {
  run_example();
  const auto before = files();
  const Report again = run_example();
  EXPECT_EQ(n_computed_, 0);
  EXPECT_EQ(again.n_found, 6u);
  EXPECT_EQ(files(), before);
}

TEST_F(Engine, AFailureTakesOnlyWhatNeedsItAlong) {
  failing_ = {3};
  const Report report = run_example();
  EXPECT_THAT(report.failures, ElementsAre("number 3"));
  EXPECT_FALSE(report.ended_by);
  const Store store = alone();
  EXPECT_EQ(stored(store, 2)["sum"], 3);
  EXPECT_EQ(stored(store, 4)["error"], "number 3");
  EXPECT_FALSE(store.has(task(3)));
  EXPECT_EQ(stored(store, 5)["sum"], 5);
}

TEST_F(Engine, WhatFailedWaitsForRetry) {
  failing_ = {3};
  run_example();
  run_example();
  EXPECT_EQ(n_computed_, 0);
  failing_ = {};
  run_example();
  EXPECT_EQ(n_computed_, 0);
  run_example(retrying());
  EXPECT_EQ(n_computed_, 2);  // 3 and the row 4
  EXPECT_EQ(stored(alone(), 4)["sum"], 8);
}

TEST_F(Engine, WhatDidNotConvergeIsRetriedWithAllThatNeedsIt) {
  unfinished_ = {1};
  run_example();
  run_example();
  EXPECT_EQ(n_computed_, 0);
  unfinished_ = {};
  run_example(retrying());
  EXPECT_EQ(n_computed_, 3);  // 1 and the rows 2 and 4
  run_example(retrying());
  EXPECT_EQ(n_computed_, 0);
}

TEST_F(Engine, ADamagedFileIsNamedAndComputedAgain) {
  run_example();
  const auto before = files();
  for (int number = 0; number < 6; ++number) {
    const std::string name = task(number).file;
    test::put_bytes(folder_ / "store" / name, before.at(name).substr(0, 20));
    const Report report = run_example();
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_THAT(report.warnings[0], HasSubstr(name));
    EXPECT_EQ(n_computed_, 1);
    EXPECT_EQ(files(), before);
  }
}

TEST_F(Engine, ShardsPartTheJobsAndShareWhatSeveralNeed) {
  run_example();
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "store");
  for (const int index : {3, 1, 2}) {
    RunOptions options;
    options.shard = Shard{index, 3};
    run_example(options);
    EXPECT_EQ(n_computed_, index == 1 ? 3 : index == 2 ? 2 : 1) << index;  // 1 is there by then
  }
  EXPECT_EQ(files(), whole);
}

TEST_F(Engine, AnyNumberOfJobsGivesTheSameFiles) {
  run_example();
  const auto whole = files();
  for (const int jobs : {1, 2, 5, 16}) {
    std::filesystem::remove_all(folder_ / "store");
    RunOptions options;
    options.jobs = jobs;
    run_example(options);
    EXPECT_EQ(files(), whole) << jobs;
  }
}

TEST_F(Engine, InterruptedKeepsWhatIsFinishedAndGoesOn) {
  run_example();
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "store");
  int n_runs = 0;
  for (bool stopped = true; stopped; ++n_runs) {
    ASSERT_LT(n_runs, 100);
    RunOptions options;
    options.jobs = 1;
    options.observer = [left = 4](const Progress& progress) mutable {
      return progress.stage == "look at the store" || --left > 0;
    };
    const Report report = run_example(options);
    stopped = report.ended_by != nullptr;
    if (!stopped) continue;
    EXPECT_THROW(report.rethrow(), Interrupted);
  }
  EXPECT_GT(n_runs, 2);
  EXPECT_EQ(files(), whole);
}

TEST_F(Engine, InterruptedStillDoesTheBriefJobsThatAreReady) {
  const Store store = alone();
  std::vector<Job> jobs = example(store);
  jobs[2].is_brief = true;
  jobs[2].compute = [&store](const Monitor&) { write_checkpoint(store, task(2), {{"sum", 3}}); };
  RunOptions options;
  options.jobs = 1;
  options.observer = [](const Progress& progress) { return progress.stage != "sum 3"; };
  jobs[1].compute = [&](const Monitor& monitor) {
    write_checkpoint(store, task(1), {{"sum", 1}, {"converged", true}});
    try {
      report_progress(monitor.shared("sum 3"), "", 0);
    } catch (const Interrupted&) {  // asked for while it ends
    }
  };
  EXPECT_THROW(run_jobs(std::move(jobs), &store, options).rethrow(), Interrupted);
  EXPECT_TRUE(store.has(task(2)));
  EXPECT_FALSE(store.has(task(3)));
}

TEST_F(Engine, AnythingButAnInputErrorEndsTheRun) {
  const Store store = alone();
  std::vector<Job> jobs = example(store);
  jobs[1].compute = [](const Monitor&) { throw OutputError("disk full"); };
  RunOptions options;
  options.jobs = 1;
  const Report report = run_jobs(std::move(jobs), &store, options);
  EXPECT_THROW(report.rethrow(), OutputError);
  EXPECT_TRUE(store.has(task(0)));
  EXPECT_FALSE(store.has(task(2)));
}

TEST_F(Engine, WithoutAStoreResultsStayInMemory) {
  std::vector<int> results(3, 0);
  std::vector<Job> jobs(3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) jobs[i].needs = {i - 1};
    jobs[i].compute = [&results, i](const Monitor&) {
      results[i] = i > 0 ? 10 * results[i - 1] : 7;
    };
  }
  EXPECT_FALSE(run_jobs(std::move(jobs), nullptr).ended_by);
  EXPECT_THAT(results, ElementsAre(7, 70, 700));
}

TEST_F(Engine, JobsOfOneFileAreComputedOnce) {
  const Store store = alone();
  RunOptions options;
  options.jobs = 2;
  const Report report = run_jobs({job(store, 0, {}), job(store, 0, {})}, &store, options);
  EXPECT_EQ(n_computed_, 1);
  EXPECT_THAT(report.failures, IsEmpty());
}

TEST_F(Engine, AChainThatCannotGoOnBeginsAnew) {
  const Store store = alone();
  bool has_start = true;
  const auto chain = [&] {
    std::vector<Job> jobs = {job(store, 0, {}), job(store, 1, {0}), job(store, 2, {1})};
    for (Job& job : jobs) job.can_serve = [&has_start] { return has_start; };
    return jobs;
  };
  run_jobs(chain(), &store);
  store.remove(task(2));
  n_computed_ = 0;
  run_jobs(chain(), &store);
  EXPECT_EQ(n_computed_, 1);
  store.remove(task(2));
  has_start = false;
  run_jobs(chain(), &store);
  EXPECT_EQ(n_computed_, 1 + 3);
}

TEST_F(Engine, SharesItsThreadsAndLeavesThoseOfOthers) {
  set_thread_count(6);
  std::atomic<int> alone = 0;
  std::atomic<int> of_others = 0;
  std::vector<Job> jobs(2);
  jobs[0].compute = [&](const Monitor&) { alone = thread_count(); };
  jobs[1].is_serial = true;
  jobs[1].needs = {0};
  jobs[1].compute = [&](const Monitor&) {
    std::thread([&] { of_others = thread_count(); }).join();
  };
  run_jobs(std::move(jobs), nullptr);
  EXPECT_EQ(alone, 6);
  EXPECT_EQ(of_others, 6);
  EXPECT_EQ(thread_count(), 6);
  set_thread_count(0);
}

TEST_F(Engine, MemoryOfAJobIsGivenBackWhenItEnds) {
  auto first = std::make_shared<int>(1);
  const std::weak_ptr<int> watching = first;
  bool is_gone = false;
  std::vector<Job> jobs(2);
  jobs[0].compute = [held = std::move(first)](const Monitor&) { ASSERT_EQ(*held, 1); };
  jobs[1].needs = {0};
  jobs[1].compute = [&](const Monitor&) { is_gone = watching.expired(); };
  run_jobs(std::move(jobs), nullptr);
  EXPECT_TRUE(is_gone);
}

}  // namespace
}  // namespace tabor::engine
