#pragma once

#include <string>
#include <vector>

namespace tabor::cli {

/// One `--set KEY=...`: a key of the case and the values it takes.
struct SweepAxis {
  std::string key;                  ///< "ball.speed"
  std::vector<std::string> values;  ///< as TOML: "0.05 m/s", "300"
  bool is_range = false;            ///< or a list; false: one value, as given

  /// The values in SI, for tables and files. Texts without a number are counted from 0.
  std::vector<double> numbers() const;
  bool has_words() const;    ///< a value is no number
  std::string unit() const;  ///< of numbers(): "m/s"; "" for plain numbers and words
};

/// "ball.speed=0.2m/s", "ball.speed=0.05m/s..1m/s:log:5", "grid.nodes=100..300:3" (linear unless it
/// says log; 5 values unless it says how many), "grid.nodes=65,97,145". Two dots that do not stand
/// between numbers belong to a path; commas beside quotes, brackets or braces to a TOML value.
/// Throws UsageError.
SweepAxis parse_axis(const std::string& text);

/// All combinations, the last axis fastest: for each, the place of its value on each axis.
std::vector<std::vector<std::size_t>> combinations(const std::vector<SweepAxis>& axes);

/// Which of these combinations to solve first, second, ..., so that each is the best start of the
/// next: axes of the keys `downwards` last, from their largest value.
std::vector<std::size_t> solving_order(const std::vector<SweepAxis>& axes,
                                       const std::vector<std::vector<std::size_t>>& all,
                                       const std::vector<std::string>& downwards);

}  // namespace tabor::cli
