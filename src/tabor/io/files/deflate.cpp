// The only file that knows zlib and libdeflate, which packs the same streams in half the time.
#include "tabor/io/files/deflate.hpp"

#include <fmt/format.h>
#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>

#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr int kLevel = 4;  // higher ones hardly pack maps any smaller

/// A running inflation that ends itself.
struct Inflation {
  z_stream stream{};
  bool ready = inflateInit(&stream) == Z_OK;
  ~Inflation() {
    if (ready) inflateEnd(&stream);
  }
};

}  // namespace

std::string inflate(std::string_view packed, std::size_t size, const std::string& name) {
  const auto damaged = [&] {
    return InputError(name, "a compressed block that cannot be unpacked",
                      fmt::format("{} bytes", size), "export or copy the file again");
  };
  Inflation inflation;
  if (!inflation.ready || packed.size() > std::size_t{1} << 31) throw damaged();
  z_stream& stream = inflation.stream;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string content;
  std::array<char, kChunk> chunk;
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = kChunk;
    status = ::inflate(&stream, Z_NO_FLUSH);
    const std::size_t n = kChunk - stream.avail_out;
    if (content.size() + n > size) throw damaged();
    content.append(chunk.data(), n);
  }
  if (status != Z_STREAM_END || content.size() != size) throw damaged();
  return content;
}

std::string deflate(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw OutputError("cannot compress: out of memory");
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

}  // namespace tabor::io
