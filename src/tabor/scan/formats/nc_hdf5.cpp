// NetCDF files that are based on HDF5, with the same names as the classic ones of nc.cpp.
#include "tabor/scan/formats/nc_hdf5.hpp"

#include <algorithm>
#include <memory>

#include "tabor/scan/formats/hdf5_scan.hpp"
#include "tabor/scan/formats/profile.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kHeights = "/heights";

std::string text_of(const io::Hdf5Reader& reader, const std::string& path,
                    const std::string& name) {
  return reader.has_attribute(path, name) ? reader.text(path, name) : "";
}

std::optional<double> number_of(const io::Hdf5Reader& reader, const std::string& path,
                                const std::string& name) {
  if (!reader.has_attribute(path, name)) return std::nullopt;
  return reader.number(path, name);
}

NetcdfAxis axis_of(const io::Hdf5Reader& reader, const std::string& path) {
  if (!reader.exists(path)) return {};
  return {.unit = text_of(reader, path, "unit"),
          .length = number_of(reader, path, "length"),
          .is_periodic = number_of(reader, path, "periodic").value_or(0) != 0};
}

/// Sends the heights with holes where the file marks them.
void send_heights(const std::filesystem::path& file,
                  const std::function<void(const Field& rows)>& send) {
  const io::Hdf5Reader reader(file);
  const double fill = number_of(reader, kHeights, "_FillValue").value_or(kHole);
  Field mask;
  if (reader.exists("/mask")) mask = reader.field("/mask");
  reader.for_rows(kHeights, [&](Index first, const Field& rows) {
    Field heights = (rows == fill).select(kHole, rows);
    if (first + rows.rows() <= mask.rows() && rows.cols() == mask.cols()) {
      heights = (mask.middleRows(first, rows.rows()) != 0).select(kHole, heights);
    }
    send(heights);
  });
}

/// Files of SurfaceTopography have x first; those of others may not.
bool is_x_first(const io::Hdf5Reader& reader, std::array<Index, 2> shape) {
  const bool has_axes = reader.exists("/x") && reader.exists("/y");
  if (!has_axes) return true;
  return reader.shape("/x") == std::vector<Index>{shape[0]} ||
         reader.shape("/y") != std::vector<Index>{shape[0]};
}

Layer map_layer(const Contents& contents, const io::Hdf5Reader& reader) {
  const std::array<Index, 2> shape = reader.map_shape(kHeights);
  const bool is_transposed = is_x_first(reader, shape);
  Layer layer{.nx = is_transposed ? shape[0] : shape[1], .ny = is_transposed ? shape[1] : shape[0]};
  layer.load = [contents, shape, is_transposed]() -> Field {
    Field map = guarded_heights(contents, shape,
                                [&](const auto& send) { send_heights(contents.file, send); });
    if (is_transposed) return map.transpose();
    return map;
  };
  return layer;
}

Layer line_layer(const Contents& contents, const io::Hdf5Reader& reader, Document& document) {
  const std::vector<double> heights = reader.numbers(kHeights);
  const bool is_even = number_of(reader, "/x", "length").has_value();
  if (!is_even) {
    return profile_layer(even_profile(contents, reader.numbers("/x"), heights),
                         text_of(reader, "/x", "unit"), "", document);
  }
  const auto row = std::make_shared<const Field>(
      Eigen::Map<const Field>(heights.data(), 1, static_cast<Index>(heights.size())));
  return {.nx = row->cols(), .ny = 1, .load = [row] { return *row; }};
}

Document describe(const Contents& contents) {
  const io::Hdf5Reader reader(contents.file);
  if (!reader.exists(kHeights) || !reader.is_dataset(kHeights) || !reader.exists("/x")) {
    throw Unrecognised(contents, "an HDF5 file without /heights (so not NetCDF)",
                       "tabor reads the HDF5 files it writes, Zygo's and NetCDF");
  }
  const std::size_t n_dimensions = reader.shape(kHeights).size();
  const bool is_line = n_dimensions == 1;
  Document document{.format = "nc"};
  Layer layer = is_line ? line_layer(contents, reader, document) : map_layer(contents, reader);
  complete({.x = axis_of(reader, "/x"),
            .y = is_line ? std::nullopt : std::optional(axis_of(reader, "/y")),
            .unit = text_of(reader, kHeights, "unit"),
            .json = text_of(reader, "/", "json")},
           layer, document);
  document.layers.push_back(std::move(layer));
  return document;
}

}  // namespace

Document open_nc_hdf5(const Contents& contents) {
  require_survival(contents, [&] { describe(contents); });
  return describe(contents);
}

}  // namespace tabor::scan::format
