#include "tabor/scan/read_parameters.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"

namespace tabor::scan {
namespace {

const Bounds kPixel{.least = 1e-15, .most = 1e6, .text = "a positive length, from 1e-15 to 1e6 m"};

std::vector<double> pixel_of(const ReadOptions& options) {
  std::vector<double> sides;
  if (options.pixel_x) sides.push_back(*options.pixel_x);
  if (options.pixel_y) sides.push_back(*options.pixel_y);
  return sides;
}

void set_pixel(ReadOptions& options, const std::vector<double>& sides) {
  if (sides.size() > 2) {
    throw InputError("pixel", fmt::format("{} lengths", sides.size()), "one, or two for x and y",
                     "");
  }
  options.pixel_x = sides.front();
  options.pixel_y = sides.size() == 2 ? std::optional(sides.back()) : std::nullopt;
}

}  // namespace

const Parameters<ReadOptions>& read_parameters() {
  using One = Parameter<ReadOptions>;
  static const Parameters<ReadOptions> table{
      One({.name = "channel",
           .help = "height channel, by name or number as in 'tabor info'",
           .example = "1",
           .study_key = "treatment.channel",
           .placeholder = "NAME"},
          &ReadOptions::channel),
      One::of_numbers({.name = "pixel",
                       .help = "pixel size where the file has none",
                       .example = "0.67 um",
                       .dimension = dimension::length,
                       .bounds = kPixel,
                       .study_key = "treatment.pixel",
                       .placeholder = "DX[,DY]"},
                      pixel_of, set_pixel),
      One({.name = "unit",
           .help = "unit of the heights where the file has none",
           .example = "um",
           .study_key = "treatment.unit",
           .placeholder = "UNIT"},
          &ReadOptions::unit),
      One({.name = "z_scale",
           .help = "height of one grey step, for images of whole numbers",
           .example = "1 nm",
           .dimension = dimension::length,
           .placeholder = "LENGTH"},
          &ReadOptions::z_scale),
      One({.name = "override_unit", .help = "let pixel and unit replace what the file says"},
          &ReadOptions::override_unit)};
  static const Parameters<ReadOptions> all = grouped(kReadingGroup, table);
  return all;
}

}  // namespace tabor::scan
