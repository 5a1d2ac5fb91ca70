#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tabor/cli/app.hpp"
#include "tabor/io/text/json.hpp"

namespace tabor::test {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// What one call of the program left behind.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs the program in this process.
inline Outcome run_tabor(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  Outcome outcome;
  outcome.code = cli::run(words, out, err);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

/// The JSON object of a call that is expected to work.
inline io::Json json_of(std::vector<std::string> words) {
  words.emplace_back("--json");
  const Outcome outcome = run_tabor(words);
  // A failure shows up as an object without keys beside the reason.
  if (outcome.out.empty()) return {{"failed", outcome.err}};
  return io::Json::parse(outcome.out);
}

inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace tabor::test
