#include "tabor/study/scan_friction.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "tabor/analysis/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/compute.hpp"
#include "tabor/study/engine.hpp"

namespace tabor::study {
namespace {

/// Elastic operators of one half-space, each lent to one job at a time.
class Operators {
 public:
  using Operator = elastic::ElasticOperator;

  Operators(const analysis::ContactSettings& settings, const Grid& grid)
      : settings_(settings), grid_(grid) {}

  /// Comes back by itself. The pool must outlive it.
  std::shared_ptr<Operator> borrow() {
    return {take().release(),
            [this](Operator* used) { give_back(std::unique_ptr<Operator>(used)); }};
  }

 private:
  std::unique_ptr<Operator> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Operator> one = std::move(idle_.back());
        idle_.pop_back();
        return one;
      }
    }
    return analysis::make_operator(settings_, grid_);
  }

  void give_back(std::unique_ptr<Operator> used) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(used));
  }

  const analysis::ContactSettings& settings_;
  const Grid& grid_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Operator>> idle_;
};

/// What is known of one pressure so far. The lists have one element per density.
struct Pressure {
  analysis::ContactRecord contact;
  std::vector<std::optional<analysis::FluidRecord>> fluids;
  std::vector<analysis::FrictionRecord> frictions;
};

/// How many contacts may wait for the rain: what fits in a quarter of the memory, at least two.
std::size_t n_waiting(const Grid& grid, bool maps_are_kept) {
  const std::size_t bytes_per_pixel =
      sizeof(double) + sizeof(bool) + (maps_are_kept ? 2 * sizeof(double) : 0);
  const std::size_t bytes = static_cast<std::size_t>(grid.nx * grid.ny) * bytes_per_pixel;
  return std::max<std::size_t>(2, available_memory_bytes() / 4 / std::max<std::size_t>(1, bytes));
}

/// The jobs of one surface and what they hand to each other.
class ScanFriction {
 public:
  ScanFriction(const topography::Topography& surface, const analysis::CaseSettings& settings,
               const std::function<void(const FrictionState&)>& receive, ContactMaps maps)
      : surface_(surface),
        settings_(settings),
        receive_(receive),
        drops_maps_(maps == ContactMaps::dropped && !settings.fluid.flows()),
        window_(n_waiting(surface.grid, !drops_maps_)),
        operators_(settings.contact, surface.grid),
        pressures_(settings.mean_pressures.size()),
        touching_(settings.mean_pressures.size()) {}

  /// What rains first, as most of it is serial, and with each contact what waits for it: among the
  /// jobs that are ready the engine takes the first.
  std::vector<Job> jobs() {
    std::vector<Job> jobs = {film_job()};
    const bool has_curve = analysis::has_density_curve(settings_);
    if (has_curve) jobs.push_back(doses_job());
    for (std::size_t i = 0; i < pressures_.size(); ++i) add_pressure(i, jobs);
    if (has_curve) jobs.push_back(curves_job());
    return jobs;
  }

  ScanFrictionResult take_result() { return {std::move(curves_)}; }

 private:
  std::size_t n_densities() const { return settings_.film.lubricant_densities.size(); }

  Job job_of(const std::string& kind, std::optional<std::size_t> pressure = {}) const {
    Job job;
    job.kind = kind;
    job.stage = kind;
    if (pressure) job.stage += " " + format_si(settings_.mean_pressures[*pressure], "Pa");
    job.memory = [this](const Monitor&) {
      return bytes_of_job(surface_.grid, settings_.fluid.flows());
    };
    return job;
  }

  Job doses_job() {
    Job job = job_of("wetting doses");
    job.is_serial = true;
    job.compute = [this](const Monitor& monitor) {
      doses_ = analysis::wetting_doses(surface_, settings_.film, monitor.own);
    };
    return job;
  }

  Job curves_job() {
    Job job = job_of("density curve");
    job.is_brief = true;
    job.needs = contacts_;
    job.needs.push_back(kDoses);
    job.compute = [this](const Monitor&) {
      curves_ = analysis::density_curves(doses_, touching_, settings_);
    };
    return job;
  }

  Job film_job() {
    Job job = job_of("film");
    job.is_serial = true;
    job.compute = [this](const Monitor& monitor) {
      films_ = analysis::film_state(surface_, settings_.film, monitor.own);
    };
    return job;
  }

  void add_pressure(std::size_t i, std::vector<Job>& jobs) {
    Job contact = contact_job(i);
    if (settings_.contact.load_path && i > 0) contact.needs.push_back(contacts_[i - 1]);
    if (i >= window_) contact.needs.push_back(results_[i - window_]);
    contacts_.push_back(jobs.size());
    jobs.push_back(std::move(contact));
    Job friction = friction_job(i);
    friction.needs = {kFilm, contacts_[i]};
    for (std::size_t d = 0; settings_.fluid.flows() && d < n_densities(); ++d) {
      friction.needs.push_back(jobs.size());
      jobs.push_back(fluid_job(i, d));
      jobs.back().needs = {kFilm, contacts_[i]};
    }
    Job result = result_job(i);
    result.needs = {jobs.size()};
    if (i > 0) result.needs.push_back(results_[i - 1]);  // in their order
    jobs.push_back(std::move(friction));
    results_.push_back(jobs.size());
    jobs.push_back(std::move(result));
  }

  Job contact_job(std::size_t i) {
    Job job = job_of("contact", i);
    job.compute = [this, i](const Monitor& monitor) {
      Pressure& pressure = pressures_[i];
      pressure.contact =
          analysis::contact_state(*operators_.borrow(), surface_, settings_.contact,
                                  settings_.mean_pressures[i], load_path_, monitor.own);
      contact::State& state = pressure.contact.state;
      touching_[i] = {pressure.contact.summary, contact::contact_mask(state)};
      pressure.fluids.resize(n_densities());
      if (drops_maps_) state.pressure = state.displacement = Field();
    };
    return job;
  }

  Job fluid_job(std::size_t i, std::size_t density) {
    Job job = job_of("flow", i);
    job.restarts = true;  // with a contact within each step of the film
    job.compute = [this, i, density](const Monitor& monitor) {
      pressures_[i].fluids[density] = analysis::fluid_state(
          *operators_.borrow(), surface_.height, pressures_[i].contact.state,
          pressures_[i].contact.summary.mean_pressure, films_[density].film.thickness,
          settings_.contact, settings_.fluid, monitor.own);
    };
    return job;
  }

  Job friction_job(std::size_t i) {
    Job job = job_of("friction", i);
    job.compute = [this, i](const Monitor&) {
      Pressure& pressure = pressures_[i];
      contact::State& state = pressure.contact.state;
      for (std::size_t d = 0; d < films_.size(); ++d) {
        pressure.frictions.push_back(analysis::friction_state(
            pressure.contact, {touching_[i].mask, state.gap, surface_.grid}, films_[d],
            fluid_of(pressure, d), settings_.contact, settings_.friction));
      }
      if (drops_maps_) state.gap = Field();
    };
    return job;
  }

  Job result_job(std::size_t i) {
    Job job = job_of("keep", i);
    job.is_brief = drops_maps_;  // whoever looks at maps writes them
    job.compute = [this, i](const Monitor&) { hand_on(std::exchange(pressures_[i], {})); };
    return job;
  }

  void hand_on(const Pressure& pressure) {
    for (std::size_t d = 0; d < films_.size(); ++d) {
      receive_({.friction = pressure.frictions[d],
                .contact = pressure.contact,
                .film = films_[d],
                .fluid = fluid_of(pressure, d)});
    }
  }

  static const analysis::FluidRecord* fluid_of(const Pressure& pressure, std::size_t density) {
    return pressure.fluids[density] ? &*pressure.fluids[density] : nullptr;
  }

  static constexpr std::size_t kFilm = 0;  // places among the jobs
  static constexpr std::size_t kDoses = 1;

  const topography::Topography& surface_;
  const analysis::CaseSettings& settings_;
  const std::function<void(const FrictionState&)>& receive_;
  bool drops_maps_;
  std::size_t window_;
  Operators operators_;
  analysis::LoadPath load_path_;  // contacts of a load path wait for each other
  std::vector<analysis::FilmRecord> films_;
  std::vector<Pressure> pressures_;
  std::vector<analysis::Touching> touching_;
  analysis::WettingDoses doses_;
  std::vector<analysis::DensityCurve> curves_;
  std::vector<std::size_t> contacts_;  // places of their jobs
  std::vector<std::size_t> results_;
};

}  // namespace

ScanFrictionResult friction_of(const topography::Topography& surface,
                               const analysis::CaseSettings& settings,
                               const std::function<void(const FrictionState&)>& receive,
                               ContactMaps maps, const RunOptions& options) {
  ScanFriction scan(surface, settings, receive, maps);
  const Report report = run_jobs(scan.jobs(), nullptr, options);
  report.rethrow();
  if (!report.failures.empty()) throw InputError(report.failures.front());
  return scan.take_result();
}

}  // namespace tabor::study
