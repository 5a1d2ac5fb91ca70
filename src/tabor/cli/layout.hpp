#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Breaks texts into lines that fit a terminal of 80 columns.
namespace tabor::cli {

inline constexpr std::size_t kScreenWidth = 80;

/// Returns the columns that a UTF-8 text takes on a screen; every character counts as one.
std::size_t width_on_screen(std::string_view text);

/// Breaks a text at blanks; it begins in column `column`, all lines but the first in column
/// `indent`.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t column);
/// The same, where the first line begins in the same column as the others.
std::string wrapped(const std::string& text, std::size_t indent);

/// Breaks a command line between its words; lines but the last end with the backslash that lets a
/// shell read on. Every line is indented by two blanks, those after the first by more.
std::string shell_lines(const std::string& command);

/// Breaks a list of choices "--level mean|plane" after the bars.
std::string wrapped_choices(const std::string& form, std::size_t indent);

}  // namespace tabor::cli
