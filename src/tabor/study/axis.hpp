#pragma once

#include <string>
#include <vector>

// Combines lists of values of case keys into cases, and chooses the order to solve them in.
namespace tabor::study {

/// Key of a case and the values that it takes.
struct SweepAxis {
  std::string key;                  ///< "ball.speed"
  std::vector<std::string> values;  ///< as TOML: "0.05 m/s", "300"
  bool is_range = false;            ///< or a list; false: one value, as given

  /// Returns the values in SI, for tables and files. Texts without a number are counted from 0.
  std::vector<double> numbers() const;
  bool has_words() const;    ///< a value is no number
  std::string unit() const;  ///< of numbers(): "m/s"; "" for plain numbers and words
};

/// Place of a case's value on each axis.
using Places = std::vector<std::size_t>;

/// Returns all combinations, the last axis fastest.
std::vector<Places> combinations(const std::vector<SweepAxis>& axes);

/// Returns the order in which to solve these combinations, so that each is the best start of the
/// next: axes of the keys `downwards` last, from their largest value.
std::vector<std::size_t> solving_order(const std::vector<SweepAxis>& axes,
                                       const std::vector<Places>& all,
                                       const std::vector<std::string>& downwards);

}  // namespace tabor::study
