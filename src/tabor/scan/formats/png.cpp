// PNG with grey values as counts. Gwyddion and tabor note in remarks which heights and sides they
// stand for (Gwyddion, image-keys.h); without them the user must say what a count and a pixel are.
#include "tabor/io/image/png.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "tabor/core/units.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/stated.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kPrefix = "Gwy::";
constexpr int kMost = 65535;

Remarks without_prefix(const std::map<std::string, std::string>& all) {
  Remarks remarks;
  for (const auto& [keyword, text] : all) {
    if (keyword.starts_with(kPrefix)) remarks[keyword.substr(kPrefix.size())] = text;
  }
  return remarks;
}

/// Heights of the counts 0 and 65535. Count 0 stands for holes, so that the lowest height is 1; a
/// flat map is all 1.
CountRange range_of(const topography::Topography& topography) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (Index i = 0; i < topography.height.size(); ++i) {
    const double z = topography.height.data()[i];
    if (z < least) least = z;  // false for holes
    if (z > most) most = z;
  }
  const double step = most > least ? (most - least) / (kMost - 1) : 1e-12;
  return {.least = least - step, .most = least + (kMost - 1) * step};
}

double step_of(const CountRange& range) { return (range.most - range.least) / kMost; }

}  // namespace

Match identify_png(std::string_view head) {
  return head.starts_with("\x89PNG\r\n\x1a\n") ? Match::yes : Match::no;
}

Document open_png(const Contents& contents) {
  io::GreyImage image = io::read_png(contents.file);
  const auto counts = std::make_shared<const Field>(std::move(image.counts));
  Document document{.format = "png"};
  if (image.bits < 16) {
    document.warnings.push_back(
        fmt::format("Heights are coarse, with only {} bits per pixel", image.bits));
  }
  Layer layer{.name = "grey values",
              .is_count = true,
              .nx = counts->cols(),
              .ny = counts->rows(),
              .load = [counts] { return *counts; }};
  const Remarks remarks = without_prefix(image.remarks);
  if (const auto range = count_range(remarks)) {
    take_remarks(remarks, layer);
    const double step = (range->most - range->least) / ((1 << image.bits) - 1);
    layer.load = [counts, least = range->least, step]() -> Field { return least + step * *counts; };
  }
  document.layers.push_back(std::move(layer));
  return document;
}

void write_png(const topography::Topography& topography, const std::filesystem::path& file) {
  const CountRange range = range_of(topography);
  const double step = step_of(range);
  io::GreyPicture picture{.nx = topography.grid.nx, .ny = topography.grid.ny};
  picture.counts.reserve(static_cast<std::size_t>(topography.height.size()));
  for (Index i = 0; i < topography.height.size(); ++i) {
    const double z = topography.height.data()[i];
    const double count =
        std::isnan(z) ? 0 : std::clamp<double>(std::round((z - range.least) / step), 1, kMost);
    picture.counts.push_back(static_cast<std::uint16_t>(count));
  }
  if (topography::count_holes(topography) > 0) picture.transparent = std::uint16_t{0};
  Remarks remarks = remarks_of(topography);
  remarks["ZMin"] = fmt::format("{:.17g}", range.least);
  remarks["ZMax"] = fmt::format("{:.17g}", range.most);
  for (const auto& [key, text] : remarks) picture.remarks[std::string(kPrefix) + key] = text;
  io::write_png(picture, file);
}

std::string note_png(const topography::Topography& topography) {
  const double step = step_of(range_of(topography));
  return fmt::format(
      "16 bits: heights in steps of {}; for programs that read counts <z_scale={:.9g}um>, "
      "pixel {:.9g} x {:.9g} um",
      format_si(step, "m"), step * 1e6, topography.grid.dx() * 1e6, topography.grid.dy() * 1e6);
}

}  // namespace tabor::scan::format
