#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Splits, trims and compares text, and parses numbers without regard to the user's locale.
namespace tabor {

/// Returns the parts between separators, empty ones too.
std::vector<std::string> split(std::string_view text, char separator);
/// Returns the text without white space at both ends.
std::string_view trim(std::string_view text);
/// Returns the text in lower case; only ASCII letters change.
std::string lower(std::string_view text);

/// Parses the whole of `text` as a number in the C locale, whatever the user's locale; nullopt if
/// it is none.
std::optional<double> parse_number(std::string_view text);

/// Returns the candidate (or its first words) within edit distance max(2, size / 3) of `word`, or
/// nullopt.
std::optional<std::string> nearest_match(std::string_view word,
                                         const std::vector<std::string>& candidates);

/// Returns "; did you mean 'plane'?" or "" when nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// Returns "yes" or "NO", for tables in which "NO" should catch the eye.
std::string yes_no(bool value);

}  // namespace tabor
