// Tables of coordinates and heights: points of a regular grid, and profiles.
#include "tabor/scan/formats/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "tabor/core/units.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kNameColumns =
    "name the columns in a line such as '# x [um] y [um] other z [um]'";

/// Metres per unit of a coordinate column; nullopt if the file does not say.
std::optional<double> pixel_of(double step, const std::string& unit) {
  const auto factor = unit.empty() ? std::nullopt : unit_factor(unit, dimension::length);
  return factor ? std::optional(step * *factor) : std::nullopt;
}

std::string unit_of(const TextHeader& header, std::size_t column) {
  return column < header.columns.size() ? header.columns[column].unit : "";
}

/// Where x, y and z stand in the table; in their common order where the header does not say.
struct Places {
  std::size_t x, y, z;
};

std::optional<Places> places_of(const TextNumbers& numbers, const TextHeader& header) {
  const std::size_t n_columns = numbers.n_columns();
  if (!header.names_places()) {
    const bool may_be = n_columns == 3 && !header.column('x') && !header.column('y');
    return may_be ? std::optional(Places{0, 1, 2}) : std::nullopt;
  }
  const std::size_t x = *header.column('x'), y = *header.column('y');
  if (const auto z = header.column('z')) return Places{x, y, *z};
  // A height by another name stands in the column that is left.
  return n_columns == 3 ? std::optional(Places{x, y, 3 - x - y}) : std::nullopt;
}

/// Points on a regular grid in any order, each node at most once; nodes without a point are holes.
std::optional<TextLayers> as_points(const TextNumbers& numbers, const TextHeader& header) {
  const auto places = places_of(numbers, header);
  // Few points without a word about their columns may as well be a small matrix.
  const std::size_t least = header.names_places() ? 2 : 4;
  if (!places || numbers.n_rows() < least) return std::nullopt;
  const TextColumn along_x = column_of(numbers, places->x);
  const TextColumn along_y = column_of(numbers, places->y);
  const TextColumn z = column_of(numbers, places->z);
  const auto x = find_grid_line(along_x);
  const auto y = find_grid_line(along_y);
  if (!x || !y || x->n * y->n < 2 || x->n * y->n > 2 * static_cast<Index>(numbers.n_rows())) {
    return std::nullopt;
  }
  Field heights = Field::Constant(y->n, x->n, kHole);
  Mask seen = Mask::Constant(y->n, x->n, false);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const Index row = y->index_of(along_y[i]);
    const Index column = x->index_of(along_x[i]);
    if (seen(row, column)) return std::nullopt;
    seen(row, column) = true;
    heights(row, column) = z[i];
  }
  Layer layer = layer_of(header, std::move(heights));
  // A single row does not tell how wide it is: square pixels are assumed, and said.
  const std::string x_unit = unit_of(header, places->x), y_unit = unit_of(header, places->y);
  layer.pixel_x = x->n > 1 ? pixel_of(x->step, x_unit) : pixel_of(y->step, y_unit);
  layer.pixel_y = y->n > 1 ? pixel_of(y->step, y_unit) : layer.pixel_x;
  if (x->n > 1 && y->n > 1) layer.pixel_ratio = y->step / x->step;
  layer.pixel_hint =
      fmt::format("coordinates in steps of {:g} and {:g} without a unit", x->step, y->step);
  TextLayers read{.format = "xyz", .layers = {}};
  if (layer.nx == 1 || layer.ny == 1) {
    read.warnings.push_back("The file has a single row of points, so square pixels are assumed");
  }
  read.layers.push_back(std::move(layer));
  return read;
}

/// Heights at the nodes of a line, in the order of rising coordinates; nodes without one are holes.
/// nullopt if two stand at one node.
std::optional<Field> along(const GridLine& line, const TextColumn& x, const TextColumn& z) {
  Field heights = Field::Constant(1, line.n, kHole);
  std::vector<bool> seen(static_cast<std::size_t>(line.n));
  for (std::size_t i = 0; i < z.size(); ++i) {
    const Index node = line.index_of(x[i]);
    if (seen[static_cast<std::size_t>(node)]) return std::nullopt;
    seen[static_cast<std::size_t>(node)] = true;
    heights(0, node) = z[i];
  }
  return heights;
}

/// The profile of the heights in one column over the places in another, a map of one row.
std::optional<Layer> profile_of(const TextNumbers& numbers, const TextHeader& header,
                                std::size_t x_place, std::size_t z_place) {
  const TextColumn x = column_of(numbers, x_place);
  const auto line = find_grid_line(x);
  constexpr Index most_gaps = 2;  // nodes for each number
  if (!line || line->n < 2 || line->n > most_gaps * static_cast<Index>(x.size())) {
    return std::nullopt;
  }
  auto heights = along(*line, x, column_of(numbers, z_place));
  if (!heights) return std::nullopt;
  Layer layer = layer_of(header, std::move(*heights));
  if (layer.unit.empty()) layer.unit = unit_of(header, z_place);
  layer.pixel_x = pixel_of(line->step, unit_of(header, x_place));
  layer.pixel_y = layer.pixel_x;
  layer.pixel_hint = fmt::format("coordinates in steps of {:g} without a unit", line->step);
  return layer;
}

/// The columns of a profile's table that may hold heights: the one that is named so, else all that
/// are no coordinates and no numbers of the lines.
std::vector<std::size_t> height_columns(const TextNumbers& numbers, const TextHeader& header,
                                        std::size_t x_place) {
  if (const auto z = header.column('z')) return {*z};
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < numbers.n_columns(); ++i) {
    if (i == x_place) continue;
    const auto line = find_coordinates(column_of(numbers, i));
    const bool is_number_of_line = line && is_count_up(*line) && numbers.n_columns() > 2;
    if (!is_number_of_line) places.push_back(i);
  }
  return places;
}

[[noreturn]] void reject_profile(const Contents& contents) {
  reject(contents, "a profile whose coordinates are not evenly spaced, each once",
         "a column x in even steps; missing ones become holes",
         "put the profile on even steps first");
}

/// One profile for each column of heights. Rejects a table whose x is no line.
TextLayers as_profiles(const Contents& contents, const TextNumbers& numbers,
                       const TextHeader& header, std::size_t x_place) {
  const std::vector<std::size_t> places = height_columns(numbers, header, x_place);
  if (places.empty()) reject(contents, "coordinates without heights", "a column z", kNameColumns);
  TextLayers read{.format = "profile", .layers = {}};
  for (const std::size_t z_place : places) {
    auto layer = profile_of(numbers, header, x_place, z_place);
    if (!layer) reject_profile(contents);
    if (places.size() > 1) layer->name = fmt::format("column {}", z_place + 1);
    read.layers.push_back(std::move(*layer));
  }
  return read;
}

/// Where x stands in a table of all of whose columns something is said, if that names a place.
std::optional<std::size_t> named_x(const TextNumbers& numbers, const TextHeader& header) {
  if (header.columns.size() != numbers.n_columns() || numbers.n_columns() < 2) return std::nullopt;
  if (const auto x = header.column('x')) return x;
  return header.column('y');
}

/// Where x stands in a table of all of whose columns something is said, but not which of them it
/// is. Rejects one where none is even.
std::optional<std::size_t> x_beside_named_z(const Contents& contents, const TextNumbers& numbers,
                                            const TextHeader& header) {
  const auto z = header.column('z');
  if (!z || header.columns.size() != numbers.n_columns() || numbers.n_columns() < 2) {
    return std::nullopt;
  }
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < numbers.n_columns(); ++i) {
    if (i != *z && find_coordinates(column_of(numbers, i))) found = i;  // numbers of lines go first
  }
  if (!found) reject_profile(contents);
  return found;
}

/// Columns from the left that look like coordinates.
std::size_t n_leading_coordinates(const TextNumbers& numbers) {
  std::size_t n = 0;
  while (n < numbers.n_columns() && find_coordinates(column_of(numbers, n))) ++n;
  return n;
}

/// Where x stands in a narrow table without names, if one column looks like it and the others do
/// not.
std::optional<std::size_t> x_by_look(const TextNumbers& numbers) {
  const std::size_t n_columns = numbers.n_columns(), n = n_leading_coordinates(numbers);
  if (n_columns == 2) {
    if (n > 0) return 0;
    return find_coordinates(column_of(numbers, 1)) ? std::optional<std::size_t>(1) : std::nullopt;
  }
  // The numbers of the lines, x and z.
  const bool is_numbered =
      n_columns == 3 && n == 2 && is_count_up(*find_coordinates(column_of(numbers, 0)));
  return is_numbered ? std::optional<std::size_t>(1) : std::nullopt;
}

/// True if a narrow table begins with coordinates in uneven steps, beside columns that are none.
bool has_uneven_coordinates(const TextNumbers& numbers) {
  constexpr std::size_t least_rows = 8, most_columns = 4;
  const std::size_t n_columns = numbers.n_columns();
  if (n_columns < 2 || n_columns > most_columns || numbers.n_rows() < least_rows) return false;
  return is_strictly_monotone(column_of(numbers, 0)) && !find_coordinates(column_of(numbers, 0)) &&
         !is_strictly_monotone(column_of(numbers, n_columns - 1));
}

/// True if a table is rather a list of points than a map: by its header or its shape.
bool is_list_of_points(const TextNumbers& numbers, const TextHeader& header) {
  constexpr std::size_t longest_map = 20;  // times its width
  const std::size_t n_columns = numbers.n_columns();
  return header.names_places() ||
         (n_columns >= 3 && n_columns <= 4 && numbers.n_rows() > longest_map * n_columns);
}

/// True if the first two of three columns lie on a grid that they visit again and again, where the
/// third does not: points with most of their nodes missing.
bool looks_like_sparse_points(const TextNumbers& numbers) {
  constexpr std::size_t least_rows = 8;
  const std::size_t n_rows = numbers.n_rows();
  if (numbers.n_columns() != 3 || n_rows < least_rows) return false;
  const auto is_revisited = [&](std::size_t i) {
    const auto line = find_grid_line(column_of(numbers, i));
    return line && line->n > 1 && 2 * line->n <= static_cast<Index>(n_rows);
  };
  return is_revisited(0) && is_revisited(1) && !find_grid_line(column_of(numbers, 2));
}

[[noreturn]] void reject_points(const Contents& contents) {
  reject(
      contents, "points that do not fill a regular grid, each node once", "evenly spaced x and y",
      "put the points on a regular grid first, for example with Gwyddion, or name the width of a "
      "map of so few columns: '# Width: 3 um'");
}

/// Without names: two columns of coordinates beside one of heights may be points along a slanted
/// line, and uneven ones are no profile.
void reject_coordinates(const Contents& contents, const TextNumbers& numbers) {
  constexpr std::size_t least_rows = 5;  // fewer may be so by chance
  const std::size_t n_columns = numbers.n_columns();
  if (n_columns > 2 && numbers.n_rows() >= least_rows && n_leading_coordinates(numbers) == 2) {
    reject(contents, "two columns of evenly spaced coordinates", "x, or the x and y of a grid",
           kNameColumns);
  }
  if (has_uneven_coordinates(numbers)) {
    reject(contents, "a first column of coordinates that are not evenly spaced",
           "x in even steps, or a map",
           "put the heights on even steps first; name the width of a map of so few columns: "
           "'# Width: 3 um'");
  }
}

}  // namespace

Layer layer_of(const TextHeader& header, Index ny, Index nx) {
  return {.name = header.channel.empty() ? "height" : header.channel,
          .unit = header.unit,
          .scale = header.scale,
          .nx = nx,
          .ny = ny};
}

Layer layer_of(const TextHeader& header, Field heights) {
  const auto shared = std::make_shared<const Field>(std::move(heights));
  Layer layer = layer_of(header, shared->rows(), shared->cols());
  layer.load = [shared] { return *shared; };
  return layer;
}

TextColumn column_of(const TextNumbers& numbers, std::size_t i, std::size_t first_row) {
  const std::size_t width = numbers.n_columns();
  return {numbers.values.data() + first_row * width + i, width, numbers.n_rows() - first_row};
}

TextColumn row_of(const TextNumbers& numbers, std::size_t i, std::size_t first_column) {
  const std::size_t width = numbers.n_columns();
  return {numbers.values.data() + i * width + first_column, 1, width - first_column};
}

std::optional<TextLayers> read_table(const Contents& contents, const TextNumbers& numbers,
                                     const TextHeader& header) {
  if (header.is_map || header.one_per_line || numbers.odd_rows() != nullptr) return std::nullopt;
  if (auto points = as_points(numbers, header)) return points;
  const bool names_points = header.names_places() && numbers.n_columns() > 2;
  if (!names_points) {
    if (const auto x = named_x(numbers, header)) return as_profiles(contents, numbers, header, *x);
    if (const auto x = x_beside_named_z(contents, numbers, header)) {
      return as_profiles(contents, numbers, header, *x);
    }
    if (const auto x = x_by_look(numbers)) return as_profiles(contents, numbers, header, *x);
    reject_coordinates(contents, numbers);
    const bool is_trace_table = n_leading_coordinates(numbers) == 1;
    if (is_trace_table) return std::nullopt;
  }
  if (is_list_of_points(numbers, header) || looks_like_sparse_points(numbers)) {
    reject_points(contents);
  }
  return std::nullopt;
}

}  // namespace tabor::scan::format
