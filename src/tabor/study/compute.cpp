#include "tabor/study/compute.hpp"

#include <optional>
#include <utility>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/digest.hpp"
#include "tabor/study/wet_shares.hpp"

namespace tabor::study {
namespace {

/// Of a job with its surface; tools/bench/study prints it. With oil that flows, what the peak of
/// `tabor friction --fluid reynolds` grows by with the pixels of a flooded scan, and a little.
constexpr std::size_t kBytesPerPixel = 80;
constexpr std::size_t kBytesPerFlowingPixel = 500;

/// A row that has its place and no numbers yet.
Row empty_row(const Study& study, const Scan& scan, const engine::Task& task, std::size_t pressure,
              const Condition& condition) {
  Row row;
  row.case_id = task.key;
  row.scan = scan.label;
  row.group = scan.group;
  row.mean_pressure = study.settings.mean_pressures[pressure];
  row.lubricant_density = study.lubricant_density(condition);
  if (study.flows()) row.fluid.emplace().sliding_speed = study.sliding_speeds[condition.speed];
  return row;
}

void require_one_size(const StoredContact& contact, const Field& film) {
  if (film.rows() == contact.gap.rows() && film.cols() == contact.gap.cols()) return;
  throw InputError("the store", "a film and a contact of two sizes", "both of one surface",
                   "remove the folder store and run the sweep again");
}

[[noreturn]] void reject_replaced(const Scan& scan) {
  throw Error(scan.file.string() +
              ": replaced or changed while the sweep ran; nothing of it was kept, start the sweep "
              "again");
}

bool holds(const Scan& scan, const std::string& sha256) {
  try {
    return io::sha256_of_file(scan.file) == sha256;
  } catch (const InputError&) {
    return false;
  }
}

topography::Topography read_unchanged(const Scan& scan, const std::string& sha256,
                                      const Observer& observer) {
  try {
    const scan::ScanFile file(scan.file, observer);
    if (file.sha256() != sha256) reject_replaced(scan);
    return file.read(scan.read);
  } catch (const InputError&) {  // of this scan, or of what took its place
    if (!holds(scan, sha256)) reject_replaced(scan);
    throw;
  }
}

}  // namespace

topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer) {
  topography::Topography treated =
      topography::apply(study.treatment, read_unchanged(scan, scan_sha256, observer), observer);
  treated.source = scan.label;  // wherever the study lies
  topography::require_no_holes(treated, scan.label, "add \"fill=harmonic\" to treatment.steps");
  return treated;
}

std::size_t bytes_of_job(const Grid& grid, bool oil_flows) {
  return static_cast<std::size_t>(grid.nx * grid.ny) *
         (oil_flows ? kBytesPerFlowingPixel : kBytesPerPixel);
}

void compute_surface(const engine::Store& store, const engine::Task& task,
                     const topography::Topography& topography) {
  write_surface(store, task, topography, metrology::power_spectra(topography));
}

contact::State solve_contact(const Study& study, const topography::Topography& topography,
                             double mean_pressure, const Observer& observer) {
  return cases::contact_state(topography, study.settings.contact,
                              contact::MeanPressure{mean_pressure}, observer)
      .state;
}

void compute_contact(const engine::Store& store, const engine::Task& task, const Study& study,
                     const topography::Topography& topography, double mean_pressure,
                     const Observer& observer) {
  write_contact(store, task, topography.grid, study.settings.contact.pressure_cap(),
                cases::contact_state(topography, study.settings.contact,
                                     contact::MeanPressure{mean_pressure}, observer));
}

void compute_film(const engine::Store& store, const engine::Task& task, const Study& study,
                  const topography::Topography& topography, const Observer& observer) {
  FilmFile file(store, task, topography.grid);
  const auto receive = [&file](cases::FilmRecord&& record) { file.add(record); };
  cases::film_state(topography, study.settings.film, receive, observer);
  file.commit();
}

void compute_fluid(const engine::Store& store, const Study& study,
                   const topography::Topography& topography, const contact::State& dry,
                   const ScanTasks& tasks, std::size_t pressure, std::size_t condition,
                   const Observer& observer) {
  const Condition under = study.conditions().at(condition);
  const cases::ContactSettings settings = study.settings.contact;
  const double mean_pressure = study.settings.mean_pressures[pressure];
  const auto elasticity = cases::make_operator(settings, topography.grid);
  const cases::FluidRecord record = cases::fluid_state(
      *elasticity, topography.height, dry, mean_pressure,
      read_film(store, tasks.film, under.density), settings, study.fluid_settings(under), observer);
  write_fluid(store, tasks.fluids[pressure][condition], topography.grid, record,
              {{"mean_pressure_Pa", mean_pressure},
               {"lubricant_density_g_per_m2", in_g_per_m2(study.lubricant_density(under))},
               {"sliding_speed_m_per_s", record.sliding_speed}});
}

void compute_wet_shares(const engine::Store& store, const engine::Task& task,
                        const engine::Task& contact, const cases::WettingDoses& doses) {
  const Mask touching = read_contact_mask(store, contact);
  if (!doses.first.empty() && doses.first.size() != static_cast<std::size_t>(touching.size())) {
    throw InputError("the store", "a surface and a contact of two sizes", "both of one surface",
                     "remove the folder store and run the sweep again");
  }
  write_wet_shares(store, task,
                   {doses.lubricant_densities, cases::lubricated_shares(doses, touching)});
}

void compute_row(const engine::Store& store, const Study& study, const Scan& scan,
                 const ScanTasks& tasks, std::size_t pressure, std::size_t condition) {
  const StoredContact contact = read_contact(store, tasks.contacts[pressure]);
  const Condition under = study.conditions().at(condition);
  const engine::Task& task = tasks.cases[pressure][condition];
  cases::FilmRecord film = read_film_record(store, tasks.film, under.density);
  film.lubricant_density = study.lubricant_density(under);
  require_one_size(contact, film.film.thickness);
  std::optional<cases::FluidRecord> fluid;
  if (study.flows()) {
    fluid = read_fluid(store, tasks.fluids[pressure][condition]);
    fluid->sliding_speed = study.sliding_speeds[under.speed];
  }
  Row row = empty_row(study, scan, task, pressure, under);
  static_cast<cases::FrictionRecord&>(row) = cases::friction_state(
      contact, {contact.contact, contact.gap, contact.grid}, film, fluid ? &*fluid : nullptr,
      study.settings.contact, study.settings.friction);
  row.mean_pressure = study.settings.mean_pressures[pressure];
  write_row(store, task, row);
}

void record_failure(const engine::Store& store, const Study& study, const Scan& scan,
                    const ScanTasks& tasks, std::size_t pressure, std::size_t condition,
                    const std::string& error) {
  const engine::Task& task = tasks.cases[pressure][condition];
  Row row = empty_row(study, scan, task, pressure, study.conditions().at(condition));
  row.error = error;
  write_row(store, task, row);
}

}  // namespace tabor::study
