#include "support/exchange_files.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "support/byte_file.hpp"
#include "support/instrument_files.hpp"
#include "support/sample_map.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::test {
namespace {

/// Appends the parts of a NetCDF header, big-endian, texts padded to 4 bytes.
class Netcdf {
 public:
  explicit Netcdf(int version) : version_(version) {
    file_.text(0, "CDF").append(static_cast<std::uint8_t>(version));
    count(0);
  }

  template <typename T>
  Netcdf& big(T value) {
    file_.big_endian(file_.bytes().size(), value);
    return *this;
  }
  /// A count, of 8 bytes in version 5.
  Netcdf& count(std::uint32_t value) {
    return version_ == 5 ? big(std::uint64_t{value}) : big(value);
  }
  /// An offset, of 4 bytes in version 1.
  Netcdf& offset(std::uint32_t value) {
    return version_ == 1 ? big(value) : big(std::uint64_t{value});
  }
  Netcdf& list(std::uint32_t tag, std::uint32_t n) { return big(tag).count(n); }
  Netcdf& name(const std::string& text) {
    count(static_cast<std::uint32_t>(text.size()));
    return padded(text);
  }
  Netcdf& text(const std::string& key, const std::string& value) {
    return name(key).big(std::uint32_t{2}).name(value);
  }
  Netcdf& number(const std::string& key, double value) {
    return name(key).big(std::uint32_t{6}).count(1).big(value);
  }
  Netcdf& axis(const std::string& key, std::uint32_t id, double length) {
    name(key).count(1).count(id).list(12, 2).number("length", length).text("unit", "um");
    return big(std::uint32_t{6}).count(0).offset(0);  // its values are not read
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(file_.bytes().size()); }
  const std::string& bytes() const { return file_.bytes(); }

 private:
  Netcdf& padded(std::string text) {
    text.resize((text.size() + 3) / 4 * 4, '\0');
    file_.text(file_.bytes().size(), text);
    return *this;
  }

  int version_;
  ByteFile file_;
};

std::string name(const std::string& text) {
  ByteFile file;
  file.append(static_cast<std::uint32_t>(text.size())).text(4, text);
  return file.bytes();
}

/// A length in four bytes, and what it belongs to.
std::string with_length(const std::string& content) {
  ByteFile file;
  file.append(std::uint8_t{4}).append(static_cast<std::uint32_t>(content.size()));
  return file.bytes() + content;
}

std::string item(const std::string& key, char kind, const std::string& content) {
  return name(key) + kind + content;
}

const std::string kEnd = name("") + "\x7f\xff\xff";

std::string folder(const std::string& key, const std::string& items) {
  return item(key, '\x7d', with_length(items + kEnd));
}

std::string quantity(const std::string& key, double value, const std::string& unit) {
  ByteFile number;
  number.append(value);
  return item(key, '\x13', with_length(number.bytes() + name(unit) + name(unit)));
}

std::string zygo_header(const std::string& first_line) {
  return first_line +
         "\n1 8 3 5 \"Mon Jan 01 00:00:00 2024\"\n0 0 2 1 1 255\n10 20 3 2\n\"a # b\"\n\"\"\n"
         "\"\"\n0 0.5 6e-07 0 1 0 2e-06 1700000000\n640 480 5 0 0 0 \"10X\"\n"
         "0 0 0 0 0 0 0 0.1 0 0\n0 0 0 0 0 0 0 0 0\n0 \"\"\n1 0\n\"\"\n#\n";
}

/// Cells of a sheet in rows, "" for none.
std::string sheet(const std::vector<std::vector<std::pair<std::string, std::string>>>& rows) {
  std::string xml = "<worksheet><sheetData>";
  for (const auto& row : rows) {
    xml += "<row>";
    for (const auto& [place, value] : row) {
      const bool is_text = value.find_first_not_of("0123456789.-") != std::string::npos;
      xml += is_text ? "<c r=\"" + place + "\" t=\"inlineStr\"><is><t>" + value + "</t></is></c>"
                     : "<c r=\"" + place + "\"><v>" + value + "</v></c>";
    }
    xml += "</row>";
  }
  return xml + "</sheetData></worksheet>";
}

}  // namespace

std::string netcdf(int version) {
  const auto layout = [version](std::uint32_t mask_begin, std::uint32_t heights_begin) {
    Netcdf file(version);
    file.list(10, 2).name("x").count(3).name("y").count(2);
    file.list(12, 1).text("json", "{\"name\": \"sheet\", \"instrument\": {\"name\": \"WLI\"}}");
    file.list(11, 4).axis("x", 0, 6).axis("y", 1, 8);
    file.name("mask").count(2).count(0).count(1).list(0, 0);
    file.big(std::uint32_t{1}).count(8).offset(mask_begin);
    file.name("heights").count(2).count(0).count(1).list(12, 1).text("unit", "um");
    file.big(std::uint32_t{6}).count(48).offset(heights_begin);
    return file;
  };
  const std::uint32_t begin = layout(0, 0).size();
  Netcdf file = layout(begin, begin + 8);
  for (const int is_hole : {0, 0, 0, 0, 0, 1, 0, 0}) file.big(static_cast<std::uint8_t>(is_hole));
  for (const double z : {1, 4, 2, 5, 3, 99}) file.big(z);
  return file.bytes();
}

std::string netcdf_line() {
  const auto layout = [](std::uint32_t x_begin, std::uint32_t heights_begin) {
    Netcdf file(2);
    file.list(10, 1).name("n").count(4).list(0, 0).list(11, 2);
    file.name("x").count(1).count(0).list(12, 1).text("unit", "um");
    file.big(std::uint32_t{6}).count(32).offset(x_begin);
    file.name("heights").count(1).count(0).list(0, 0);
    file.big(std::uint32_t{6}).count(32).offset(heights_begin);
    return file;
  };
  const std::uint32_t begin = layout(0, 0).size();
  Netcdf file = layout(begin, begin + 32);
  for (const double value : {0.0, 1.0, 3.0, 4.5, 1.0, 2.0, 0.0, 3.0}) file.big(value);
  return file.bytes();
}

std::string opdx() {
  ByteFile matrix;
  matrix.append<std::uint32_t>(2).append<std::uint32_t>(3);
  for (const float value : {1.f, 2.f, 3.f, 4.f, 5.f, static_cast<float>(kNaN)}) {
    matrix.append(value);
  }
  const std::string map = quantity("Dimension1Extent", 4, "\xc2\xb5m") +
                          quantity("Dimension2Extent", 4, "\xc2\xb5m") +
                          quantity("DataScale", 0.5, "nm") +
                          item("Matrix", '\0',
                               name("Matrix<float>") + std::string(4, '\0') + name("WykoData.dll") +
                                   with_length(matrix.bytes()));
  const std::string settings =
      folder("MeasurementSettings", item("InstrumentName", '\x12', with_length("GT-K")));
  return std::string("VCA DATA\x01\0\0\x55", 12) + folder("MetaData", settings) +
         folder("2D_Data", folder("Raw", map));
}

std::string opdx_number(const std::string& name, double value) {
  ByteFile number;
  number.append(value);
  return std::string("VCA DATA\x01\0\0\x55", 12) +
         folder("2D_Data", folder("Raw", item(name, '\x0d', number.bytes())));
}

std::string zygo_points() {
  return zygo_header("Zygo XYZ Data File - Format 1") +
         "10 20 1\n11 20 2\n12 20 3\n10 21 4\n11 21 5\n12 21 No Data\n#";
}

std::string zygo_counts() {
  return zygo_header("Zygo ASCII Data File - Format 2") + "7 7\n#\n1 2 3 4\n5 2147483640\n#";
}

std::string container(const std::string& index) {
  const std::string text =
      index.ends_with(".yml")
          ? "surfaces:\n- name: sheet\n  topographies:\n  - name: \"spot 1\"\n"
            "    datafile: {original: spot.xyz, squeezed-netcdf: spot-squeezed.nc}\n"
            "    size: !!python/tuple [6.0, 8.0]\n    unit: \"\\xB5m\"\n"
            "    detrend_mode: height\n    fill_undefined_data_mode: harmonic\n"
          : "{\"surfaces\": [{\"name\": \"sheet\", \"topographies\": [{\"name\": \"spot 1\", "
            "\"datafile\": {\"squeezed-netcdf\": \"spot-squeezed.nc\"}, \"size\": [6, 8], "
            "\"unit\": \"um\"}]}]}";
  return io::zip({{index, text}, {"spot-squeezed.nc", netcdf()}});
}

std::string container_of_original(const std::string& name, const std::string& bytes,
                                  const std::string& size) {
  const std::string index = fmt::format(
      "{{\"surfaces\": [{{\"name\": \"sheet\", \"topographies\": [{{\"name\": \"spot\", "
      "\"datafile\": {{\"original\": \"{}\"}}, \"size\": {}, \"unit\": \"um\", "
      "\"height_scale\": 0.5}}]}}]}}",
      name, size);
  return io::zip({{"index.json", index}, {name, bytes}});
}

std::string mitutoyo() {
  const char* book =
      "<workbook xmlns:r=\"x\"><sheets><sheet name=\"Certificate\" sheetId=\"1\" r:id=\"rId1\"/>"
      "<sheet name=\"DATA\" sheetId=\"2\" r:id=\"rId2\"/></sheets></workbook>";
  const char* links =
      "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/>"
      "<Relationship Id=\"rId2\" Target=\"/xl/worksheets/sheet2.xml\"/></Relationships>";
  const char* texts =
      "<sst><si><t>2.5mm</t></si><si><r><t>Ra </t></r><r><t>3.3 um</t></r></si></sst>";
  const std::string certificate =
      "<worksheet><sheetData><row><c r=\"E48\" t=\"s\"><v>0</v></c></row></sheetData></worksheet>";
  std::string data = sheet({{{"A1", "?"}, {"E1", "0.1"}, {"F1", "1"}},
                            {{"E2", "0.2"}, {"F2", "2"}},
                            {{"E3", "0.3"}, {"F3", "4"}},
                            {{"E4", "0.4"}, {"F4", "8"}}});
  const std::string text_cell = "<c r=\"A1\" t=\"inlineStr\"><is><t>?</t></is></c>";
  data.replace(data.find(text_cell), text_cell.size(), "<c r=\"A1\" t=\"s\"><v>1</v></c>");
  return io::zip({{"xl/workbook.xml", book},
                  {"xl/_rels/workbook.xml.rels", links},
                  {"xl/sharedStrings.xml", texts},
                  {"xl/worksheets/sheet1.xml", certificate},
                  {"xl/worksheets/sheet2.xml", data}});
}

std::string layered_sur() {
  constexpr int kWithIntensity = 11;
  std::string surface = sur("DIGITAL SURF", 16, kWithIntensity);
  std::string intensity = sur("DIGITAL SURF", 16, 10);
  surface[14] = 2;  // objects
  intensity.replace(212, 2, std::string(2, '\0'));
  const std::string data = plain_sur().substr(surface.size());
  return surface + data + intensity + data;
}

}  // namespace tabor::test
