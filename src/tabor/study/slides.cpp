#include "tabor/study/slides.hpp"

#include <fmt/format.h>

#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/sealed_file.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/record.hpp"

namespace tabor::study {
namespace {

Columns<cases::SlideRecord> state_columns(bool is_trapped) {
  return cases::slide_columns({.trapped = is_trapped});
}

/// Calls look(scan, study of it alone, task, pressure, density) for every slide.
template <typename Look>
void for_each_slide(const Study& study, const std::vector<ScanTasks>& tasks, const Look& look) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Study alone = study.of(study.scans[i]);
    for (std::size_t p = 0; p < tasks[i].slides.size(); ++p) {
      for (std::size_t d = 0; d < tasks[i].slides[p].size(); ++d) {
        look(study.scans[i], tasks[i].slides[p][d], alone.settings.mean_pressures[p],
             alone.settings.film.lubricant_densities[d]);
      }
    }
  }
}

}  // namespace

Columns<SlideRow> slide_row_columns(const Study& study) {
  const cases::SlideParts parts = cases::parts_of(study.settings, *study.slide);
  const Columns<SlideRow> before{
      {"scan", "", "scan", &SlideRow::scan},
      {"group", "", "group", &SlideRow::group},
      {"lubricant_density_g_per_m2",
       "g/m²",
       "lubricant",
       [](const SlideRow& row) { return in_g_per_m2(row.lubricant_density); },
       {.shown = Shown::unscaled}}};
  return joined<SlideRow>(before, within(cases::slide_columns(parts), &SlideRow::state));
}

void write_slide(const engine::Store& store, const engine::Task& task, const StoredSlide& slide) {
  const bool is_trapped = !slide.states.empty() && slide.states.front().trapped.has_value();
  io::Json states = io::Json::array();
  for (const cases::SlideRecord& one : slide.states) {
    states.push_back(io::json_of(state_columns(is_trapped), one));
  }
  io::Json warnings = io::Json::array();
  for (const Warning& one : slide.warnings) {
    warnings.push_back({{"code", one.code}, {"text", one.text}, {"weight", one.weight}});
  }
  io::Json json = {{"canonical_text", task.text},  {"error", slide.error},
                   {"converged", slide.converged}, {"trapped", is_trapped},
                   {"states", std::move(states)},  {"warnings", std::move(warnings)}};
  io::write_file(store.path(task), io::to_text(io::sealed(std::move(json))) + "\n");
}

StoredSlide read_slide(const engine::Store& store, const engine::Task& task) {
  const io::Json json = io::read_json(store.path(task));
  const std::string name = store.path(task).string();
  try {
    if (!io::is_sealed(json)) throw InputError(name + ": not the slide that was written");
    if (json.at("canonical_text").get<std::string>() != task.text) {
      throw InputError(name + ": belongs to another slide");
    }
    StoredSlide slide;
    slide.error = json.at("error").get<std::string>();
    slide.converged = json.at("converged").get<bool>();
    const Columns<cases::SlideRecord> columns = state_columns(json.at("trapped").get<bool>());
    for (const io::Json& state : json.at("states")) {
      io::read_json(state, columns, slide.states.emplace_back());
    }
    for (const io::Json& one : json.at("warnings")) {
      slide.warnings.push_back({one.at("code").get<std::string>(),
                                one.at("text").get<std::string>(), one.at("weight").get<double>()});
    }
    return slide;
  } catch (const io::Json::exception&) {
    throw InputError(name + ": not complete");
  }
}

StoredSlide compute_slide(const engine::Store& store, const engine::Task& task, const Study& study,
                          const topography::Topography& surface, double mean_pressure,
                          double lubricant_density, const Observer& observer) {
  cases::SlideRun run;
  run.checkpoint = store.path(task);
  run.checkpoint.replace_extension("run");
  cases::SlideResult result = cases::slide(
      surface, study.slide_settings(mean_pressure, lubricant_density), *study.slide, run, observer);
  return {.states = std::move(result.states),
          .warnings = std::move(result.warnings),
          .converged = result.converged};
}

StudySlides slides_in(const engine::Store& store, const Study& study,
                      const std::vector<ScanTasks>& tasks) {
  StudySlides found;
  for_each_slide(study, tasks,
                 [&](const Scan& scan, const engine::Task& task, double pressure, double density) {
                   if (!store.has(task) || !defect(store, task).empty()) return;
                   const StoredSlide slide = read_slide(store, task);
                   if (!slide.error.empty()) {
                     found.failures.push_back(
                         fmt::format("{} {} {}: {}", scan.label, format_si(pressure, "Pa"),
                                     results::density_text(density), slide.error));
                     return;
                   }
                   for (const cases::SlideRecord& state : slide.states) {
                     found.rows.push_back({scan.label, scan.group, density, state});
                   }
                   found.warnings.push_back({.surface = scan.label,
                                             .pressure = format_si(pressure, "Pa"),
                                             .density = results::density_text(density),
                                             .warnings = slide.warnings});
                 });
  return found;
}

}  // namespace tabor::study
