// NPY, NumPy's array file (numpy.lib.format, versions 1 to 3): shape and type, no unit, no pixel.
#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_grid.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"\x93NUMPY", 6};

/// The text after "'key':" in the header's Python dictionary, whose quotes are single.
std::string_view value_of(const Contents& contents, std::string_view header, std::string_view key) {
  const std::string quoted = fmt::format("'{}'", key);
  const std::size_t at = header.find(quoted);
  const std::string_view rest =
      at == std::string_view::npos ? "" : trim(header.substr(at + quoted.size()));
  if (!rest.starts_with(':')) {
    reject(contents, fmt::format("no '{}' in the header", key), "an NPY header", kDamaged);
  }
  return trim(rest.substr(1));
}

bool is_transposed(const Contents& contents, std::string_view text) {
  if (text.starts_with("True")) return true;
  if (text.starts_with("False")) return false;
  reject(contents, fmt::format("fortran_order {}", text.substr(0, text.find(','))), "True or False",
         kDamaged);
}

struct Type {
  Sample sample;
  std::endian order;
};

/// "<f8", ">i2", "|u1", as numpy.dtype.str writes them.
Type type_of(const Contents& contents, std::string_view text) {
  static constexpr std::pair<std::string_view, Sample> kinds[]{
      {"u1", Sample::u8},  {"i1", Sample::i8},  {"u2", Sample::u16}, {"i2", Sample::i16},
      {"u4", Sample::u32}, {"i4", Sample::i32}, {"u8", Sample::u64}, {"i8", Sample::i64},
      {"f4", Sample::f32}, {"f8", Sample::f64}};
  const std::string_view name = text.substr(0, text.find('\'', 1));
  if (name.size() == 4 && name[0] == '\'') {
    for (const auto& [kind, sample] : kinds) {
      if (name.substr(2) == kind) {
        return {sample, name[1] == '>' ? std::endian::big : std::endian::little};
      }
    }
  }
  reject(contents,
         fmt::format("an array of type {}", text.substr(0, text.find(", 'fortran_order'"))),
         "integers or real numbers", "save it as float64");
}

/// The numbers in "(480, 640), ...".
std::vector<double> shape_of(const Contents& contents, std::string_view text) {
  const std::size_t end = text.find(')');
  std::vector<double> shape;
  if (text.starts_with('(') && end != std::string_view::npos) {
    for (const std::string& part : split(text.substr(1, end - 1), ',')) {
      std::string_view number = trim(part);
      if (number.empty()) continue;
      if (number.ends_with('L')) number.remove_suffix(1);  // of Python 2
      shape.push_back(parse_number(number).value_or(0));
    }
  }
  if (shape.size() != 2) {
    reject(contents, fmt::format("an array of {} dimensions", shape.size()),
           "two dimensions (rows, columns)", "save one two-dimensional map");
  }
  return shape;
}

/// A narrow array whose first column looks like coordinates is a table, not a map.
void reject_table(const Contents& contents, const Field& array) {
  constexpr Index widest = 4, fewest_rows = 8;
  if (array.cols() < 2 || array.cols() > widest || array.rows() < fewest_rows) return;
  const auto column = [&](Index i) {
    return TextColumn{array.data() + i, static_cast<std::size_t>(array.cols()),
                      static_cast<std::size_t>(array.rows())};
  };
  if (!find_coordinates(column(0)) || is_strictly_monotone(column(array.cols() - 1))) return;
  reject(
      contents,
      fmt::format("an array of {} columns, the first one evenly spaced coordinates", array.cols()),
      "a map of heights", "save the heights alone, a profile as one row, or a text file x z");
}

}  // namespace

Match identify_npy(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_npy(const Contents& contents) {
  Cursor cursor(contents);
  cursor.skip(kMagic.size());
  const int version = cursor.take<std::uint8_t>();
  cursor.skip(1);
  const std::size_t length =
      version == 1 ? cursor.take<std::uint16_t>() : cursor.take<std::uint32_t>();
  std::string header(cursor.take(length));
  std::replace(header.begin(), header.end(), '"', '\'');
  const Type type = type_of(contents, value_of(contents, header, "descr"));
  const bool transposed = is_transposed(contents, value_of(contents, header, "fortran_order"));
  const auto shape = shape_of(contents, value_of(contents, header, "shape"));
  check_size(contents, shape[1], shape[0], cursor.left() / size_of(type.sample));
  Layer layer{.name = "array",
              .is_count = is_integer(type.sample),
              .nx = static_cast<Index>(shape[1]),
              .ny = static_cast<Index>(shape[0])};
  const std::string_view data =
      cursor.take(byte_size({.sample = type.sample, .nx = layer.nx, .ny = layer.ny}));
  layer.load = [contents, data, type, transposed, nx = layer.nx, ny = layer.ny]() -> Field {
    const Raster raster{.sample = type.sample,
                        .order = type.order,
                        .nx = transposed ? ny : nx,
                        .ny = transposed ? nx : ny};
    Field stored = decode(contents, data, raster);
    Field array = transposed ? Field(stored.transpose()) : std::move(stored);
    reject_table(contents, array);
    return array;
  };
  Document document{.format = "npy"};
  warn_of_surplus(cursor, document);
  document.layers.push_back(std::move(layer));
  return document;
}

void write_npy_map(const MapSet& maps, const std::filesystem::path& file) {
  const Grid& grid = maps.grid;
  const NamedMap& map = maps.maps.front();
  const bool is_single = map.precision == io::Precision::float32;
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   is_single ? "<f4" : "<f8", grid.ny, grid.nx);
  constexpr std::size_t kAlignment = 64;  // numpy aligns the data so that it can be memory-mapped
  const std::size_t before = kMagic.size() + 4;
  header.resize((before + header.size() + kAlignment) / kAlignment * kAlignment - before - 1, ' ');
  header += '\n';
  std::string bytes(kMagic);
  put<std::uint8_t>(bytes, 1);
  put<std::uint8_t>(bytes, 0);
  put(bytes, static_cast<std::uint16_t>(header.size()));
  bytes += header;
  is_single ? put_field_f32(bytes, map.load()) : put_field(bytes, map.load());
  io::write_file(file, std::string_view(bytes));
}

void write_npy(const topography::Topography& topography, const std::filesystem::path& file) {
  write_npy_map(as_maps(topography, "height"), file);
}

std::string note_npy(const topography::Topography& topography) {
  const double dx = topography.grid.dx() * 1e6;
  const double dy = topography.grid.dy() * 1e6;
  return fmt::format(
      "heights in m, without unit and pixel; <unit=m> and <pixel={}> give them",
      dx == dy ? fmt::format("{:.9g}um", dx) : fmt::format("{:.9g}um,{:.9g}um", dx, dy));
}

}  // namespace tabor::scan::format
