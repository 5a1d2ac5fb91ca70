#include "tabor/study/tables.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/study_keys.hpp"
#include "tabor/study/wet_shares.hpp"

namespace tabor::study {
namespace {

/// One line per warning.
std::string warning_texts(const Row& row) {
  std::string lines;
  for (const Warning& warning : row.warnings) {
    lines += (lines.empty() ? "" : "\n") + advised(warning.text, spelling());
  }
  return lines;
}

std::string warning_codes(const Row& row) { return results::codes_text(row.warnings); }

/// What is not in results.csv, so that it keeps its agreed columns, is in results.h5 alone. Columns
/// of a tool and of a film that flows come after the others, so that these stay where they are.
Columns<Row> row_columns(const cases::FrictionParts& parts) {
  constexpr ColumnStyle tabled{.media = cases::media::kTable};
  return joined<Row>(joined<Row>({{"case_id", "", "", &Row::case_id},
                                  {"scan", "", "", &Row::scan},
                                  {"group", "", "", &Row::group}},
                                 inherited<Row>(cases::friction_columns(parts))),
                     {{"error", "", "", &Row::error, tabled},
                      {"warnings", "", "", warning_texts, tabled},
                      {"warning_codes", "", "", warning_codes, tabled}});
}

void write_settings(io::Hdf5Writer& writer, const Study& study, const std::string& command) {
  write_root(writer, "scans/0000/surface");
  writer.attribute("/", "command", command);
  writer.attribute("/", "config_toml", to_toml(study));
  writer.attribute("/", "created",
                   fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  writer.attribute("/", "title", study.title);
  io::Json settings = io::Json::object();
  const io::Json in_force = results::settings_json(study.settings);
  for (const auto& [key, value] : in_force.items()) {
    if (key != "threads") settings[key] = value;  // of this run, not of the study
  }
  settings["boundary_shear_strength_Pa"] = study.settings.friction.boundary_strength();
  io::write_members(writer, "/", settings);
}

void write_surface_facts(io::Hdf5Writer& writer, const std::string& group,
                         const SurfaceFacts& facts) {
  writer.attribute(group, "nx", static_cast<std::int64_t>(facts.nx));
  writer.attribute(group, "ny", static_cast<std::int64_t>(facts.ny));
  writer.attribute(group, "pixel_x_m", facts.pixel_x);
  writer.attribute(group, "pixel_y_m", facts.pixel_y);
  writer.attribute(group, "rms_height_m", facts.rms_height);
  writer.attribute(group, "rms_slope", facts.rms_slope);
  writer.attribute(group, "treatment", facts.treatment);
  writer.attribute(group, "doubts", facts.warnings);
}

/// Links into the store, only to what is there.
void write_links(io::Hdf5Writer& writer, const std::string& group, const engine::Store& store,
                 const ScanTasks& tasks, std::size_t n_films) {
  const auto link = [&](const std::string& name, const engine::Task& task,
                        const std::string& target) {
    if (store.has(task)) writer.external_link(group + "/" + name, "store/" + task.file, target);
  };
  link("surface", tasks.surface, "/surface");
  link("psd", tasks.surface, "/psd");
  // Links the maps of the first place of a tool.
  const std::size_t n_pressures = tasks.cases.size();
  for (std::size_t i = 0; i < n_pressures; ++i) {
    link(fmt::format("contact/{:04}", i), tasks.contacts[i * tasks.contacts.size() / n_pressures],
         "/contact");
  }
  for (std::size_t i = 0; i < n_films; ++i) {
    link(fmt::format("films/{:04}", i), tasks.film, film_group(i));
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < n_pressures && !tasks.trapped.empty(); ++i) {
    for (const engine::Task& task : tasks.trapped[i * tasks.contacts.size() / n_pressures]) {
      link(fmt::format("trapped/{:04}", place++), task, "/trapped");
    }
  }
  place = 0;
  for (const std::vector<engine::Task>& fluids : tasks.fluids) {
    for (const engine::Task& task : fluids) {
      link(fmt::format("fluid/{:04}", place++), task, "/fluid");
    }
  }
}

/// What this scan was computed under, whether its own or the study's.
void write_scan_settings(io::Hdf5Writer& writer, const std::string& group, const Study& alone) {
  const bool saturates = alone.settings.contact.saturation_pressure.has_value();
  writer.attribute(
      group, "contact",
      std::string(kDeformations.of(saturates ? Deformation::saturated : Deformation::elastic)));
  const friction::Area area = alone.settings.friction.area_of(alone.settings.contact);
  writer.attribute(group, "area", std::string(friction::name(area)));
  writer.attribute(group, "reading", std::string(deposition::name(alone.settings.film.reading)));
}

void write_scans(io::Hdf5Writer& writer, const engine::Store& store, const Study& study,
                 const std::vector<ScanTasks>& tasks) {
  writer.group("/scans");
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::string group = fmt::format("/scans/{:04}", i);
    writer.group(group);
    writer.attribute(group, "file", study.scans[i].label);
    writer.attribute(group, "group", study.scans[i].group);
    writer.attribute(group, "input_sha256", tasks[i].sha256);
    const Study alone = study.of(study.scans[i]);
    write_scan_settings(writer, group, alone);
    if (store.has(tasks[i].surface) && defect(store, tasks[i].surface).empty()) {
      write_surface_facts(writer, group, read_surface_facts(store, tasks[i].surface));
    }
    write_links(writer, group, store, tasks[i], alone.settings.film.lubricant_densities.size());
  }
}

void write_experiment(io::Hdf5Writer& writer, const Experiment& experiment) {
  std::vector<double> density;
  for (const double value : experiment.lubricant_density) {
    density.push_back(std::isnan(value) ? value : in_g_per_m2(value));
  }
  writer.write("/experiment/mean_pressure_Pa", experiment.mean_pressure);
  writer.write("/experiment/friction", experiment.friction);
  writer.write("/experiment/error", experiment.error);
  writer.write("/experiment/lubricant_density_g_per_m2", density);
}

}  // namespace

std::vector<Row> rows_in(const engine::Store& store, const std::vector<ScanTasks>& tasks) {
  std::vector<Row> rows;
  for (const ScanTasks& scan : tasks) {
    for (const std::vector<engine::Task>& cases : scan.cases) {
      for (const engine::Task& task : cases) {
        if (store.has(task) && defect(store, task).empty()) rows.push_back(read_row(store, task));
      }
    }
  }
  return rows;
}

std::vector<results::Finding> findings_in(const std::vector<Row>& rows,
                                          const std::vector<results::Case>& of_slides) {
  std::vector<results::Case> cases;
  for (const Row& row : rows) {
    if (row.failed()) continue;
    cases.push_back(
        {.surface = row.scan,
         .pressure = format_si(row.mean_pressure, "Pa"),
         .density = fmt::format("{} g/m^2", in_g_per_m2(row.lubricant_density)),
         .speed = row.fluid ? format_si(row.fluid->sliding_speed, "m/s") : std::string(),
         .warnings = row.warnings});
  }
  for (const results::Case& slide : of_slides) {
    const auto pressed = std::find_if(cases.begin(), cases.end(), [&](const results::Case& one) {
      return one.surface == slide.surface && one.pressure == slide.pressure &&
             one.density == slide.density;
    });
    if (pressed == cases.end()) {
      cases.push_back(slide);
    } else {
      add(slide.warnings, pressed->warnings);
    }
  }
  results::shorten_paths(cases);
  std::vector<results::Finding> findings = results::findings_of(cases);
  results::spell(spelling(), findings);
  return findings;
}

std::string results_csv(const std::vector<Row>& rows, const cases::FrictionParts& parts) {
  return io::csv_of(row_columns(parts), rows, cases::media::kCsv);
}

std::string averages_csv(const std::vector<Average>& averages, const cases::FrictionParts& parts) {
  return io::csv_of(average_columns(parts), averages);
}

StudyTables tables_of(const engine::Store& store, const Study& study,
                      const std::vector<ScanTasks>& tasks) {
  StudyTables tables{.rows = rows_in(store, tasks),
                     .averages = {},
                     .curves = density_curves_in(store, study, tasks),
                     .averaged = {}};
  if (study.slide) tables.slides = slides_in(store, study, tasks);
  tables.averages = averages(tables.rows);
  tables.averaged = average_curves(tables.curves, tables.rows);
  return tables;
}

std::vector<std::string> failures_in(const std::vector<Row>& rows) {
  struct Failure {
    const Row& first;
    std::set<double> pressures;
  };
  std::map<std::string_view, std::set<double>> pressures_of_scan;
  std::vector<Failure> failures;
  for (const Row& row : rows) {
    pressures_of_scan[row.scan].insert(row.mean_pressure);
    if (!row.failed()) continue;
    const auto same = std::find_if(failures.begin(), failures.end(), [&](const Failure& one) {
      return one.first.scan == row.scan && one.first.error == row.error;
    });
    if (same != failures.end()) {
      same->pressures.insert(row.mean_pressure);
    } else {
      failures.push_back({row, {row.mean_pressure}});
    }
  }
  std::vector<std::string> lines;
  lines.reserve(failures.size());
  for (const auto& [first, pressures] : failures) {
    const std::string in_file = first.scan + ": ";
    const std::string why =
        first.error.starts_with(in_file) ? first.error.substr(in_file.size()) : first.error;
    std::vector<std::string> some;
    if (pressures.size() < pressures_of_scan[first.scan].size()) {
      for (const double pressure : pressures) some.push_back(format_si(pressure, "Pa"));
    }
    const std::string under = some.empty() ? "" : fmt::format(" under {}", fmt::join(some, ", "));
    lines.push_back(fmt::format("{}{}: {}", first.scan, under, why));
  }
  return lines;
}

Remarks remarks_in(const std::filesystem::path& results) {
  return io::read_guarded(results, [](const io::Hdf5Reader& reader) {
    Remarks remarks;
    if (reader.has_attribute("/", "warnings")) {
      remarks.warnings = reader.attribute_texts("/", "warnings");
    }
    const std::vector<std::string> scans = reader.texts("/table/scan");
    const std::vector<std::string> errors = reader.texts("/table/error");
    const std::vector<double> pressures = reader.numbers("/table/mean_pressure_Pa");
    const std::size_t n = std::min({scans.size(), errors.size(), pressures.size()});
    std::vector<Row> rows(n);
    for (std::size_t i = 0; i < n; ++i) {
      rows[i].scan = scans[i];
      rows[i].error = errors[i];
      rows[i].mean_pressure = pressures[i];
    }
    remarks.failures = failures_in(rows);
    return remarks;
  });
}

void write_tables(const engine::Store& store, const Study& study,
                  const std::vector<ScanTasks>& tasks, const StudyTables& tables,
                  const std::string& command) {
  const cases::FrictionParts parts = cases::parts_of(study.settings);
  const std::vector<Row>& rows = tables.rows;
  const std::vector<Average>& means = tables.averages;
  io::write_file(store.directory() / "results.csv", results_csv(rows, parts));
  io::write_file(store.directory() / "averages.csv", averages_csv(means, parts));
  if (!tables.curves.empty()) {
    io::write_file(store.directory() / "density_curves.csv",
                   io::csv_of(curve_columns(), points_of(tables.curves)));
  }
  if (study.slide) {
    io::write_file(store.directory() / "slides.csv",
                   io::csv_of(slide_row_columns(study), tables.slides.rows));
  }
  io::Hdf5Writer writer(store.directory() / "results.h5");
  write_settings(writer, study, command);
  writer.attribute("/", "n_cases", static_cast<std::int64_t>(study.n_cases()));
  writer.attribute("/", "n_cases_done", static_cast<std::int64_t>(rows.size()));
  std::vector<results::Finding> findings(tables.warnings.size());
  for (std::size_t i = 0; i < tables.warnings.size(); ++i) findings[i].text = tables.warnings[i];
  const std::vector<results::Finding> of_rows = findings_in(rows, tables.slides.warnings);
  findings.insert(findings.end(), of_rows.begin(), of_rows.end());
  results::write_warnings(writer, findings);
  io::write_datasets(writer, "/table", row_columns(parts), rows, cases::media::kTable);
  io::write_datasets(writer, "/averages", average_columns(parts), means);
  if (!tables.slides.rows.empty()) {
    io::write_datasets(writer, "/slides", slide_row_columns(study), tables.slides.rows);
  }
  if (!tables.curves.empty()) {
    io::write_datasets(writer, "/density_curves", curve_columns(), points_of(tables.curves));
    io::write_datasets(writer, "/density_averages", average_curve_columns(),
                       points_of(tables.averaged));
    io::write_datasets(writer, "/density_plateaus", plateau_columns(), tables.averaged);
    io::write_datasets(writer, "/density_places", place_columns(), places_of(tables.averaged));
    std::vector<std::string> answers;
    for (const GroupCurve& curve : tables.averaged) answers.push_back(answer_of(curve));
    writer.attribute("/", "answers", answers);
  }
  write_scans(writer, store, study, tasks);
  if (study.experiment) write_experiment(writer, *study.experiment);
  writer.commit();
}

}  // namespace tabor::study
