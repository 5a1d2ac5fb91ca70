// The only file that knows libpng.
#include "tabor/io/image/png.hpp"

#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/regular_file.hpp"

namespace tabor::io {
namespace {

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

// libpng's own way out of an error is longjmp, which would skip destructors; throwing through its C
// frames is what its manual allows C++ programs to do instead (libpng is built with unwind tables
// on the platforms tabor supports).
[[noreturn]] void throw_input(png_structp png, png_const_charp message) {
  throw InputError(*static_cast<const std::string*>(png_get_error_ptr(png)) +
                   ": damaged PNG: " + message);
}

[[noreturn]] void throw_output(png_structp png, png_const_charp message) {
  throw OutputError(*static_cast<const std::string*>(png_get_error_ptr(png)) +
                    ": cannot write: " + message);
}

void ignore_warning(png_structp, png_const_charp) {}

/// Deflate unpacks to at most so many times its size (zlib technical note).
constexpr double kLargestRatio = 1032;

/// What libpng may ask for at once to read a file of this size [bytes]: a chunk that states a
/// length which the file cannot have is then skipped.
std::size_t largest_block(const std::filesystem::path& file) {
  constexpr double kOwn = 1e6;  // buffers of libpng and zlib themselves
  return static_cast<std::size_t>(kOwn + kLargestRatio *
                                             static_cast<double>(std::filesystem::file_size(file)));
}

png_voidp allocate(png_structp png, png_alloc_size_t size) {
  return size <= *static_cast<const std::size_t*>(png_get_mem_ptr(png)) ? std::malloc(size)
                                                                        : nullptr;
}

void release(png_structp, png_voidp block) { std::free(block); }

struct Reader {
  Reader(std::string* name, std::size_t* largest)
      : png(png_create_read_struct_2(PNG_LIBPNG_VER_STRING, name, &throw_input, &ignore_warning,
                                     largest, &allocate, &release)),
        info(png_create_info_struct(png)) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  png_structp png;
  png_infop info;
};

struct Writer {
  explicit Writer(std::string* name)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, name, &throw_output, &ignore_warning)),
        info(png_create_info_struct(png)) {}
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  png_structp png;
  png_infop info;
};

void write_to(std::FILE* stream, const Picture& picture, std::string name) {
  const Writer writer(&name);
  png_init_io(writer.png, stream);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.nx),
               static_cast<png_uint_32>(picture.ny), 8,
               picture.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  const std::size_t row_bytes = static_cast<std::size_t>(picture.nx * picture.channels);
  for (Index row = 0; row < picture.ny; ++row) {
    png_write_row(writer.png, picture.values.data() + static_cast<std::size_t>(row) * row_bytes);
  }
  png_write_end(writer.png, writer.info);
}

/// Writes a grey picture row by row; PNG stores the high byte first.
void write_to(std::FILE* stream, const GreyPicture& picture, std::string name) {
  const Writer writer(&name);
  png_init_io(writer.png, stream);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.nx),
               static_cast<png_uint_32>(picture.ny), 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (picture.transparent) {
    png_color_16 grey{};
    grey.gray = *picture.transparent;
    png_set_tRNS(writer.png, writer.info, nullptr, 0, &grey);
  }
  for (const auto& [keyword, text] : picture.remarks) {
    png_text chunk{};
    chunk.compression = PNG_TEXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(keyword.c_str());
    chunk.text = const_cast<char*>(text.c_str());
    chunk.text_length = text.size();
    png_set_text(writer.png, writer.info, &chunk, 1);
  }
  png_write_info(writer.png, writer.info);
  png_set_swap(writer.png);
  for (Index row = 0; row < picture.ny; ++row) {
    png_write_row(writer.png,
                  reinterpret_cast<png_const_bytep>(picture.counts.data() + row * picture.nx));
  }
  png_write_end(writer.png, writer.info);
}

/// Writes under a temporary name, which is then renamed.
template <typename Any>
void write_picture(const Any& picture, const std::filesystem::path& file) {
  TemporaryFile temporary(file);
  Stream stream(std::fopen(temporary.path().c_str(), "wb"), &std::fclose);
  if (!stream) throw OutputError(file.string() + ": cannot write: " + std::strerror(errno));
  write_to(stream.get(), picture, file.string());
  if (std::fclose(stream.release()) != 0) {
    throw OutputError(file.string() + ": cannot write: " + std::strerror(errno));
  }
  temporary.commit();
}

/// The remarks that stand before the pixels.
std::map<std::string, std::string> remarks_of(const Reader& reader) {
  png_textp texts = nullptr;
  int n = 0;
  png_get_text(reader.png, reader.info, &texts, &n);
  std::map<std::string, std::string> remarks;
  for (int i = 0; i < n; ++i) {
    if (texts[i].text != nullptr) remarks[texts[i].key] = texts[i].text;
  }
  return remarks;
}

/// Rejects sizes that the file's own bytes cannot hold.
void check_size(const Reader& reader, const std::filesystem::path& file) {
  const auto nx = png_get_image_width(reader.png, reader.info);
  const auto ny = png_get_image_height(reader.png, reader.info);
  const double bytes =
      static_cast<double>(png_get_rowbytes(reader.png, reader.info)) * static_cast<double>(ny);
  if (bytes > kLargestRatio * static_cast<double>(std::filesystem::file_size(file))) {
    throw InputError(file.string(), fmt::format("{} x {} pixels in its header", nx, ny),
                     "as many as its data can hold",
                     "the file is damaged or truncated: export or copy it again");
  }
}

/// The grey value that stands for transparent pixels; -1 if there is none.
int transparent_grey(const Reader& reader) {
  png_color_16* colour = nullptr;
  const bool is_there = png_get_tRNS(reader.png, reader.info, nullptr, nullptr, &colour) != 0;
  return is_there && colour != nullptr ? colour->gray : -1;
}

void check_grey(const Reader& reader, const std::string& name) {
  const int colour = png_get_color_type(reader.png, reader.info);
  if (colour != PNG_COLOR_TYPE_GRAY && colour != PNG_COLOR_TYPE_GRAY_ALPHA) {
    throw InputError(name, "a colour PNG", "grey values, one per pixel",
                     "convert it to 16-bit grey first");
  }
  // An interlaced or plain image needs its counts (8 bytes a pixel) and one decoded copy (2 or 4).
  const double bytes = 12.0 * png_get_image_width(reader.png, reader.info) *
                       png_get_image_height(reader.png, reader.info);
  check_memory(name, "an image", bytes, "");
}

}  // namespace

void write_png(const Picture& picture, const std::filesystem::path& file) {
  write_picture(picture, file);
}

void write_png(const GreyPicture& picture, const std::filesystem::path& file) {
  write_picture(picture, file);
}

GreyImage read_png(const std::filesystem::path& file) {
  std::string name = file.string();
  const RegularFile opened(file);
  const Stream stream(::fdopen(::dup(opened.descriptor()), "rb"), &std::fclose);
  if (!stream) throw InputError(name + ": cannot be read: " + std::strerror(errno));
  std::size_t largest = largest_block(file);
  const Reader reader(&name, &largest);
  png_init_io(reader.png, stream.get());
  png_read_info(reader.png, reader.info);
  check_size(reader, file);
  check_grey(reader, name);
  GreyImage image;
  image.bits = png_get_bit_depth(reader.png, reader.info);
  image.remarks = remarks_of(reader);
  png_set_packing(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  const Index nx = png_get_image_width(reader.png, reader.info);
  const Index ny = png_get_image_height(reader.png, reader.info);
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> bytes(row_bytes * static_cast<std::size_t>(ny));
  std::vector<png_bytep> rows;
  for (Index row = 0; row < ny; ++row) {
    rows.push_back(bytes.data() + static_cast<std::size_t>(row) * row_bytes);
  }
  png_read_image(reader.png, rows.data());
  const Index n_channels = png_get_channels(reader.png, reader.info);
  const int transparent = transparent_grey(reader);
  image.counts.resize(ny, nx);
  for (Index row = 0; row < ny; ++row) {
    const png_byte* line = rows[static_cast<std::size_t>(row)];
    const auto sample = [&](Index k) {
      return image.bits == 16 ? 256 * line[2 * k] + line[2 * k + 1] : line[k];
    };
    for (Index column = 0; column < nx; ++column) {
      const int grey = sample(n_channels * column);
      const bool is_hole = n_channels == 2 ? sample(2 * column + 1) == 0 : grey == transparent;
      image.counts(row, column) = is_hole ? std::numeric_limits<double>::quiet_NaN() : grey;
    }
  }
  return image;
}

}  // namespace tabor::io
