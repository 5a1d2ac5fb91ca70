// tabor's own HDF5 files (docs/results.md): the group /surface.
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "tabor/core/text.hpp"
#include "tabor/core/version.hpp"
#include "tabor/topography/formats/hdf5_scan.hpp"
#include "tabor/topography/formats/readers.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::topography::format {
namespace {

constexpr const char* kHeight = "/surface/height";
constexpr std::string_view kSignature{"\x89HDF\r\n\x1a\n", 8};

std::string text_or_empty(const io::Hdf5Reader& reader, const std::string& name) {
  return reader.has_attribute("/surface", name) ? reader.text("/surface", name) : "";
}

std::vector<std::string> texts_or_none(const io::Hdf5Reader& reader, const std::string& name) {
  if (!reader.has_attribute("/surface", name)) return {};
  return reader.attribute_texts("/surface", name);
}

/// Pixel pitch from the coordinates of the pixel centres; a single pixel's centre is half of it.
double pitch(const Contents& contents, const std::vector<double>& centres) {
  const std::size_t n = centres.size();
  const double pixel =
      n > 1 ? (centres.back() - centres.front()) / static_cast<double>(n - 1) : 2 * centres.front();
  return checked_pixel(contents, pixel);
}

double pixel(const Contents& contents, const io::Hdf5Reader& reader, const std::string& axis) {
  const std::string attribute = "pixel_" + axis + "_m";
  if (reader.has_attribute("/surface", attribute)) {
    return checked_pixel(contents, reader.number("/surface", attribute));
  }
  return pitch(contents, reader.numbers("/surface/" + axis));
}

/// Sends the heights, NaN where the mask is set.
void send_heights(const std::filesystem::path& file,
                  const std::function<void(const Field& rows)>& send) {
  const io::Hdf5Reader reader(file);
  const auto [ny, nx] = reader.map_shape(kHeight);
  io::ByteMap mask;
  if (reader.exists("/surface/mask")) mask = reader.bytes("/surface/mask");
  const bool is_masked = mask.rows() == ny && mask.cols() == nx;
  reader.for_rows(kHeight, [&](Index first, const Field& rows) {
    if (!is_masked) return send(rows);
    send((mask.middleRows(first, rows.rows()) != 0).select(kHole, rows));
  });
}

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Document describe(const Contents& contents) {
  const io::Hdf5Reader reader(contents.file);
  if (!reader.exists(kHeight)) {
    throw Unrecognised(contents, "an HDF5 file without /surface/height",
                       "tabor reads the HDF5 files it writes");
  }
  const std::array<Index, 2> shape = reader.map_shape(kHeight);
  Document document{.format = "h5",
                    .instrument = text_or_empty(reader, "instrument"),
                    .history = texts_or_none(reader, "treatment")};
  document.periodic =
      reader.has_attribute("/surface", "periodic") && reader.integer("/surface", "periodic") != 0;
  document.metadata["source"] = text_or_empty(reader, "source");
  if (reader.has_attribute("/", "methods")) {
    document.metadata["methods"] =
        fmt::format("{}", fmt::join(reader.attribute_texts("/", "methods"), " "));
  }
  // Doubts are found anew in the heights; the old ones may have been treated away since.
  for (const std::string& doubt : texts_or_none(reader, "doubts")) {
    document.metadata["earlier doubts"] += doubt + "; ";
  }
  document.layers.push_back({.name = "height",
                             .unit = "m",
                             .nx = shape[1],
                             .ny = shape[0],
                             .pixel_x = pixel(contents, reader, "x"),
                             .pixel_y = pixel(contents, reader, "y"),
                             .load = [contents, shape] {
                               return heights_from_copy(contents, shape, [&](const auto& send) {
                                 send_heights(contents.file, send);
                               });
                             }});
  return document;
}

}  // namespace

Match identify_h5(std::string_view head) {
  return head.starts_with(kSignature) ? Match::maybe : Match::no;
}

Document open_h5(const Contents& contents) {
  require_survival(contents, [&] { describe(contents); });
  return describe(contents);
}

void write_h5(const Topography& topography, const std::filesystem::path& file) {
  io::Hdf5Writer writer(file);
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", 1);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "created", now_utc());
  writer.attribute("/", "default", "surface");
  if (const auto methods = topography.metadata.find("methods");
      methods != topography.metadata.end() && !methods->second.empty()) {
    writer.attribute("/", "methods", split(methods->second, ' '));
  }
  write_surface_group(writer, topography, topography.source);
  writer.commit();
}

}  // namespace tabor::topography::format
