// Writing X3P: ISO 25178-72 (formerly ISO 5436-2).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/text/xml.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
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

/// ISO 25178-72 wants dates where nobody knows one.
constexpr std::string_view kUnknownDate = "1970-01-01T00:00:00";

/// When it was measured, if that is known as the standard writes it (xsd:dateTime).
std::string_view date_of(const topography::Topography& topography) {
  const auto date = topography.metadata.find("Date");
  if (date == topography.metadata.end()) return kUnknownDate;
  const std::string_view text = date->second;
  const auto is_like = [&](std::string_view pattern) {
    return text.size() >= pattern.size() &&
           std::equal(pattern.begin(), pattern.end(), text.begin(), [](char wanted, char c) {
             return wanted == '0' ? c >= '0' && c <= '9' : c == wanted;
           });
  };
  const bool is_date_time = is_like("0000-00-00T00:00:00") &&
                            text.find_first_not_of("0123456789.:+-TZ") == std::string_view::npos;
  return is_date_time ? text : kUnknownDate;
}

std::string text_xml(const std::string& text) { return io::xml_escape(writable_text(text)); }

std::string record2(const topography::Topography& topography) {
  return fmt::format(
      "  <Record2>\n    <Date>{0}</Date>\n    <Instrument>\n"
      "      <Manufacturer>{1}</Manufacturer>\n      <Model>not available</Model>\n"
      "      <Serial>not available</Serial>\n      <Version>not available</Version>\n"
      "    </Instrument>\n    <CalibrationDate>{3}</CalibrationDate>\n    <ProbingSystem>\n"
      "      <Type>Software</Type>\n      <Identification>not available</Identification>\n"
      "    </ProbingSystem>\n    <Comment>{2}</Comment>\n  </Record2>\n",
      date_of(topography),
      text_xml(topography.instrument.empty() ? "not available" : topography.instrument),
      text_xml(topography.source), kUnknownDate);
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
std::string valid_bits(const topography::Topography& topography) {
  if (topography::count_holes(topography) == 0) return "";
  const Field& height = topography.height;
  std::string bits(static_cast<std::size_t>(height.size() + 7) / 8, '\0');
  for (Index i = 0; i < height.size(); ++i) {
    char& byte = bits[static_cast<std::size_t>(i / 8)];
    if (!std::isnan(height.data()[i])) byte = static_cast<char>(byte | (1 << (i % 8)));
  }
  return bits;
}

}  // namespace

void write_x3p(const topography::Topography& topography, const std::filesystem::path& file) {
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

}  // namespace tabor::scan::format
