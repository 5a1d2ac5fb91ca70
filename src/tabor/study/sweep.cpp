#include "tabor/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/study/compute.hpp"
#include "tabor/study/scan_work.hpp"
#include "tabor/study/tables.hpp"
#include "tabor/study/work_share.hpp"

namespace tabor::study {
namespace {

/// Shares the machine's threads among the workers for as long as it lives.
class ThreadShare {
 public:
  explicit ThreadShare(int n_workers) : before_(thread_count()) {
    set_thread_count(std::max(1, before_ / n_workers));
  }
  ~ThreadShare() { set_thread_count(before_); }
  ThreadShare(const ThreadShare&) = delete;
  ThreadShare& operator=(const ThreadShare&) = delete;

 private:
  int before_;
};

class Sweep {
 public:
  Sweep(const Store& store, const Study& study, const std::vector<ScanUnits>& units,
        const SweepOptions& options, Outcome& outcome)
      : store_(store), study_(study), units_(units), options_(options), outcome_(outcome) {}

  /// Works through the plan. Throws what stopped it, after every worker has ended.
  void run(const std::vector<ScanPlan>& plans) {
    for (std::size_t scan = 0; scan < plans.size(); ++scan) {
      scans_.emplace_back(plans[scan], study_.mean_pressures.size());
      add_tasks(plans[scan], scan);
    }
    if (tasks_.empty()) {
      return;
    }
    work_share_.emplace(tasks_);
    const int n_jobs = options_.jobs > 0 ? options_.jobs : affordable_jobs();
    const int n_workers = std::min(static_cast<int>(tasks_.size()), n_jobs);
    {
      const ThreadShare share(n_workers);
      std::vector<std::jthread> workers;
      for (int i = 1; i < n_workers; ++i) {
        workers.emplace_back([this] { work(); });
      }
      work();
    }
    if (first_error_) {
      std::rethrow_exception(first_error_);
    }
  }

 private:
  /// The film first: with it in the store, rows follow their contacts one by one.
  void add_tasks(const ScanPlan& plan, std::size_t scan) {
    if (plan.surface) {
      tasks_.push_back({Task::Kind::surface, scan});
    }
    if (plan.film) {
      tasks_.push_back({Task::Kind::film, scan});
    }
    for (const std::size_t pressure : plan.pressures) {
      tasks_.push_back({Task::Kind::contact, scan, pressure});
    }
  }

  /// Scans of a study are of one size, or nearly: the first that can be read tells for all.
  int affordable_jobs() {
    for (const Task& task : tasks_) {
      try {
        return jobs_that_fit(surface(task)->height.size(), available_memory_bytes(),
                             thread_count());
      } catch (const InputError&) {
        // Said where the scan is used.
      }
    }
    return 1;
  }

  void work() {
    for (std::size_t next = next_++; next < tasks_.size() && !stop_; next = next_++) {
      try {
        const Stopwatch watch;
        perform(tasks_[next]);
        scans_[tasks_[next].scan].task_done();
        const std::lock_guard lock(mutex_);
        work_share_->end(next, watch.seconds());
      } catch (...) {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        first_error_ = first_error_ ? first_error_ : std::current_exception();
      }
    }
  }

  /// Input errors belong to the case; everything else ends the sweep.
  void perform(const Task& task) {
    std::string error;
    try {
      compute(task);
    } catch (const InputError& failure) {
      error = failure.what();
    }
    if (task.kind == Task::Kind::surface) {
      return;  // what fails here fails again, with its rows, where the surface is used
    }
    const auto ready = task.kind == Task::Kind::film
                           ? scans_[task.scan].film_ended(error)
                           : scans_[task.scan].contact_ended(task.pressure, error);
    for (const ScanWork::Ready& rows : ready) {
      make_rows(task.scan, rows);
    }
  }

  void compute(const Task& task) {
    switch (task.kind) {
      case Task::Kind::surface:
        return compute_surface_of(task);
      case Task::Kind::film:
        return compute_film_of(task);
      case Task::Kind::contact:
        return compute_contact_of(task);
    }
  }

  void compute_surface_of(const Task& task) {
    const Unit& unit = units_[task.scan].surface;
    const auto lock = exclusive(unit);
    if (!usable(unit)) {
      compute_surface(store_, unit, *surface(task));
      count(outcome_.n_surfaces);
    }
  }

  void compute_film_of(const Task& task) {
    const Unit& unit = units_[task.scan].film;
    const auto lock = exclusive(unit);
    if (!usable(unit)) {
      const std::string stage = stage_name("film", study_.scans[task.scan]);
      compute_film(store_, unit, study_, *surface(task), watch(task, stage));
      count(outcome_.n_films);
    }
  }

  void compute_contact_of(const Task& task) {
    const Unit& unit = units_[task.scan].contacts[task.pressure];
    const auto lock = exclusive(unit);
    const bool again = scans_[task.scan].plan().retry[task.pressure];
    if (usable(unit) && (!again || read_contact(store_, unit).convergence.converged)) {
      return;
    }
    const double load = study_.mean_pressures[task.pressure];
    const std::string stage = stage_name("contact", study_.scans[task.scan], load);
    compute_contact(store_, unit, study_, *surface(task), load, watch(task, stage));
    count(outcome_.n_contacts);
  }

  void make_rows(std::size_t scan, const ScanWork::Ready& rows) {
    const Scan& file = study_.scans[scan];
    if (rows.error.empty()) {
      compute_rows(store_, study_, file, units_[scan], rows.pressure);
    } else {
      record_failure(store_, study_, file, units_[scan], rows.pressure, rows.error);
    }
    const std::lock_guard lock(mutex_);
    outcome_.n_rows += study_.lubricant_densities.size();
  }

  std::shared_ptr<const topography::Topography> surface(const Task& task) {
    return scans_[task.scan].surface([this, &task] {
      const Scan& scan = study_.scans[task.scan];
      const Observer observer = [this, stage = stage_name("read", scan)](const Progress& inner) {
        report({stage, inner.fraction, inner.convergence});
        return true;
      };
      return treated_surface(study_, scan, observer);
    });
  }

  /// True if the unit is in the store and can be read to its last byte.
  bool usable(const Unit& unit) {
    if (!store_.has(unit)) {
      return false;
    }
    const std::string problem =
        defect(store_, unit, study_.lubricant_densities.size(), Depth::maps);
    if (!problem.empty()) {
      const std::lock_guard lock(mutex_);
      outcome_.warnings.push_back("damaged, computed again: " + problem);
    }
    return problem.empty();
  }

  FileLock exclusive(const Unit& unit) {
    return store_.lock(unit.key, [this] { report({"waiting for another shard"}); });
  }

  /// Keeps account of how far the task is, and passes its messages on.
  Observer watch(const Task& task, const std::string& stage) {
    const auto place = static_cast<std::size_t>(&task - tasks_.data());
    return [this, place, stage, first = 0.0](const Progress& inner) mutable {
      double share = inner.fraction;
      if (inner.convergence != nullptr) {
        first = first > 0 && std::isfinite(first) ? first : inner.convergence->certificate;
        share = share_done(first, *inner.convergence);
      }
      if (share >= 0) {
        const std::lock_guard lock(mutex_);
        work_share_->inside(place, share);
      }
      report({stage, inner.fraction, inner.convergence});
      return true;
    };
  }

  /// Passes one message on, with the share of the whole sweep. Throws Interrupted to stop.
  void report(Progress progress) {
    const std::lock_guard lock(mutex_);
    progress.whole = work_share_->share();
    if (!stop_ && options_.observer && !options_.observer(progress)) {
      stop_ = true;
    }
    if (stop_) {
      throw Interrupted();
    }
  }

  void count(std::size_t& counter) {
    const std::lock_guard lock(mutex_);
    ++counter;
  }

  const Store& store_;
  const Study& study_;
  const std::vector<ScanUnits>& units_;
  const SweepOptions& options_;
  Outcome& outcome_;            // guarded by mutex_
  std::deque<ScanWork> scans_;  // a deque, since mutexes do not move
  std::vector<Task> tasks_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::optional<WorkShare> work_share_;  // guarded by mutex_
  std::exception_ptr first_error_;       // guarded by mutex_
};

void count_rows(const std::vector<Row>& rows, Outcome& outcome) {
  outcome.n_done = rows.size();
  for (const Row& row : rows) {
    outcome.n_failed += row.failed() ? 1 : 0;
    outcome.n_not_converged += !row.failed() && !row.converged ? 1 : 0;
    if (row.failed()) {
      outcome.failures.push_back(
          fmt::format("{} {} Pa: {}", row.scan, row.mean_pressure, row.error));
    }
  }
  const auto last = std::unique(outcome.failures.begin(), outcome.failures.end());
  outcome.failures.erase(last, outcome.failures.end());
}

void warn_about_copies(const Study& study, const std::vector<ScanUnits>& units,
                       std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (units[i].sha256 == units[j].sha256) {
        warnings.push_back(
            fmt::format("{} and {} hold the same bytes; if both are in one average, its error is "
                        "too small",
                        study.scans[j].label, study.scans[i].label));
      }
    }
  }
}

}  // namespace

Outcome run(const Study& study, const std::filesystem::path& directory,
            const SweepOptions& options) {
  const Store store(directory, options.shard ? Store::Use::shared : Store::Use::alone);
  Outcome outcome;
  outcome.n_cases = study.n_cases();
  const std::vector<ScanUnits> units = units_of(study);
  warn_about_copies(study, units, outcome.warnings);
  const auto plans =
      plan(store, study, units, options.shard.value_or(Shard{}), options.retry, outcome.warnings);
  std::exception_ptr error;
  try {
    Sweep(store, study, units, options, outcome).run(plans);
  } catch (...) {
    error = std::current_exception();
  }
  try {
    // One shard at a time: whoever comes last has seen every row.
    const FileLock lock = store.lock("results", [] {});
    const std::vector<Row> rows = rows_in(store, units);
    write_tables(store, study, units, rows, options.command);
    count_rows(rows, outcome);
  } catch (...) {
    error = error ? error : std::current_exception();
  }
  if (error) {
    std::rethrow_exception(error);
  }
  return outcome;
}

}  // namespace tabor::study
