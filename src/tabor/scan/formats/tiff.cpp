// TIFF with grey values as counts: the user must say what a count and a pixel are, but for files of
// tabor, which note them in the tag ImageDescription.
#include "tabor/io/image/tiff.hpp"

#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/stated.hpp"

namespace tabor::scan::format {
namespace {

/// Microscopes keep heights in tags of their own beside a picture: those are Gwyddion's matter.
void require_plain_grey(const Contents& contents, const io::TiffDescription& image) {
  if (image.is_grey && !image.has_park_tags) return;
  throw Unrecognised(contents,
                     image.has_park_tags
                         ? "a TIFF of a Park microscope"
                         : "a TIFF that is no plain grey picture (colours or alpha)",
                     "save heights as 16-bit grey");
}

constexpr std::string_view kOwn = "tabor heights";

/// The remarks behind the first line of a description that tabor wrote.
Remarks remarks_in(const std::string& text) {
  Remarks remarks;
  if (!text.starts_with(kOwn)) return remarks;
  for (const std::string& line : split(text, '\n')) {
    const std::size_t equals = line.find(" = ");
    if (equals != std::string::npos) remarks[line.substr(0, equals)] = line.substr(equals + 3);
  }
  return remarks;
}

}  // namespace

Match identify_tiff(std::string_view head) {
  for (const std::string_view magic :
       {std::string_view("II*\0", 4), std::string_view("MM\0*", 4), std::string_view("II+\0", 4),
        std::string_view("MM\0+", 4)}) {
    if (head.starts_with(magic)) return Match::maybe;
  }
  return Match::no;
}

Document open_tiff(const Contents& contents) {
  const io::TiffDescription image = io::describe_tiff(contents.file);
  require_plain_grey(contents, image);
  const std::size_t ratio = image.is_compressed ? kLargestDeflateRatio : 1;
  check_packed_size(contents, static_cast<double>(image.nx), static_cast<double>(image.ny),
                    contents.bytes.size(), ratio,
                    static_cast<std::size_t>(std::max(1, image.bits / 8)));
  Document document{.format = "tiff"};
  if (image.n_images > 1) {
    document.warnings.push_back(fmt::format("only the first of {} images is read", image.n_images));
  }
  if (image.bits < 16) {
    document.warnings.push_back(
        fmt::format("Heights are coarse, with only {} bits per pixel", image.bits));
  }
  if (image.white_is_zero) {
    document.warnings.push_back("White is zero in this picture, so dark pixels are high");
  }
  Layer layer{
      .name = "grey values", .is_count = true, .nx = image.nx, .ny = image.ny, .load = [contents] {
        return io::read_tiff(contents.file,
                             [&contents](double share) { contents.finished({}, share); });
      }};
  if (image.is_float) take_remarks(remarks_in(image.text), layer);
  document.layers.push_back(std::move(layer));
  return document;
}

void write_tiff(const topography::Topography& topography, const std::filesystem::path& file) {
  std::string text(kOwn);
  for (const auto& [key, value] : remarks_of(topography)) text += "\n" + key + " = " + value;
  io::write_tiff(topography.height, text, file);
}

std::string note_tiff(const topography::Topography&) { return "heights in single precision, in m"; }

}  // namespace tabor::scan::format
