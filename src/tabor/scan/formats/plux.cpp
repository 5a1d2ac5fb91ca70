// PLUX, Sensofar's newer files: a ZIP archive of index.xml and raw layers.
#include <fmt/format.h>

#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/io/text/xml.hpp"
#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

// Real files have some ten items and one or two layers; finding the n-th takes n steps.
constexpr int kMostItems = 64;
constexpr int kMostLayers = 16;

double number(const Contents& contents, const io::XmlElement& general, const char* name) {
  const auto value = parse_number(general.at(name).text());
  if (!value) reject(contents, fmt::format("no number {}", name), "a PLUX index", kDamaged);
  return *value;
}

/// The instrument among the NAME and VALUE pairs of the index.
std::string device_of(const io::XmlElement& root) {
  for (int i = 0; i < kMostItems; ++i) {
    const io::XmlElement item = root.at(fmt::format("INFO/ITEM_{}", i));
    if (!item) return "Sensofar";
    if (item.at("NAME").text() == "Device") return "Sensofar " + item.at("VALUE").text();
  }
  return "Sensofar";
}

Field unpack(const Archive& archive, const io::ZipEntry& entry, const Raster& raster) {
  Field field(raster.ny, raster.nx);
  RowDecoder decoder(raster, field);
  archive.read(entry, [&decoder](std::string_view piece) { decoder.accept(piece); });
  return field;
}

}  // namespace

Match identify_plux(std::string_view head) { return is_zip(head) ? Match::maybe : Match::no; }

Document open_plux(const Contents& contents) {
  const auto archive = std::make_shared<const Archive>(contents, "index.xml", "PLUX");
  const io::XmlDocument xml(archive->main(), contents.file.string() + ": index.xml");
  const io::XmlElement root = xml.root();
  const io::XmlElement general = root.at("GENERAL");
  if (!general.at("IMAGE_SIZE_X")) {
    throw Unrecognised(contents, "an index.xml without an image size (so not PLUX)", "");
  }
  const double nx = number(contents, general, "IMAGE_SIZE_X");
  const double ny = number(contents, general, "IMAGE_SIZE_Y");
  check_packed_size(contents, nx, ny, contents.bytes.size(), kLargestDeflateRatio, sizeof(float));
  const Raster raster{
      .sample = Sample::f32, .nx = static_cast<Index>(nx), .ny = static_cast<Index>(ny)};
  Document document{.format = "plux", .instrument = device_of(root)};
  document.metadata["Date"] = general.at("DATE").text();
  for (int i = 0;; ++i) {
    const std::string file = root.at(fmt::format("LAYER_{}/FILENAME_Z", i)).text();
    if (file.empty()) break;
    if (i == kMostLayers) reject(contents, "more than 16 layers", "a PLUX index", kDamaged);
    const io::ZipEntry& entry = archive->entry(file, byte_size(raster));
    Layer layer{.name = fmt::format("layer {}", i), .unit = "um", .nx = raster.nx, .ny = raster.ny};
    const double um_x = number(contents, general, "FOV_X");
    const double um_y = number(contents, general, "FOV_Y");
    layer.pixel_x = um_x * 1e-6;
    layer.pixel_y = um_y * 1e-6;
    layer.said_x = fmt::format("FOV_X {:g}", um_x);
    layer.said_y = fmt::format("FOV_Y {:g}", um_y);
    layer.load = [archive, entry, raster] { return unpack(*archive, entry, raster); };
    document.layers.push_back(std::move(layer));
  }
  if (document.layers.empty()) {
    reject(contents, "no layer with heights (LAYER_0/FILENAME_Z)", "a height map", kDamaged);
  }
  return document;
}

}  // namespace tabor::scan::format
