// tabor's own HDF5 files (docs/results.md): the group /surface.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/version.hpp"
#include "tabor/scan/formats/hdf5_scan.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kHeight = "/surface/height";
constexpr const char* kMask = "/surface/mask";
constexpr std::string_view kSignature{"\x89HDF\r\n\x1a\n", 8};

std::string text_or_empty(const io::Hdf5Reader& reader, const std::string& name) {
  return reader.has_attribute("/surface", name) ? reader.text("/surface", name) : "";
}

std::vector<std::string> texts_or_none(const io::Hdf5Reader& reader, const std::string& name) {
  if (!reader.has_attribute("/surface", name)) return {};
  return reader.attribute_texts("/surface", name);
}

/// What tabor writes is in metres and says so; others may have added their own.
std::string unit_of(const io::Hdf5Reader& reader, const std::string& path) {
  return reader.has_attribute(path, "units") ? reader.text(path, "units") : "m";
}

/// Pixel pitch [m] from the coordinates of the n pixel centres; a single pixel's centre is half of
/// it.
double pitch(const Contents& contents, const io::Hdf5Reader& reader, const std::string& path,
             Index n) {
  const std::vector<double> centres = reader.numbers(path);
  if (std::ssize(centres) != n) {
    reject(contents, fmt::format("{} places in {}", centres.size(), path),
           fmt::format("{}, as the map has", n), kDamaged);
  }
  const std::string unit = unit_of(reader, path);
  const auto factor = unit_factor(unit, dimension::length);
  if (!factor) reject(contents, fmt::format("{} in '{}'", path, unit), "a unit of length");
  const double step =
      n > 1 ? (centres.back() - centres.front()) / static_cast<double>(n - 1) : 2 * centres.front();
  if (!(step > 0)) return step * *factor;  // no pixel, however even
  for (std::size_t i = 0; i < centres.size(); ++i) {
    constexpr double most_off = 0.01;  // pixels; coordinates may be stored as float32
    const double even = centres.front() + static_cast<double>(i) * step;
    if (!(std::abs(centres[i] - even) <= most_off * std::abs(step))) {
      reject(contents, "uneven places in " + path, "evenly spaced rows and columns",
             "resample it first");
    }
  }
  return step * *factor;
}

double pixel(const Contents& contents, const io::Hdf5Reader& reader, const std::string& axis,
             Index n) {
  const std::string attribute = "pixel_" + axis + "_m", path = "/surface/" + axis;
  if (!reader.has_attribute("/surface", attribute)) return pitch(contents, reader, path, n);
  const double stated = reader.number("/surface", attribute);
  constexpr double same = 1e-3;
  if (is_pixel(stated) && reader.exists(path) && n > 1 &&
      std::abs(pitch(contents, reader, path, n) - stated) > same * stated) {
    reject(contents, fmt::format("{} = {} m, but other steps in {}", attribute, stated, path),
           "one pixel size", kDamaged);
  }
  return stated;
}

/// Where the pixel stands.
std::string said(const io::Hdf5Reader& reader, const std::string& axis) {
  const std::string attribute = "pixel_" + axis + "_m";
  return reader.has_attribute("/surface", attribute) ? attribute : "the steps of /surface/" + axis;
}

void require_known_version(const Contents& contents, const io::Hdf5Reader& reader) {
  constexpr std::int64_t newest = kFormatVersion;
  if (!reader.has_attribute("/", "format_version")) return;
  const std::int64_t version = reader.integer("/", "format_version");
  if (version > newest) {
    reject(contents, fmt::format("format_version {}", version), fmt::format("at most {}", newest),
           "read it with the tabor that wrote it");
  }
}

void require_mask_of_map(const Contents& contents, const io::Hdf5Reader& reader,
                         const std::array<Index, 2>& shape) {
  if (!reader.exists(kMask)) return;
  const std::vector<Index> mask = reader.shape(kMask);
  if (mask != std::vector<Index>(shape.begin(), shape.end())) {
    reject(contents, fmt::format("{} of shape {}", kMask, fmt::join(mask, " x ")),
           fmt::format("{} as the map", fmt::join(shape, " x ")), kDamaged);
  }
}

/// Sends the heights, NaN where the mask is set.
void send_heights(const std::filesystem::path& file,
                  const std::function<void(const Field& rows)>& send) {
  const io::Hdf5Reader reader(file);
  const bool is_masked = reader.exists(kMask);
  io::ByteMap mask;
  if (is_masked) mask = reader.bytes(kMask);
  reader.for_rows(kHeight, [&](Index first, const Field& rows) {
    if (!is_masked) return send(rows);
    send((mask.middleRows(first, rows.rows()) != 0).select(kHole, rows));
  });
}

std::optional<topography::Edges> edges(const Contents& contents, const io::Hdf5Reader& reader) {
  const std::string said = text_or_empty(reader, "edges");
  if (said.empty()) return std::nullopt;
  const auto known = topography::kEdges.find(said);
  if (known) return known;
  reject(contents, fmt::format("edges = '{}' of /surface", said),
         fmt::format("{}", fmt::join(topography::kEdges.all(), ", ")), kDamaged);
}

/// Copies of the scan along each side.
double tiles(const Contents& contents, const io::Hdf5Reader& reader,
             const std::array<Index, 2>& shape) {
  if (!reader.has_attribute("/surface", "tiles")) return 1;
  const double n = reader.number("/surface", "tiles");
  const auto most = static_cast<double>(std::max(shape[0], shape[1]));
  if (n >= 1 && n <= most) return n;
  reject(contents, fmt::format("tiles = {} of /surface", n), fmt::format("from 1 to {}", most),
         kDamaged);
}

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// Warnings are found anew in the heights; the old ones may have been treated away since. But
/// heights that were invented cannot be told from others any more.
void add_warnings(const io::Hdf5Reader& reader, Document& document) {
  const std::vector<std::string> warnings = texts_or_none(reader, "doubts");
  std::vector<std::string> codes = texts_or_none(reader, "doubt_codes");
  codes.resize(warnings.size());
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    if (codes[i] == "filled-holes") {
      document.lasting.push_back({.code = codes[i], .text = warnings[i]});
    } else {
      document.metadata["earlier warnings"] += warnings[i] + "; ";
    }
  }
}

/// Throws InputError for a file that tabor has written without a surface.
void reject_results(const Contents& contents, const io::Hdf5Reader& reader) {
  if (!reader.has_attribute("/", "format") || reader.text("/", "format") != "tabor") return;
  const std::string kind =
      reader.has_attribute("/", "kind") ? " (" + reader.text("/", "kind") + ")" : "";
  reject(contents, "results of tabor" + kind, "a scan file",
         "'tabor report' draws them, tb.load() of Python reads them");
}

Document describe(const Contents& contents) {
  const io::Hdf5Reader reader(contents.file);
  if (!reader.exists(kHeight)) {
    reject_results(contents, reader);
    throw Unrecognised(contents, "an HDF5 file without /surface/height",
                       "tabor reads the HDF5 files it writes, Zygo's and NetCDF");
  }
  require_known_version(contents, reader);
  const std::array<Index, 2> shape = reader.map_shape(kHeight);
  require_mask_of_map(contents, reader, shape);
  Document document{.format = "h5",
                    .instrument = text_or_empty(reader, "instrument"),
                    .history = texts_or_none(reader, "treatment")};
  document.periodic =
      reader.has_attribute("/surface", "periodic") && reader.integer("/surface", "periodic") != 0;
  document.edges = edges(contents, reader);
  document.tiles = tiles(contents, reader, shape);
  document.metadata["source"] = text_or_empty(reader, "source");
  if (reader.has_attribute("/", "methods")) {
    document.metadata["methods"] =
        fmt::format("{}", fmt::join(reader.attribute_texts("/", "methods"), " "));
  }
  add_warnings(reader, document);
  document.layers.push_back({.name = "height",
                             .unit = unit_of(reader, kHeight),
                             .nx = shape[1],
                             .ny = shape[0],
                             .pixel_x = pixel(contents, reader, "x", shape[1]),
                             .pixel_y = pixel(contents, reader, "y", shape[0]),
                             .said_x = said(reader, "x"),
                             .said_y = said(reader, "y"),
                             .load = [contents, shape] {
                               return guarded_heights(contents, shape, [&](const auto& send) {
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

void write_h5(const topography::Topography& topography, const std::filesystem::path& file) {
  io::Hdf5Writer writer(file);
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", kFormatVersion);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "created", now_utc());
  writer.attribute("/", "default", "surface");
  if (const auto methods = topography.metadata.find("methods");
      methods != topography.metadata.end() && !methods->second.empty()) {
    writer.attribute("/", "methods", split(methods->second, ' '));
  }
  topography::write_surface_group(writer, topography, topography.source);
  writer.commit();
}

}  // namespace tabor::scan::format
