#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

// Writes the settings that a sentence advises in the words of its reader. Sentences name them
// neutrally, "; <level=plane> removes it"; the command line, studies and Python spell them in their
// own words.
namespace tabor {

/// Setting that a sentence names: "<lowpass>" without a value, "<boundary=free>" with one.
struct Advice {
  std::string setting;  ///< "boundary"
  std::string value;    ///< "free", or ""
};

/// Spelling of a setting for a reader: "--boundary free"; "" if the reader has no such setting.
using AdviceSpelling = std::function<std::string(const Advice& advice)>;

/// Returns the settings of a sentence, in their order.
std::vector<Advice> advice_in(std::string_view text);

/// Returns the sentence with its settings spelled. A part that names a setting without spelling is
/// left out: the brackets around it, else its clause, from "; " to the next. The first clause
/// always stays.
std::string advised(std::string_view text, const AdviceSpelling& spelling);

/// Spells settings as options of the command line, whether a verb has them or not: "--level plane".
std::string as_option(const Advice& advice);

/// Returns the sentence without any advice.
std::string without_advice(std::string_view text);

}  // namespace tabor
