#include "fuzz/png.hpp"

#include <cstddef>
#include <cstdint>

#include "tabor/io/files/deflate.hpp"

namespace tabor::fuzz {
namespace {

constexpr std::string_view kSignature{"\x89PNG\r\n\x1a\n", 8};

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24u, 16u, 8u, 0u}) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::uint32_t from_big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

/// CRC-32 of the PNG specification, annex D (polynomial 0xEDB88320, bit by bit).
std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

/// Whether bytes begin like a zlib stream (RFC 1950, section 2.2).
bool is_packed(std::string_view data) {
  if (data.size() < 2) return false;
  const auto method = static_cast<unsigned char>(data[0]);
  const auto flags = static_cast<unsigned char>(data[1]);
  return (method & 0x0F) == 8 && (method * 256u + flags) % 31 == 0;
}

}  // namespace

std::string png_chunk(std::string_view type, std::string_view data) {
  std::string chunk = big_endian(static_cast<std::uint32_t>(data.size()));
  return chunk.append(type).append(data).append(4, '\0');
}

std::string plain_png(int bits, int colour_type, int interlace) {
  constexpr std::uint32_t kWidth = 4, kHeight = 3;
  std::string header = big_endian(kWidth) + big_endian(kHeight);
  for (const int byte : {bits, colour_type, 0, 0, interlace}) header += static_cast<char>(byte);
  const std::string pixels(64, '\0');  // more than any of these images needs
  return std::string(kSignature) + png_chunk("IHDR", header) + png_chunk("IDAT", pixels) +
         png_chunk("IEND", "");
}

std::string repaired_png(std::string_view bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and checksum
  std::string repaired(bytes.substr(0, kSignature.size()));
  bytes.remove_prefix(repaired.size());
  while (bytes.size() >= kFrame && from_big_endian(bytes) <= bytes.size() - kFrame) {
    const std::size_t size = from_big_endian(bytes);
    const std::string_view type = bytes.substr(4, 4);
    const std::string_view data = bytes.substr(8, size);
    bytes.remove_prefix(kFrame + size);
    const bool pack = type == "IDAT" && !is_packed(data);
    const std::string chunk = png_chunk(type, pack ? io::deflate(data) : std::string(data));
    const std::string_view checked = std::string_view(chunk).substr(4, chunk.size() - 8);
    repaired.append(chunk, 0, chunk.size() - 4).append(big_endian(checksum(checked)));
  }
  return repaired.append(bytes);
}

}  // namespace tabor::fuzz
