#include "tabor/study/tables.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <ctime>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/study/wet_shares.hpp"

namespace tabor::study {
namespace {

/// One line per warning.
std::string warning_texts(const Row& row) {
  std::string lines;
  for (const analysis::Warning& warning : row.warnings) {
    lines += (lines.empty() ? "" : "\n") + warning.text;
  }
  return lines;
}

std::string warning_codes(const Row& row) {
  return fmt::format("{}", fmt::join(analysis::codes_of(row.warnings), " "));
}

/// What is not in results.csv, so that it keeps its agreed columns, is in results.h5 alone. Columns
/// of a film that flows come after the others, so that these stay where they are.
Columns<Row> row_columns(bool oil_flows) {
  constexpr ColumnStyle tabled{.media = analysis::media::kTable};
  return joined<Row>(joined<Row>({{"case_id", "", "", &Row::case_id},
                                  {"scan", "", "", &Row::scan},
                                  {"group", "", "", &Row::group}},
                                 inherited<Row>(analysis::friction_columns(oil_flows))),
                     {{"error", "", "", &Row::error, tabled},
                      {"warnings", "", "", warning_texts, tabled},
                      {"warning_codes", "", "", warning_codes, tabled}});
}

void write_oil(io::Hdf5Writer& writer, const friction::FlowingOil& oil) {
  writer.attribute("/", "fluid", "reynolds");
  writer.attribute("/", "viscosity_Pa_s", oil.viscosity);
  if (oil.pressure_viscosity) {
    writer.attribute("/", "pressure_viscosity_per_Pa", *oil.pressure_viscosity);
  }
  if (oil.eyring_stress) writer.attribute("/", "eyring_stress_Pa", *oil.eyring_stress);
}

void write_settings(io::Hdf5Writer& writer, const Study& study, const std::string& command) {
  const analysis::ContactSettings& contact = study.settings.contact;
  write_root(writer, "scans/0000/surface");
  writer.attribute("/", "command", command);
  writer.attribute("/", "config_toml", to_toml(study));
  writer.attribute("/", "created",
                   fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  writer.attribute("/", "title", study.title);
  writer.attribute("/", "shear_strength_Pa", study.settings.friction.shear_strength);
  writer.attribute("/", "boundary_shear_strength_Pa", study.settings.friction.boundary_strength());
  writer.attribute("/", "youngs_modulus_Pa", contact.youngs_modulus);
  writer.attribute("/", "poissons_ratio", contact.poissons_ratio);
  writer.attribute("/", "effective_modulus_Pa", contact.effective_modulus());
  if (contact.saturation_pressure) {
    writer.attribute("/", "saturation_pressure_Pa", *contact.saturation_pressure);
  }
  writer.attribute("/", "oil_density_kg_per_m3", study.settings.film.oil_density);
  writer.attribute("/", "area",
                   std::string(friction::name(study.settings.friction.area_of(contact))));
  if (study.flows()) write_oil(writer, study.settings.fluid.oil());
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
void write_links(io::Hdf5Writer& writer, const std::string& group, const Store& store,
                 const ScanTasks& tasks, std::size_t n_films) {
  const auto link = [&](const std::string& name, const Task& task, const std::string& target) {
    if (store.has(task)) writer.external_link(group + "/" + name, "store/" + task.file, target);
  };
  link("surface", tasks.surface, "/surface");
  link("psd", tasks.surface, "/psd");
  for (std::size_t i = 0; i < tasks.contacts.size(); ++i) {
    link(fmt::format("contact/{:04}", i), tasks.contacts[i], "/contact");
  }
  for (std::size_t i = 0; i < n_films; ++i) {
    link(fmt::format("films/{:04}", i), tasks.film, film_group(i));
  }
  std::size_t place = 0;
  for (const std::vector<Task>& fluids : tasks.fluids) {
    for (const Task& task : fluids) link(fmt::format("fluid/{:04}", place++), task, "/fluid");
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

void write_scans(io::Hdf5Writer& writer, const Store& store, const Study& study,
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

std::vector<Row> rows_in(const Store& store, const std::vector<ScanTasks>& tasks) {
  std::vector<Row> rows;
  for (const ScanTasks& scan : tasks) {
    for (const std::vector<Task>& cases : scan.cases) {
      for (const Task& task : cases) {
        if (store.has(task) && defect(store, task).empty()) rows.push_back(read_row(store, task));
      }
    }
  }
  return rows;
}

std::vector<analysis::Finding> findings_in(const std::vector<Row>& rows) {
  std::vector<analysis::Case> cases;
  for (const Row& row : rows) {
    if (row.failed()) continue;
    cases.push_back(
        {.surface = row.scan,
         .pressure = format_si(row.mean_pressure, "Pa"),
         .density = fmt::format("{} g/m^2", in_g_per_m2(row.lubricant_density)),
         .speed = row.fluid ? format_si(row.fluid->sliding_speed, "m/s") : std::string(),
         .warnings = row.warnings});
  }
  return analysis::findings_of(cases);
}

std::string results_csv(const std::vector<Row>& rows, bool oil_flows) {
  return io::csv_of(row_columns(oil_flows), rows, analysis::media::kCsv);
}

std::string averages_csv(const std::vector<Average>& averages, bool oil_flows) {
  return io::csv_of(average_columns(oil_flows), averages);
}

StudyTables tables_of(const Store& store, const Study& study, const std::vector<ScanTasks>& tasks) {
  StudyTables tables{.rows = rows_in(store, tasks),
                     .averages = {},
                     .curves = density_curves_in(store, study, tasks),
                     .averaged = {}};
  tables.averages = averages(tables.rows);
  tables.averaged = average_curves(study, tables.curves);
  return tables;
}

void write_tables(const Store& store, const Study& study, const std::vector<ScanTasks>& tasks,
                  const StudyTables& tables, const std::string& command) {
  const std::vector<Row>& rows = tables.rows;
  const std::vector<Average>& means = tables.averages;
  io::write_file(store.directory() / "results.csv", results_csv(rows, study.flows()));
  io::write_file(store.directory() / "averages.csv", averages_csv(means, study.flows()));
  if (!tables.curves.empty()) {
    io::write_file(store.directory() / "density_curves.csv",
                   io::csv_of(curve_columns(), points_of(tables.curves)));
  }
  io::Hdf5Writer writer(store.directory() / "results.h5");
  write_settings(writer, study, command);
  writer.attribute("/", "n_cases", static_cast<std::int64_t>(study.n_cases()));
  writer.attribute("/", "n_cases_done", static_cast<std::int64_t>(rows.size()));
  std::vector<std::string> lines;
  for (const analysis::Finding& finding : findings_in(rows)) {
    lines.push_back(analysis::line_of(finding));
  }
  writer.attribute("/", "warnings", lines);
  io::write_datasets(writer, "/table", row_columns(study.flows()), rows, analysis::media::kTable);
  io::write_datasets(writer, "/averages", average_columns(study.flows()), means);
  if (!tables.curves.empty()) {
    io::write_datasets(writer, "/density_curves", curve_columns(), points_of(tables.curves));
    io::write_datasets(writer, "/density_averages", average_curve_columns(),
                       points_of(tables.averaged));
    std::vector<std::string> answers;
    for (const GroupCurve& curve : tables.averaged) answers.push_back(answer_of(curve));
    writer.attribute("/", "answers", answers);
  }
  write_scans(writer, store, study, tasks);
  if (study.experiment) write_experiment(writer, *study.experiment);
  writer.commit();
}

}  // namespace tabor::study
