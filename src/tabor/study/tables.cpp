#include "tabor/study/tables.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <ctime>
#include <functional>
#include <optional>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/csv.hpp"

namespace tabor::study {
namespace {

/// A column of a table: either numbers or text. Both files are written from one list of these.
template <typename Entry>
struct Column {
  std::string name;
  std::function<double(const Entry&)> number;
  std::function<std::string(const Entry&)> text = nullptr;
};

const std::vector<Column<Row>>& contact_columns() {
  static const std::vector<Column<Row>> columns{
      {"case_id", nullptr, [](const Row& row) { return row.case_id; }},
      {"scan", nullptr, [](const Row& row) { return row.scan; }},
      {"group", nullptr, [](const Row& row) { return row.group; }},
      {"mean_pressure_Pa", [](const Row& row) { return row.mean_pressure; }},
      {"lubricant_density_g_per_m2",
       [](const Row& row) { return in_g_per_m2(row.lubricant_density); }},
      {"contact_area_fraction", [](const Row& row) { return row.contact_area_fraction; }},
      {"contact_area_fraction_pixels",
       [](const Row& row) { return row.contact_area_fraction_pixels; }},
      {"saturated_area_fraction", [](const Row& row) { return row.saturated_area_fraction; }},
      {"mean_gap_m", [](const Row& row) { return row.mean_gap; }},
      {"lubricated_share", [](const Row& row) { return row.lubricated_share; }},
      {"spill_over_fraction", [](const Row& row) { return row.spill_over_fraction; }},
      {"friction_dry", [](const Row& row) { return row.friction_dry; }},
      {"friction_lubricated", [](const Row& row) { return row.friction_lubricated; }},
      {"certificate", [](const Row& row) { return row.certificate; }},
      {"converged", nullptr, [](const Row& row) { return row.converged ? "true" : "false"; }}};
  return columns;
}

/// Those of a film that flows come after the others, so that these stay where they are.
std::vector<Column<Row>> row_columns(bool oil_flows) {
  std::vector<Column<Row>> columns = contact_columns();
  if (!oil_flows) return columns;
  for (const auto& [name, member] : kFluidColumns) {
    columns.push_back({name, [value = member](const Row& row) {
                         return row.fluid ? (*row.fluid).*value : kNoValue;
                       }});
  }
  columns.push_back({"fluid_converged", nullptr, [](const Row& row) {
                       return row.fluid && row.fluid->converged ? "true" : "false";
                     }});
  return columns;
}

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

/// Only in results.h5, so that results.csv keeps its agreed columns.
const std::vector<Column<Row>>& further_columns() {
  static const std::vector<Column<Row>> columns{
      {"trapped_fraction", [](const Row& row) { return row.trapped_fraction; }},
      {"escaping_fraction", [](const Row& row) { return row.escaping_fraction; }},
      {"error", nullptr, [](const Row& row) { return row.error; }},
      {"warnings", nullptr, warning_texts},
      {"warning_codes", nullptr, warning_codes}};
  return columns;
}

template <typename MeanOf>
void add_mean(std::vector<Column<Average>>& columns, const std::string& name,
              const MeanOf& mean_of) {
  columns.push_back({name + "_mean", [mean_of](const Average& a) { return mean_of(a).mean; }});
  columns.push_back(
      {name + "_std", [mean_of](const Average& a) { return mean_of(a).standard_deviation; }});
  columns.push_back(
      {name + "_sem", [mean_of](const Average& a) { return mean_of(a).standard_error; }});
}

std::vector<Column<Average>> average_columns(bool oil_flows) {
  std::vector<Column<Average>> made{
      {"group", nullptr, [](const Average& a) { return a.group; }},
      {"mean_pressure_Pa", [](const Average& a) { return a.mean_pressure; }},
      {"lubricant_density_g_per_m2",
       [](const Average& a) { return in_g_per_m2(a.lubricant_density); }},
      {"n", [](const Average& a) { return static_cast<double>(a.n); }}};
  add_mean(made, "friction_dry", [](const Average& a) { return a.friction_dry; });
  add_mean(made, "friction_lubricated", [](const Average& a) { return a.friction_lubricated; });
  if (!oil_flows) return made;
  made.push_back({"sliding_speed_m_per_s",
                  [](const Average& a) { return a.fluid.value_or(FluidAverage{}).sliding_speed; }});
  const auto of_fluid = [](Mean FluidAverage::*mean) {
    return [mean](const Average& a) { return a.fluid.value_or(FluidAverage{}).*mean; };
  };
  add_mean(made, "fluid_load_share", of_fluid(&FluidAverage::load_share));
  add_mean(made, "friction_viscous", of_fluid(&FluidAverage::friction_viscous));
  add_mean(made, "friction_mixed", of_fluid(&FluidAverage::friction_mixed));
  return made;
}

template <typename Entry>
std::string to_csv(const std::vector<Column<Entry>>& columns, const std::vector<Entry>& entries) {
  std::vector<std::string> cells;
  cells.reserve(columns.size());
  for (const Column<Entry>& column : columns) {
    cells.push_back(column.name);
  }
  std::string csv = io::csv_line(cells);
  for (const Entry& entry : entries) {
    cells.clear();
    for (const Column<Entry>& column : columns) {
      cells.push_back(column.text ? column.text(entry) : io::csv_number(column.number(entry)));
    }
    csv += io::csv_line(cells);
  }
  return csv;
}

template <typename Entry>
void write_columns(io::Hdf5Writer& writer, const std::string& group,
                   const std::vector<Column<Entry>>& columns, const std::vector<Entry>& entries) {
  for (const Column<Entry>& column : columns) {
    const std::string path = group + "/" + column.name;
    if (column.name == "n" || column.name.ends_with("converged")) {
      std::vector<std::int64_t> values;
      values.reserve(entries.size());
      for (const Entry& entry : entries) {
        values.push_back(column.text ? column.text(entry) == "true"
                                     : std::lround(column.number(entry)));
      }
      writer.write(path, values);
    } else if (column.text) {
      std::vector<std::string> values;
      values.reserve(entries.size());
      for (const Entry& entry : entries) {
        values.push_back(column.text(entry));
      }
      writer.write(path, values);
    } else {
      std::vector<double> values;
      values.reserve(entries.size());
      for (const Entry& entry : entries) {
        values.push_back(column.number(entry));
      }
      writer.write(path, values);
    }
  }
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
  write_root(writer, "scans/0000/surface");
  writer.attribute("/", "command", command);
  writer.attribute("/", "config_toml", to_toml(study));
  writer.attribute("/", "created",
                   fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  writer.attribute("/", "title", study.title);
  writer.attribute("/", "shear_strength_Pa", study.shear_strength);
  writer.attribute("/", "youngs_modulus_Pa", study.solid.youngs_modulus);
  writer.attribute("/", "poissons_ratio", study.solid.poissons_ratio);
  writer.attribute("/", "effective_modulus_Pa", study.effective_modulus());
  if (std::isfinite(study.saturation_pressure)) {
    writer.attribute("/", "saturation_pressure_Pa", study.saturation_pressure);
  }
  writer.attribute("/", "oil_density_kg_per_m3", study.lubricant.oil_density);
  writer.attribute("/", "area", std::string(friction::name(study.area)));
  if (study.flows()) write_oil(writer, *study.lubricant.flowing);
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
  writer.attribute(group, "doubts", facts.doubts);
}

/// Links into the store, only to what is there.
void write_links(io::Hdf5Writer& writer, const std::string& group, const Store& store,
                 const ScanUnits& units, std::size_t n_films) {
  const auto link = [&](const std::string& name, const Unit& unit, const std::string& target) {
    if (store.has(unit)) {
      writer.external_link(group + "/" + name, "store/" + unit.file, target);
    }
  };
  link("surface", units.surface, "/surface");
  link("psd", units.surface, "/psd");
  for (std::size_t i = 0; i < units.contacts.size(); ++i) {
    link(fmt::format("contact/{:04}", i), units.contacts[i], "/contact");
  }
  for (std::size_t i = 0; i < n_films; ++i) {
    link(fmt::format("films/{:04}", i), units.film, film_group(i));
  }
  std::size_t place = 0;
  for (const std::vector<Unit>& fluids : units.fluids) {
    for (const Unit& unit : fluids) link(fmt::format("fluid/{:04}", place++), unit, "/fluid");
  }
}

void write_scans(io::Hdf5Writer& writer, const Store& store, const Study& study,
                 const std::vector<ScanUnits>& units) {
  writer.group("/scans");
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string group = fmt::format("/scans/{:04}", i);
    writer.group(group);
    writer.attribute(group, "file", study.scans[i].label);
    writer.attribute(group, "group", study.scans[i].group);
    writer.attribute(group, "input_sha256", units[i].sha256);
    if (store.has(units[i].surface) && defect(store, units[i].surface).empty()) {
      write_surface_facts(writer, group, read_surface_facts(store, units[i].surface));
    }
    write_links(writer, group, store, units[i], study.lubricant_densities.size());
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

std::vector<Row> rows_in(const Store& store, const std::vector<ScanUnits>& units) {
  std::vector<Row> rows;
  for (const ScanUnits& scan : units) {
    for (const std::vector<Unit>& cases : scan.cases) {
      for (const Unit& unit : cases) {
        if (store.has(unit) && defect(store, unit).empty()) {
          rows.push_back(read_row(store, unit));
        }
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
  return to_csv(row_columns(oil_flows), rows);
}

std::string averages_csv(const std::vector<Average>& averages, bool oil_flows) {
  return to_csv(average_columns(oil_flows), averages);
}

void write_tables(const Store& store, const Study& study, const std::vector<ScanUnits>& units,
                  const std::vector<Row>& rows, const std::string& command) {
  const std::vector<Average> means = averages(rows);
  io::write_file(store.directory() / "results.csv", results_csv(rows, study.flows()));
  io::write_file(store.directory() / "averages.csv", averages_csv(means, study.flows()));
  io::Hdf5Writer writer(store.directory() / "results.h5");
  write_settings(writer, study, command);
  writer.attribute("/", "n_cases", static_cast<std::int64_t>(study.n_cases()));
  writer.attribute("/", "n_cases_done", static_cast<std::int64_t>(rows.size()));
  std::vector<std::string> lines;
  for (const analysis::Finding& finding : findings_in(rows)) {
    lines.push_back(analysis::line_of(finding));
  }
  writer.attribute("/", "warnings", lines);
  write_columns(writer, "/table", row_columns(study.flows()), rows);
  write_columns(writer, "/table", further_columns(), rows);
  write_columns(writer, "/averages", average_columns(study.flows()), means);
  write_scans(writer, store, study, units);
  if (study.experiment) {
    write_experiment(writer, *study.experiment);
  }
  writer.commit();
}

}  // namespace tabor::study
