#include "tabor/study/friction_jobs.hpp"

#include <memory>
#include <string>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/engine/made_once.hpp"
#include "tabor/io/hdf5_guard.hpp"
#include "tabor/study/compute.hpp"

namespace tabor::study {
namespace {

engine::Quality quality_of_row(const Row& row) {
  if (row.failed()) return engine::Quality::failed;
  return row.converged ? engine::Quality::converged : engine::Quality::not_converged;
}

engine::Quality quality_of(bool converged) {
  return converged ? engine::Quality::converged : engine::Quality::not_converged;
}

/// Without its maps.
bool contact_converged(const engine::Store& store, const engine::Task& task) {
  return io::read_guarded(store.path(task), [](const io::Hdf5Reader& reader) {
           return reader.number("/contact", "converged");
         }) != 0;
}

/// What the jobs of one scan share: all that outlives them, and its treated surface.
struct ScanOfJobs {
  const engine::Store& store;
  const Study study;  ///< of this scan alone
  const Scan& scan;
  const ScanTasks& tasks;
  engine::MadeOnce<topography::Topography> treated = {};
  cases::WettingDoses doses = {};  ///< made by a job of its own for those that need it

  /// Made by the first who asks, and gone with the last job.
  std::shared_ptr<const topography::Topography> surface(const engine::Monitor& monitor) {
    return treated.get([&] {
      return treated_surface(study, scan, tasks.sha256, monitor.shared(stage_name("read", scan)));
    });
  }
};
using SharedScan = std::shared_ptr<ScanOfJobs>;
using SharedContact = std::shared_ptr<engine::MadeOnce<contact::State>>;

engine::Job job_of(const std::string& kind, const SharedScan& scan, const engine::Task& task) {
  engine::Job job;
  job.task = task;
  job.kind = kind;
  job.defect = [scan, task] { return defect(scan->store, task); };
  job.memory = [scan](const engine::Monitor& monitor) {
    return bytes_of_job(scan->surface(monitor)->grid, scan->study.flows());
  };
  return job;
}

engine::Job surface_job(const SharedScan& scan) {
  engine::Job job = job_of("surface", scan, scan->tasks.surface);
  job.stage = stage_name("surface", scan->scan);
  job.compute = [scan](const engine::Monitor& monitor) {
    compute_surface(scan->store, scan->tasks.surface, *scan->surface(monitor));
  };
  return job;
}

engine::Job film_job(const SharedScan& scan) {
  engine::Job job = job_of("film", scan, scan->tasks.film);
  job.stage = stage_name("film", scan->scan);
  job.is_serial = true;
  job.compute = [scan](const engine::Monitor& monitor) {
    compute_film(scan->store, scan->tasks.film, scan->study, *scan->surface(monitor), monitor.own);
  };
  return job;
}

/// Nothing of it is stored: it is done for the contacts whose wet shares are missing.
engine::Job doses_job(const SharedScan& scan) {
  engine::Job job = job_of("wetting doses", scan, {});
  job.defect = nullptr;
  job.stage = stage_name("wetting doses", scan->scan);
  job.is_serial = true;
  job.compute = [scan](const engine::Monitor& monitor) {
    scan->doses =
        cases::wetting_doses(*scan->surface(monitor), scan->study.settings.film, monitor.own);
  };
  return job;
}

engine::Job wet_shares_job(const SharedScan& scan, std::size_t pressure) {
  engine::Job job = job_of(kWetSharesKind, scan, scan->tasks.wet_shares[pressure]);
  job.is_brief = true;
  job.memory = nullptr;
  job.compute = [scan, pressure](const engine::Monitor&) {
    compute_wet_shares(scan->store, scan->tasks.wet_shares[pressure],
                       scan->tasks.contacts[pressure], scan->doses);
  };
  return job;
}

engine::Job contact_job(const SharedScan& scan, std::size_t pressure) {
  const engine::Task& task = scan->tasks.contacts[pressure];
  const double load = scan->study.settings.mean_pressures[pressure];
  engine::Job job = job_of("contact", scan, task);
  job.stage = stage_name("contact", scan->scan, load);
  job.quality = [scan, task] { return quality_of(contact_converged(scan->store, task)); };
  job.compute = [scan, task, load](const engine::Monitor& monitor) {
    compute_contact(scan->store, task, scan->study, *scan->surface(monitor), load, monitor.own);
  };
  return job;
}

engine::Job fluid_job(const SharedScan& scan, const SharedContact& dry, std::size_t pressure,
                      std::size_t condition) {
  const engine::Task& task = scan->tasks.fluids[pressure][condition];
  const double load = scan->study.settings.mean_pressures[pressure];
  engine::Job job = job_of("fluid", scan, task);
  job.stage = stage_name("flow", scan->scan, load);
  job.restarts = true;  // with a contact within each step of the film
  job.quality = [scan, task] {
    return quality_of(read_fluid(scan->store, task).summary.convergence.converged());
  };
  job.compute = [scan, dry, load, pressure, condition](const engine::Monitor& monitor) {
    const auto surface = scan->surface(monitor);
    const auto contact =
        dry->get([&] { return solve_contact(scan->study, *surface, load, monitor.own); });
    compute_fluid(scan->store, scan->study, *surface, *contact, scan->tasks, pressure, condition,
                  monitor.own);
  };
  return job;
}

engine::Job row_job(const SharedScan& scan, std::size_t pressure, std::size_t condition) {
  const engine::Task& task = scan->tasks.cases[pressure][condition];
  engine::Job job = job_of("case", scan, task);
  job.is_brief = true;
  job.memory = nullptr;
  job.quality = [scan, task] { return quality_of_row(read_row(scan->store, task)); };
  job.compute = [scan, pressure, condition](const engine::Monitor&) {
    try {
      compute_row(scan->store, scan->study, scan->scan, scan->tasks, pressure, condition);
    } catch (const InputError& damage) {  // of a file of this store, which is no fault of the case
      throw Error(damage.what());
    }
  };
  job.record_failure = [scan, pressure, condition](const std::string& error) {
    record_failure(scan->store, scan->study, scan->scan, scan->tasks, pressure, condition, error);
  };
  return job;
}

/// The list of all jobs as it grows.
class JobList {
 public:
  void add(const SharedScan& scan) {
    surface_ = add(surface_job(scan), {});
    film_ = add(film_job(scan), {});
    if (!scan->tasks.wet_shares.empty()) doses_ = add(doses_job(scan), {});
    shown_ = {surface_};
    const std::size_t n_pressures = scan->tasks.contacts.size();
    contacts_.clear();
    for (std::size_t pressure = 0; pressure < n_pressures; ++pressure) add_contact(scan, pressure);
    for (std::size_t pressure = 0; pressure < n_pressures; ++pressure) add_flows(scan, pressure);
    part_ += n_pressures;
  }

  std::vector<engine::Job> take() { return std::move(jobs_); }

 private:
  void add_contact(const SharedScan& scan, std::size_t pressure) {
    contacts_.push_back(add(contact_job(scan, pressure), {}, part_ + pressure));
    if (scan->study.flows()) return;
    shown_ = {surface_};
    if (!scan->tasks.wet_shares.empty()) {
      shown_.push_back(
          add(wet_shares_job(scan, pressure), {contacts_[pressure], doses_}, part_ + pressure));
    }
    for (std::size_t i = 0; i < scan->tasks.cases[pressure].size(); ++i) {
      add_row(scan, pressure, i, {contacts_[pressure], film_});
    }
  }

  /// The contact without oil is solved once for all films that flow in it.
  void add_flows(const SharedScan& scan, std::size_t pressure) {
    const auto dry = std::make_shared<engine::MadeOnce<contact::State>>();
    for (std::size_t i = 0; i < scan->tasks.fluids[pressure].size(); ++i) {
      const std::size_t fluid =
          add(fluid_job(scan, dry, pressure, i), {contacts_[pressure], film_}, part_ + pressure);
      add_row(scan, pressure, i, {contacts_[pressure], film_, fluid});
    }
  }

  void add_row(const SharedScan& scan, std::size_t pressure, std::size_t condition,
               std::vector<std::size_t> needs) {
    add(row_job(scan, pressure, condition), std::move(needs), part_ + pressure);
    jobs_.back().wants = shown_;
  }

  std::size_t add(engine::Job job, std::vector<std::size_t> needs,
                  std::optional<std::size_t> part = {}) {
    job.needs = std::move(needs);
    job.part = part;
    jobs_.push_back(std::move(job));
    return jobs_.size() - 1;
  }

  std::vector<engine::Job> jobs_;
  std::size_t part_ = 0;  // of the first pressure of the scan
  std::size_t surface_ = 0;
  std::size_t film_ = 0;
  std::size_t doses_ = 0;
  std::vector<std::size_t> shown_;  // beside the rows of a pressure
  std::vector<std::size_t> contacts_;
};

}  // namespace

std::vector<engine::Job> friction_jobs(const engine::Store& store, const Study& study,
                                       const std::vector<ScanTasks>& tasks) {
  JobList jobs;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    jobs.add(SharedScan(new ScanOfJobs{store, study.of(study.scans[i]), study.scans[i], tasks[i]}));
  }
  return jobs.take();
}

}  // namespace tabor::study
