// PNG with grey values as counts: the user must say what a count and a pixel are.
#include "tabor/io/image/png.hpp"

#include <fmt/format.h>

#include <memory>

#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {

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
  document.layers.push_back({.name = "grey values",
                             .is_count = true,
                             .nx = counts->cols(),
                             .ny = counts->rows(),
                             .load = [counts] { return *counts; }});
  return document;
}

}  // namespace tabor::scan::format
