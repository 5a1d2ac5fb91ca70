#include "tabor/study/friction_jobs.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "tabor/core/advice.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/engine/made_once.hpp"
#include "tabor/study/friction_graph.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/slides.hpp"
#include "tabor/study/study_keys.hpp"
#include "tabor/study/task_file.hpp"
#include "tabor/study/treated_scan.hpp"
#include "tabor/study/wet_shares.hpp"

namespace tabor::study {
namespace {

engine::Quality quality_of(bool converged) {
  return converged ? engine::Quality::converged : engine::Quality::not_converged;
}

engine::Quality quality_of_row(const Row& row) {
  return row.failed() ? engine::Quality::failed : quality_of(row.converged);
}

/// Reads whether a stored contact converged, without its maps.
bool contact_converged(const engine::Store& store, const engine::Task& task) {
  return read_task(store, task, [](const io::Hdf5Reader& reader) {
           return reader.number("/contact", "converged");
         }) != 0;
}

std::vector<FilmCondition> conditions_of(const Study& study) {
  std::vector<FilmCondition> conditions;
  for (const Condition& one : study.conditions()) {
    conditions.push_back({one.density, study.fluid_settings(one)});
  }
  return conditions;
}

/// Results of one scan in the folder of its study.
class FrictionInFolder : public FrictionStore,
                         public std::enable_shared_from_this<FrictionInFolder> {
 public:
  FrictionInFolder(const engine::Store& folder, Study study, const Scan& scan,
                   const ScanTasks& tasks, std::size_t first_part)
      : FrictionStore(study.settings, conditions_of(study)),
        folder_(folder),
        study_(std::move(study)),
        scan_(scan),
        tasks_(tasks),
        first_part_(first_part) {}

  const ScanTasks& tasks() const { return tasks_; }

  void describe(const FrictionPlace& place, engine::Job& job) override {
    if (const engine::Task* task = task_of(place)) attach(*task, job);
    const bool is_of_scan =
        place.kind == FrictionJob::film || place.kind == FrictionJob::wetting_doses;
    job.stage = stage_name(job.kind, scan_, is_of_scan ? 0 : mean_pressure_of(place.contact));
    if (!is_of_scan) job.part = first_part_ + pressure_of(place.contact);
    add_quality(place, job);
    if (place.kind == FrictionJob::friction) describe_row(place, job);
  }

  /// Returns the job that stores the treated scan with its spectra; no friction needs it.
  engine::Job surface_job() {
    engine::Job job;
    attach(tasks_.surface, job);
    job.kind = "surface";
    job.stage = stage_name(job.kind, scan_);
    job.memory = [self = shared_from_this()](const engine::Monitor& monitor) {
      return bytes_of_job(self->surface(monitor)->grid, self->settings());
    };
    job.compute = [self = shared_from_this()](const engine::Monitor& monitor) {
      const Surface treated = self->surface(monitor);
      write_surface(self->folder_, self->tasks_.surface, *treated,
                    metrology::power_spectra(*treated));
    };
    return job;
  }

  /// Returns the job of one slide; no friction needs it.
  engine::Job slide_job(std::size_t pressure, std::size_t density) {
    engine::Job job;
    const engine::Task& task = tasks_.slides[pressure][density];
    attach(task, job);
    job.kind = kSlideKind;
    job.stage = stage_name(job.kind, scan_, settings().mean_pressures[pressure]);
    job.part = first_part_ + pressure;
    job.memory = [self = shared_from_this()](const engine::Monitor& monitor) {
      return bytes_of_slide(self->surface(monitor)->grid, self->settings());
    };
    job.compute = [self = shared_from_this(), &task, pressure,
                   density](const engine::Monitor& monitor) {
      const cases::CaseSettings& all = self->settings();
      write_slide(self->folder_, task,
                  compute_slide(self->folder_, task, self->study_, *self->surface(monitor),
                                all.mean_pressures[pressure], all.film.lubricant_densities[density],
                                monitor.own));
    };
    job.quality = [&folder = folder_, task] {
      const StoredSlide slide = read_slide(folder, task);
      return slide.error.empty() ? quality_of(slide.converged) : engine::Quality::failed;
    };
    job.record_failure = [&folder = folder_, task](const std::string& error) {
      StoredSlide failed;
      failed.error = advised(error, spelling());
      write_slide(folder, task, failed);
    };
    return job;
  }

  /// Made by the first who asks, and gone with the last job.
  Surface surface(const engine::Monitor& monitor) override {
    return treated_.get([&] {
      return treated_surface(study_, scan_, tasks_.sha256,
                             monitor.shared(stage_name("read", scan_)));
    });
  }
  std::shared_ptr<const Mask> touching(std::size_t contact) override {
    return std::make_shared<const Mask>(read_contact_mask(folder_, tasks_.contacts[contact]));
  }
  /// The folder holds no displacements: the contact is solved once more for all films in it, and
  /// dropped after the last.
  std::shared_ptr<const contact::State> dry_contact(
      std::size_t contact, const std::function<contact::State()>& solve) override {
    DryContact& dry = dry_contacts_[contact];
    auto state = dry.state.get(solve);
    if (++dry.n_films == conditions().size()) dry.state.drop();
    return state;
  }
  std::shared_ptr<const Field> film(std::size_t density) override {
    return std::make_shared<const Field>(read_film(folder_, tasks_.film, density));
  }
  FrictionInputs inputs(const FrictionPlace& place) override;

  void store_films(const Surface& surface, const LayFilms& lay) override {
    FilmFile file(folder_, tasks_.film, surface->grid);
    lay([&file](cases::FilmRecord&& film) { file.add(film); });
    file.commit();
  }
  void store(const FrictionPlace& place, const Surface& surface,
             cases::ContactRecord&& contact) override {
    write_contact(folder_, tasks_.contacts[place.contact], surface->grid,
                  settings().contact.pressure_cap(), contact);
  }
  void store(const FrictionPlace& place, WetShares&& shares) override {
    write_wet_shares(folder_, tasks_.wet_shares[place.contact], shares);
  }
  void store(const FrictionPlace& place, const Surface& surface,
             cases::TrappedRecord&& trapped) override {
    const Condition under = study_.conditions().at(place.condition);
    write_trapped(folder_, tasks_.trapped[place.contact][place.condition], surface->grid, trapped,
                  {{"mean_pressure_Pa", mean_pressure_of(place.contact)},
                   {"lubricant_density_g_per_m2", in_g_per_m2(study_.lubricant_density(under))}});
  }
  void store(const FrictionPlace& place, const Surface& surface,
             cases::FluidRecord&& fluid) override {
    const Condition under = study_.conditions().at(place.condition);
    write_fluid(folder_, tasks_.fluids[pressure_of(place.contact)][place.condition], surface->grid,
                fluid,
                {{"mean_pressure_Pa", mean_pressure_of(place.contact)},
                 {"lubricant_density_g_per_m2", in_g_per_m2(study_.lubricant_density(under))},
                 {"sliding_speed_m_per_s", fluid.sliding_speed}});
  }
  void store(const FrictionPlace& place, cases::FrictionRecord&& friction) override {
    Row row;
    static_cast<cases::FrictionRecord&>(row) = std::move(friction);
    store_row(place, std::move(row));
  }

 private:
  const engine::Task* task_of(const FrictionPlace& place) const {
    switch (place.kind) {
      case FrictionJob::film:
        return &tasks_.film;
      case FrictionJob::wetting_doses:
        return nullptr;  // for wet shares that are missing
      case FrictionJob::contact:
        return &tasks_.contacts[place.contact];
      case FrictionJob::wet_shares:
        return &tasks_.wet_shares[place.contact];
      case FrictionJob::trapped:
        return &tasks_.trapped[place.contact][place.condition];
      case FrictionJob::fluid:
        return &tasks_.fluids[pressure_of(place.contact)][place.condition];
      case FrictionJob::friction:
        return &tasks_.cases[pressure_of(place.contact)][place.condition];
    }
    return nullptr;
  }

  void attach(const engine::Task& task, engine::Job& job) const {
    job.task = task;
    job.defect = [&folder = folder_, task] { return study::defect(folder, task); };
  }

  void add_quality(const FrictionPlace& place, engine::Job& job) const {
    const engine::Task& task = job.task;
    if (place.kind == FrictionJob::contact) {
      job.quality = [&folder = folder_, task] {
        return quality_of(contact_converged(folder, task));
      };
    } else if (place.kind == FrictionJob::trapped) {
      job.quality = [&folder = folder_, task] {
        return quality_of(read_trapped(folder, task).converged());
      };
    } else if (place.kind == FrictionJob::fluid) {
      job.quality = [&folder = folder_, task] {
        return quality_of(read_fluid(folder, task).summary.convergence.converged());
      };
    } else if (place.kind == FrictionJob::friction) {
      job.quality = [&folder = folder_, task] { return quality_of_row(read_row(folder, task)); };
    }
  }

  void describe_row(const FrictionPlace& place, engine::Job& job) {
    job.compute = [compute = std::move(job.compute)](const engine::Monitor& monitor) {
      try {
        compute(monitor);
      } catch (
          const InputError& damage) {  // of a file of this store, which is no fault of the case
        throw Error(damage.what());
      }
    };
    job.record_failure = [self = shared_from_this(), place](const std::string& error) {
      Row row;
      row.error = advised(error, spelling());
      self->store_row(place, std::move(row));
    };
  }

  /// Stores a row under its case.
  void store_row(const FrictionPlace& place, Row&& row) const {
    const engine::Task& task = tasks_.cases[pressure_of(place.contact)][place.condition];
    const Condition under = study_.conditions().at(place.condition);
    row.case_id = task.key;
    row.scan = scan_.label;
    row.group = scan_.group;
    row.mean_pressure = mean_pressure_of(place.contact);
    if (row.failed()) {
      row.lubricant_density = study_.lubricant_density(under);
      if (is_trapped()) row.trapped.emplace();
      if (flows()) row.fluid.emplace().sliding_speed = study_.sliding_speeds[under.speed];
    }
    write_row(folder_, task, row);
  }

  /// A contact with all its maps, and how many films have asked for it.
  struct DryContact {
    engine::MadeOnce<contact::State> state;
    std::atomic<std::size_t> n_films = 0;
  };

  const engine::Store& folder_;
  const Study study_;  ///< of this scan alone
  const Scan& scan_;
  const ScanTasks& tasks_;
  std::size_t first_part_;
  engine::MadeOnce<topography::Topography> treated_;
  std::vector<DryContact> dry_contacts_ = std::vector<DryContact>(tasks_.contacts.size());
};

FrictionInputs FrictionInFolder::inputs(const FrictionPlace& place) {
  const Condition under = study_.conditions().at(place.condition);
  const auto contact =
      std::make_shared<const StoredContact>(read_contact(folder_, tasks_.contacts[place.contact]));
  const auto film =
      std::make_shared<cases::FilmRecord>(read_film_record(folder_, tasks_.film, under.density));
  film->lubricant_density = study_.lubricant_density(under);
  const Field& thickness = film->film.thickness;
  if (thickness.rows() != contact->gap.rows() || thickness.cols() != contact->gap.cols()) {
    throw InputError("the store", "a film and a contact of two sizes", "both of one surface",
                     "remove the folder store and run the sweep again");
  }
  std::shared_ptr<cases::TrappedRecord> trapped;
  if (is_trapped()) {
    trapped = std::make_shared<cases::TrappedRecord>(
        read_trapped(folder_, tasks_.trapped[place.contact][place.condition]));
  }
  std::shared_ptr<cases::FluidRecord> fluid;
  if (flows()) {
    fluid = std::make_shared<cases::FluidRecord>(
        read_fluid(folder_, tasks_.fluids[pressure_of(place.contact)][place.condition]));
    fluid->sliding_speed = study_.sliding_speeds[under.speed];
  }
  return {
      contact, {contact, &contact->contact}, {contact, &contact->gap}, contact->grid, film, trapped,
      fluid};
}

/// Appends the jobs of one scan; rows of a pressure are shown with its surface and wet shares.
void add_scan(const std::shared_ptr<FrictionInFolder>& scan, std::vector<engine::Job>& jobs) {
  FrictionGraph graph(scan, jobs);
  const std::size_t surface = graph.add(scan->surface_job(), {});
  const bool has_wet_shares = !scan->tasks().wet_shares.empty();
  graph.add_rain(has_wet_shares);
  for (std::size_t i = 0; i < scan->settings().mean_pressures.size(); ++i) {
    graph.add_contact(i);
    std::vector<std::size_t> shown = {surface};
    if (has_wet_shares) shown.push_back(graph.add_wet_shares(i));
    for (const std::size_t place : graph.add_frictions(i)) jobs[place].wants = shown;
    if (scan->tasks().slides.empty()) continue;
    for (std::size_t density = 0; density < scan->tasks().slides[i].size(); ++density) {
      graph.add(scan->slide_job(i, density), {});
    }
  }
}

}  // namespace

std::vector<engine::Job> friction_jobs(const engine::Store& store, const Study& study,
                                       const std::vector<ScanTasks>& tasks) {
  std::vector<engine::Job> jobs;
  std::size_t n_parts = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    add_scan(std::make_shared<FrictionInFolder>(store, study.of(study.scans[i]), study.scans[i],
                                                tasks[i], n_parts),
             jobs);
    n_parts += tasks[i].cases.size();
  }
  return jobs;
}

}  // namespace tabor::study
