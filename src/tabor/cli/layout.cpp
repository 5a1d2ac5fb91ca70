#include "tabor/cli/layout.hpp"

#include <algorithm>
#include <vector>

#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

/// What stands between pieces on a line, and at the end of a line that goes on.
struct Joint {
  std::string within;
  std::string at_break;
};

std::string laid_out(const std::vector<std::string>& pieces, const Joint& joint, std::size_t indent,
                     std::size_t column) {
  std::string text;
  bool begins_line = true;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_last = i + 1 == pieces.size();
    const std::size_t needed =
        joint.within.size() + width_on_screen(pieces[i]) + (is_last ? 0 : joint.at_break.size());
    if (!begins_line && column + needed > kScreenWidth) {
      text += joint.at_break + '\n' + std::string(indent, ' ');
      column = indent;
      begins_line = true;
    }
    text += (begins_line ? "" : joint.within) + pieces[i];
    column += (begins_line ? 0 : joint.within.size()) + width_on_screen(pieces[i]);
    begins_line = false;
  }
  return text;
}

/// Words of a command line; a quoted one stays whole.
std::vector<std::string> shell_words(const std::string& command) {
  std::vector<std::string> words;
  bool is_quoted = false;
  bool begins = true;
  for (const char c : command) {
    if (c == '\'') is_quoted = !is_quoted;
    if (c == ' ' && !is_quoted) {
      begins = true;
      continue;
    }
    if (begins) words.emplace_back();
    begins = false;
    words.back() += c;
  }
  return words;
}

}  // namespace

std::size_t width_on_screen(std::string_view text) {
  // UTF-8 continuation bytes have no width.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t column) {
  return laid_out(split(text, ' '), {" ", ""}, indent, column);
}

std::string wrapped(const std::string& text, std::size_t indent) {
  return wrapped(text, indent, indent);
}

std::string shell_lines(const std::string& command) {
  constexpr std::size_t kFirst = 2;
  constexpr std::size_t kNext = 6;
  return std::string(kFirst, ' ') + laid_out(shell_words(command), {" ", " \\"}, kNext, kFirst);
}

std::string wrapped_choices(const std::string& form, std::size_t indent) {
  std::vector<std::string> pieces = split(form, '|');
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) pieces[i] += '|';
  return laid_out(pieces, {"", ""}, 2 * indent, indent);
}

}  // namespace tabor::cli
