// DATX, HDF5 files of Zygo's Mx software: /MetaData names the dataset of the surface, whose
// attributes hold units and scales.
#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/hdf5_scan.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
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
      reject(contents, fmt::format("no {} in its table of contents", link), "a Zygo height map",
             kDamaged);
    }
  }
  return place.starts_with('/') ? place : "/" + place;
}

/// Metres per pixel: the second number of the converter.
std::optional<double> pixel(const io::Hdf5Reader& reader, const std::string& path,
                            const std::string& converter) {
  if (!reader.has_attribute(path, converter)) return std::nullopt;
  const auto records = reader.attribute_records(path, converter);
  if (records.size() != 1 || records[0].numbers.size() < 2) return std::nullopt;
  // A measurement without lateral calibration says 0.
  const double metres = records[0].numbers[1];
  return metres == 0 ? std::nullopt : std::optional(metres);
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

/// Sends the heights with holes where the file has no value.
void send_heights(const std::filesystem::path& file, const std::string& path, double no_data,
                  const std::function<void(const Field& rows)>& send) {
  io::Hdf5Reader(file).for_rows(
      path, [&](Index, const Field& rows) { send((rows == no_data).select(kHole, rows)); });
}

Document describe(const Contents& contents) {
  const io::Hdf5Reader reader(contents.file);
  if (!reader.exists(kMetaData)) {
    throw Unrecognised(contents, "an HDF5 file without /MetaData (so not Zygo's DATX)",
                       "tabor reads the HDF5 files it writes, Zygo's and NetCDF");
  }
  const std::string path = surface_path(contents, reader.records(kMetaData));
  const std::array<Index, 2> shape = reader.map_shape(path);
  const double no_data =
      reader.has_attribute(path, "No Data") ? reader.number(path, "No Data") : kHole;
  Document document{.format = "datx", .instrument = "Zygo"};
  document.layers.push_back({.name = "Surface",
                             .unit = unit_of(reader, path),
                             .nx = shape[1],
                             .ny = shape[0],
                             .pixel_x = pixel(reader, path, "X Converter"),
                             .pixel_y = pixel(reader, path, "Y Converter"),
                             .said_x = "X Converter",
                             .said_y = "Y Converter",
                             .load = [contents, shape, path, no_data] {
                               return guarded_heights(contents, shape, [&](const auto& send) {
                                 send_heights(contents.file, path, no_data, send);
                               });
                             }});
  return document;
}

}  // namespace

Match identify_datx(std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n") ? Match::maybe : Match::no;
}

Document open_datx(const Contents& contents) {
  require_survival(contents, [&] { describe(contents); });
  return describe(contents);
}

}  // namespace tabor::scan::format
