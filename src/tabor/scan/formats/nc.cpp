// NetCDF as SurfaceTopography and contact.engineering write it: a variable `heights` over the
// dimensions x and y, or x alone, or over points n at the positions x (SurfaceTopography,
// IO/NC.py). Classic files; those based on HDF5 are in nc_hdf5.cpp.
#include <fmt/format.h>

#include <cmath>

#include "tabor/core/units.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/scan/formats/nc_hdf5.hpp"
#include "tabor/scan/formats/netcdf.hpp"
#include "tabor/scan/formats/profile.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kHdf5{"\x89HDF\r\n\x1a\n", 8};

/// Bytes of a variable, and their layout as a map of `ny` rows.
struct Values {
  std::string_view bytes;
  Raster raster;
};

/// The values of a variable of one or two dimensions, all of which lie in the file.
Values values_of(const Contents& contents, const NetcdfVariable& variable) {
  const auto& dimensions = variable.dimensions;
  if (dimensions.empty() || dimensions.size() > 2) {
    reject(contents, fmt::format("'{}' of {} dimensions", variable.name, dimensions.size()),
           "one or two", "export one map");
  }
  const auto ny = static_cast<double>(dimensions.size() == 2 ? dimensions[0].length : 1);
  const auto nx = static_cast<double>(dimensions.back().length);
  Cursor cursor(contents);
  cursor.seek(variable.begin);
  check_size(contents, nx, ny, cursor.left() / size_of(variable.sample));
  const Raster raster{.sample = variable.sample,
                      .order = std::endian::big,
                      .nx = static_cast<Index>(nx),
                      .ny = static_cast<Index>(ny)};
  return {cursor.take(byte_size(raster)), raster};
}

/// Makes holes of the fill value, and applies the scale of packed values (NetCDF conventions).
RowStep unpacked(const NetcdfAttributes& attributes) {
  const double fill = number_of(attributes, "_FillValue").value_or(kHole);
  const double missing = number_of(attributes, "missing_value").value_or(kHole);
  const double scale = number_of(attributes, "scale_factor").value_or(1);
  const double offset = number_of(attributes, "add_offset").value_or(0);
  return [=](std::span<double> row) {
    for (double& z : row) z = z == fill || z == missing ? kHole : z * scale + offset;
  };
}

Field decoded(const Contents& contents, const Values& values, const RowStep& step = {}) {
  return decode(contents, values.bytes, values.raster, step);
}

std::vector<double> numbers_of(const Contents& contents, const NetcdfVariable& variable) {
  const Field row = decoded(contents, values_of(contents, variable), unpacked(variable.attributes));
  return {row.data(), row.data() + row.size()};
}

/// The variable of positions along a dimension.
NetcdfAxis axis_of(const NetcdfHeader& header, const std::string& name) {
  const NetcdfVariable* variable = header.variable(name);
  if (variable == nullptr) return {};
  return {.unit = text_of(variable->attributes, "unit"),
          .length = number_of(variable->attributes, "length"),
          .is_periodic = number_of(variable->attributes, "periodic").value_or(0) != 0};
}

Field load_map(const Contents& contents, const NetcdfVariable& heights, const NetcdfVariable* mask,
               bool is_transposed) {
  Field map = decoded(contents, values_of(contents, heights), unpacked(heights.attributes));
  if (mask != nullptr) {
    const Field is_hole = decoded(contents, values_of(contents, *mask));
    map = (is_hole != 0).select(kHole, map);
  }
  if (is_transposed) return map.transpose();
  return map;
}

bool has_same_shape(const NetcdfVariable& a, const NetcdfVariable& b) {
  return a.dimensions.size() == b.dimensions.size() &&
         std::equal(a.dimensions.begin(), a.dimensions.end(), b.dimensions.begin(),
                    [](const auto& one, const auto& other) { return one.length == other.length; });
}

Layer map_layer(const Contents& contents, const NetcdfHeader& header,
                const NetcdfVariable& heights) {
  const bool is_transposed =
      heights.dimensions.size() == 2 && heights.dimensions.front().name == "x";
  const Raster raster = values_of(contents, heights).raster;
  Layer layer{.nx = is_transposed ? raster.ny : raster.nx,
              .ny = is_transposed ? raster.nx : raster.ny};
  const NetcdfVariable* mask = header.variable("mask");
  if (mask != nullptr && !has_same_shape(*mask, heights)) {
    reject(contents, "a mask of another size", "one value per height", kDamaged);
  }
  if (mask != nullptr) values_of(contents, *mask);  // rejects what is not there
  layer.load = [contents, heights, is_transposed,
                mask = mask == nullptr ? std::optional<NetcdfVariable>() : *mask] {
    return load_map(contents, heights, mask ? &*mask : nullptr, is_transposed);
  };
  return layer;
}

Layer line_layer(const Contents& contents, const NetcdfHeader& header,
                 const NetcdfVariable& heights, Document& document) {
  const NetcdfVariable* positions = header.variable("x");
  if (heights.dimensions.front().name == "x" || positions == nullptr) {
    return map_layer(contents, header, heights);
  }
  return profile_layer(
      even_profile(contents, numbers_of(contents, *positions), numbers_of(contents, heights)),
      text_of(positions->attributes, "unit"), "", document);
}

Document open_classic(const Contents& contents) {
  const NetcdfHeader header = read_netcdf_header(contents);
  const NetcdfVariable* heights = header.variable("heights");
  if (heights == nullptr || heights->dimensions.empty()) {
    throw Unrecognised(contents, "a NetCDF file without 'heights'",
                       "tabor reads the NetCDF files of SurfaceTopography");
  }
  Document document{.format = "nc"};
  const bool is_line = heights->dimensions.size() == 1;
  Layer layer = is_line ? line_layer(contents, header, *heights, document)
                        : map_layer(contents, header, *heights);
  const NetcdfSurface surface{.x = axis_of(header, "x"),
                              .y = is_line ? std::nullopt : std::optional(axis_of(header, "y")),
                              .unit = text_of(heights->attributes, "unit"),
                              .json = text_of(header.attributes, "json")};
  complete(surface, layer, document);
  document.layers.push_back(std::move(layer));
  return document;
}

/// Remarks of others need not be JSON.
io::Json json_or_null(const std::string& text) {
  try {
    return io::parse_json(text);
  } catch (const InputError&) {
    return nullptr;
  }
}

std::string text_in(const io::Json& object, const std::string& key) {
  return object.contains(key) && object.at(key).is_string() ? object.at(key).get<std::string>()
                                                            : "";
}

/// What else the file says: one line of JSON.
void describe(const std::string& text, Document& document) {
  const io::Json remarks = text.empty() ? io::Json() : json_or_null(text);
  if (!remarks.is_object()) return;
  if (remarks.contains("instrument")) document.instrument = text_in(remarks["instrument"], "name");
  for (const auto& [key, value] : remarks.items()) {
    if (value.is_string()) document.metadata[key] = value.get<std::string>();
  }
  if (!remarks.contains("history") || !remarks["history"].is_array()) return;
  for (const io::Json& step : remarks["history"]) {
    if (step.is_string()) document.history.push_back(step.get<std::string>());
  }
}

}  // namespace

void complete(const NetcdfSurface& surface, Layer& layer, Document& document) {
  const auto pixel = [](const NetcdfAxis& axis, Index n) -> std::optional<double> {
    if (!axis.length || axis.unit.empty()) return std::nullopt;
    return *axis.length * unit_factor(axis.unit, dimension::length).value_or(kHole) /
           static_cast<double>(n);
  };
  const auto said = [](const char* name, const NetcdfAxis& axis) {
    return fmt::format("{}:length = {:g} {}", name, axis.length.value_or(kHole), axis.unit);
  };
  if (!layer.pixel_x) {
    layer.pixel_x = pixel(surface.x, layer.nx);
    layer.pixel_y = surface.y ? pixel(*surface.y, layer.ny) : layer.pixel_x;
    layer.said_x = said("x", surface.x);
    layer.said_y = surface.y ? said("y", *surface.y) : layer.said_x;
  }
  // SurfaceTopography has one unit for all; line scans name it at the positions only.
  layer.unit = surface.unit.empty() ? surface.x.unit : surface.unit;
  document.periodic = surface.x.is_periodic && (!surface.y || surface.y->is_periodic);
  describe(surface.json, document);
  const auto name = document.metadata.find("name");
  layer.name = name == document.metadata.end() ? "height" : name->second;
}

Match identify_nc(std::string_view head) {
  if (is_netcdf(head)) return Match::yes;
  return head.starts_with(kHdf5) ? Match::maybe : Match::no;
}

Document open_nc(const Contents& contents) {
  return is_netcdf(contents.bytes) ? open_classic(contents) : open_nc_hdf5(contents);
}

}  // namespace tabor::scan::format
