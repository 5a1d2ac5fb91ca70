// OPDx, Bruker's Vision64 (Dektak stylus profilers and white-light instruments): a tree of named
// items, maps in 2D_Data and profiles in 1D_Data (Gwyddion, dektakvca.c; SurfaceTopography,
// IO/OPDx.py).
#include <fmt/format.h>

#include <map>

#include "tabor/core/units.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"VCA DATA\x01\x00\x00\x55", 12};
constexpr int kDeepest = 32;
constexpr std::size_t kMostItems = 100'000;

/// Kinds of items.
enum class Kind : std::uint8_t {
  matrix = 0x00,
  boolean = 0x01,
  i16 = 0x04,
  u16 = 0x05,
  i32 = 0x06,
  u32 = 0x07,
  i64 = 0x0A,
  u64 = 0x0B,
  f32 = 0x0C,
  f64 = 0x0D,
  type_id = 0x0E,
  text = 0x12,
  quantity = 0x13,
  time = 0x15,
  unit = 0x18,
  doubles = 0x40,
  texts = 0x42,
  plain_matrix = 0x45,
  raw_data = 0x46,
  raw_data_2d = 0x47,
  positions = 0x7C,
  container = 0x7D,
  end = 0x7F
};

/// Value of an item; which members have a meaning depends on its kind.
struct Item {
  double number = 0;
  std::string text = {};        ///< or the symbol of a unit
  std::string_view bytes = {};  ///< of a list of doubles or a matrix of floats
  Index nx = 0;
  Index ny = 0;
};

using Items = std::map<std::string, Item>;

/// Takes the items of a file in order and stores them by their path.
class ItemReader {
 public:
  explicit ItemReader(const Contents& contents) : contents_(contents), cursor_(contents) {}

  Items take() {
    cursor_.skip(kMagic.size());
    while (cursor_.left() > 0 && take_item("", 0)) {
    }
    return std::move(items_);
  }

 private:
  std::string take_name() {
    const auto size = cursor_.take<std::uint32_t>();
    return std::string(cursor_.take(size));
  }

  /// Lengths are stored in as many bytes as the byte before them says.
  std::size_t take_length() {
    const auto width = cursor_.take<std::uint8_t>();
    switch (width) {
      case 1:
        return cursor_.take<std::uint8_t>();
      case 2:
        return cursor_.take<std::uint16_t>();
      case 4:
        return cursor_.take<std::uint32_t>();
      default:
        reject(contents_, fmt::format("a length of {} bytes", width), "1, 2 or 4", kDamaged);
    }
  }

  /// The bytes of an item that begins with the name of its type and its length.
  std::string_view take_typed() {
    take_name();
    return cursor_.take(take_length());
  }

  template <typename T>
  Item take_number() {
    return {.number = static_cast<double>(cursor_.take<T>())};
  }

  /// Value, name and symbol, or the other way round.
  Item take_unit(bool value_first) {
    const Contents inside = contents_.part(cursor_.take(take_length()));
    Cursor cursor(inside);
    const auto take_inner_name = [&cursor] {
      const auto size = cursor.take<std::uint32_t>();
      return std::string(cursor.take(size));
    };
    Item item;
    if (value_first) item.number = cursor.take<double>();
    take_inner_name();
    item.text = take_inner_name();
    if (!value_first) item.number = cursor.take<double>();
    return item;
  }

  Item take_doubles() {
    constexpr std::size_t kUnknown = 5;  // bytes before the values
    std::string_view bytes = take_typed();
    if (bytes.size() < kUnknown) reject(contents_, "a list without head", "", kDamaged);
    bytes.remove_prefix(kUnknown);
    return {.bytes = bytes, .nx = static_cast<Index>(bytes.size() / sizeof(double)), .ny = 1};
  }

  Item take_matrix(bool is_named) {
    take_name();
    if (is_named) {
      cursor_.skip(sizeof(std::uint32_t));
      take_name();
    }
    const Contents inside = contents_.part(cursor_.take(take_length()));
    Cursor cursor(inside);
    const double ny = cursor.take<std::uint32_t>();
    const double nx = cursor.take<std::uint32_t>();
    check_size(contents_, nx, ny, cursor.left() / sizeof(float));
    return {.bytes = cursor.take(cursor.left()),
            .nx = static_cast<Index>(nx),
            .ny = static_cast<Index>(ny)};
  }

  /// The names of a list, one a line.
  Item take_texts() {
    const Contents inside = contents_.part(take_typed());
    Cursor cursor(inside);
    Item item;
    while (cursor.left() > 0) {
      const auto size = cursor.take<std::uint32_t>();
      item.text += std::string(cursor.take(size)) + "\n";
    }
    return item;
  }

  void take_children(const std::string& path, int depth) {
    const std::size_t length = take_length();
    if (length > cursor_.left()) reject(contents_, "items beyond its end", "", kDamaged);
    const std::size_t end = cursor_.position() + length;
    while (cursor_.position() < end && take_item(path, depth + 1)) {
    }
    cursor_.seek(end);
  }

  Item take_value(Kind kind) {
    constexpr std::size_t kTimeSize = 9;
    switch (kind) {
      case Kind::matrix:
      case Kind::plain_matrix:
        return take_matrix(kind == Kind::matrix);
      case Kind::boolean:
        return take_number<std::uint8_t>();
      case Kind::i16:
        return take_number<std::int16_t>();
      case Kind::u16:
        return take_number<std::uint16_t>();
      case Kind::i32:
        return take_number<std::int32_t>();
      case Kind::u32:
        return take_number<std::uint32_t>();
      case Kind::i64:
        return take_number<std::int64_t>();
      case Kind::u64:
        return take_number<std::uint64_t>();
      case Kind::f32:
        return take_number<float>();
      case Kind::f64:
        return take_number<double>();
      case Kind::text:
        return {.text = std::string(cursor_.take(take_length()))};
      case Kind::quantity:
        return take_unit(true);
      case Kind::unit:
        return take_unit(false);
      case Kind::time:
        cursor_.skip(kTimeSize);
        return {};
      case Kind::doubles:
        return take_doubles();
      case Kind::texts:
        return take_texts();
      case Kind::type_id:
      case Kind::positions:
        take_typed();
        return {};
      default:
        reject(contents_, fmt::format("an item of kind {}", static_cast<int>(kind)),
               "a kind that is known", kDamaged);
    }
  }

  /// Takes one item; false behind the last one of a list.
  bool take_item(const std::string& folder, int depth) {
    if (depth > kDeepest || ++n_items_ > kMostItems) {
      reject(contents_, "items without end", "a measurement", kDamaged);
    }
    const std::string path = folder + "/" + take_name();
    const auto kind = static_cast<Kind>(cursor_.take<std::uint8_t>());
    if (kind == Kind::end) return false;
    if (kind == Kind::container || kind == Kind::raw_data || kind == Kind::raw_data_2d) {
      take_children(path, depth);
    } else {
      items_.emplace(path, take_value(kind));
    }
    return true;
  }

  Contents contents_;
  Cursor cursor_;
  Items items_;
  std::size_t n_items_ = 0;
};

const Item* find(const Items& items, const std::string& path) {
  const auto found = items.find(path);
  return found == items.end() ? nullptr : &found->second;
}

/// The pixel from the distance between the first and the last of n points.
void set_pixel(const Item* extent, Index n, std::optional<double>& pixel, std::string& said) {
  if (extent == nullptr) return;
  const auto factor = unit_factor(extent->text, dimension::length);
  pixel = extent->number * factor.value_or(kHole) / static_cast<double>(n > 1 ? n - 1 : 1);
  said = fmt::format("an extent of {:g} {}", extent->number, extent->text);
}

/// Layer of the data in `folder`, but for its size, pixel and heights.
Layer named_layer(const Items& items, const std::string& folder) {
  Layer layer{.name = folder.substr(folder.rfind('/') + 1)};
  if (const Item* scale = find(items, folder + "/DataScale")) {
    layer.unit = scale->text;
    layer.scale = scale->number;
  }
  return layer;
}

Layer map_layer(const Contents& contents, const Items& items, const std::string& folder,
                const Item& matrix) {
  Layer layer = named_layer(items, folder);
  layer.nx = matrix.nx;
  layer.ny = matrix.ny;
  set_pixel(find(items, folder + "/Dimension2Extent"), matrix.nx, layer.pixel_x, layer.said_x);
  set_pixel(find(items, folder + "/Dimension1Extent"), matrix.ny, layer.pixel_y, layer.said_y);
  const Raster raster{.sample = Sample::f32, .nx = matrix.nx, .ny = matrix.ny};
  layer.load = [contents, bytes = matrix.bytes, raster] { return decode(contents, bytes, raster); };
  return layer;
}

Layer line_layer(const Contents& contents, const Items& items, const std::string& folder,
                 const Item& list) {
  Layer layer = named_layer(items, folder);
  check_size(contents, static_cast<double>(list.nx), 1, list.bytes.size() / sizeof(double));
  layer.nx = list.nx;
  layer.ny = 1;
  set_pixel(find(items, folder + "/Extent"), list.nx, layer.pixel_x, layer.said_x);
  layer.pixel_y = layer.pixel_x;
  layer.said_y = layer.said_x;
  const Raster raster{.sample = Sample::f64, .nx = list.nx, .ny = 1};
  layer.load = [contents, bytes = list.bytes, raster] { return decode(contents, bytes, raster); };
  return layer;
}

void add_layers(const Contents& contents, const Items& items, Document& document) {
  for (const auto& [path, item] : items) {
    if (item.nx == 0) continue;  // of a kind without values
    const bool is_map = path.starts_with("/2D_Data/") && path.ends_with("/Matrix");
    const bool is_line = path.starts_with("/1D_Data/") && path.ends_with("/Array") &&
                         !path.ends_with("/PositionArray/Array");
    const std::string folder = path.substr(0, path.rfind('/'));
    if (is_map) document.layers.push_back(map_layer(contents, items, folder, item));
    if (is_line) document.layers.push_back(line_layer(contents, items, folder, item));
  }
}

std::string text_at(const Items& items, const std::string& path) {
  const Item* item = find(items, path);
  return item == nullptr ? "" : item->text;
}

}  // namespace

Match identify_opdx(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_opdx(const Contents& contents) {
  const Items items = ItemReader(contents).take();
  Document document{.format = "opdx", .instrument = "Bruker"};
  const std::string name = text_at(items, "/MetaData/MeasurementSettings/InstrumentName");
  if (!name.empty()) document.instrument += " " + name;
  const std::string date = text_at(items, "/MetaData/Date");
  if (!date.empty()) document.metadata["Date"] = date;
  add_layers(contents, items, document);
  if (document.layers.empty()) {
    reject(contents, "neither 2D_Data nor 1D_Data", "a height map or a profile", kDamaged);
  }
  return document;
}

}  // namespace tabor::scan::format
