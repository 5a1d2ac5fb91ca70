// Text files: a matrix of heights, or x y z coordinates of a regular grid, or a profile x z.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_table.hpp"

namespace tabor::scan::format {
namespace {

struct Shape {
  Index ny;
  Index nx;
};

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

/// Rows between which lines without numbers stand may be several maps, one below the other.
void reject_blocks(const Contents& contents, const TextNumbers& numbers) {
  const bool are_blocks = numbers.rows.size() > 1 &&
                          std::all_of(numbers.rows.begin(), numbers.rows.end(),
                                      [](const TextRows& block) { return block.n_rows > 1; });
  if (!are_blocks) return;
  const TextRows& first = numbers.rows.front();
  reject(contents,
         fmt::format("{} blocks of numbers, the first one of {} rows up to line {}",
                     numbers.rows.size(), first.n_rows, first.first_line + first.n_rows - 1),
         "one map, or maps that each have a header such as '# Channel: height'",
         "save each in a file of its own, or take out the lines between them");
}

/// What a matrix has beside its heights.
struct Coordinates {
  std::optional<GridLine> x = {};  ///< in the first row
  std::optional<GridLine> y = {};  ///< in the first column
};

/// Coordinates in a line of numbers that is long enough to tell.
std::optional<GridLine> clear_coordinates(const TextColumn& line) {
  constexpr std::size_t least = 5;
  const auto found = line.size() >= least ? find_coordinates(line) : std::nullopt;
  const bool has_few_gaps = found && 2 * found->n <= 3 * static_cast<Index>(line.size());
  return has_few_gaps ? found : std::nullopt;
}

/// Coordinates in the first row and column of a matrix: evenly spaced where the next row and column
/// are not. Where both are, the number in the corner is neither.
Coordinates coordinates_of(const TextNumbers& numbers) {
  if (numbers.n_rows() < 2 || numbers.n_columns() < 2) return {};
  const auto is_even = [](const TextColumn& line) { return find_coordinates(line).has_value(); };
  const bool may_x = !is_even(row_of(numbers, 1, 1)), may_y = !is_even(column_of(numbers, 1, 1));
  const auto x = may_x ? clear_coordinates(row_of(numbers, 0, 1)) : std::nullopt;
  const auto y = may_y ? clear_coordinates(column_of(numbers, 0, 1)) : std::nullopt;
  if (x && y) return {x, y};
  if (may_y && clear_coordinates(column_of(numbers, 0))) {
    return {.y = clear_coordinates(column_of(numbers, 0))};
  }
  if (may_x && clear_coordinates(row_of(numbers, 0))) {
    return {.x = clear_coordinates(row_of(numbers, 0))};
  }
  return {};
}

std::string warning_of(const Coordinates& found) {
  const bool both = found.x && found.y;
  return fmt::format(
      "the first {} evenly spaced: taken as coordinates, not as heights; a line '# Width: 3 um' "
      "above "
      "the numbers makes heights of all",
      both      ? "row and column are"
      : found.x ? "row is"
                : "column is");
}

/// Takes row and column of coordinates off a matrix.
void remove(const Coordinates& found, TextNumbers& numbers) {
  const std::size_t width = numbers.n_columns();
  const std::size_t first_row = found.x ? 1 : 0, first_column = found.y ? 1 : 0;
  std::vector<double> kept;
  kept.reserve(numbers.values.size());
  for (std::size_t row = first_row; row < numbers.n_rows(); ++row) {
    const double* values = numbers.values.data() + row * width;
    kept.insert(kept.end(), values + first_column, values + width);
  }
  numbers.rows = {{numbers.rows.front().first_line + first_row, numbers.n_rows() - first_row,
                   width - first_column}};
  numbers.values = std::move(kept);
}

/// SPIP writes behind the heights a second map, 0 where one is void.
void apply_valid_map(const TextHeader& header, TextNumbers& numbers) {
  if (!(header.n_void > 0) || !header.nx || !header.ny) return;
  const std::size_t n = numbers.values.size() / 2;
  if (static_cast<double>(numbers.values.size()) != 2 * *header.nx * *header.ny) return;
  for (std::size_t i = 0; i < n; ++i) {
    if (numbers.values[n + i] == 0) numbers.values[i] = kHole;
  }
  numbers.values.resize(n);
}

Layer as_matrix(const Contents& contents, TextNumbers numbers, const TextHeader& header) {
  apply_valid_map(header, numbers);
  const Shape shape = shape_of(contents, numbers, header);
  const auto values = std::make_shared<const std::vector<double>>(std::move(numbers.values));
  Layer layer = layer_of(header, shape.ny, shape.nx);
  layer.load = [values, shape]() -> Field {
    return Eigen::Map<const Field>(values->data(), shape.ny, shape.nx);
  };
  layer.pixel_x = header.pixel_x;
  layer.pixel_y = header.pixel_y;
  if (header.width) layer.pixel_x = *header.width / static_cast<double>(shape.nx);
  if (header.height) layer.pixel_y = *header.height / static_cast<double>(shape.ny);
  layer.said_x = header.said_x;
  layer.said_y = header.said_y;
  layer.pixel_hint = header.pixel_hint;
  return layer;
}

/// A matrix of heights, without coordinates beside them.
TextLayers read_matrix(const Contents& contents, TextNumbers numbers, const TextHeader& header) {
  TextLayers read{.format = "matrix", .layers = {}};
  if (header.one_per_line && numbers.n_rows() != numbers.n_columns()) {
    read.warnings.push_back(
        "The file does not give the number of rows, so a square map is assumed");
  }
  const bool is_plain = !header.is_map && !header.one_per_line;
  if (!(header.nx && header.ny) && !header.one_per_line) reject_blocks(contents, numbers);
  Coordinates found;
  if (is_plain && numbers.odd_rows() == nullptr) found = coordinates_of(numbers);
  if (found.x || found.y) {
    remove(found, numbers);
    read.warnings.push_back(warning_of(found));
  }
  Layer layer = as_matrix(contents, std::move(numbers), header);
  if (found.x && found.y) {
    layer.pixel_ratio = found.y->step / found.x->step;
    layer.pixel_hint = fmt::format("coordinates in steps of {:g} and {:g} without a unit",
                                   found.x->step, found.y->step);
  }
  read.layers.push_back(std::move(layer));
  return read;
}

/// Heights stored as shares of a step and from another zero.
void apply_offset(const TextHeader& header, TextNumbers& numbers) {
  if (header.offset == 0) return;
  for (double& value : numbers.values) value += header.offset / header.scale;
}

/// One header and the numbers behind it, taken from the front of `text`.
TextLayers take_section(const Contents& contents, std::string_view& text, std::size_t& first_line) {
  TextHeader header = take_header(contents, text, first_line);
  TextNumbers numbers = parse_numbers(contents, text,
                                      {.first_line = header.n_lines + first_line,
                                       .one_per_line = header.one_per_line,
                                       .two_columns = header.columns.size() == 2,
                                       .begins_section = begins_section});
  text = numbers.rest;
  first_line = numbers.rest_line;
  if (numbers.values.empty()) return {};
  header.fit_columns(numbers.n_columns());
  if (header.names_places() && !header.column('z') && numbers.n_columns() > 3) {
    reject(contents, fmt::format("{} columns, none of them named z", numbers.n_columns()),
           "one of heights", "name the columns in a line such as '# x [um] y [um] other z [um]'");
  }
  apply_offset(header, numbers);
  if (auto table = read_table(contents, numbers, header)) return std::move(*table);
  return read_matrix(contents, std::move(numbers), header);
}

/// Names that tell the channels of several sections apart.
void name_channels(std::vector<Layer>& layers) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const bool is_named = layers[i].name != "height";
    if (!is_named) layers[i].name = fmt::format("block {}", i);
  }
}

bool has_binary(std::string_view head) {
  return std::any_of(head.begin(), head.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 32 && c != '\n' && c != '\r' && c != '\t';
  });
}

Match identify_plain(std::string_view head) {
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

Document open_plain(const Contents& contents) {
  Document document;
  std::string_view text = contents.bytes;
  std::size_t first_line = 1, n_sections = 0;
  while (!text.empty()) {
    TextLayers read = take_section(contents, text, first_line);
    if (read.layers.empty()) continue;
    if (n_sections++ == 0) document.format = read.format;
    for (Layer& layer : read.layers) document.layers.push_back(std::move(layer));
    for (std::string& warning : read.warnings) document.warnings.push_back(std::move(warning));
  }
  if (document.layers.empty()) reject(contents, "no numbers", "a matrix or x y z", kDamaged);
  if (n_sections > 1) name_channels(document.layers);
  return document;
}

}  // namespace

Match identify_text(std::string_view head) {
  if (const auto utf8 = utf8_from_utf16(head)) return identify_text(*utf8);
  const auto plain = without_quotes(head);
  return identify_plain(plain ? *plain : head);
}

Document open_text(const Contents& contents) {
  if (const auto utf8 = utf8_from_utf16(contents.bytes)) return open_text(contents.part(*utf8));
  const auto plain = without_quotes(contents.bytes);
  return open_plain(plain ? contents.part(*plain) : contents);
}

}  // namespace tabor::scan::format
