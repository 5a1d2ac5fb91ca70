// GWY, Gwyddion's native format: channels "/N/data" with masks "/N/mask" in one container.
#include <fmt/format.h>

#include <cmath>

#include "tabor/core/rows.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/gwy_object.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic = "GWYP";
constexpr const char* kInstrument = "Instrument";
constexpr const char* kSource = "Source";

std::string unit_of(const GwyObject& field, const std::string& which) {
  const GwyObject* unit = field.object(which, "GwySIUnit");
  return unit == nullptr ? "" : unit->text("unitstr");
}

/// Raw float64 bytes of a data field of the given size.
std::string_view data_of(const Contents& contents, const GwyObject& field, Index nx, Index ny) {
  const auto data = field.items.find("data");
  const std::size_t expected = static_cast<std::size_t>(nx * ny) * sizeof(double);
  if (data == field.items.end() || data->second.type != 'D' ||
      data->second.array.size() != expected || field.number("xres", 0) != static_cast<double>(nx) ||
      field.number("yres", 0) != static_cast<double>(ny)) {
    reject(contents, "a data field without its data", fmt::format("{} x {} numbers", nx, ny),
           kDamaged);
  }
  return data->second.array;
}

std::optional<double> pixel(const GwyObject& field, const std::string& real, Index n) {
  const auto factor = unit_factor(unit_of(field, "si_unit_xy"), dimension::length);
  if (!factor || field.items.count(real) == 0) return std::nullopt;
  return field.number(real, 0) * *factor / static_cast<double>(n);
}

std::string said(const GwyObject& field, const std::string& real) {
  return fmt::format("{} {:g} {}", real, field.number(real, 0), unit_of(field, "si_unit_xy"));
}

/// What Gwyddion shows under a mask is interpolated: those pixels are holes.
Field masked(const Contents& contents, std::string_view data, std::string_view mask,
             const Raster& raster) {
  Field heights = decode(contents, data, raster);
  if (mask.empty()) return heights;
  const auto pitch = static_cast<std::size_t>(raster.nx) * sizeof(double);
  for_each_row(raster.ny, [&](Index y) {
    const char* row = mask.data() + static_cast<std::size_t>(y) * pitch;
    for (Index x = 0; x < raster.nx; ++x) {
      double value;
      std::memcpy(&value, row + static_cast<std::size_t>(x) * sizeof value, sizeof value);
      if (value > 0.5) heights(y, x) = kHole;
    }
  });
  contents.finished(mask, 1);
  return heights;
}

Layer layer_of(const Contents& contents, const GwyObject& root, const GwyObject& field, int id) {
  const std::string prefix = fmt::format("/{}/", id);
  const double nx = field.number("xres", 0);
  const double ny = field.number("yres", 0);
  check_size(contents, nx, ny, contents.bytes.size() / sizeof(double));
  Layer layer{.name = root.text(prefix + "data/title"), .unit = unit_of(field, "si_unit_z")};
  if (layer.name.empty()) layer.name = fmt::format("channel {}", id);
  layer.index = id;
  layer.nx = static_cast<Index>(nx);
  layer.ny = static_cast<Index>(ny);
  layer.pixel_x = pixel(field, "xreal", layer.nx);
  layer.pixel_y = pixel(field, "yreal", layer.ny);
  layer.said_x = said(field, "xreal");
  layer.said_y = said(field, "yreal");
  const std::string_view data = data_of(contents, field, layer.nx, layer.ny);
  std::string_view mask;
  if (const GwyObject* mask_field = root.object(prefix + "mask", "GwyDataField")) {
    mask = data_of(contents, *mask_field, layer.nx, layer.ny);
  }
  const Raster raster{.nx = layer.nx, .ny = layer.ny};
  layer.load = [contents, data, mask, raster] { return masked(contents, data, mask, raster); };
  return layer;
}

/// The N of "/N/data"; nullopt for every other key.
std::optional<int> channel_id(const std::string& key) {
  const std::vector<std::string> parts = split(key, '/');
  if (parts.size() != 3 || !parts[0].empty() || parts[2] != "data") return std::nullopt;
  constexpr std::size_t most_digits = 6;
  const std::string& digits = parts[1];
  const bool is_number = !digits.empty() && digits.size() <= most_digits &&
                         digits.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::optional(std::stoi(digits)) : std::nullopt;
}

void add_metadata(Document& document, const GwyObject& root, int id) {
  const GwyObject* meta = root.object(fmt::format("/{}/meta", id), "GwyContainer");
  if (meta == nullptr) return;
  for (const auto& [key, value] : meta->items) {
    if (value.text.empty()) continue;
    if (key == kInstrument && document.instrument.empty()) {
      document.instrument = value.text;
    } else {
      document.metadata.emplace(key, value.text);
    }
  }
}

/// True if Gwyddion made up this side of a map: it puts 1 m where a file that it reads states none.
bool is_invented(const std::optional<double>& pixel, Index n) {
  constexpr double kRounding = 1e-12;
  return pixel && std::abs(*pixel * static_cast<double>(n) - 1) < kRounding;
}

/// True if write_gwy() has written the file, so that its sizes are those of its map.
bool is_own(const GwyObject& root) {
  const GwyObject* meta = root.object("/0/meta", "GwyContainer");
  return meta != nullptr && meta->items.contains(kSource) && meta->items.contains(kInstrument);
}

/// A side that Gwyddion made up is not known; the other one neither if it only makes the pixels
/// square.
void forget_invented_size(Layer& layer) {
  const bool x = is_invented(layer.pixel_x, layer.nx), y = is_invented(layer.pixel_y, layer.ny);
  if (!x && !y) return;
  constexpr double kRounding = 1e-12;
  const bool is_square =
      layer.pixel_x && layer.pixel_y && std::abs(*layer.pixel_x / *layer.pixel_y - 1) < kRounding;
  if (x || is_square) layer.pixel_x.reset();
  if (y || is_square) layer.pixel_y.reset();
  layer.pixel_hint = "no pixel size in the file (Gwyddion puts 1 m for none)";
}

}  // namespace

Match identify_gwy(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_gwy(const Contents& contents) {
  const GwyObject root = parse_gwy(contents);
  Document document{.format = "gwy"};
  std::map<int, const GwyObject*> fields;
  for (const auto& [key, value] : root.items) {
    const auto id = channel_id(key);
    const GwyObject* field = root.object(key, "GwyDataField");
    if (id && field != nullptr) fields[*id] = field;
  }
  for (const auto& [id, field] : fields) {
    document.layers.push_back(layer_of(contents, root, *field, id));
    add_metadata(document, root, id);
  }
  for (Layer& layer : document.layers) {
    if (!is_own(root)) forget_invented_size(layer);
  }
  if (document.layers.empty()) {
    reject(contents, "no image channel", "a height map (/0/data)",
           "profiles, volumes and point clouds cannot be read");
  }
  return document;
}

namespace {

GwyBuilder unit(const std::string& text) {
  GwyBuilder builder("GwySIUnit");
  builder.add("unitstr", text);
  return builder;
}

GwyBuilder data_field(const MapSet& set, const Field& values, const std::string& z_unit) {
  const Grid& grid = set.grid;
  GwyBuilder builder("GwyDataField");
  builder.add("xres", static_cast<std::int32_t>(grid.nx));
  builder.add("yres", static_cast<std::int32_t>(grid.ny));
  builder.add("xreal", grid.lx);
  builder.add("yreal", grid.ly);
  builder.add("xoff", set.left);
  builder.add("yoff", set.top);
  builder.add("si_unit_xy", unit("m"));
  builder.add("si_unit_z", unit(z_unit));
  builder.add("data", values);
  return builder;
}

/// Objects of the format count their bytes in 32 bits.
void require_countable(const Grid& grid, std::size_t n_fields, const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = 0xffffffff - (1 << 20);  // some for names and metadata
  if (static_cast<std::size_t>(grid.size()) * n_fields * sizeof(double) <= most_bytes) return;
  throw InputError(file.string(),
                   fmt::format("{} x {} pixels, {} times", grid.nx, grid.ny, n_fields),
                   "at most 4 GiB of maps and masks in GWY", "write .h5 or .vti instead");
}

/// Adds one channel; returns the number of its fields: values, and a mask where it has holes.
std::size_t add_channel(std::size_t id, const NamedMap& map, const MapSet& set, GwyBuilder& root) {
  const std::string prefix = fmt::format("/{}/", id);
  const Field values = map.load();
  const Mask hole = values.isNaN();
  // Gwyddion computes with the values under a mask, so they must be numbers: the mean.
  const double n_valid = static_cast<double>(hole.size() - hole.count());
  const double mean = hole.select(0, values).sum() / std::max(1.0, n_valid);
  const std::string unit_of_values = map.unit == "1" ? "" : map.unit;
  root.add(prefix + "data", data_field(set, hole.select(mean, values), unit_of_values));
  root.add(prefix + "data/title", map.name);
  if (!hole.any()) return 1;
  root.add(prefix + "mask", data_field(set, hole.cast<double>(), ""));
  return 2;
}

}  // namespace

void write_gwy_maps(const MapSet& maps, const std::filesystem::path& file) {
  require_countable(maps.grid, maps.maps.size(), file);
  GwyBuilder root("GwyContainer");
  std::size_t n_fields = 0;
  for (std::size_t id = 0; id < maps.maps.size(); ++id) {
    n_fields += add_channel(id, maps.maps[id], maps, root);
    require_countable(maps.grid, n_fields, file);
  }
  GwyBuilder meta("GwyContainer");
  for (const auto& [key, value] : maps.metadata) meta.add(key, value);
  root.add("/0/meta", meta);
  io::write_file(file, std::string_view(std::string(kMagic) + root.bytes()));
}

void write_gwy(const topography::Topography& topography, const std::filesystem::path& file) {
  MapSet maps = as_maps(topography, topography.channel.empty() ? "height" : topography.channel);
  maps.metadata = topography.metadata;
  maps.metadata[kSource] = topography.source;
  maps.metadata[kInstrument] = topography.instrument;
  write_gwy_maps(maps, file);
}

}  // namespace tabor::scan::format
