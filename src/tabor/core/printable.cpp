#include "tabor/core/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace tabor {
namespace {

/// Longer than any file name and far longer than any message that quotes only sound input.
constexpr std::size_t kLongest = 8192;
constexpr std::size_t kEndsKept = 2000;

/// Characters (Unicode 15) that a terminal acts upon or that nobody sees, from and to.
constexpr std::array<std::pair<char32_t, char32_t>, 18> kUnseen{{{0x00, 0x1F},
                                                                 {0x7F, 0x9F},
                                                                 {0xAD, 0xAD},
                                                                 {0x34F, 0x34F},
                                                                 {0x61C, 0x61C},
                                                                 {0x115F, 0x1160},
                                                                 {0x17B4, 0x17B5},
                                                                 {0x180B, 0x180F},
                                                                 {0x200B, 0x200F},
                                                                 {0x2028, 0x202E},
                                                                 {0x2060, 0x206F},
                                                                 {0x3164, 0x3164},
                                                                 {0xFE00, 0xFE0F},
                                                                 {0xFEFF, 0xFEFF},
                                                                 {0xFFA0, 0xFFA0},
                                                                 {0xFFF0, 0xFFFB},
                                                                 {0x1D173, 0x1D17A},
                                                                 {0xE0000, 0xE0FFF}}};

bool is_unseen(char32_t character) {
  return std::any_of(kUnseen.begin(), kUnseen.end(), [&](const auto& range) {
    return range.first <= character && character <= range.second;
  });
}

bool is_continuation(char c) { return (c & 0xC0) == 0x80; }

/// The first character of a text and its bytes; no bytes where the text is not UTF-8 (RFC 3629).
struct Decoded {
  char32_t character = 0;
  std::size_t size = 0;
};

Decoded first_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  char32_t character = lead & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (!is_continuation(text[i])) return {};
    character = character << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = 0xD800 <= character && character <= 0xDFFF;
  if (character < least[size] || character > 0x10FFFF || is_half) return {};
  return {character, size};
}

/// What a terminal gets for the beginning of `text`, whose bytes it takes off.
std::string take_shown(std::string_view& text) {
  const auto [character, size] = first_character(text);
  const std::string_view bytes = text.substr(0, std::max<std::size_t>(size, 1));
  text.remove_prefix(bytes.size());
  if (size > 0 && !is_unseen(character)) return std::string(bytes);
  if (size > 1) return fmt::format("\\u{{{:x}}}", static_cast<std::uint32_t>(character));
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(bytes.front()));
}

/// As a string of JSON may spell it, in two halves beyond the first 65536.
std::string json_escape(char32_t character) {
  const auto code = static_cast<std::uint32_t>(character);
  if (code < 0x10000) return fmt::format("\\u{:04x}", code);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0 + (code >> 10), 0xDC00 + (code & 0x3FF));
}

}  // namespace

std::string printable(std::string_view text) {
  const bool is_cut = text.size() > kLongest;
  std::string shown;
  std::string_view rest = is_cut ? text.substr(0, kEndsKept) : text;
  while (!rest.empty()) shown += take_shown(rest);
  if (!is_cut) return shown;
  shown += " ... ";
  rest = text.substr(text.size() - kEndsKept);
  while (!rest.empty()) shown += take_shown(rest);
  return shown;
}

std::string printable_lines(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const bool is_end = text.front() == '\n';
    if (is_end) text.remove_prefix(1);
    shown += is_end ? "\n" : take_shown(text);
  }
  return shown;
}

std::string printable_json(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto [character, size] = first_character(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(size, 1));
    text.remove_prefix(bytes.size());
    shown +=
        character >= 0x7F && is_unseen(character) ? json_escape(character) : std::string(bytes);
  }
  return shown;
}

}  // namespace tabor
