#include "tabor/study/record.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/sealed_file.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/slides.hpp"
#include "tabor/study/task_file.hpp"
#include "tabor/study/wet_shares.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::study {
namespace {

void write_spectrum(io::Hdf5Writer& writer, const std::string& axis, const std::string& density,
                    const metrology::Spectrum& spectrum) {
  const std::string q_path = "/psd/" + axis + "_q_rad_per_m";
  const std::string density_path = "/psd/" + axis + "_" + density;
  writer.write(q_path, spectrum.q);
  writer.describe(q_path, "rad/m", "wavevector 2 pi / lambda");
  writer.write(density_path, spectrum.density);
  writer.describe(density_path, spectrum.unit, "power spectral density");
  writer.attribute("/psd", "hurst_" + axis, spectrum.hurst.hurst);
}

double value_or_nan(const io::Json& value) {
  return value.is_null() ? kNoValue : value.get<double>();
}

std::string defect_of_json(const engine::Store& store, const engine::Task& task) {
  try {
    if (task.file.starts_with(kWetSharesKind)) return read_wet_shares(store, task), "";
    if (task.file.starts_with(kSlideKind)) return read_slide(store, task), "";
    return read_row(store, task).case_id == task.key ? "" : "belongs to another case";
  } catch (const InputError& error) {
    return error.what();
  }
}

SurfaceFacts facts_of_surface(const io::Hdf5Reader& reader) {
  const std::array<Index, 2> shape = reader.map_shape("/surface/height");
  const auto pixel = [&reader](const std::string& axis) {
    const std::vector<double> centres = reader.numbers("/surface/" + axis);
    if (centres.empty()) throw InputError("/surface/" + axis + " is empty");
    return 2 * centres.front();
  };
  return {.nx = shape[1],
          .ny = shape[0],
          .pixel_x = pixel("x"),
          .pixel_y = pixel("y"),
          .rms_height = reader.number("/psd", "rms_height_m"),
          .rms_slope = reader.number("/psd", "rms_slope"),
          .treatment = reader.attribute_texts("/surface", "treatment"),
          .warnings = reader.attribute_texts("/surface", "doubts")};
}

Field read_map(const engine::Store& store, const engine::Task& task, const std::string& path) {
  return read_task(store, task, [&](const io::Hdf5Reader& reader) { return reader.field(path); });
}

/// All but the maps, which are of one shape.
StoredContact contact_numbers(const io::Hdf5Reader& reader) {
  StoredContact stored;
  const std::array<Index, 2> shape = reader.map_shape("/contact/gap");
  if (reader.map_shape("/contact/state") != shape) {
    throw InputError("/contact/state and /contact/gap are of two shapes");
  }
  stored.grid = {shape[1], shape[0], reader.number("/contact", "size_x_m"),
                 reader.number("/contact", "size_y_m")};
  cases::ContactRecord& record = stored;
  io::read_attributes(reader, "/contact", cases::contact_columns(), record, cases::media::kStore);
  // A file without a place of a tool reads as one at no number.
  if (record.tool_place && std::isnan(record.tool_place->x)) record.tool_place.reset();
  if (reader.number("/contact", "converged") != 0) record.convergence.status = Status::converged;
  record.warnings = read_warnings(reader, "/contact");
  return stored;
}

}  // namespace

void write_row(const engine::Store& store, const engine::Task& task, const Row& row) {
  io::Json json;
  json["case_id"] = row.case_id;
  json["canonical_text"] = task.text;
  json["software_version"] = kVersion;
  json["scan"] = row.scan;
  json["group"] = row.group;
  json.update(io::json_of<cases::FrictionRecord>(cases::friction_columns(cases::parts_of(row)), row,
                                                 cases::media::kStore));
  json["warnings"] = io::Json::array();
  for (const Warning& warning : row.warnings) {
    json["warnings"].push_back(
        {{"code", warning.code}, {"text", warning.text}, {"weight", io::number(warning.weight)}});
  }
  json["error"] = row.error;
  io::write_file(store.path(task), io::to_text(io::sealed(std::move(json))) + "\n");
}

Row read_row(const engine::Store& store, const engine::Task& task) {
  const io::Json json = io::read_json(store.path(task));
  try {
    if (!io::is_sealed(json)) {
      throw InputError(store.path(task).string() + ": not the row that was written");
    }
    Row row;
    row.case_id = json.at("case_id").get<std::string>();
    row.scan = json.at("scan").get<std::string>();
    row.group = json.at("group").get<std::string>();
    io::read_json<cases::FrictionRecord>(
        json,
        cases::friction_columns({.trapped = json.contains("trapped_converged"),
                                 .fluid = json.contains("sliding_speed_m_per_s"),
                                 .tool = json.contains("tool_places")}),
        row, cases::media::kStore);
    for (const io::Json& warning : json.at("warnings")) {
      row.warnings.push_back({warning.at("code").get<std::string>(),
                              warning.at("text").get<std::string>(),
                              value_or_nan(warning.at("weight"))});
    }
    row.error = json.at("error").get<std::string>();
    return row;
  } catch (const io::Json::exception&) {
    throw InputError(store.path(task).string() + ": not a complete row");
  }
}

void write_surface(const engine::Store& store, const engine::Task& task,
                   const topography::Topography& topography,
                   const metrology::PowerSpectra& spectra) {
  io::Hdf5Writer writer = task_writer(store, task, "surface");
  topography::write_surface_group(writer, topography, topography.source, io::Precision::float32);
  write_spectrum(writer, "x", "c1d_m3", spectra.x);
  write_spectrum(writer, "y", "c1d_m3", spectra.y);
  write_spectrum(writer, "radial", "c2d_m4", spectra.radial);
  writer.attribute("/psd", "convention", std::string(name_of(spectra.convention)));
  writer.attribute("/psd", "window", std::string(name_of(spectra.window)));
  // Both measure the heights; the spectrum's own are those under its window.
  writer.attribute("/psd", "rms_height_m", metrology::rms_height(topography));
  writer.attribute("/psd", "rms_slope", numerics::rms_slope(topography.height, topography.grid));
  writer.commit();
}

void write_contact(const engine::Store& store, const engine::Task& task, const Grid& grid,
                   double saturation_pressure, const cases::ContactRecord& record) {
  io::Hdf5Writer writer = task_writer(store, task, "contact");
  writer.axes("/contact", grid);
  const std::string path = "/contact/state";
  writer.write(path, results::contact_map(record.state, saturation_pressure));
  writer.describe(path, "1", results::kContactMap);
  writer.attach_axes(path);
  write_map(writer, "/contact", {"gap", "m", "gap between the surfaces"}, record.state.gap);
  if (record.tool) {
    write_map(writer, "/contact", {"tool", "m", "heights of the tool, towards the surface"},
              *record.tool);
  }
  writer.nxdata("/contact", "state");
  io::write_attributes(writer, "/contact", cases::contact_columns(), record, cases::media::kStore);
  write_attributes(writer, "/contact", {{"size_x_m", grid.lx}, {"size_y_m", grid.ly}});
  write_warnings(writer, "/contact", record.warnings);
  writer.commit();
}

SurfaceFacts read_surface_facts(const engine::Store& store, const engine::Task& task) {
  return read_task(store, task, facts_of_surface);
}

cases::ContactRecord read_contact_record(const engine::Store& store, const engine::Task& task) {
  return read_task(store, task, contact_numbers);
}

Mask read_contact_mask(const engine::Store& store, const engine::Task& task) {
  return read_map(store, task, "/contact/state") > 0;
}

StoredContact read_contact(const engine::Store& store, const engine::Task& task) {
  StoredContact stored = read_task(store, task, contact_numbers);
  stored.contact = read_contact_mask(store, task);
  stored.gap = read_map(store, task, "/contact/gap");
  return stored;
}

FilmFile::FilmFile(const engine::Store& store, const engine::Task& task, const Grid& grid)
    : grid_(grid), writer_(task_writer(store, task, "films/0000")) {
  writer_.group("/films");
}

void FilmFile::add(const cases::FilmRecord& record) {
  const std::string group = film_group(record.film.request);
  writer_.axes(group, grid_);
  write_map(writer_, group, {"film_thickness", "m", "film thickness"}, record.film.thickness);
  writer_.nxdata(group, "film_thickness");
  io::write_attributes(writer_, group, cases::film_columns(), record, cases::media::kStore);
  write_warnings(writer_, group, record.warnings);
}

void FilmFile::commit() { writer_.commit(); }

Field read_film(const engine::Store& store, const engine::Task& task, std::size_t density) {
  return read_map(store, task, film_group(density) + "/film_thickness");
}

cases::FilmRecord read_film_record(const engine::Store& store, const engine::Task& task,
                                   std::size_t density) {
  const auto numbers = [density](const io::Hdf5Reader& reader) {
    cases::FilmRecord record;
    io::read_attributes(reader, film_group(density), cases::film_columns(), record,
                        cases::media::kStore);
    record.warnings = read_warnings(reader, film_group(density));
    return record;
  };
  cases::FilmRecord record = read_task(store, task, numbers);
  record.film.thickness = read_film(store, task, density);
  return record;
}

std::string defect(const engine::Store& store, const engine::Task& task) {
  if (task.file.ends_with(".json")) return defect_of_json(store, task);
  // Only a file that is to the last byte what was written is opened at all.
  std::string problem = io::broken_seal(store.path(task));
  if (!problem.empty()) return problem;
  try {
    const std::string text = read_task(store, task, [](const io::Hdf5Reader& reader) {
      return reader.text("/", "canonical_text");
    });
    return text == task.text ? "" : "belongs to another task";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string film_group(std::size_t density) { return fmt::format("/films/{:04}", density); }

}  // namespace tabor::study
