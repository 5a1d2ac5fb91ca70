#include "tabor/study/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/parameters.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/digest.hpp"

namespace tabor::study {
namespace {

engine::Task task_of(std::string_view kind, std::string_view extension, const std::string& body) {
  return engine::make_task(kind, extension,
                           fmt::format("tabor {} {}\n{}", kind, kAlgorithms, body));
}

/// The oil that is trapped in one contact, under each condition.
std::vector<engine::Task> trapped_tasks(const Study& study, const engine::Task& contact,
                                        const engine::Task& film) {
  std::vector<engine::Task> tasks;
  for (const Condition& condition : study.conditions()) {
    tasks.push_back(trapped_task(study, contact, film, study.lubricant_density(condition)));
  }
  return tasks;
}

/// The contact under one pressure, and what is computed from it.
void add_pressure(const Study& study, const Scan& scan, double pressure, ScanTasks& tasks) {
  std::vector<engine::Task> contacts;
  for (std::size_t i = 0; i < study.settings.contact.tool.n_places(); ++i) {
    contacts.push_back(contact_task(study, tasks.surface, pressure, i));
  }
  std::vector<std::vector<engine::Task>> trapped;
  if (study.settings.trapped.is_asked()) {
    for (const engine::Task& contact : contacts) {
      trapped.push_back(trapped_tasks(study, contact, tasks.film));
    }
  }
  const std::vector<Condition> conditions = study.conditions();
  std::vector<engine::Task> cases;
  std::vector<engine::Task> fluids;
  cases.reserve(conditions.size());
  fluids.reserve(conditions.size());
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Condition& condition = conditions[i];
    std::vector<engine::Task> oil;
    oil.reserve(trapped.size());
    for (const std::vector<engine::Task>& at_place : trapped) oil.push_back(at_place[i]);
    if (study.flows()) fluids.push_back(fluid_task(study, contacts.front(), tasks.film, condition));
    cases.push_back(case_task(study, scan, contacts, tasks.film, study.lubricant_density(condition),
                              oil, study.flows() ? &fluids.back() : nullptr));
  }
  tasks.contacts.insert(tasks.contacts.end(), contacts.begin(), contacts.end());
  tasks.trapped.insert(tasks.trapped.end(), trapped.begin(), trapped.end());
  if (cases::has_density_curve(study.settings)) {
    tasks.wet_shares.push_back(wet_shares_task(study, contacts.front()));
  }
  if (study.slide) {
    std::vector<engine::Task>& slides = tasks.slides.emplace_back();
    for (const double density : study.settings.film.lubricant_densities) {
      slides.push_back(slide_task(study, tasks.surface, pressure, density));
    }
  }
  tasks.cases.push_back(std::move(cases));
  tasks.fluids.push_back(std::move(fluids));
}

std::string text_line_of(const std::string& key, const Cell& cell) {
  if (const auto* word = std::get_if<std::string>(&cell)) return engine::text_line(key, *word);
  if (const auto* count = std::get_if<std::uint64_t>(&cell)) {
    return engine::text_line(key, std::to_string(*count));
  }
  if (const auto* flag = std::get_if<bool>(&cell)) {
    return engine::text_line(key, *flag ? "yes" : "no");
  }
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && !std::isnan(*number) ? engine::text_line(key, *number) : "";
}

/// A line for each parameter that the result depends on.
template <typename Settings>
std::string text_of(const Parameters<Settings>& parameters, const Settings& settings) {
  std::string lines;
  for (const Parameter<Settings>& one : parameters) {
    if (one.identity == Identity::no) continue;
    const Cell cell = one.identifying(settings);
    const bool is_default = cell == one.identifying(Settings{});
    if (one.identity == Identity::unless_default && is_default) continue;
    lines += text_line_of(one.json_key(), cell);
  }
  return lines;
}

/// Returns the text of these parameters alone.
template <typename Settings>
std::string text_of(const Parameters<Settings>& parameters, const Settings& settings,
                    std::initializer_list<std::string_view> names) {
  Parameters<Settings> some;
  for (const std::string_view name : names) some.push_back(parameter_of(parameters, name));
  return text_of(some, settings);
}

/// Says which rain falls on mirror images; nothing for surfaces without.
std::string line_of_images(const Study& study) {
  if (!topography::mirrors(study.treatment)) return "";
  return engine::text_line("image_algorithms", kImageAlgorithms);
}

}  // namespace

engine::Task surface_task(const Study& study, const Scan& scan, const std::string& scan_sha256) {
  std::string body = engine::text_line("scan_sha256", scan_sha256);
  body += engine::text_line("channel", scan.read.channel.value_or(""));
  body += engine::text_line("unit", scan.read.unit.value_or(""));
  body += engine::text_line("pixel_x_m", scan.read.pixel_x.value_or(0));
  body += engine::text_line("pixel_y_m", scan.read.pixel_y.value_or(0));
  for (const std::string& step : study.treatment) body += engine::text_line("step", step);
  return task_of("surface", "h5", body);
}

engine::Task contact_task(const Study& study, const engine::Task& surface, double mean_pressure,
                          std::size_t place) {
  const std::size_t n_places = study.settings.contact.tool.n_places();
  const cases::ContactSettings& settings = study.settings.contact;
  return task_of(
      "contact", "h5",
      engine::text_line("surface", surface.key) +
          engine::text_line("mean_pressure_Pa", mean_pressure) +
          engine::text_line("effective_modulus_Pa", settings.effective_modulus()) +
          text_of(cases::contact_parameters(), settings) +
          (place > 0 ? engine::text_line("tool_place", fmt::format("{}/{}", place, n_places))
                     : ""));
}

engine::Task film_task(const Study& study, const engine::Task& surface) {
  const cases::FilmSettings& lubricant = study.settings.film;
  std::string body = engine::text_line("surface", surface.key) +
                     text_of(cases::film_parameters(), lubricant) + line_of_images(study);
  for (const double density : lubricant.lubricant_densities) {
    body += engine::text_line("lubricant_density_kg_per_m2", density);
  }
  return task_of("film", "h5", body);
}

engine::Task wet_shares_task(const Study& study, const engine::Task& contact) {
  const cases::FilmSettings& lubricant = study.settings.film;
  std::string body =
      engine::text_line("wet_shares_algorithms", kWetSharesAlgorithms) +
      engine::text_line("contact", contact.key) +
      text_of(cases::film_parameters(), lubricant, {"oil_density", "reading", "edge"});
  for (const double density : lubricant.lubricant_densities) {
    if (density > 0) body += engine::text_line("lubricant_density_kg_per_m2", density);
  }
  return task_of(kWetSharesKind, "json", body);
}

engine::Task trapped_task(const Study& study, const engine::Task& contact, const engine::Task& film,
                          double lubricant_density) {
  const std::string body =
      engine::text_line("trapped_algorithms", kTrappedAlgorithms) +
      engine::text_line("contact", contact.key) + engine::text_line("film", film.key) +
      engine::text_line("lubricant_density_kg_per_m2", lubricant_density) +
      text_of(cases::trapped_parameters(), study.settings.trapped) +
      text_of(cases::friction_parameters(), study.settings.friction, {"dry_below"});
  return task_of("trapped", "h5", body);
}

engine::Task slide_task(const Study& study, const engine::Task& surface, double mean_pressure,
                        double lubricant_density) {
  const cases::CaseSettings one = study.slide_settings(mean_pressure, lubricant_density);
  std::string body = engine::text_line("slide_algorithms", kSlideAlgorithms) +
                     engine::text_line("surface", surface.key) +
                     engine::text_line("mean_pressure_Pa", mean_pressure) +
                     engine::text_line("effective_modulus_Pa", one.contact.effective_modulus()) +
                     text_of(cases::contact_parameters(), one.contact) +
                     text_of(cases::friction_parameters(), one.friction) +
                     engine::text_line("area", friction::name(one.friction.area_of(one.contact))) +
                     text_of(cases::slide_parameters(), *study.slide);
  if (lubricant_density > 0) {
    body += engine::text_line("lubricant_density_kg_per_m2", lubricant_density) +
            text_of(cases::film_parameters(), one.film) + line_of_images(study);
    if (one.trapped.is_asked()) body += text_of(cases::trapped_parameters(), one.trapped);
  }
  return task_of(kSlideKind, "json", body);
}

engine::Task fluid_task(const Study& study, const engine::Task& contact, const engine::Task& film,
                        const Condition& condition) {
  const std::string body =
      engine::text_line("fluid_algorithms", kFluidAlgorithms) +
      engine::text_line("contact", contact.key) + engine::text_line("film", film.key) +
      engine::text_line("lubricant_density_kg_per_m2", study.lubricant_density(condition)) +
      text_of(cases::fluid_parameters(), study.fluid_settings(condition));
  return task_of("fluid", "h5", body);
}

engine::Task case_task(const Study& study, const Scan& scan,
                       const std::vector<engine::Task>& contacts, const engine::Task& film,
                       double lubricant_density, const std::vector<engine::Task>& trapped,
                       const engine::Task* fluid) {
  std::string trapped_lines;
  for (const engine::Task& oil : trapped) trapped_lines += engine::text_line("trapped", oil.key);
  std::string contact_lines;
  for (const engine::Task& contact : contacts) {
    contact_lines += engine::text_line("contact", contact.key);
  }
  return task_of(
      "case", "json",
      engine::text_line("scan", scan.label) + engine::text_line("group", scan.group) +
          contact_lines + engine::text_line("film", film.key) +
          engine::text_line("lubricant_density_kg_per_m2", lubricant_density) +
          text_of(cases::friction_parameters(), study.settings.friction) +
          engine::text_line(
              "area", friction::name(study.settings.friction.area_of(study.settings.contact))) +
          trapped_lines + (fluid != nullptr ? engine::text_line("fluid", fluid->key) : ""));
}

std::vector<ScanTasks> tasks_of(const Study& study, const Observer& observer) {
  std::vector<ScanTasks> all;
  for (const Scan& scan : study.scans) {
    ScanTasks tasks;
    const Study alone = study.of(scan);
    const std::string stage = stage_name("hash", scan);
    tasks.sha256 =
        io::sha256_of_file(scan.file, [&] { report_progress(observer, stage, std::nan("")); });
    tasks.surface = surface_task(alone, scan, tasks.sha256);
    tasks.film = film_task(alone, tasks.surface);
    for (const double pressure : alone.settings.mean_pressures) {
      add_pressure(alone, scan, pressure, tasks);
    }
    all.push_back(std::move(tasks));
  }
  return all;
}

std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure) {
  return mean_pressure > 0
             ? fmt::format("{} {} {}", what, scan.label, format_si(mean_pressure, "Pa"))
             : fmt::format("{} {}", what, scan.label);
}

}  // namespace tabor::study
