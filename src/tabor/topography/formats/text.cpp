// Text files: a matrix of heights, or x y z coordinates of a regular grid, or a profile x z.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/core/units.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/topography/formats/readers.hpp"
#include "tabor/topography/formats/text_header.hpp"
#include "tabor/topography/formats/text_numbers.hpp"

namespace tabor::topography::format {
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

/// The grid line behind column `offset` of `stride` columns, if all coordinates lie on one: a
/// single node if they are all the same. The spacing is the smallest step between consecutive
/// points.
std::optional<GridLine> find_grid_line(const std::vector<double>& values, std::size_t stride,
                                       std::size_t offset) {
  double low = values[offset];
  double high = low;
  for (std::size_t i = offset; i < values.size(); i += stride) {
    if (std::isnan(values[i])) return std::nullopt;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  if (high == low) return GridLine{low, 1, 1};
  double step = high - low;
  if (!std::isfinite(step)) return std::nullopt;
  for (std::size_t i = offset + stride; i < values.size(); i += stride) {
    const double difference = std::abs(values[i] - values[i - stride]);
    if (difference > 1e-9 * (high - low)) step = std::min(step, difference);
  }
  if (!(step > 0) || (high - low) / step > static_cast<double>(values.size())) return std::nullopt;
  const double n_steps = std::round((high - low) / step);
  const GridLine line{low, (high - low) / n_steps, static_cast<Index>(n_steps) + 1};
  for (std::size_t i = offset; i < values.size(); i += stride) {
    if (!line.holds(values[i])) return std::nullopt;
  }
  return line;
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

/// Points on a regular grid in any order, each node at most once; nodes without a point are holes.
std::optional<Layer> as_xyz(const TextNumbers& numbers, const TextHeader& header) {
  // Few points without a word about their columns may as well be a small matrix.
  const std::size_t least = header.x_unit.empty() ? 4 : 2;
  if (numbers.n_columns() != 3 || numbers.n_rows() < least || header.is_map) return std::nullopt;
  const auto x = find_grid_line(numbers.values, 3, 0);
  const auto y = find_grid_line(numbers.values, 3, 1);
  if (!x || !y || x->n * y->n < 2 || x->n * y->n > 2 * static_cast<Index>(numbers.n_rows())) {
    return std::nullopt;
  }
  Field heights = Field::Constant(y->n, x->n, kHole);
  Mask seen = Mask::Constant(y->n, x->n, false);
  for (std::size_t i = 0; i < numbers.values.size(); i += 3) {
    const Index row = y->index_of(numbers.values[i + 1]);
    const Index column = x->index_of(numbers.values[i]);
    if (seen(row, column)) return std::nullopt;
    seen(row, column) = true;
    heights(row, column) = numbers.values[i + 2];
  }
  Layer layer = layer_of(header, std::move(heights));
  // A single row does not tell how wide it is: square pixels are assumed, and said (open_text).
  layer.pixel_x = x->n > 1 ? pixel_of(x->step, header.x_unit) : pixel_of(y->step, header.y_unit);
  layer.pixel_y = y->n > 1 ? pixel_of(y->step, header.y_unit) : layer.pixel_x;
  layer.pixel_hint =
      fmt::format("coordinates in steps of {:g} and {:g} without a unit", x->step, y->step);
  return layer;
}

/// Two columns with an evenly rising first one: a profile, read as a map of one row.
std::optional<Layer> as_profile(const TextNumbers& numbers, const TextHeader& header) {
  if (numbers.n_columns() != 2 || numbers.n_rows() < 4 || header.is_map) return std::nullopt;
  const auto x = find_grid_line(numbers.values, 2, 0);
  if (!x || x->n != static_cast<Index>(numbers.n_rows())) return std::nullopt;
  Field heights(1, x->n);
  for (Index i = 0; i < x->n; ++i) {
    if (x->index_of(numbers.values[static_cast<std::size_t>(2 * i)]) != i) return std::nullopt;
    heights(0, i) = numbers.values[static_cast<std::size_t>(2 * i + 1)];
  }
  Layer layer = layer_of(header, std::move(heights));
  layer.pixel_x = pixel_of(x->step, header.x_unit);
  layer.pixel_y = layer.pixel_x;
  layer.pixel_hint = fmt::format("coordinates in steps of {:g} without a unit", x->step);
  return layer;
}

/// Rows and columns of a matrix: the header's, a square for exports without line structure, else
/// the lines themselves.
Shape shape_of(const Contents& contents, const TextNumbers& numbers, const TextHeader& header) {
  const std::size_t n = numbers.values.size();
  if (header.nx && header.ny) {
    check_size(contents, *header.nx, *header.ny, n);
    if (*header.nx * *header.ny != static_cast<double>(n)) {
      refuse(contents, fmt::format("{} numbers", n),
             fmt::format("{} x {} as its header says", *header.nx, *header.ny), kDamaged);
    }
    return {static_cast<Index>(*header.ny), static_cast<Index>(*header.nx)};
  }
  if (header.one_per_line && (numbers.n_rows() == 1 || numbers.n_columns() == 1)) {
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
    if (side * side != n) {
      refuse(contents, fmt::format("{} numbers without line structure", n), "a square map",
             kDamaged);
    }
    return {static_cast<Index>(side), static_cast<Index>(side)};
  }
  if (const TextRows* odd = numbers.odd_rows()) {
    refuse(contents, fmt::format("{} numbers on line {}", odd->n_columns, odd->first_line),
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
    if (!is_header_line(line)) return Match::no;
    has_header = true;
  }
  return has_header ? Match::maybe : Match::no;
}

Document open_text(const Contents& contents) {
  if (const auto utf8 = utf8_from_utf16(contents.bytes)) return open_text(contents.part(*utf8));
  std::string_view text = contents.bytes;
  const TextHeader header = take_header(contents, text);
  TextNumbers numbers = parse_numbers(contents, text, header.n_lines + 1);
  if (numbers.values.empty()) refuse(contents, "no numbers", "a matrix or x y z", kDamaged);
  Document document{.format = "matrix"};
  const bool rectangular = numbers.odd_rows() == nullptr;
  if (auto xyz = rectangular ? as_xyz(numbers, header) : std::nullopt) {
    document.format = "xyz";
    if (xyz->nx == 1 || xyz->ny == 1) {
      document.doubts.push_back("a single row of points: square pixels are assumed");
    }
    document.layers.push_back(std::move(*xyz));
  } else if (auto profile = rectangular ? as_profile(numbers, header) : std::nullopt) {
    document.format = "profile";
    document.doubts.push_back("a profile of one row: areal results do not apply");
    document.layers.push_back(std::move(*profile));
  } else {
    if (!header.x_unit.empty()) {
      refuse(contents, "points that are not on a regular grid", "evenly spaced x and y",
             "put the points on a regular grid first, for example with Gwyddion");
    }
    if (header.one_per_line && numbers.n_rows() != numbers.n_columns()) {
      document.doubts.push_back("a square map is assumed: the file does not tell its rows");
    }
    document.layers.push_back(as_matrix(contents, std::move(numbers), header));
  }
  return document;
}

void write_matrix(const Topography& topography, const std::filesystem::path& file) {
  const Grid& grid = topography.grid;
  std::string text =
      fmt::format("# Channel: {}\n# Width: {} m\n# Height: {} m\n# Value units: m\n",
                  topography.channel.empty() ? "height" : topography.channel, grid.lx, grid.ly);
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      fmt::format_to(std::back_inserter(text), "{}{}", topography.height(y, x),
                     x + 1 < grid.nx ? '\t' : '\n');
    }
  }
  io::write_file(file, std::string_view(text));
}

void write_xyz(const Topography& topography, const std::filesystem::path& file) {
  const Grid& grid = topography.grid;
  std::string text = "# x [m] y [m] z [m]\n";
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      fmt::format_to(std::back_inserter(text), "{} {} {}\n",
                     (static_cast<double>(x) + 0.5) * grid.dx(),
                     (static_cast<double>(y) + 0.5) * grid.dy(), topography.height(y, x));
    }
  }
  io::write_file(file, std::string_view(text));
}

}  // namespace tabor::topography::format
