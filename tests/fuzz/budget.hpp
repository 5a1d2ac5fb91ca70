#pragma once

#include <cstddef>

namespace tabor::fuzz {

/// Measures what one input costs, from construction on: memory asked for beyond what was held
/// before, and processor time of all threads. Needs the address sanitizer, whose allocator reports
/// every block, those of foreign libraries too.
class Budget {
 public:
  Budget();
  std::size_t peak_bytes() const;  ///< largest amount held at one time
  double seconds() const;

 private:
  double start_;
};

/// Most memory an input may take: a fixed part for buffers of the libraries, and a multiple of its
/// size. A value of one or two bytes becomes a height of eight, held twice while a map is checked;
/// deflate unpacks to at most 1032 times its size.
constexpr std::size_t allowed_bytes(std::size_t input_bytes, bool packed) {
  constexpr std::size_t kFixed = std::size_t{8} << 20;
  return kFixed + (packed ? 1032 : 1) * std::size_t{64} * input_bytes;
}

}  // namespace tabor::fuzz
