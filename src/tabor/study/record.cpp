#include "tabor/study/record.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/json.hpp"
#include "tabor/io/sealed_file.hpp"
#include "tabor/study/unit_file.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::study {
namespace {

/// Columns of a row that are plain numbers, with their names in the file.
struct Member {
  const char* name;
  double Row::*value;
};
constexpr Member kMembers[] = {
    {"mean_pressure_Pa", &Row::mean_pressure},
    {"lubricant_density_kg_per_m2", &Row::lubricant_density},
    {"contact_area_fraction", &Row::contact_area_fraction},
    {"contact_area_fraction_pixels", &Row::contact_area_fraction_pixels},
    {"saturated_area_fraction", &Row::saturated_area_fraction},
    {"mean_gap_m", &Row::mean_gap},
    {"lubricated_share", &Row::lubricated_share},
    {"spill_over_fraction", &Row::spill_over_fraction},
    {"trapped_fraction", &Row::trapped_fraction},
    {"escaping_fraction", &Row::escaping_fraction},
    {"friction_dry", &Row::friction_dry},
    {"friction_lubricated", &Row::friction_lubricated},
    {"certificate", &Row::certificate},
};

io::ByteMap contact_states(const contact::State& state, double saturation_pressure) {
  return (state.pressure > 0).cast<std::uint8_t>() +
         contact::saturated_mask(state, saturation_pressure).cast<std::uint8_t>();
}

void write_spectrum(io::Hdf5Writer& writer, const std::string& axis, const std::string& density,
                    const topography::Spectrum& spectrum) {
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

std::string defect_of_row(const Store& store, const Unit& unit) {
  try {
    return read_row(store, unit).case_id == unit.key ? "" : "belongs to another case";
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
          .doubts = reader.attribute_texts("/surface", "doubts")};
}

/// All but the maps, which are of one shape.
StoredContact contact_numbers(const io::Hdf5Reader& reader) {
  const auto scalar = [&reader](const char* name) { return reader.number("/contact", name); };
  StoredContact stored;
  const std::array<Index, 2> shape = reader.map_shape("/contact/gap");
  if (reader.map_shape("/contact/state") != shape) {
    throw InputError("/contact/state and /contact/gap are of two shapes");
  }
  stored.grid = {shape[1], shape[0], scalar("size_x_m"), scalar("size_y_m")};
  stored.summary.mean_pressure = scalar("mean_pressure_Pa");
  stored.summary.contact_area_fraction = scalar("contact_area_fraction");
  stored.summary.contact_area_fraction_pixels = scalar("contact_area_fraction_pixels");
  stored.summary.saturated_area_fraction = scalar("saturated_area_fraction");
  stored.summary.mean_gap = scalar("mean_gap_m");
  stored.convergence.certificate = scalar("certificate");
  stored.convergence.converged = scalar("converged") != 0;
  stored.warnings = read_warnings(reader, "/contact");
  return stored;
}

}  // namespace

void write_row(const Store& store, const Unit& unit, const Row& row) {
  io::Json json;
  json["case_id"] = row.case_id;
  json["canonical_text"] = unit.text;
  json["software_version"] = kVersion;
  json["scan"] = row.scan;
  json["group"] = row.group;
  for (const Member& member : kMembers) {
    json[member.name] = io::number(row.*member.value);
  }
  json["converged"] = row.converged;
  if (row.fluid) {
    for (const auto& [name, value] : kFluidColumns) {
      json[name] = io::number((*row.fluid).*value);
    }
    json["fluid_converged"] = row.fluid->converged;
  }
  json["warnings"] = io::Json::array();
  for (const analysis::Warning& warning : row.warnings) {
    json["warnings"].push_back(
        {{"code", warning.code}, {"text", warning.text}, {"weight", io::number(warning.weight)}});
  }
  json["error"] = row.error;
  io::write_file(store.path(unit), io::to_text(io::sealed(std::move(json))) + "\n");
}

Row read_row(const Store& store, const Unit& unit) {
  const io::Json json = io::read_json(store.path(unit));
  try {
    if (!io::is_sealed(json)) {
      throw InputError(store.path(unit).string() + ": not the row that was written");
    }
    Row row;
    row.case_id = json.at("case_id").get<std::string>();
    row.scan = json.at("scan").get<std::string>();
    row.group = json.at("group").get<std::string>();
    for (const Member& member : kMembers) {
      row.*member.value = value_or_nan(json.at(member.name));
    }
    if (json.contains("sliding_speed_m_per_s")) {
      row.fluid.emplace();
      for (const auto& [name, value] : kFluidColumns) {
        (*row.fluid).*value = value_or_nan(json.at(name));
      }
      row.fluid->converged = json.at("fluid_converged").get<bool>();
    }
    for (const io::Json& warning : json.at("warnings")) {
      row.warnings.push_back({warning.at("code").get<std::string>(),
                              warning.at("text").get<std::string>(),
                              value_or_nan(warning.at("weight"))});
    }
    row.converged = json.at("converged").get<bool>();
    row.error = json.at("error").get<std::string>();
    return row;
  } catch (const io::Json::exception&) {
    throw InputError(store.path(unit).string() + ": not a complete row");
  }
}

Scalars scalars_of(const contact::Summary& summary, const Convergence& convergence) {
  return {{"mean_pressure_Pa", summary.mean_pressure},
          {"contact_area_fraction", summary.contact_area_fraction},
          {"contact_area_fraction_pixels", summary.contact_area_fraction_pixels},
          {"saturated_area_fraction", summary.saturated_area_fraction},
          {"mean_gap_m", summary.mean_gap},
          {"separation_m", summary.separation},
          {"max_pressure_Pa", summary.max_pressure},
          {"elastic_energy_J_per_m2", summary.elastic_energy},
          {"n_patches", static_cast<double>(summary.n_patches)},
          {"perimeter_m", summary.perimeter},
          {"certificate", convergence.certificate},
          {"contact_gap_error_m", summary.contact_gap_error},
          {"tolerance", convergence.tolerance},
          {"converged", convergence.converged ? 1.0 : 0.0},
          {"iterations", static_cast<double>(convergence.iterations)},
          {"operator_applications", static_cast<double>(convergence.operator_applications)}};
}

Scalars scalars_of(const lubrication::Film& film, double lubricant_density) {
  return {{"lubricant_density_g_per_m2", in_g_per_m2(lubricant_density)},
          {"mean_film_m", film.mean_film},
          {"n_droplets", static_cast<double>(film.n_droplets)},
          {"wet_fraction", film.wet_fraction},
          {"max_film_m", film.max_film},
          {"deposited_volume_m3", film.deposited_volume},
          {"lost_volume_m3", film.lost_volume},
          {"n_pools", static_cast<double>(film.n_pools)},
          {"seconds", film.seconds},
          {"peak_memory_bytes", static_cast<double>(peak_memory_bytes())}};
}

void write_surface(const Store& store, const Unit& unit, const topography::Topography& topography,
                   const topography::PowerSpectra& spectra) {
  io::Hdf5Writer writer = unit_writer(store, unit, "surface");
  topography::write_surface_group(writer, topography, topography.source, io::Precision::float32);
  write_spectrum(writer, "x", "c1d_m3", spectra.x);
  write_spectrum(writer, "y", "c1d_m3", spectra.y);
  write_spectrum(writer, "radial", "c2d_m4", spectra.radial);
  writer.attribute("/psd", "convention", std::string(name_of(spectra.convention)));
  writer.attribute("/psd", "window", std::string(name_of(spectra.window)));
  writer.attribute("/psd", "rms_height_m", spectra.rms_height);
  writer.attribute("/psd", "rms_slope", spectra.rms_slope);
  writer.commit();
}

void write_contact(const Store& store, const Unit& unit, const Grid& grid,
                   const contact::Problem& problem, const contact::State& state,
                   const contact::Summary& summary, const Cost& cost,
                   const analysis::Warnings& warnings) {
  io::Hdf5Writer writer = unit_writer(store, unit, "contact");
  writer.axes("/contact", grid);
  const std::string path = "/contact/state";
  writer.write(path, contact_states(state, problem.saturation_pressure));
  writer.describe(path, "1", "0 no contact, 1 contact below saturation, 2 saturated");
  writer.attach_axes(path);
  write_map(writer, "/contact", {"gap", "m", "gap between the surfaces"}, state.gap);
  writer.nxdata("/contact", "state");
  write_attributes(writer, "/contact", scalars_of(summary, state.convergence));
  write_attributes(writer, "/contact",
                   {{"size_x_m", grid.lx},
                    {"size_y_m", grid.ly},
                    {"fft_seconds", cost.fft_seconds},
                    {"seconds", cost.seconds},
                    {"peak_memory_bytes", static_cast<double>(peak_memory_bytes())}});
  write_warnings(writer, "/contact", warnings);
  writer.commit();
}

SurfaceFacts read_surface_facts(const Store& store, const Unit& unit) {
  return io::read_guarded(store.path(unit), facts_of_surface);
}

StoredContact read_contact(const Store& store, const Unit& unit) {
  StoredContact stored = io::read_guarded(store.path(unit), contact_numbers);
  stored.contact = io::read_guarded_map(store.path(unit), "/contact/state") > 0;
  stored.gap = io::read_guarded_map(store.path(unit), "/contact/gap");
  return stored;
}

FilmFile::FilmFile(const Store& store, const Unit& unit, const Grid& grid)
    : grid_(grid), writer_(unit_writer(store, unit, "films/0000")) {
  writer_.group("/films");
}

void FilmFile::add(const lubrication::Film& film, double lubricant_density,
                   const analysis::Warnings& warnings) {
  const std::string group = film_group(film.request);
  writer_.axes(group, grid_);
  write_map(writer_, group, {"film_thickness", "m", "film thickness"}, film.thickness);
  writer_.nxdata(group, "film_thickness");
  write_attributes(writer_, group, scalars_of(film, lubricant_density));
  write_warnings(writer_, group, warnings);
}

void FilmFile::commit() { writer_.commit(); }

Field read_film(const Store& store, const Unit& unit, std::size_t density) {
  return io::read_guarded_map(store.path(unit), film_group(density) + "/film_thickness");
}

analysis::Warnings read_film_warnings(const Store& store, const Unit& unit, std::size_t density) {
  return io::read_guarded(store.path(unit), [density](const io::Hdf5Reader& reader) {
    return read_warnings(reader, film_group(density));
  });
}

std::string defect(const Store& store, const Unit& unit) {
  if (unit.file.ends_with(".json")) return defect_of_row(store, unit);
  // Only a file that is to the last byte what was written is opened at all.
  std::string problem = io::broken_seal(store.path(unit));
  if (!problem.empty()) return problem;
  try {
    const std::string text = io::read_guarded(store.path(unit), [](const io::Hdf5Reader& reader) {
      return reader.text("/", "canonical_text");
    });
    return text == unit.text ? "" : "belongs to another unit";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string film_group(std::size_t density) { return fmt::format("/films/{:04}", density); }

}  // namespace tabor::study
