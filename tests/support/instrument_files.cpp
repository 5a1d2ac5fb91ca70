#include "support/instrument_files.hpp"

#include <cstdint>
#include <utility>

#include "support/byte_file.hpp"
#include "support/sample_map.hpp"
#include "tabor/io/files/deflate.hpp"

namespace tabor::test {
namespace {

/// 3 x 2 map; what stands for the hole at its last pixel differs from format to format.
template <typename T>
ByteFile& append_counts(ByteFile& file, T missing) {
  for (const int value : {1, 2, 3, 4, 5}) file.append(static_cast<T>(value));
  return file.append(missing);
}

}  // namespace

std::string sur(const std::string& magic, int bits, int type) {
  ByteFile file(512);
  file.text(0, magic).number<std::int16_t>(14, 1).number<std::int16_t>(16, 1);
  file.number(18, static_cast<std::int16_t>(type)).text(20, "Roughness");
  file.number<std::int16_t>(86, 1).number(98, static_cast<std::int16_t>(bits));
  file.number<std::int32_t>(100, 1).number<std::int32_t>(104, 5);
  file.number<std::int32_t>(108, 3).number<std::int32_t>(112, 2).number<std::int32_t>(116, 6);
  file.number(120, 2.0f).number(124, 4.0f).number(128, 0.5f);
  file.text(180, "\xb5m").text(196, "\xc2\xb5m").text(212, "nm");
  file.number<std::uint16_t>(334, 4).number<std::uint16_t>(336, 2);
  file.number(474, 0.0f);
  file.text(512, "notexx");  // comment and private bytes
  return file.bytes();
}

std::string plain_sur() {
  ByteFile data;
  append_counts<std::int16_t>(data, -1);  // zmin - 2
  return sur("DIGITAL SURF", 16) + data.bytes();
}

std::string compressed_sur() {
  ByteFile data;
  append_counts<std::int32_t>(data, -1);
  const std::string first = io::deflate(data.bytes().substr(0, 10));
  const std::string second = io::deflate(data.bytes().substr(10));
  ByteFile table;
  table.append<std::uint32_t>(2);
  table.append<std::uint32_t>(10).append(static_cast<std::uint32_t>(first.size()));
  table.append<std::uint32_t>(14).append(static_cast<std::uint32_t>(second.size()));
  return sur("DSCOMPRESSED", 32) + table.bytes() + first + second;
}

std::string al3d() {
  ByteFile file;
  file.text(0, std::string("AliconaImaging\0\r\n", 17));
  const std::pair<const char*, const char*> tags[]{{"Version", "1"},
                                                   {"TagCount", "6"},
                                                   {"Rows", "2"},
                                                   {"PixelSizeYMeter", "4e-6"},
                                                   {"PixelSizeXMeter", "2e-6"},
                                                   {"InvalidPixelValue", "3.000000028e+15"},
                                                   {"Cols", "3"},
                                                   {"DepthImageOffset", "700"}};
  for (const auto& [key, value] : tags) {
    const std::size_t at = file.bytes().size();
    file.text(at, key).text(at + 20, value).text(at + 50, "\r\n");
  }
  std::size_t at = 700;
  for (const float value : {1.f, 2.f, 3.f, 0.f, 4.f, 5.f, 3.00000003e15f}) {
    file.number(at, value);  // rows padded to 8 bytes: a fourth value that is no pixel
    at += sizeof value;
  }
  return file.bytes();
}

std::string opd() {
  ByteFile data;
  data.append<std::uint16_t>(3).append<std::uint16_t>(2).append<std::uint16_t>(2);
  // Columns, upwards.
  for (const int value : {4, 1, 5, 2, 32767, 3}) data.append(static_cast<std::int16_t>(value));
  ByteFile file;
  file.number<std::uint16_t>(0, 1);
  const auto entry = [&file](const std::string& name, std::int16_t kind, std::size_t length) {
    const std::size_t at = file.bytes().size();
    file.text(at, name).number(at + 16, kind);
    file.number(at + 18, static_cast<std::int32_t>(length)).number<std::uint16_t>(at + 22, 0);
  };
  entry("Directory", 1, 7 * 24);
  entry("RAW_DATA", 3, data.bytes().size());
  entry("", 0, 4);  // without a name, but with bytes
  entry("Wavelength", 7, 4);
  entry("Mult", 6, 2);
  entry("Pixel_size", 7, 4);
  entry("Aspect", 7, 4);
  file.text(file.bytes().size(), data.bytes());
  file.append(-1.0f).append(600.0f).append<std::int16_t>(1200).append(2e-3f).append(2.0f);
  return file.bytes();
}

std::string plu() {
  ByteFile file(500);
  file.text(0, "Mon Jan 01 00:00:00 2024");
  file.number<std::uint32_t>(388, 2).number<std::uint32_t>(392, 3);
  file.number(404, 2.0f).number(408, 4.0f).number<std::uint32_t>(428, 3);
  file.number<std::uint32_t>(500, 2).number<std::uint32_t>(504, 3);
  append_counts(file, 1000001.0f);
  return file.append(1.0f).append(5.0f).bytes();
}

std::string metropro() {
  ByteFile file(834);
  file.big_endian<std::uint32_t>(0, 0x881B036F).big_endian<std::int16_t>(4, 1);
  file.big_endian<std::int32_t>(6, 834).big_endian<std::uint32_t>(60, 12);
  file.big_endian<std::uint16_t>(52, 3).big_endian<std::uint16_t>(54, 2);
  file.big_endian<std::uint16_t>(56, 1).big_endian<std::uint32_t>(72, 24);
  file.big_endian<std::uint16_t>(68, 3).big_endian<std::uint16_t>(70, 2);
  file.big_endian(164, 0.5f).big_endian(168, 600e-9f).big_endian(176, 1.0f);
  file.big_endian(184, 2e-6f).big_endian<std::int16_t>(218, 0);
  for (int i = 0; i < 6; ++i) file.append<std::uint16_t>(7);  // intensity
  for (const std::int32_t value : {1, 2, 3, 4, 5, 2147483640}) {
    file.big_endian(file.bytes().size(), value);
  }
  return file.bytes();
}

std::string nms() {
  ByteFile file(3468);
  file.number(16, 1.0).number(24, 6.0).text(32, "OM_MS_2.0");
  file.number<std::uint32_t>(1368, 3).number<std::uint32_t>(1372, 2);
  file.number(1376, 2000.0).number(1384, 4000.0);
  // Full scale is 65535 = 5 * 13107.
  for (const int value : {0, 1, 2, 3, 4, 5}) file.append(static_cast<std::uint16_t>(13107 * value));
  for (int i = 0; i < 6; ++i) file.append<std::uint8_t>(9);  // grey image
  return file.bytes();
}

std::string tmd() {
  ByteFile file;
  file.text(0, std::string("Binary TrueMap Data File v2.0\r\n\0", 32));
  file.text(32, std::string("note\0", 5)).append<std::uint32_t>(3).append<std::uint32_t>(2);
  file.append(6e-3f).append(8e-3f).append(0.0f).append(0.0f);
  append_counts(file, static_cast<float>(kNaN));
  return file.bytes();
}

std::vector<InstrumentFile> instrument_files() {
  return {{"sur", "plain", plain_sur()}, {"sur", "compressed", compressed_sur()},
          {"al3d", "al3d", al3d()},      {"opd", "opd", opd()},
          {"plu", "plu", plu()},         {"metropro", "metropro", metropro()},
          {"nms", "nms", nms()},         {"tmd", "tmd", tmd()}};
}

}  // namespace tabor::test
