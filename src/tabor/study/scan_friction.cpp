#include "tabor/study/scan_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/engine/engine.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/study/compute.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

constexpr Index kFewestPixels = 32;  // along a side that is still coarsened

/// Elastic operators of one half-space, each lent to one job at a time.
class Operators {
 public:
  using Operator = elastic::ElasticOperator;

  Operators(const cases::ContactSettings& settings, const Grid& grid)
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
    return cases::make_operator(settings_, grid_);
  }

  void give_back(std::unique_ptr<Operator> used) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(used));
  }

  const cases::ContactSettings& settings_;
  const Grid& grid_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Operator>> idle_;
};

/// What is known of one pressure so far. The lists have one element per density.
struct Pressure {
  cases::ContactRecord contact;
  std::vector<std::optional<cases::FluidRecord>> fluids;
  std::vector<cases::FrictionRecord> frictions;
};

/// How many contacts may wait for the rain: what fits in a quarter of the memory, at least two.
std::size_t n_waiting(const Grid& grid, bool maps_are_kept) {
  const std::size_t bytes_per_pixel =
      sizeof(double) + sizeof(bool) + (maps_are_kept ? 2 * sizeof(double) : 0);
  const std::size_t bytes = static_cast<std::size_t>(grid.nx * grid.ny) * bytes_per_pixel;
  return std::max<std::size_t>(2, available_memory_bytes() / 4 / std::max<std::size_t>(1, bytes));
}

/// Area averages over twice the pixel still show a surface.
bool can_be_coarsened(const Grid& grid) { return std::min(grid.nx, grid.ny) >= kFewestPixels; }

/// The jobs of one surface and what they hand to each other.
class ScanFriction {
 public:
  ScanFriction(const topography::Topography& surface, const cases::CaseSettings& settings,
               const std::function<void(const FrictionState&)>& receive, ContactMaps maps,
               bool compares_pixels)
      : surface_(surface),
        settings_(settings),
        receive_(receive),
        compares_pixels_(compares_pixels && can_be_coarsened(surface.grid)),
        drops_maps_(maps == ContactMaps::dropped && !settings.fluid.flows()),
        window_(n_waiting(surface.grid, !drops_maps_)),
        operators_(settings.contact, surface.grid),
        pressures_(settings.mean_pressures.size()),
        touching_(settings.mean_pressures.size()) {}

  /// What rains first, as most of it is serial, and with each contact what waits for it: among the
  /// jobs that are ready the engine takes the first.
  std::vector<engine::Job> jobs() {
    std::vector<engine::Job> jobs = {film_job()};
    const bool has_curve = cases::has_density_curve(settings_);
    if (has_curve) jobs.push_back(doses_job());
    for (std::size_t i = 0; i < pressures_.size(); ++i) add_pressure(i, jobs);
    if (has_curve) jobs.push_back(curves_job());
    if (compares_pixels_) jobs.push_back(coarse_job());
    return jobs;
  }

  ScanFrictionResult take_result() { return {std::move(curves_), std::move(coarse_)}; }

 private:
  std::size_t n_densities() const { return settings_.film.lubricant_densities.size(); }

  engine::Job job_of(const std::string& kind, std::optional<std::size_t> pressure = {}) const {
    engine::Job job;
    job.kind = kind;
    job.stage = kind;
    if (pressure) job.stage += " " + format_si(settings_.mean_pressures[*pressure], "Pa");
    job.memory = [this](const engine::Monitor&) {
      return bytes_of_job(surface_.grid, settings_.fluid.flows());
    };
    return job;
  }

  engine::Job doses_job() {
    engine::Job job = job_of("wetting doses");
    job.is_serial = true;
    job.compute = [this](const engine::Monitor& monitor) {
      doses_ = cases::wetting_doses(surface_, settings_.film, monitor.own);
    };
    return job;
  }

  engine::Job curves_job() {
    engine::Job job = job_of("density curve");
    job.is_brief = true;
    job.needs = contacts_;
    job.needs.push_back(kDoses);
    job.compute = [this](const engine::Monitor&) {
      curves_ = cases::density_curves(doses_, touching_, settings_);
    };
    return job;
  }

  engine::Job film_job() {
    engine::Job job = job_of("film");
    job.is_serial = true;
    job.compute = [this](const engine::Monitor& monitor) {
      films_ = cases::film_state(surface_, settings_.film, monitor.own);
    };
    return job;
  }

  /// Rain and contacts on a quarter of the pixels.
  engine::Job coarse_job() {
    engine::Job job = job_of("coarse pixels");
    job.compute = [this](const engine::Monitor& monitor) {
      const Grid& grid = surface_.grid;
      const topography::Topography coarse = topography::apply(
          {fmt::format("resample={},{}", grid.nx / 2, grid.ny / 2)}, surface_, monitor.own);
      const auto films = cases::film_state(coarse, settings_.film, monitor.own);
      coarse_.pixel_x = coarse.grid.dx();
      const auto receive = [&](const cases::ContactRecord& contact) {
        const Mask touching = contact::contact_mask(contact.state);
        std::vector<double>& shares = coarse_.lubricated_shares.emplace_back();
        for (const cases::FilmRecord& film : films) {
          shares.push_back(friction::lubricated_share(touching, film.film.thickness));
        }
      };
      const auto elasticity = cases::make_operator(settings_.contact, coarse.grid);
      cases::contact_states(*elasticity, coarse, settings_.contact, cases::controls_of(settings_),
                            receive, monitor.own);
    };
    return job;
  }

  void add_pressure(std::size_t i, std::vector<engine::Job>& jobs) {
    engine::Job contact = contact_job(i);
    if (settings_.contact.load_path && i > 0) contact.needs.push_back(contacts_[i - 1]);
    if (i >= window_) contact.needs.push_back(results_[i - window_]);
    contacts_.push_back(jobs.size());
    jobs.push_back(std::move(contact));
    engine::Job friction = friction_job(i);
    friction.needs = {kFilm, contacts_[i]};
    for (std::size_t d = 0; settings_.fluid.flows() && d < n_densities(); ++d) {
      friction.needs.push_back(jobs.size());
      jobs.push_back(fluid_job(i, d));
      jobs.back().needs = {kFilm, contacts_[i]};
    }
    engine::Job result = result_job(i);
    result.needs = {jobs.size()};
    if (i > 0) result.needs.push_back(results_[i - 1]);  // in their order
    jobs.push_back(std::move(friction));
    results_.push_back(jobs.size());
    jobs.push_back(std::move(result));
  }

  engine::Job contact_job(std::size_t i) {
    engine::Job job = job_of("contact", i);
    job.compute = [this, i](const engine::Monitor& monitor) {
      Pressure& pressure = pressures_[i];
      pressure.contact = cases::contact_state(*operators_.borrow(), surface_, settings_.contact,
                                              contact::MeanPressure{settings_.mean_pressures[i]},
                                              load_path_, monitor.own);
      contact::State& state = pressure.contact.state;
      touching_[i] = cases::touching_of(pressure.contact);
      pressure.fluids.resize(n_densities());
      if (drops_maps_) state.pressure = state.displacement = Field();
    };
    return job;
  }

  engine::Job fluid_job(std::size_t i, std::size_t density) {
    engine::Job job = job_of("flow", i);
    job.restarts = true;  // with a contact within each step of the film
    job.compute = [this, i, density](const engine::Monitor& monitor) {
      pressures_[i].fluids[density] =
          cases::fluid_state(*operators_.borrow(), surface_, pressures_[i].contact, films_[density],
                             settings_.contact, settings_.fluid, monitor.own);
    };
    return job;
  }

  engine::Job friction_job(std::size_t i) {
    engine::Job job = job_of("friction", i);
    job.compute = [this, i](const engine::Monitor&) {
      Pressure& pressure = pressures_[i];
      contact::State& state = pressure.contact.state;
      for (std::size_t d = 0; d < films_.size(); ++d) {
        pressure.frictions.push_back(cases::friction_state(
            pressure.contact, {touching_[i].mask, state.gap, surface_.grid}, films_[d],
            fluid_of(pressure, d), settings_.contact, settings_.friction));
      }
      if (drops_maps_) state.gap = Field();
    };
    return job;
  }

  engine::Job result_job(std::size_t i) {
    engine::Job job = job_of("keep", i);
    job.is_brief = drops_maps_;  // whoever looks at maps writes them
    job.compute = [this, i](const engine::Monitor&) { hand_on(std::exchange(pressures_[i], {})); };
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

  static const cases::FluidRecord* fluid_of(const Pressure& pressure, std::size_t density) {
    return pressure.fluids[density] ? &*pressure.fluids[density] : nullptr;
  }

  static constexpr std::size_t kFilm = 0;  // places among the jobs
  static constexpr std::size_t kDoses = 1;

  const topography::Topography& surface_;
  const cases::CaseSettings& settings_;
  const std::function<void(const FrictionState&)>& receive_;
  bool compares_pixels_;
  bool drops_maps_;
  std::size_t window_;
  Operators operators_;
  cases::LoadPath load_path_;  // contacts of a load path wait for each other
  std::vector<cases::FilmRecord> films_;
  std::vector<Pressure> pressures_;
  std::vector<cases::Touching> touching_;
  cases::WettingDoses doses_;
  std::vector<cases::DensityCurve> curves_;
  CoarsePixels coarse_;
  std::vector<std::size_t> contacts_;  // places of their jobs
  std::vector<std::size_t> results_;
};

}  // namespace

ScanFrictionResult friction_of(const topography::Topography& surface,
                               const cases::CaseSettings& settings,
                               const std::function<void(const FrictionState&)>& receive,
                               ContactMaps maps, const engine::RunOptions& options,
                               bool compares_pixels) {
  ScanFriction scan(surface, settings, receive, maps, compares_pixels);
  const engine::Report report = engine::run_jobs(scan.jobs(), nullptr, options);
  report.rethrow();
  if (!report.failures.empty()) throw InputError(report.failures.front());
  return scan.take_result();
}

}  // namespace tabor::study
