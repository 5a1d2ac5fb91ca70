// Maps as text: a matrix, points x y z, and a table of several maps.
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <iterator>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

/// In as few digits as read back to the same number.
void put_number(double value, io::Precision precision, std::string& text) {
  const auto out = std::back_inserter(text);
  if (precision == io::Precision::float32) {
    fmt::format_to(out, "{}", static_cast<float>(value));
  } else {
    fmt::format_to(out, "{}", value);
  }
}

/// What stands between the numbers of a row.
char separator_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".csv" ? ',' : '\t';
}

double x_of(const MapSet& maps, Index x) {
  return maps.left + (static_cast<double>(x) + 0.5) * maps.grid.dx();
}
double y_of(const MapSet& maps, Index y) {
  return maps.top + (static_cast<double>(y) + 0.5) * maps.grid.dy();
}

/// "pressure_Pa"
std::string column_of(const NamedMap& map) {
  std::string unit;
  for (const char c : map.unit) unit += c == '/' || c == ' ' ? '_' : c;
  return map.unit == "1" ? map.name : map.name + "_" + unit;
}

std::string csv_header(const MapSet& maps) {
  std::vector<std::string> names{"x_m", "y_m"};
  for (const NamedMap& map : maps.maps) names.push_back(column_of(map));
  return io::csv_line(names);
}

/// The pixels of one row, a line each; a hole is an empty cell.
std::string csv_row(const MapSet& maps, const std::vector<Field>& values, Index y) {
  std::string text;
  for (Index x = 0; x < maps.grid.nx; ++x) {
    fmt::format_to(std::back_inserter(text), "{},{}", x_of(maps, x), y_of(maps, y));
    for (std::size_t i = 0; i < values.size(); ++i) {
      text += ',';
      const double value = values[i](y, x);
      if (std::isfinite(value)) put_number(value, maps.maps[i].precision, text);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void write_matrix_map(const MapSet& maps, const std::filesystem::path& file) {
  const Grid& grid = maps.grid;
  const NamedMap& map = maps.maps.front();
  const Field values = map.load();
  std::string text =
      fmt::format("# Channel: {}\n# Width: {} m\n# Height: {} m\n# Value units: {}\n",
                  writable_text(map.name), grid.lx, grid.ly, map.unit);
  const char separator = separator_of(file);
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      put_number(values(y, x), map.precision, text);
      text += x + 1 < grid.nx ? separator : '\n';
    }
  }
  io::write_file(file, std::string_view(text));
}

void write_matrix(const topography::Topography& topography, const std::filesystem::path& file) {
  write_matrix_map(as_maps(topography, topography.channel.empty() ? "height" : topography.channel),
                   file);
}

void write_xyz_map(const MapSet& maps, const std::filesystem::path& file) {
  const NamedMap& map = maps.maps.front();
  if (maps.grid.size() < 2) {
    throw InputError(file.string(), "one pixel", "at least two, whose places show the pixel size",
                     "write .txt");
  }
  const Field values = map.load();
  std::string text = fmt::format("# x [m] y [m] {} [{}]\n", map.name, map.unit);
  for (Index y = 0; y < maps.grid.ny; ++y) {
    for (Index x = 0; x < maps.grid.nx; ++x) {
      fmt::format_to(std::back_inserter(text), "{} {} ", x_of(maps, x), y_of(maps, y));
      put_number(values(y, x), map.precision, text);
      text += '\n';
    }
  }
  io::write_file(file, std::string_view(text));
}

void write_xyz(const topography::Topography& topography, const std::filesystem::path& file) {
  write_xyz_map(as_maps(topography, "z"), file);
}

void write_csv_maps(const MapSet& maps, const std::filesystem::path& file) {
  std::vector<Field> values;
  values.reserve(maps.maps.size());
  for (const NamedMap& map : maps.maps) values.push_back(map.load());
  io::write_file(file, [&](const io::Append& append) {
    append(csv_header(maps));
    for (Index y = 0; y < maps.grid.ny; ++y) append(csv_row(maps, values, y));
  });
}

}  // namespace tabor::scan::format
