#include "support/container_files.hpp"

#include <initializer_list>

#include "support/byte_file.hpp"
#include "support/sample_map.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::test {
namespace {

template <typename T>
std::string values(std::initializer_list<double> list) {
  ByteFile bytes;
  for (const double value : list) bytes.append(static_cast<T>(value));
  return bytes.bytes();
}

std::string layers(double factor) {
  return values<float>({factor, 2 * factor, 3 * factor, 4 * factor, 5 * factor, kNaN});
}

std::string plux_index(int n_layers) {
  std::string xml =
      "<?xml version=\"1.0\"?><xml><GENERAL><DATE>2024-01-01</DATE><IMAGE_SIZE_X>3</IMAGE_SIZE_X>"
      "<IMAGE_SIZE_Y>2</IMAGE_SIZE_Y><FOV_X>2</FOV_X><FOV_Y>4</FOV_Y></GENERAL>"
      "<INFO><ITEM_0><NAME>Device</NAME><VALUE>S neox</VALUE></ITEM_0></INFO>";
  for (int i = 0; i < n_layers; ++i) {
    const std::string number = std::to_string(i);
    xml += "<LAYER_" + number + "><FILENAME_Z>LAYER_" + number + ".raw</FILENAME_Z></LAYER_" +
           number + ">";
  }
  return xml + "</xml>";
}

/// A false-colour block: size, samples, a palette between both.
template <typename T>
void append_image(ByteFile& file, std::initializer_list<double> samples) {
  for (const std::size_t number : {std::size_t{3}, std::size_t{2}, 8 * sizeof(T), std::size_t{0},
                                   6 * sizeof(T), std::size_t{0}, std::size_t{9}}) {
    file.append(static_cast<std::uint32_t>(number));
  }
  file.text(file.bytes().size(), std::string(768, '\0'));
  file.text(file.bytes().size(), values<T>(samples));
}

std::string bcr_header(const std::string& kind, int intelmode) {
  std::string text = "fileformat = " + kind +
                     "\nheadersize = 2048\n% a remark\nxpixels = 3\nypixels = 2\n"
                     "xlength = 6000\nylength = 8000\nbit2nm = " +
                     (kind.starts_with("bcrf") ? "1" : "0.5") +
                     "\nintelmode = " + std::to_string(intelmode) +
                     "\nvoidpixels = 1\nzunit = nm\n";
  text.resize(2048, ' ');
  return text;
}

/// Every character of ASCII text in two bytes, with the mark of the byte order.
std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  wide.resize(2 * text.size());  // the mark counts as a character of the header
  return wide;
}

}  // namespace

std::string plux() { return io::zip({{"index.xml", plux_index(1)}, {"LAYER_0.raw", layers(1)}}); }

std::string two_layer_plux() {
  return io::zip(
      {{"index.xml", plux_index(2)}, {"LAYER_0.raw", layers(1)}, {"LAYER_1.raw", layers(10)}});
}

std::string vk4() {
  constexpr std::size_t kConditions = 12 + 18 * 4;
  constexpr std::size_t kImages = kConditions + 76 * 4;
  ByteFile file(kImages);
  file.text(0, "VK4_").number<std::uint32_t>(4, 1);
  file.number(12, static_cast<std::uint32_t>(kConditions));
  file.number(kConditions, std::uint32_t{76 * 4});
  file.number(kConditions + 42 * 4, std::uint32_t{2'000'000});  // [pm] per pixel
  file.number(kConditions + 43 * 4, std::uint32_t{4'000'000});
  file.number(kConditions + 44 * 4, std::uint32_t{500});  // [pm] per count
  file.number(12 + 3 * 4, static_cast<std::uint32_t>(file.bytes().size()));
  append_image<std::uint16_t>(file, {9, 9, 9, 9, 9, 9});
  file.number(12 + 6 * 4, static_cast<std::uint32_t>(file.bytes().size()));
  append_image<std::uint32_t>(file, {1, 2, 3, 4, 5, 6});
  return file.bytes();
}

std::string vk6() {
  // A picture comes first, in which the signature of an archive may occur by chance.
  return std::string("VK6\0", 4) + "BM picture PK\x03\x04 rest of it" +
         io::zip({{"Vk4File", vk4()}});
}

std::string bcr() {
  ByteFile file;
  file.text(0, bcr_header("bcrstm", 0));
  for (const std::int16_t count : std::initializer_list<std::int16_t>{1, 2, 3, 4, 5, 32767}) {
    file.big_endian(file.bytes().size(), count);
  }
  return file.bytes();
}

std::string bcrf(bool wide) {
  const std::string header = bcr_header(wide ? "bcrf_unicode" : "bcrf", 1);
  return (wide ? utf16(header) : header) + values<float>({1, 2, 3, 4, 5, 3.402823e38});
}

std::string tiff(int bits, int format, int photometric, const std::string& missing) {
  const std::string data = format == 3   ? values<float>({1, 2, 3, 4, 5, 6})
                           : bits == 8   ? values<std::uint8_t>({1, 2, 3, 4, 5, 6})
                           : bits == 32  ? values<std::uint32_t>({1, 2, 3, 4, 5, 6})
                           : format == 2 ? values<std::int16_t>({-1, 2, 3, 4, 5, 6})
                                         : values<std::uint16_t>({1, 2, 3, 4, 5, 6});
  const std::pair<int, std::size_t> tags[]{{256, 3},
                                           {257, 2},
                                           {258, static_cast<std::size_t>(bits)},
                                           {259, 1},
                                           {262, static_cast<std::size_t>(photometric)},
                                           {273, 8},
                                           {277, 1},
                                           {278, 2},
                                           {279, data.size()},
                                           {339, static_cast<std::size_t>(format)}};
  constexpr std::uint16_t kLong = 4;
  constexpr std::uint16_t kShort = 3;
  ByteFile file;
  file.text(0, std::string("II*\0", 4)).number(4, static_cast<std::uint32_t>(8 + data.size()));
  const std::size_t n_tags = std::size(tags) + (missing.empty() ? 0 : 1);
  file.text(8, data).append(static_cast<std::uint16_t>(n_tags));
  for (const auto& [tag, value] : tags) {
    const bool is_long = tag < 258 || tag == 273 || tag == 278 || tag == 279;
    file.append(static_cast<std::uint16_t>(tag)).append(is_long ? kLong : kShort);
    file.append(std::uint32_t{1}).append(static_cast<std::uint32_t>(value));
  }
  if (!missing.empty()) {
    constexpr std::uint16_t kText = 2;
    file.append(std::uint16_t{42113}).append(kText).append(std::uint32_t{4});
    for (std::size_t i = 0; i < 4; ++i) file.append(i < missing.size() ? missing[i] : '\0');
  }
  return file.append(std::uint32_t{0}).bytes();
}

}  // namespace tabor::test
