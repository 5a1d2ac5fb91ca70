// Text files of Zygo's MetroPro and Mx: 14 lines of header and, between lines of a single '#', the
// points "x y z" of format 1 ("XYZ") or the counts of intensity and phase of format 2 ("ASCII")
// (MetroPro Reference Guide OMP-0347, "ASCII data file").
#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/text.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kPoints = "Zygo XYZ Data File - Format 1";
constexpr std::string_view kCounts = "Zygo ASCII Data File - Format 2";
constexpr double kLeastInvalid = 2147483640;

struct Header {
  std::vector<std::string> lines;
  double x = 0, y = 0;  ///< camera pixel of the first height
  double nx = 0, ny = 0;
  std::string_view data;  ///< behind the '#' that ends the header
};

/// The parts of a line between blanks and tabs.
std::vector<std::string> words_of(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// Number `i` of a header line, both counted from 0.
double number(const Contents& contents, const Header& header, std::size_t line, std::size_t i) {
  const std::vector<std::string> words = words_of(header.lines[line]);
  const auto value = i < words.size() ? parse_number(words[i]) : std::nullopt;
  if (!value) {
    reject(contents, fmt::format("no number {} on line {}", i + 1, line + 1),
           "a header of MetroPro", kDamaged);
  }
  return *value;
}

Header take_header(const Contents& contents) {
  constexpr std::size_t kLines = 14;
  Header header{.lines = {}, .data = contents.bytes};
  while (true) {
    if (header.data.empty() || header.lines.size() > kLines) {
      reject(contents, "no line '#' behind its header", "a header of 14 lines", kDamaged);
    }
    std::string line(trim(take_line(header.data)));
    if (line == "#") break;
    header.lines.push_back(std::move(line));
  }
  constexpr std::size_t kLeast = 13;  // the last lines differ between versions
  if (header.lines.size() < kLeast) {
    reject(contents, fmt::format("a header of {} lines", header.lines.size()), "14", kDamaged);
  }
  header.x = number(contents, header, 3, 0);
  header.y = number(contents, header, 3, 1);
  header.nx = number(contents, header, 3, 2);
  header.ny = number(contents, header, 3, 3);
  constexpr std::size_t kLeastBytes = 2;  // a digit and a separator
  check_size(contents, header.nx, header.ny, header.data.size() / kLeastBytes);
  return header;
}

/// A layer of the header's size; 0 stands for a camera that is not calibrated.
Layer layer_of(const Contents& contents, const Header& header) {
  const double pixel = number(contents, header, 7, 6);
  Layer layer{
      .name = "height", .nx = static_cast<Index>(header.nx), .ny = static_cast<Index>(header.ny)};
  if (pixel != 0) layer.pixel_x = layer.pixel_y = pixel;
  layer.said_x = layer.said_y = fmt::format("a camera resolution of {:g} m", pixel);
  return layer;
}

/// Stores a point "x y z" or "x y No Data", whose x and y are camera pixels.
void store(const Contents& contents, const Header& header, std::string_view line, Field& heights) {
  const std::vector<std::string> words = words_of(line);
  const auto x = words.size() > 2 ? parse_number(words[0]) : std::nullopt;
  const auto y = words.size() > 2 ? parse_number(words[1]) : std::nullopt;
  const double column = x.value_or(kHole) - header.x, row = y.value_or(kHole) - header.y;
  const bool is_inside = column >= 0 && column < header.nx && row >= 0 && row < header.ny;
  const auto z = words.size() > 2 ? parse_number(words[2]) : std::nullopt;
  const bool is_hole = words.size() > 3 && words[2] == "No";
  if (!is_inside || (!z && !is_hole)) {
    reject(contents, "'" + std::string(line.substr(0, 40)) + "'",
           fmt::format("x y z inside of {} x {} pixels", header.nx, header.ny), kDamaged);
  }
  heights(static_cast<Index>(row), static_cast<Index>(column)) = z.value_or(kHole);
}

Field points(const Contents& contents, const Header& header) {
  Field heights =
      Field::Constant(static_cast<Index>(header.ny), static_cast<Index>(header.nx), kHole);
  std::string_view rest = header.data;
  Index n_points = 0;
  bool has_end = false;
  while (!rest.empty() && !has_end) {
    const std::string_view line = trim(take_line(rest));
    has_end = line == "#";
    if (has_end || line.empty()) continue;
    store(contents, header, line, heights);
    ++n_points;
  }
  if (!has_end && n_points < heights.size()) {
    reject(contents, fmt::format("{} points and no '#' behind them", n_points),
           fmt::format("{} x {} as its header says", header.nx, header.ny), kDamaged);
  }
  return heights;
}

/// The numbers up to the next '#'.
std::vector<double> take_block(const Contents& contents, std::string_view& rest) {
  const std::size_t end = rest.find('#');
  if (end == std::string_view::npos) reject(contents, "no '#' behind its counts", "", kDamaged);
  std::vector<double> values;
  std::string_view block = rest.substr(0, end);
  while (!block.empty()) {
    for (const std::string& word : words_of(trim(take_line(block)))) {
      const auto value = parse_number(word);
      if (!value) reject(contents, "'" + word.substr(0, 40) + "'", "a count", kDamaged);
      values.push_back(*value);
    }
  }
  rest.remove_prefix(end + 1);
  return values;
}

/// Metres per count of the phase.
double scale_of(const Contents& contents, const Header& header) {
  const double resolution = number(contents, header, 10, 0);
  const double steps = resolution == 0 ? 4096 : resolution == 1 ? 32768 : 131072;
  const double interferometer = number(contents, header, 7, 1);
  const double wavelength = number(contents, header, 7, 2);
  const double obliquity = number(contents, header, 7, 4);
  return interferometer * wavelength * obliquity / steps;
}

Field counts(const Contents& contents, const Header& header) {
  std::string_view rest = header.data;
  take_block(contents, rest);  // intensity
  std::vector<double> values = take_block(contents, rest);
  if (static_cast<double>(values.size()) != header.nx * header.ny) {
    reject(contents, fmt::format("{} counts", values.size()),
           fmt::format("{} x {} as its header says", header.nx, header.ny), kDamaged);
  }
  for (double& value : values) {
    if (value >= kLeastInvalid) value = kHole;
  }
  return Eigen::Map<const Field>(values.data(), static_cast<Index>(header.ny),
                                 static_cast<Index>(header.nx));
}

}  // namespace

Match identify_zygo_text(std::string_view head) {
  return head.starts_with(kPoints) || head.starts_with(kCounts) ? Match::yes : Match::no;
}

Document open_zygo_text(const Contents& contents) {
  const bool has_points = contents.bytes.starts_with(kPoints);
  const Header header = take_header(contents);
  Layer layer = layer_of(contents, header);
  if (has_points) {
    layer.load = [contents, header] { return points(contents, header); };
  } else {
    layer.unit = "m";
    layer.scale = scale_of(contents, header);
    layer.load = [contents, header] { return counts(contents, header); };
  }
  Document document{.format = "zygo-text", .instrument = "Zygo"};
  document.layers.push_back(std::move(layer));
  return document;
}

}  // namespace tabor::scan::format
