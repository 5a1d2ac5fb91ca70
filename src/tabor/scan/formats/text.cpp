// Text files: a matrix of heights, or x y z coordinates of a regular grid, or a profile x z.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/core/units.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_header.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

/// Largest distance of a coordinate from its grid line, as a share of the spacing: room for the
/// rounding of printed coordinates.
constexpr double kGridTolerance = 0.05;

/// Evenly spaced coordinates: their first value, spacing and count.
struct GridLine {
  double first = 0;
  double step = 0;
  Index n = 0;

  Index index_of(double coordinate) const { return std::lround((coordinate - first) / step); }
  bool holds(double coordinate) const {
    const double position = (coordinate - first) / step;
    return std::abs(position - std::round(position)) <= kGridTolerance;
  }
};

/// One column of a table.
struct TextColumn {
  const std::vector<double>& values;
  std::size_t stride;  ///< columns of the table
  std::size_t offset;

  std::size_t size() const { return values.size() / stride; }
  double operator[](std::size_t row) const { return values[row * stride + offset]; }
};

/// What of a range counts as the same coordinate.
constexpr double kSameShare = 1e-9;

bool holds_all(const GridLine& line, const TextColumn& column) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!line.holds(column[i])) return false;
  }
  return true;
}

/// The smallest step between consecutive points taken as the spacing: right for scans whose
/// coordinates were printed with all their digits.
std::optional<GridLine> line_of_smallest_step(const TextColumn& column, double low, double high) {
  double step = high - low;
  for (std::size_t i = 1; i < column.size(); ++i) {
    const double difference = std::abs(column[i] - column[i - 1]);
    if (difference > kSameShare * (high - low)) step = std::min(step, difference);
  }
  if ((high - low) / step > static_cast<double>(column.values.size())) return std::nullopt;
  const double n_steps = std::round((high - low) / step);
  const GridLine line{low, (high - low) / n_steps, static_cast<Index>(n_steps) + 1};
  return holds_all(line, column) ? std::optional(line) : std::nullopt;
}

/// The same for coordinates that rounding or the stage moved: gaps between sorted coordinates are
/// either within a node or from node to node, and each of these is some whole spacings.
std::optional<GridLine> line_of_median_gap(const TextColumn& column, double low, double high) {
  constexpr double clear_jump = 4;  // from the largest gap within a node to the next one
  std::vector<double> places;
  for (std::size_t i = 0; i < column.size(); ++i) places.push_back(column[i]);
  std::sort(places.begin(), places.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double gap = places[i] - places[i - 1];
    if (gap > kSameShare * (high - low)) gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end());
  // The last jump above which the gaps still make up most of the line: those beside missing
  // columns do not.
  std::size_t first = gaps.size() - 1;
  double above = gaps[first];
  while (first > 0 && (2 * above <= high - low || gaps[first] <= clear_jump * gaps[first - 1])) {
    above += gaps[--first];
  }
  const double smallest = gaps[first];
  const double median_gap = gaps[first + (gaps.size() - first) / 2];
  // Places over the numbers of their nodes, as a straight line.
  double node = 0, sum_node = 0, sum_place = 0, sum_square = 0, sum_product = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double gap = i > 0 ? places[i] - places[i - 1] : 0;
    if (gap >= smallest) node += std::round(gap / median_gap);
    const double place = places[i] - low;
    sum_node += node;
    sum_place += place;
    sum_square += node * node;
    sum_product += node * place;
  }
  if (!(node >= 1) || node > static_cast<double>(column.size())) return std::nullopt;
  const auto n = static_cast<double>(places.size());
  const double step =
      (n * sum_product - sum_node * sum_place) / (n * sum_square - sum_node * sum_node);
  const GridLine line{low + (sum_place - step * sum_node) / n, step, static_cast<Index>(node) + 1};
  return holds_all(line, column) ? std::optional(line) : std::nullopt;
}

/// The grid line behind a column, if all its coordinates lie on one: a single node if they are all
/// the same.
std::optional<GridLine> find_grid_line(const TextColumn& column) {
  double low = column[0];
  double high = low;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (std::isnan(column[i])) return std::nullopt;
    low = std::min(low, column[i]);
    high = std::max(high, column[i]);
  }
  if (high == low) return GridLine{low, 1, 1};
  if (!std::isfinite(high - low)) return std::nullopt;
  const auto line = line_of_smallest_step(column, low, high);
  return line ? line : line_of_median_gap(column, low, high);
}

/// Metres per unit of a coordinate column; nullopt if the file does not say.
std::optional<double> pixel_of(double step, const std::string& unit) {
  const auto factor = unit.empty() ? std::nullopt : unit_factor(unit, dimension::length);
  return factor ? std::optional(step * *factor) : std::nullopt;
}

struct Shape {
  Index ny;
  Index nx;
};

Layer layer_of(const TextHeader& header, Shape shape) {
  return {.name = header.channel.empty() ? "height" : header.channel,
          .unit = header.unit,
          .scale = header.scale,
          .nx = shape.nx,
          .ny = shape.ny};
}

/// A layer over values that are already complete.
Layer layer_of(const TextHeader& header, Field heights) {
  const auto shared = std::make_shared<const Field>(std::move(heights));
  Layer layer = layer_of(header, Shape{shared->rows(), shared->cols()});
  layer.load = [shared] { return *shared; };
  return layer;
}

/// Where x, y and z stand in the table; in their common order where the header does not say.
struct Places {
  std::size_t x, y, z;
};

std::optional<Places> places_of(const TextNumbers& numbers, const TextHeader& header) {
  if (header.is_map) return std::nullopt;
  const std::size_t n_columns = numbers.n_columns();
  if (!header.names_places()) return n_columns == 3 ? std::optional(Places{0, 1, 2}) : std::nullopt;
  const std::size_t x = *header.column('x'), y = *header.column('y');
  if (const auto z = header.column('z')) return Places{x, y, *z};
  // A height by another name stands in the column that is left.
  return n_columns == 3 ? std::optional(Places{x, y, 3 - x - y}) : std::nullopt;
}

std::string unit_of(const TextHeader& header, char name) {
  const auto place = header.column(name);
  return place ? header.columns[*place].unit : "";
}

/// Points on a regular grid in any order, each node at most once; nodes without a point are holes.
std::optional<Layer> as_xyz(const TextNumbers& numbers, const TextHeader& header) {
  const auto places = places_of(numbers, header);
  // Few points without a word about their columns may as well be a small matrix.
  const std::size_t least = header.names_places() ? 2 : 4;
  if (!places || numbers.n_rows() < least) return std::nullopt;
  const std::size_t stride = numbers.n_columns();
  const TextColumn along_x{numbers.values, stride, places->x};
  const TextColumn along_y{numbers.values, stride, places->y};
  const TextColumn z{numbers.values, stride, places->z};
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
  // A single row does not tell how wide it is: square pixels are assumed, and said (open_text).
  const std::string x_unit = unit_of(header, 'x'), y_unit = unit_of(header, 'y');
  layer.pixel_x = x->n > 1 ? pixel_of(x->step, x_unit) : pixel_of(y->step, y_unit);
  layer.pixel_y = y->n > 1 ? pixel_of(y->step, y_unit) : layer.pixel_x;
  if (x->n > 1 && y->n > 1) layer.pixel_ratio = y->step / x->step;
  layer.pixel_hint =
      fmt::format("coordinates in steps of {:g} and {:g} without a unit", x->step, y->step);
  return layer;
}

/// Two columns with an evenly rising first one: a profile, read as a map of one row.
std::optional<Layer> as_profile(const TextNumbers& numbers, const TextHeader& header) {
  if (numbers.n_columns() != 2 || numbers.n_rows() < 4 || header.is_map) return std::nullopt;
  const std::size_t x_place = header.column('z') == 0U ? 1 : header.column('x').value_or(0);
  const TextColumn along_x{numbers.values, 2, x_place};
  const TextColumn z{numbers.values, 2, 1 - x_place};
  const auto x = find_grid_line(along_x);
  if (!x || x->n != static_cast<Index>(numbers.n_rows())) return std::nullopt;
  Field heights(1, x->n);
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (x->index_of(along_x[i]) != static_cast<Index>(i)) return std::nullopt;
    heights(0, static_cast<Index>(i)) = z[i];
  }
  Layer layer = layer_of(header, std::move(heights));
  layer.pixel_x = pixel_of(x->step, unit_of(header, 'x'));
  layer.pixel_y = layer.pixel_x;
  layer.pixel_hint = fmt::format("coordinates in steps of {:g} without a unit", x->step);
  return layer;
}

/// Whether a table is rather a list of points than a map: by its header or its shape.
bool is_list_of_points(const TextNumbers& numbers, const TextHeader& header) {
  constexpr std::size_t longest_map = 20;  // times its width
  if (header.is_map || header.one_per_line) return false;
  const std::size_t n_columns = numbers.n_columns();
  return header.names_places() ||
         (n_columns >= 3 && n_columns <= 4 && numbers.n_rows() > longest_map * n_columns);
}

/// Rows and columns of a matrix: the header's, a square for exports without line structure, else
/// the lines themselves.
Shape shape_of(const Contents& contents, const TextNumbers& numbers, const TextHeader& header) {
  const std::size_t n = numbers.values.size();
  if (header.nx && header.ny) {
    check_size(contents, *header.nx, *header.ny, n);
    if (*header.nx * *header.ny != static_cast<double>(n)) {
      reject(contents, fmt::format("{} numbers", n),
             fmt::format("{} x {} as its header says", *header.nx, *header.ny), kDamaged);
    }
    return {static_cast<Index>(*header.ny), static_cast<Index>(*header.nx)};
  }
  if (header.one_per_line && (numbers.n_rows() == 1 || numbers.n_columns() == 1)) {
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
    if (side * side != n) {
      reject(contents, fmt::format("{} numbers without line structure", n), "a square map",
             kDamaged);
    }
    return {static_cast<Index>(side), static_cast<Index>(side)};
  }
  if (const TextRows* odd = numbers.odd_rows()) {
    reject(contents, fmt::format("{} numbers on line {}", odd->n_columns, odd->first_line),
           fmt::format("{} as on line {}", numbers.n_columns(), numbers.rows.front().first_line),
           kDamaged);
  }
  return {static_cast<Index>(numbers.n_rows()), static_cast<Index>(numbers.n_columns())};
}

Layer as_matrix(const Contents& contents, TextNumbers numbers, const TextHeader& header) {
  const Shape shape = shape_of(contents, numbers, header);
  const auto values = std::make_shared<const std::vector<double>>(std::move(numbers.values));
  Layer layer = layer_of(header, shape);
  layer.load = [values, shape]() -> Field {
    return Eigen::Map<const Field>(values->data(), shape.ny, shape.nx);
  };
  layer.pixel_x = header.pixel;
  layer.pixel_y = header.pixel;
  if (header.width) layer.pixel_x = *header.width / static_cast<double>(shape.nx);
  if (header.height) layer.pixel_y = *header.height / static_cast<double>(shape.ny);
  return layer;
}

bool has_binary(std::string_view head) {
  return std::any_of(head.begin(), head.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 32 && c != '\n' && c != '\r' && c != '\t';
  });
}

}  // namespace

Match identify_text(std::string_view head) {
  if (const auto utf8 = utf8_from_utf16(head)) return identify_text(*utf8);
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  if (has_binary(head)) return Match::no;
  bool has_header = false;
  const char line_end = line_end_of(head);
  while (!head.empty()) {
    const std::string_view line = take_line(head, line_end);
    if (starts_with_number(line)) return Match::yes;
    if (!is_header_line(line)) return Match::maybe;  // open_text says which line is none
    has_header = true;
  }
  return has_header ? Match::maybe : Match::no;
}

Document open_text(const Contents& contents) {
  if (const auto utf8 = utf8_from_utf16(contents.bytes)) return open_text(contents.part(*utf8));
  std::string_view text = contents.bytes;
  TextHeader header = take_header(contents, text);
  TextNumbers numbers = parse_numbers(contents, text,
                                      {.first_line = header.n_lines + 1,
                                       .one_per_line = header.one_per_line,
                                       .two_columns = header.columns.size() == 2});
  if (numbers.values.empty()) reject(contents, "no numbers", "a matrix or x y z", kDamaged);
  Document document{.format = "matrix"};
  const bool rectangular = numbers.odd_rows() == nullptr;
  header.fit_columns(numbers.n_columns());
  if (header.names_places() && !header.column('z') && numbers.n_columns() > 3) {
    reject(contents, fmt::format("{} columns, none of them named z", numbers.n_columns()),
           "one of heights", "name the columns in a line such as '# x [um] y [um] other z [um]'");
  }
  if (auto xyz = rectangular ? as_xyz(numbers, header) : std::nullopt) {
    document.format = "xyz";
    if (xyz->nx == 1 || xyz->ny == 1) {
      document.warnings.push_back("a single row of points: square pixels are assumed");
    }
    document.layers.push_back(std::move(*xyz));
  } else if (auto profile = rectangular ? as_profile(numbers, header) : std::nullopt) {
    document.format = "profile";
    document.layers.push_back(std::move(*profile));
  } else {
    if (rectangular && is_list_of_points(numbers, header)) {
      reject(contents, "points that do not fill a regular grid, each node once",
             "evenly spaced x and y",
             "put the points on a regular grid first, for example with Gwyddion, or name the width "
             "of a map of so few columns: '# Width: 3 um'");
    }
    if (header.one_per_line && numbers.n_rows() != numbers.n_columns()) {
      document.warnings.push_back("a square map is assumed: the file does not tell its rows");
    }
    document.layers.push_back(as_matrix(contents, std::move(numbers), header));
  }
  return document;
}

}  // namespace tabor::scan::format
