#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tabor {

/// The parts between separators, empty ones too.
std::vector<std::string> split(std::string_view text, char separator);
/// Without the white space at both ends.
std::string_view trim(std::string_view text);
/// In lower case; letters of ASCII alone change.
std::string lower(std::string_view text);

/// The whole of `text` as a number in the C locale, whatever the user's locale; nullopt otherwise.
std::optional<double> parse_number(std::string_view text);

/// The candidate within edit distance max(2, size / 3) that is nearest to `word`; nullopt if none.
std::optional<std::string> nearest_match(std::string_view word,
                                         const std::vector<std::string>& candidates);

/// "; did you mean 'plane'?" or "" when nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// "yes" or "NO", for tables, where what should catch the eye is the latter.
std::string yes_no(bool value);

}  // namespace tabor
