#pragma once

#include <algorithm>
#include <cstring>
#include <string>

namespace tabor::test {

/// Builds the bytes of an instrument's file at given offsets.
class ByteFile {
 public:
  explicit ByteFile(std::size_t size = 0) : bytes_(size, '\0') {}

  ByteFile& text(std::size_t at, const std::string& text) {
    return raw(at, text.data(), text.size());
  }
  template <typename T>
  ByteFile& number(std::size_t at, T value) {
    return raw(at, &value, sizeof value);
  }
  template <typename T>
  ByteFile& big_endian(std::size_t at, T value) {
    char swapped[sizeof(T)];
    std::memcpy(swapped, &value, sizeof(T));
    std::reverse(swapped, swapped + sizeof(T));
    return raw(at, swapped, sizeof(T));
  }
  template <typename T>
  ByteFile& append(T value) {
    return number(bytes_.size(), value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  ByteFile& raw(std::size_t at, const void* data, std::size_t size) {
    if (bytes_.size() < at + size) bytes_.resize(at + size, '\0');
    std::memcpy(bytes_.data() + at, data, size);
    return *this;
  }
  std::string bytes_;
};

}  // namespace tabor::test
