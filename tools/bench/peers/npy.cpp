#include "npy.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <string>

namespace tabor::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers go in and out as they are");
const std::string kMagic("\x93NUMPY\x01\0", 8);

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// The dictionary in front of the numbers.
std::string header_of(std::istream& stream, const std::filesystem::path& file) {
  std::string magic(kMagic.size(), '\0');
  std::array<unsigned char, 2> length{};
  stream.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  stream.read(reinterpret_cast<char*>(length.data()), 2);
  if (!stream || magic != kMagic) reject(file, "no NPY file of version 1");
  std::string header(length[0] + 256U * length[1], '\0');
  stream.read(header.data(), static_cast<std::streamsize>(header.size()));
  return header;
}

}  // namespace

Field read_npy(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string header = header_of(stream, file);
  static const std::regex form(
      R"(\{'descr': '<f8', 'fortran_order': False, 'shape': \((\d+), (\d+)\), \}\s*)");
  std::smatch shape;
  if (!std::regex_match(header, shape, form)) {
    reject(file, "got " + header.substr(0, header.find('\n')) + ", expected rows of <f8");
  }
  Field field(std::stol(shape[1]), std::stol(shape[2]));
  stream.read(reinterpret_cast<char*>(field.data()),
              static_cast<std::streamsize>(field.size() * sizeof(double)));
  if (!stream) reject(file, "ends too early");
  if (!field.allFinite()) reject(file, "holds numbers that are not finite");
  return field;
}

void write_npy(const Field& field, const std::filesystem::path& file) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", field.rows(),
                  field.cols());
  constexpr std::size_t alignment = 64;  // magic, length and header together
  const std::size_t before = kMagic.size() + 2;
  header.resize((before + header.size()) / alignment * alignment + alignment - before - 1, ' ');
  header += '\n';
  std::ofstream stream(file, std::ios::binary);
  stream << kMagic << static_cast<char>(header.size() % 256)
         << static_cast<char>(header.size() / 256) << header;
  stream.write(reinterpret_cast<const char*>(field.data()),
               static_cast<std::streamsize>(field.size() * sizeof(double)));
  if (!stream.flush()) reject(file, "cannot be written");
}

}  // namespace tabor::bench
