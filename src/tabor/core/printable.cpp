#include "tabor/core/printable.hpp"

#include <fmt/format.h>

namespace tabor {
namespace {

/// Longer than any file name and far longer than any message that quotes only sound input.
constexpr std::size_t kLongest = 8192;
constexpr std::size_t kEndsKept = 2000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.size() > kLongest && i == kEndsKept) {
      shown += " ... ";
      i = text.size() - kEndsKept;
    }
    const char c = text[i];
    if (is_control(c)) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      shown += c;
    }
  }
  return shown;
}

}  // namespace tabor
