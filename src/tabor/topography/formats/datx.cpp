// DATX, HDF5 files of Zygo's Mx software: /MetaData names the dataset of the surface, whose
// attributes hold units and scales.
#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/topography/formats/bytes.hpp"
#include "tabor/topography/formats/readers.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography::format {
namespace {

constexpr const char* kMetaData = "/MetaData";

/// Where the link of this name leads from `source`; "" if there is none. The table's columns are
/// source, link, destination.
std::string destination(const std::vector<io::Hdf5Record>& table, const std::string& source,
                        const std::string& link) {
  for (const io::Hdf5Record& row : table) {
    if (row.texts.size() == 3 && row.texts[0] == source && row.texts[1] == link) {
      return row.texts[2];
    }
  }
  return "";
}

/// The path of the height map inside the file.
std::string surface_path(const Contents& contents, const std::vector<io::Hdf5Record>& table) {
  std::string place = "Root";
  for (const char* link : {"Measurement", "Surface", "Path"}) {
    place = destination(table, place, link);
    if (place.empty()) {
      refuse(contents, fmt::format("no {} in its table of contents", link), "a Zygo height map",
             kDamaged);
    }
  }
  return place.starts_with('/') ? place : "/" + place;
}

/// Metres per pixel: the second number of the converter.
std::optional<double> pixel(const Contents& contents, const io::Hdf5Reader& reader,
                            const std::string& path, const std::string& converter) {
  if (!reader.has_attribute(path, converter)) return std::nullopt;
  const auto records = reader.attribute_records(path, converter);
  if (records.size() != 1 || records[0].numbers.size() < 2) return std::nullopt;
  // A measurement without lateral calibration says 0.
  const double metres = records[0].numbers[1];
  return metres == 0 ? std::nullopt : std::optional(checked_pixel(contents, metres));
}

/// Zygo writes the names of units in full.
std::string unit_of(const io::Hdf5Reader& reader, const std::string& path) {
  static constexpr std::pair<const char*, const char*> names[]{
      {"nanometers", "nm"}, {"micrometers", "um"}, {"millimeters", "mm"}, {"meters", "m"}};
  if (!reader.has_attribute(path, "Unit")) return "";
  const std::vector<std::string> texts = reader.attribute_texts(path, "Unit");
  if (texts.size() != 1) return "";
  for (const auto& [name, symbol] : names) {
    if (lower(texts.front()) == name) return symbol;
  }
  return texts.front();
}

Field height_of(const Contents& contents, const std::string& path, double no_data) {
  const io::Hdf5Reader reader(contents.file);
  Field height = reader.field(path, [&contents](double share) { contents.finished({}, share); });
  for_each_row(height.rows(), [&](Index y) {
    for (Index x = 0; x < height.cols(); ++x) {
      if (height(y, x) == no_data) height(y, x) = kHole;
    }
  });
  return height;
}

Document describe(const Contents& contents) {
  const io::Hdf5Reader reader(contents.file);
  if (!reader.exists(kMetaData)) {
    throw Unrecognised(contents, "an HDF5 file without /MetaData (so not Zygo's DATX)",
                       "tabor reads the HDF5 files it writes and Zygo's");
  }
  const std::string path = surface_path(contents, reader.records(kMetaData));
  const std::vector<Index> shape = reader.shape(path);
  if (shape.size() != 2 || shape[0] < 1 || shape[1] < 1) {
    refuse(contents, "heights that are no map", "two dimensions", kDamaged);
  }
  const double no_data =
      reader.has_attribute(path, "No Data") ? reader.number(path, "No Data") : kHole;
  Document document{.format = "datx", .instrument = "Zygo"};
  document.layers.push_back(
      {.name = "Surface",
       .unit = unit_of(reader, path),
       .nx = shape[1],
       .ny = shape[0],
       .pixel_x = pixel(contents, reader, path, "X Converter"),
       .pixel_y = pixel(contents, reader, path, "Y Converter"),
       .load = [contents, path, no_data] { return height_of(contents, path, no_data); }});
  return document;
}

}  // namespace

Match identify_datx(std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n") ? Match::maybe : Match::no;
}

Document open_datx(const Contents& contents) {
  if (!io::hdf5_survives([&] { describe(contents); })) {
    refuse(contents, "an HDF5 file whose tables are damaged", "a scan", kDamaged);
  }
  return describe(contents);
}

}  // namespace tabor::topography::format
