#include "tabor/study/sweep_workers.hpp"

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
#include "tabor/core/watch.hpp"
#include "tabor/study/compute.hpp"
#include "tabor/study/scan_work.hpp"
#include "tabor/study/thread_share.hpp"
#include "tabor/study/work_share.hpp"

namespace tabor::study {
namespace {

class Sweep {
 public:
  Sweep(const Store& store, const Study& study, const std::vector<ScanUnits>& units,
        const SweepOptions& options, const Stopwatch& since_start, Outcome& outcome)
      : store_(store),
        study_(study),
        units_(units),
        options_(options),
        since_start_(since_start),
        outcome_(outcome) {}

  /// Works through the plan. Throws what stopped it, after every worker has ended.
  void run(const std::vector<ScanPlan>& plans) {
    for (std::size_t scan = 0; scan < plans.size(); ++scan) {
      scans_.emplace_back(plans[scan], study_.mean_pressures.size());
      add_tasks(plans[scan], scan);
    }
    for (std::size_t scan = 0; scan < plans.size(); ++scan) add_flows(plans[scan], scan);
    if (tasks_.empty()) {
      return;
    }
    work_share_.emplace(tasks_, [this] { return since_start_.seconds(); });
    const int n_jobs = options_.jobs > 0 ? options_.jobs : affordable_jobs();
    const int n_workers = std::min(static_cast<int>(tasks_.size()), n_jobs);
    work_share_->set_workers(n_workers);
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
  /// The film first: with it in the store, rows follow their contacts one by one. Films flow last:
  /// they wait for contacts and films that other workers have begun before.
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

  void add_flows(const ScanPlan& plan, std::size_t scan) {
    for (const ScanPlan::Flow& flow : plan.flows) {
      tasks_.push_back({Task::Kind::fluid, scan, flow.pressure, flow.condition, flow.retry});
    }
  }

  /// Scans of a study are of one size, or nearly: the first that can be read tells for all.
  int affordable_jobs() {
    for (const Task& task : tasks_) {
      try {
        return jobs_that_fit(surface(task)->height.size(), available_memory_bytes(), thread_count(),
                             study_.flows());
      } catch (const InputError&) {
        // Said where the scan is used.
      }
    }
    return 1;
  }

  void work() {
    // Loops that know no observer, as those of a contact's set-up, end when the sweep does.
    const Observer asking = [this](const Progress& progress) {
      report(progress);
      return true;
    };
    for (std::size_t next = next_++; next < tasks_.size() && !stop_; next = next_++) {
      try {
        const Watch watch(asking, "");
        begin(tasks_[next]);
        perform(tasks_[next]);
        scans_[tasks_[next].scan].task_done();
        const std::lock_guard lock(mutex_);
        work_share_->end(next);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        first_error_ = first_error_ ? first_error_ : std::current_exception();
      }
    }
  }

  void begin(const Task& task) {
    const std::lock_guard lock(mutex_);
    work_share_->begin(place_of(task));
  }

  std::size_t place_of(const Task& task) const {
    return static_cast<std::size_t>(&task - tasks_.data());
  }

  /// Input errors belong to the case; everything else ends the sweep.
  void perform(const Task& task) {
    if (task.kind == Task::Kind::fluid) return perform_flow(task);
    const std::string error = complaint_of([&] { compute(task); });
    if (task.kind == Task::Kind::surface) {
      return;  // what fails here fails again, with its rows, where the surface is used
    }
    const auto ready = task.kind == Task::Kind::film
                           ? scans_[task.scan].film_ended(error)
                           : scans_[task.scan].contact_ended(task.pressure, error);
    if (study_.flows()) return;  // each film that flows makes its own row
    for (const ScanWork::Ready& rows : ready) {
      for (std::size_t i = 0; i < study_.conditions().size(); ++i) {
        make_row(task.scan, rows.pressure, i, rows.error);
      }
    }
  }

  void perform_flow(const Task& task) {
    std::string error = scans_[task.scan].wait_for(
        task.pressure, [&] { report({stage_name("waiting for", study_.scans[task.scan])}); });
    begin(task);  // waiting tells nothing about what it takes
    if (error.empty()) error = complaint_of([&] { compute(task); });
    make_row(task.scan, task.pressure, task.condition, error);
    scans_[task.scan].flow_ended(task.pressure);
  }

  template <typename Action>
  static std::string complaint_of(const Action& action) {
    try {
      action();
    } catch (const InputError& failure) {
      return failure.what();
    }
    return "";
  }

  void compute(const Task& task) {
    switch (task.kind) {
      case Task::Kind::surface:
        return compute_surface_of(task);
      case Task::Kind::film:
        return compute_film_of(task);
      case Task::Kind::contact:
        return compute_contact_of(task);
      case Task::Kind::fluid:
        return compute_fluid_of(task);
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

  void compute_fluid_of(const Task& task) {
    const ScanUnits& units = units_[task.scan];
    const Unit& unit = units.fluids[task.pressure][task.condition];
    const auto lock = exclusive(unit);
    if (usable(unit) && (!task.retry || read_fluid(store_, unit).summary.converged)) {
      return;
    }
    const double load = study_.mean_pressures[task.pressure];
    const std::string stage = stage_name("flow", study_.scans[task.scan], load);
    // Contacts within a film begin anew each time: they do not tell how far it is.
    const Observer observer = [this, &stage](const Progress& inner) {
      report({stage, std::nan(""), inner.convergence});
      return true;
    };
    const auto dry = scans_[task.scan].dry_contact(
        task.pressure, [&] { return solve_contact(study_, *surface(task), load, observer); });
    compute_fluid(store_, study_, *surface(task), *dry, units, task.pressure, task.condition,
                  observer);
    count(outcome_.n_fluids);
  }

  void make_row(std::size_t scan, std::size_t pressure, std::size_t condition,
                const std::string& error) {
    const Scan& file = study_.scans[scan];
    if (error.empty()) {
      compute_row(store_, study_, file, units_[scan], pressure, condition);
    } else {
      record_failure(store_, study_, file, units_[scan], pressure, condition, error);
    }
    count(outcome_.n_rows);
  }

  std::shared_ptr<const topography::Topography> surface(const Task& task) {
    return scans_[task.scan].surface([this, &task] {
      const Scan& scan = study_.scans[task.scan];
      const Observer observer = [this, stage = stage_name("read", scan)](const Progress& inner) {
        report({stage, inner.fraction, inner.convergence});
        return true;
      };
      return treated_surface(study_, scan, units_[task.scan].sha256, observer);
    });
  }

  /// True if the unit is in the store as it was written.
  bool usable(const Unit& unit) {
    if (!store_.has(unit)) {
      return false;
    }
    const std::string problem = defect(store_, unit);
    if (!problem.empty()) {
      const std::lock_guard lock(mutex_);
      outcome_.warnings.push_back("damaged, computed again: " + problem);
    }
    return problem.empty();
  }

  std::optional<io::FileLock> exclusive(const Unit& unit) {
    return store_.lock(unit.key, [this] { report({"waiting for another shard"}); });
  }

  /// Keeps account of how far the task is, and passes its messages on.
  Observer watch(const Task& task, const std::string& stage) {
    return [this, place = place_of(task), stage, first = 0.0](const Progress& inner) mutable {
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
  const Stopwatch& since_start_;
  Outcome& outcome_;            // guarded by mutex_
  std::deque<ScanWork> scans_;  // a deque, since mutexes do not move
  std::vector<Task> tasks_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::optional<WorkShare> work_share_;  // guarded by mutex_
  std::exception_ptr first_error_;       // guarded by mutex_
};

}  // namespace

void compute_missing(const Store& store, const Study& study, const std::vector<ScanUnits>& units,
                     const std::vector<ScanPlan>& plans, const SweepOptions& options,
                     const Stopwatch& since_start, Outcome& outcome) {
  Sweep(store, study, units, options, since_start, outcome).run(plans);
}

}  // namespace tabor::study
