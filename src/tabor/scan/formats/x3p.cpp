// X3P: ISO 25178-72 (formerly ISO 5436-2), a ZIP archive of main.xml and binary data.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "tabor/core/rows.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/text/xml.hpp"
#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kMain = "main.xml";

struct Axis {
  std::string type;  ///< I = incremental, A = absolute
  Sample sample = Sample::f64;
  std::optional<double> increment;  ///< [m]; the standard's default is 1
  double offset = 0;
  std::string said;  ///< the increment as it stands
};

/// Everything main.xml says about one matrix of heights.
struct Matrix {
  Axis x, y, z;
  Index nx = 0;
  Index ny = 0;
  Index n_layers = 1;
  std::size_t size() const { return static_cast<std::size_t>(nx * ny * n_layers); }
};

/// Nothing for an empty or missing element (ISO 25178-72 makes both optional).
std::optional<double> number(const Contents& contents, const io::XmlElement& element) {
  if (element.text().empty()) return std::nullopt;
  const auto value = parse_number(element.text());
  if (!value || !std::isfinite(*value)) {
    reject(contents, "'" + element.text() + "' in <" + element.name() + ">", "a finite number",
           kDamaged);
  }
  return *value;
}

Sample sample_of(const Contents& contents, const std::string& type) {
  if (type == "I") return Sample::i16;
  if (type == "L") return Sample::i32;
  if (type == "F") return Sample::f32;
  if (type == "D" || type.empty()) return Sample::f64;
  reject(contents, "data type '" + type + "'", "I, L, F or D", kDamaged);
}

Axis axis(const Contents& contents, const io::XmlElement& root, const std::string& name) {
  const io::XmlElement element = root.at("Record1/Axes/" + name);
  if (!element) reject(contents, "no axis " + name + " in main.xml", "Record1/Axes", kDamaged);
  // What an increment of pixels cannot be the user may put right; a height scale has no such way.
  const io::XmlElement increment = element.at("Increment");
  const bool is_lateral = name != "CZ";
  return {.type = element.at("AxisType").text(),
          .sample = sample_of(contents, element.at("DataType").text()),
          .increment = is_lateral ? stated_number(increment.text()) : number(contents, increment),
          .offset = number(contents, element.at("Offset")).value_or(0),
          .said = fmt::format("Increment {} of axis {}", increment.text(), name)};
}

void require_matrix(const Contents& contents, const io::XmlElement& root) {
  const std::string feature = root.at("Record1/FeatureType").text();
  if (feature == "PCL" || root.at("Record3/ListDimension")) {
    const std::string what = feature == "PCL" ? "a point cloud" : "a list of points";
    reject(contents, what + " (FeatureType " + feature + ")", "a matrix of heights",
           "put the points on a regular grid first, for example with Gwyddion");
  }
}

/// How many heights the file claims to hold, in main.xml or in the entry that it links to.
std::size_t n_samples_of(const Contents& contents, const Archive& archive,
                         const io::XmlElement& root) {
  const std::string link = root.at("Record3/DataLink/PointDataLink").text();
  const io::XmlElement list = root.at("Record3/DataList");
  if (!link.empty()) {
    const std::string type = root.at("Record1/Axes/CZ/DataType").text();
    return archive.find(link).size / size_of(sample_of(contents, type));
  }
  if (!list) reject(contents, "no data in main.xml", "DataLink or DataList", kDamaged);
  return list.children("Datum").size();
}

Matrix describe(const Contents& contents, const io::XmlElement& root, std::size_t n_samples) {
  Matrix matrix{.x = axis(contents, root, "CX"),
                .y = axis(contents, root, "CY"),
                .z = axis(contents, root, "CZ")};
  for (const Axis* lateral : {&matrix.x, &matrix.y}) {
    if (lateral->type == "A") {
      reject(contents, "a lateral axis with its own list of coordinates (AxisType A)",
             "evenly spaced rows and columns (AxisType I)", "resample it first");
    }
    if (lateral->type != "I" && !lateral->type.empty()) {
      reject(contents, "AxisType '" + lateral->type + "'", "I or A", kDamaged);
    }
  }
  if (matrix.z.increment == 0) {
    reject(contents, "heights with an Increment of 0", "another number", kDamaged);
  }
  const io::XmlElement dimension = root.at("Record3/MatrixDimension");
  const double nx = number(contents, dimension.at("SizeX")).value_or(0);
  const double ny = number(contents, dimension.at("SizeY")).value_or(0);
  const double n_layers = number(contents, dimension.at("SizeZ")).value_or(1);
  check_size(contents, nx, ny, n_samples);
  check_size(contents, nx * ny, n_layers, n_samples);
  check_packed_size(contents, nx * ny, n_layers, contents.bytes.size(), kLargestDeflateRatio, 1);
  constexpr double kMostLayers = 1000;  // far more than instruments write; each takes memory
  if (n_layers > kMostLayers) {
    reject(contents, fmt::format("{} layers", n_layers), fmt::format("at most {}", kMostLayers));
  }
  matrix.nx = static_cast<Index>(nx);
  matrix.ny = static_cast<Index>(ny);
  matrix.n_layers = static_cast<Index>(n_layers);
  return matrix;
}

/// Heights listed in main.xml itself; an empty element is a hole, "x;y;z" gives z.
std::vector<double> listed(const Contents& contents, const io::XmlElement& list,
                           const Matrix& matrix) {
  const std::vector<io::XmlElement> items = list.children("Datum");
  if (items.size() != matrix.size()) {
    reject(contents, fmt::format("{} heights in main.xml", items.size()),
           fmt::format("{}", matrix.size()), kDamaged);
  }
  std::vector<double> values;
  for (const io::XmlElement& item : items) {
    const std::string text = split(item.text(), ';').back();
    const auto value = parse_number(text);
    if (!value && !text.empty()) reject(contents, "'" + text + "'", "a height", kDamaged);
    values.push_back(value.value_or(kHole));
  }
  return values;
}

/// Entries of the archive that hold the heights.
struct Links {
  const io::ZipEntry* data = nullptr;
  const io::ZipEntry* valid = nullptr;  ///< null: all points are valid
  std::string digest = {};              ///< MD5 of the data in hexadecimal, "" if there is none
  std::string valid_digest = {};
};

Raster raster_of(const Matrix& matrix) {
  return {.sample = matrix.z.sample, .nx = matrix.nx, .ny = matrix.ny};
}

std::string digest_of(const io::XmlElement& element) {
  constexpr std::size_t kDigits = 32;
  const std::string text = lower(element.text());
  return text.size() == kDigits ? text : "";
}

Links links_of(const Archive& archive, const io::XmlElement& link, const Matrix& matrix) {
  const std::size_t size = byte_size(raster_of(matrix)) * static_cast<std::size_t>(matrix.n_layers);
  Links links{.data = &archive.entry(link.at("PointDataLink").text(), size)};
  const std::string valid = link.at("ValidPointsLink").text();
  if (!valid.empty()) links.valid = &archive.entry(valid, (matrix.size() + 7) / 8);
  links.digest = digest_of(link.at("MD5ChecksumPointData"));
  links.valid_digest = digest_of(link.at("MD5ChecksumValidPoints"));
  return links;
}

/// One bit per point of all layers, lowest bit first, 1 = valid.
void apply_valid_points(Field& field, const std::string& bits, Index first_point) {
  for (Index i = 0; i < field.size(); ++i) {
    const auto point = static_cast<std::size_t>(first_point + i);
    const bool valid = (static_cast<unsigned char>(bits[point / 8]) >> (point % 8)) & 1u;
    if (!valid) field.data()[i] = kHole;
  }
}

/// Unpacks layer k, which follows the layers before it in the same entry.
Field unpack(const Archive& archive, const Links& links, const Matrix& matrix, Index k,
             std::vector<std::string>& warnings) {
  Field field(matrix.ny, matrix.nx);
  RowDecoder decoder(raster_of(matrix), field);
  io::RunningDigest digest(io::DigestKind::md5);
  std::size_t n_before = byte_size(raster_of(matrix)) * static_cast<std::size_t>(k);
  archive.read(*links.data, [&](std::string_view piece) {
    if (!links.digest.empty()) digest.add(piece);
    const std::size_t n_skipped = std::min(n_before, piece.size());
    n_before -= n_skipped;
    decoder.accept(piece.substr(n_skipped));
  });
  if (!links.digest.empty() && digest.hexadecimal() != links.digest) {
    warnings.push_back("The data do not match their MD5 checksum. They were changed after export");
  }
  if (links.valid != nullptr) {
    const std::string bits = archive.read(*links.valid);
    if (!links.valid_digest.empty() &&
        io::md5(std::as_bytes(std::span(bits))) != links.valid_digest) {
      warnings.push_back(
          "The valid points do not match their MD5 checksum. They were changed "
          "after export");
    }
    apply_valid_points(field, bits, k * matrix.nx * matrix.ny);
  }
  return field;
}

/// True if the file turns its axes in space; heights over the matrix are the same.
bool is_rotated(const Contents& contents, const io::XmlElement& root) {
  const io::XmlElement rotation = root.at("Record1/Axes/Rotation");
  for (int row = 1; row <= 3; ++row) {
    for (int column = 1; column <= 3; ++column) {
      const double unit = row == column ? 1 : 0;
      const auto element = number(contents, rotation.at(fmt::format("r{}{}", row, column)));
      if (std::abs(element.value_or(unit) - unit) > 1e-6) return true;
    }
  }
  return false;
}

/// Stored values of layer k.
using Load = std::function<Field(Index k, std::vector<std::string>& warnings)>;

/// Profiles need no second spacing.
const Axis& y_axis(const Matrix& matrix) {
  return matrix.ny == 1 && matrix.y.increment.value_or(0) == 0 ? matrix.x : matrix.y;
}

void add_layers(Document& document, const Matrix& matrix, const Load& load) {
  if (!matrix.z.increment && is_integer(matrix.z.sample)) {
    document.warnings.push_back(
        "Whole numbers without an Increment are read as heights in metres (ISO 25178-72)");
  }
  warn_of_negative_scale(matrix.z.increment.value_or(1), document);
  for (Index k = 0; k < matrix.n_layers; ++k) {
    Layer layer{.name = matrix.n_layers > 1 ? fmt::format("layer {}", k) : "height",
                .unit = "m",
                .nx = matrix.nx,
                .ny = matrix.ny,
                .pixel_x = matrix.x.increment,  // the standard's 1 m for none: no scan has that
                .pixel_y = y_axis(matrix).increment,
                .said_x = matrix.x.said,
                .said_y = y_axis(matrix).said};
    layer.late_warnings = std::make_shared<std::vector<std::string>>();
    layer.load = [load, k, z = matrix.z, warnings = layer.late_warnings] {
      Field field = load(k, *warnings);
      for_each_row(field.rows(), [&](Index y) {
        for (Index x = 0; x < field.cols(); ++x) {
          field(y, x) = field(y, x) * z.increment.value_or(1) + z.offset;
        }
      });
      return field;
    };
    document.layers.push_back(std::move(layer));
  }
}

/// Maker and model; ISO 25178-72 wants both filled in, so that writers without either put a phrase.
std::string instrument_of(const io::XmlElement& root) {
  const io::XmlElement instrument = root.at("Record2/Instrument");
  std::string name;
  for (const char* part : {"Manufacturer", "Model"}) {
    const std::string text(trim(instrument.at(part).text()));
    if (!text.empty() && lower(text) != "not available") name += (name.empty() ? "" : " ") + text;
  }
  return name;
}

void add_metadata(Document& document, const io::XmlElement& root) {
  for (const char* path : {"Record1/Revision", "Record2/Date", "Record2/Creator", "Record2/Comment",
                           "Record2/Instrument/Serial", "Record2/ProbingSystem/Identification"}) {
    const std::string text = root.at(path).text();
    if (!text.empty()) document.metadata[split(path, '/').back()] = text;
  }
}

}  // namespace

Match identify_x3p(std::string_view head) { return is_zip(head) ? Match::maybe : Match::no; }

Document open_x3p(const Contents& contents) {
  const auto archive = std::make_shared<const Archive>(contents, kMain, "X3P");
  const io::XmlDocument xml(archive->main(), contents.file.string() + ": main.xml");
  const io::XmlElement root = xml.root();
  Document document{.format = "x3p", .instrument = instrument_of(root)};
  add_metadata(document, root);
  require_matrix(contents, root);
  const Matrix matrix = describe(contents, root, n_samples_of(contents, *archive, root));
  if (is_rotated(contents, root)) {
    document.warnings.push_back(
        "The Rotation of the axes is not applied. Rows and heights are as stored");
  }
  const io::XmlElement link = root.at("Record3/DataLink");
  const io::XmlElement list = root.at("Record3/DataList");
  if (!link.at("PointDataLink").text().empty()) {
    const Links links = links_of(*archive, link, matrix);
    add_layers(document, matrix, [archive, links, matrix](Index k, auto& warnings) {
      return unpack(*archive, links, matrix, k, warnings);
    });
  } else {
    const auto values = std::make_shared<const std::vector<double>>(listed(contents, list, matrix));
    add_layers(document, matrix, [values, matrix](Index k, auto&) -> Field {
      return Eigen::Map<const Field>(values->data() + k * matrix.nx * matrix.ny, matrix.ny,
                                     matrix.nx);
    });
  }
  return document;
}

}  // namespace tabor::scan::format
