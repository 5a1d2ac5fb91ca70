// X3P: ISO 25178-72 (formerly ISO 5436-2), a ZIP archive of main.xml and binary data.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/digest.hpp"
#include "tabor/io/xml.hpp"
#include "tabor/io/zip.hpp"
#include "tabor/topography/formats/bytes.hpp"
#include "tabor/topography/formats/readers.hpp"

namespace tabor::topography::format {
namespace {

constexpr std::size_t kMaxXml = std::size_t{64} << 20;

struct Axis {
  std::string type;  ///< I = incremental, A = absolute
  Sample sample = Sample::f64;
  double increment = 1;
  double offset = 0;
};

/// Everything main.xml says about one matrix of heights.
struct Matrix {
  Axis x, y, z;
  Index nx = 0;
  Index ny = 0;
  Index n_layers = 1;
  std::size_t size() const { return static_cast<std::size_t>(nx * ny * n_layers); }
};

/// The archive and its main.xml, wherever the folder of the latter is.
struct Archive {
  const Contents* contents;
  io::ZipReader zip;
  std::string folder;

  const io::ZipEntry* find(std::string link) const {
    std::replace(link.begin(), link.end(), '\\', '/');
    while (link.starts_with("./") || link.starts_with("/")) link.erase(0, link.find('/') + 1);
    for (const io::ZipEntry& entry : zip.entries()) {
      if (entry.name == folder + link) return &entry;
    }
    return nullptr;
  }

  std::string read(const std::string& link, std::size_t size) const {
    const io::ZipEntry* entry = find(link);
    if (entry == nullptr) {
      refuse(*contents, "no entry '" + link + "'", "the data main.xml links to", kDamaged);
    }
    if (entry->size != size) {
      refuse(*contents, fmt::format("{} of {} bytes", link, entry->size),
             fmt::format("{} bytes as main.xml says", size), kDamaged);
    }
    return zip.read(*entry, size);
  }
};

/// Empty and missing numbers mean the default (ISO 25178-72 makes both optional).
double number(const Contents& contents, const io::XmlElement& element, double fallback) {
  if (element.text().empty()) return fallback;
  const auto value = parse_number(element.text());
  if (!value || !std::isfinite(*value)) {
    refuse(contents, "'" + element.text() + "' in <" + element.name() + ">", "a finite number",
           kDamaged);
  }
  return *value;
}

Sample sample_of(const Contents& contents, const std::string& type) {
  if (type == "I") return Sample::i16;
  if (type == "L") return Sample::i32;
  if (type == "F") return Sample::f32;
  if (type == "D" || type.empty()) return Sample::f64;
  refuse(contents, "data type '" + type + "'", "I, L, F or D", kDamaged);
}

Axis axis(const Contents& contents, const io::XmlElement& root, const std::string& name) {
  const io::XmlElement element = root.at("Record1/Axes/" + name);
  if (!element) refuse(contents, "no axis " + name + " in main.xml", "Record1/Axes", kDamaged);
  return {.type = element.at("AxisType").text(),
          .sample = sample_of(contents, element.at("DataType").text()),
          .increment = number(contents, element.at("Increment"), 1),
          .offset = number(contents, element.at("Offset"), 0)};
}

void require_matrix(const Contents& contents, const io::XmlElement& root) {
  const std::string feature = root.at("Record1/FeatureType").text();
  if (feature == "PCL" || root.at("Record3/ListDimension")) {
    refuse(contents, "a point cloud (FeatureType " + feature + ")", "a matrix of heights",
           "put the points on a regular grid first, for example with Gwyddion");
  }
}

Matrix describe(const Contents& contents, const io::XmlElement& root) {
  require_matrix(contents, root);
  Matrix matrix{.x = axis(contents, root, "CX"),
                .y = axis(contents, root, "CY"),
                .z = axis(contents, root, "CZ")};
  for (const Axis* lateral : {&matrix.x, &matrix.y}) {
    if (lateral->type == "A") {
      refuse(contents, "a lateral axis with its own list of coordinates (AxisType A)",
             "evenly spaced rows and columns (AxisType I)", "resample it first");
    }
  }
  const io::XmlElement dimension = root.at("Record3/MatrixDimension");
  const double nx = number(contents, dimension.at("SizeX"), 0);
  const double ny = number(contents, dimension.at("SizeY"), 0);
  const double n_layers = number(contents, dimension.at("SizeZ"), 1);
  // A deflate stream unpacks to at most 1032 times its size; no sample is smaller than a byte.
  const std::size_t most = 1032 * contents.bytes.size();
  check_size(contents, nx, ny, most);
  check_size(contents, nx * ny, n_layers, most);
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
    refuse(contents, fmt::format("{} heights in main.xml", items.size()),
           fmt::format("{}", matrix.size()), kDamaged);
  }
  std::vector<double> values;
  for (const io::XmlElement& item : items) {
    const std::string text = split(item.text(), ';').back();
    const auto value = parse_number(text);
    if (!value && !text.empty()) refuse(contents, "'" + text + "'", "a height", kDamaged);
    values.push_back(value.value_or(kHole));
  }
  return values;
}

void apply_valid_points(std::vector<double>& values, const std::string& bits) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool valid = (static_cast<unsigned char>(bits[i / 8]) >> (i % 8)) & 1u;
    if (!valid) values[i] = kHole;
  }
}

void compare_digest(const std::string& bytes, const io::XmlElement& expected, Document& document) {
  const std::string digest = io::md5(std::as_bytes(std::span(bytes)));
  if (expected.text().size() == digest.size() && lower(expected.text()) != digest) {
    document.doubts.push_back("the data do not match their MD5 checksum: changed after export");
  }
}

std::vector<double> linked(const Archive& archive, const io::XmlElement& link, const Matrix& matrix,
                           Document& document) {
  const Raster raster{
      .sample = matrix.z.sample, .nx = matrix.nx, .ny = matrix.ny * matrix.n_layers};
  const std::string bytes = archive.read(link.at("PointDataLink").text(), byte_size(raster));
  compare_digest(bytes, link.at("MD5ChecksumPointData"), document);
  const Field decoded = decode(bytes, raster);
  std::vector<double> values(decoded.data(), decoded.data() + decoded.size());
  const std::string valid_link = link.at("ValidPointsLink").text();
  if (!valid_link.empty()) {
    apply_valid_points(values, archive.read(valid_link, (matrix.size() + 7) / 8));
  }
  return values;
}

void add_layers(Document& document, const Contents& contents, const Matrix& matrix,
                std::vector<double> values) {
  const auto shared = std::make_shared<const std::vector<double>>(std::move(values));
  for (Index k = 0; k < matrix.n_layers; ++k) {
    const auto load = [shared, matrix, k]() -> Field {
      const Index n = matrix.nx * matrix.ny;
      const Field raw = Eigen::Map<const Field>(shared->data() + k * n, matrix.ny, matrix.nx);
      return raw * matrix.z.increment + matrix.z.offset;
    };
    document.layers.push_back({.name = matrix.n_layers > 1 ? fmt::format("layer {}", k) : "height",
                               .unit = "m",
                               .nx = matrix.nx,
                               .ny = matrix.ny,
                               .pixel_x = checked_pixel(contents, matrix.x.increment),
                               .pixel_y = checked_pixel(contents, matrix.y.increment),
                               .load = load});
  }
}

/// Maker and model; ISO 25178-72 wants both filled in, so that writers without either put a phrase.
std::string instrument_of(const io::XmlElement& root) {
  const io::XmlElement instrument = root.at("Record2/Instrument");
  std::string name;
  for (const char* part : {"Manufacturer", "Model"}) {
    const std::string text(trim(instrument.at(part).text()));
    if (!text.empty() && lower(text) != "not available") {
      name += (name.empty() ? "" : " ") + text;
    }
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

Archive open_archive(const Contents& contents) {
  Archive archive{&contents, io::ZipReader(contents.bytes, contents.file.string()), ""};
  for (const io::ZipEntry& entry : archive.zip.entries()) {
    const bool is_main = entry.name == "main.xml" || entry.name.ends_with("/main.xml");
    if (is_main && !entry.name.starts_with("__MACOSX")) {
      archive.folder = entry.name.substr(0, entry.name.size() - std::string("main.xml").size());
      return archive;
    }
  }
  throw Unrecognised(contents, "a ZIP archive without main.xml, so no X3P file",
                     "unpack it if it holds several files");
}

}  // namespace

Match identify_x3p(std::string_view head) {
  return head.starts_with("PK\x03\x04") ? Match::maybe : Match::no;
}

Document open_x3p(const Contents& contents) {
  const Archive archive = open_archive(contents);
  const std::string text = archive.zip.read(*archive.find("main.xml"), kMaxXml);
  const io::XmlDocument xml(text, contents.file.string() + ": main.xml");
  const io::XmlElement root = xml.root();
  Document document{.format = "x3p", .instrument = instrument_of(root)};
  add_metadata(document, root);
  const Matrix matrix = describe(contents, root);
  const io::XmlElement link = root.at("Record3/DataLink");
  const io::XmlElement list = root.at("Record3/DataList");
  if (!link && !list) refuse(contents, "no data in main.xml", "DataLink or DataList", kDamaged);
  add_layers(document, contents, matrix,
             link ? linked(archive, link, matrix, document) : listed(contents, list, matrix));
  return document;
}

namespace {

std::string axis_xml(const char* name, char type, double increment) {
  return fmt::format(
      "      <{0}>\n        <AxisType>{1}</AxisType>\n        <DataType>D</DataType>\n"
      "        <Increment>{2:.17g}</Increment>\n        <Offset>0</Offset>\n      </{0}>\n",
      name, type, increment);
}

std::string record1(const Grid& grid) {
  return "  <Record1>\n    <Revision>ISO5436 - 2000</Revision>\n"
         "    <FeatureType>SUR</FeatureType>\n    <Axes>\n" +
         axis_xml("CX", 'I', grid.dx()) + axis_xml("CY", 'I', grid.dy()) + axis_xml("CZ", 'A', 1) +
         "    </Axes>\n  </Record1>\n";
}

std::string record2(const Topography& topography) {
  const auto date = topography.metadata.find("Date");
  const std::string when = date == topography.metadata.end() ? "1970-01-01T00:00:00" : date->second;
  return fmt::format(
      "  <Record2>\n    <Date>{0}</Date>\n    <Instrument>\n"
      "      <Manufacturer>{1}</Manufacturer>\n      <Model>not available</Model>\n"
      "      <Serial>not available</Serial>\n      <Version>not available</Version>\n"
      "    </Instrument>\n    <CalibrationDate>{0}</CalibrationDate>\n    <ProbingSystem>\n"
      "      <Type>Software</Type>\n      <Identification>not available</Identification>\n"
      "    </ProbingSystem>\n    <Comment>{2}</Comment>\n  </Record2>\n",
      io::xml_escape(when),
      io::xml_escape(topography.instrument.empty() ? "not available" : topography.instrument),
      io::xml_escape(topography.source));
}

std::string record3(const Grid& grid, const std::string& data, const std::string& valid) {
  const auto digest = [](const std::string& bytes) {
    return io::md5(std::as_bytes(std::span(bytes)));
  };
  std::string links = fmt::format(
      "      <PointDataLink>bindata/data.bin</PointDataLink>\n"
      "      <MD5ChecksumPointData>{}</MD5ChecksumPointData>\n",
      digest(data));
  if (!valid.empty()) {
    links += fmt::format(
        "      <ValidPointsLink>bindata/valid.bin</ValidPointsLink>\n"
        "      <MD5ChecksumValidPoints>{}</MD5ChecksumValidPoints>\n",
        digest(valid));
  }
  return fmt::format(
      "  <Record3>\n    <MatrixDimension>\n      <SizeX>{}</SizeX>\n      <SizeY>{}</SizeY>\n"
      "      <SizeZ>1</SizeZ>\n    </MatrixDimension>\n    <DataLink>\n{}    </DataLink>\n"
      "  </Record3>\n",
      grid.nx, grid.ny, links);
}

/// One bit per pixel, lowest bit first, 1 = valid; empty if there are no holes.
std::string valid_bits(const Topography& topography) {
  if (count_holes(topography) == 0) return "";
  const Field& height = topography.height;
  std::string bits(static_cast<std::size_t>(height.size() + 7) / 8, '\0');
  for (Index i = 0; i < height.size(); ++i) {
    char& byte = bits[static_cast<std::size_t>(i / 8)];
    if (!std::isnan(height.data()[i])) byte = static_cast<char>(byte | (1 << (i % 8)));
  }
  return bits;
}

}  // namespace

void write_x3p(const Topography& topography, const std::filesystem::path& file) {
  std::string data;
  put_field(data, topography.height);
  std::string valid = valid_bits(topography);
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n" +
      record1(topography.grid) + record2(topography) + record3(topography.grid, data, valid) +
      "  <Record4>\n    <ChecksumFile>md5checksum.hex</ChecksumFile>\n  </Record4>\n"
      "</p:ISO5436_2>\n";
  const std::string checksum = io::md5(std::as_bytes(std::span(xml))) + " *main.xml\n";
  std::vector<io::ZipContent> files{{"main.xml", xml}, {"md5checksum.hex", checksum}};
  if (!valid.empty()) files.push_back({"bindata/valid.bin", std::move(valid)});
  files.push_back({"bindata/data.bin", std::move(data)});
  io::write_file(file, std::string_view(io::zip(files)));
}

}  // namespace tabor::topography::format
