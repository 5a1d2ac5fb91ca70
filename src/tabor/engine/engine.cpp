#include "tabor/engine/engine.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/engine/plan.hpp"
#include "tabor/engine/work_share.hpp"

namespace tabor::engine {
namespace {

/// Shares the threads of a run among its jobs; threads outside the run keep theirs.
class ThreadShare {
 public:
  void begin(const Job& job) { change(job, 1); }
  void end(const Job& job) { change(job, -1); }
  const std::atomic<int>& of_each() const { return of_each_; }

 private:
  void change(const Job& job, int by) {
    (job.is_serial ? n_serial_ : n_parallel_) += by;
    of_each_ = std::max(1, (n_threads_ - n_serial_) / std::max(1, n_parallel_));
  }

  int n_threads_ = thread_count();
  int n_serial_ = 0;
  int n_parallel_ = 0;
  std::atomic<int> of_each_ = n_threads_;
};

/// The message of an InputError, or "".
template <typename Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const InputError& failure) {
    return failure.what();
  }
  return "";
}

/// Gives back the memory that its functions hold.
void release(Job& job) {
  job.compute = nullptr;
  job.defect = nullptr;
  job.quality = nullptr;
  job.record_failure = nullptr;
  job.can_serve = nullptr;
  job.memory = nullptr;
}

class Engine {
 public:
  Engine(std::vector<Job> jobs, Plan plan, const Store* store, const RunOptions& options)
      : jobs_(std::move(jobs)),
        plan_(std::move(plan.entries)),
        store_(store),
        options_(options),
        work_share_(kinds(), [this] { return options_.since_start.seconds(); }),
        users_(jobs_.size()),
        n_open_needs_(jobs_.size(), 0),
        errors_(jobs_.size()),
        has_twin_(jobs_.size(), false) {
    report_.n_found = plan.n_found;
    report_.warnings = std::move(plan.warnings);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!plan_[i].wanted) release(jobs_[i]);
    }
    connect();
  }

  Report run() {
    try {
      work_with(n_workers());
    } catch (...) {
      stop_with(std::current_exception());
    }
    // A job that was asked to stop may have ended all the same.
    if (stop_ && !report_.ended_by) report_.ended_by = std::make_exception_ptr(Interrupted());
    for (const auto& [place, error] : failures_) report_.failures.push_back(error);
    return std::move(report_);
  }

 private:
  /// Returns the kind of each job; "" for jobs without work, or brief ones, which need no time.
  std::vector<std::string> kinds() const {
    std::vector<std::string> kinds;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      kinds.push_back(plan_[i].wanted && !jobs_[i].is_brief ? jobs_[i].kind : "");
    }
    return kinds;
  }

  /// Jobs with the same file wait for the first of them.
  void connect() {
    std::map<std::string, std::size_t> first_of_file;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!plan_[i].wanted) continue;
      for (const std::size_t need : jobs_[i].needs) wait_for(need, i);
      const std::string& file = jobs_[i].task.file;
      if (!file.empty()) {
        const auto [first, is_first] = first_of_file.try_emplace(file, i);
        has_twin_[i] = !is_first;
        if (has_twin_[i]) wait_for(first->second, i);
      }
      ++n_open_;
      if (n_open_needs_[i] == 0) ready_.insert(i);
    }
  }

  void wait_for(std::size_t need, std::size_t user) {
    assert(need < user);
    if (!plan_[need].wanted) return;
    users_[need].push_back(user);
    ++n_open_needs_[user];
  }

  int n_workers() {
    int n_jobs = 0;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      n_jobs += plan_[i].wanted && !jobs_[i].is_brief ? 1 : 0;
    }
    if (n_jobs <= 1) return 1;
    return std::min(n_jobs, options_.jobs > 0 ? options_.jobs : n_affordable());
  }

  /// Jobs of a run are of one size, or nearly: the first that can be told tells for all.
  int n_affordable() {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!jobs_[i].memory) continue;
      std::size_t bytes = 0;
      const std::string error =
          complaint_of([&] { bytes = jobs_[i].memory(monitor_of(i)); });  // said where it is done
      if (error.empty()) return jobs_that_fit(bytes, available_memory_bytes(), thread_count());
    }
    return thread_count();
  }

  void work_with(int n_workers) {
    work_share_.set_workers(n_workers);
    std::vector<std::jthread> workers;
    for (int i = 1; i < n_workers; ++i) workers.emplace_back([this] { work(); });
    work();
  }

  void work() {
    const ThreadLimit limit(thread_share_.of_each());
    // Loops that know no observer, as those of a contact's set-up, end when the run does.
    const Observer asking = [this](const Progress& progress) {
      tell(progress);
      return true;
    };
    while (const auto job = take()) {
      try {
        std::optional<Watch> watch;
        if (!jobs_[*job].is_brief) watch.emplace(asking, "");
        const std::string error = perform(*job);
        end(*job, error);
      } catch (...) {
        stop_with(std::current_exception());
      }
    }
  }

  /// The first job that is ready, as soon as there is one; nullopt when nothing is left. A run that
  /// ends early still does the brief ones, so that what was finished is seen.
  std::optional<std::size_t> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stop_ || n_open_ == 0 || !ready_.empty(); });
    const auto next = std::find_if(ready_.begin(), ready_.end(), [this](std::size_t job) {
      return !stop_ || jobs_[job].is_brief;
    });
    if (next == ready_.end()) return std::nullopt;
    const std::size_t job = *next;
    ready_.erase(next);
    --n_open_;
    work_share_.begin(job);
    thread_share_.begin(jobs_[job]);
    if (n_open_ == 0) changed_.notify_all();
    return job;
  }

  /// Returns why there is no result, or "".
  std::string perform(std::size_t place) {
    const Job& job = jobs_[place];
    std::string error = error_of_needs(job);
    const bool failed_before = !error.empty();
    if (!failed_before) error = complaint_of([&] { compute(place); });
    if (error.empty()) return error;
    if (job.record_failure) {
      job.record_failure(error);
      count(job, 0);
    }
    if (!failed_before) {
      const std::lock_guard lock(mutex_);
      failures_[place] = error;
    }
    return error;
  }

  std::string error_of_needs(const Job& job) {
    const std::lock_guard lock(mutex_);
    for (const std::size_t need : job.needs) {
      if (!errors_[need].empty()) return errors_[need];
    }
    return "";
  }

  void compute(std::size_t place) {
    const Job& job = jobs_[place];
    const auto lock = exclusive(job);
    if (is_there_by_now(place)) return;
    const Stopwatch watch;
    job.compute(monitor_of(place));
    count(job, watch.seconds());
  }

  std::optional<io::FileLock> exclusive(const Job& job) {
    if (store_ == nullptr || job.is_brief || job.task.file.empty()) return std::nullopt;
    return store_->lock(job.task.key, [this] { tell({"waiting for another shard"}); });
  }

  /// True if another shard, or a job with the same file, has stored it since the plan was made.
  bool is_there_by_now(std::size_t place) {
    const Job& job = jobs_[place];
    const bool maybe = store_ != nullptr && (has_twin_[place] || store_->is_shared()) &&
                       !job.task.file.empty() && store_->has(job.task);
    if (!maybe) return false;
    const std::string problem = job.defect ? job.defect() : "";
    if (!problem.empty()) {
      const std::lock_guard lock(mutex_);
      report_.warnings.push_back("damaged, computed again: " + problem);
      return false;
    }
    if (job.can_serve && !job.can_serve()) return false;
    return !plan_[place].retried || !job.quality || job.quality() == Quality::converged;
  }

  void end(std::size_t place, const std::string& error) {
    const std::lock_guard lock(mutex_);
    errors_[place] = error;
    release(jobs_[place]);
    for (const std::size_t user : users_[place]) {
      if (--n_open_needs_[user] == 0) ready_.insert(user);
    }
    work_share_.end(place);
    thread_share_.end(jobs_[place]);
    changed_.notify_all();
  }

  void stop_with(const std::exception_ptr& error) {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    report_.ended_by = report_.ended_by ? report_.ended_by : error;
    changed_.notify_all();
  }

  void count(const Job& job, double seconds) {
    const std::lock_guard lock(mutex_);
    ++report_.n_computed[job.kind];
    report_.seconds[job.kind] += seconds;
  }

  // NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks): the function objects own their captures
  Monitor monitor_of(std::size_t place) {
    const auto shared = [this](const std::string& stage) -> Observer {
      return [this, stage](const Progress& inner) {
        tell({stage, inner.fraction, inner.convergence});
        return true;
      };
    };
    return {.own = own_observer(place), .shared = shared};
  }

  /// Keeps account of how far the job is, and passes its messages on.
  Observer own_observer(std::size_t place) {
    return [this, place, stage = jobs_[place].stage, restarts = jobs_[place].restarts,
            first = 0.0](const Progress& inner) mutable {
      double share = inner.fraction;
      if (inner.convergence != nullptr) {
        first = first > 0 && std::isfinite(first) ? first : inner.convergence->certificate;
        share = share_done(first, *inner.convergence);
      }
      if (share >= 0 && !restarts) {
        const std::lock_guard lock(mutex_);
        work_share_.inside(place, share);
      }
      tell({stage, restarts ? std::nan("") : inner.fraction, inner.convergence});
      return true;
    };
  }
  // NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks)

  /// Passes one message on, with the share of the whole run. Throws Interrupted to stop.
  void tell(Progress progress) {
    const std::lock_guard lock(mutex_);
    progress.whole = work_share_.share();
    if (!stop_ && options_.observer && !options_.observer(progress)) stop_ = true;
    if (stop_) throw Interrupted();
  }

  std::vector<Job> jobs_;
  std::vector<Plan::Entry> plan_;
  const Store* store_;
  const RunOptions& options_;
  std::mutex mutex_;  // of everything below
  std::condition_variable changed_;
  WorkShare work_share_;
  ThreadShare thread_share_;
  std::vector<std::vector<std::size_t>> users_;  // jobs that wait for it
  std::vector<std::size_t> n_open_needs_;
  std::vector<std::string> errors_;              // why there is no result
  std::map<std::size_t, std::string> failures_;  // of jobs that failed by themselves
  std::vector<bool> has_twin_;                   // a job before it has the same file
  std::set<std::size_t> ready_;                  // the first is done first
  std::size_t n_open_ = 0;                       // jobs nobody has taken yet
  bool stop_ = false;
  Report report_;
};

}  // namespace

std::size_t Report::computed(const std::string& kind) const {
  const auto found = n_computed.find(kind);
  return found == n_computed.end() ? 0 : found->second;
}

void Report::rethrow() const {
  if (ended_by) std::rethrow_exception(ended_by);
}

Report run_jobs(std::vector<Job> jobs, const Store* store, const RunOptions& options) {
  Plan plan =
      plan_jobs(jobs, store, options.shard.value_or(Shard{}), options.retry, options.observer);
  return Engine(std::move(jobs), std::move(plan), store, options).run();
}

}  // namespace tabor::engine
