#pragma once

#include <string>
#include <vector>

namespace tabor::study {

/// One key of a case and the values that it takes.
struct SweepAxis {
  std::string key;                  ///< "ball.speed"
  std::vector<std::string> values;  ///< as TOML: "0.05 m/s", "300"
  bool is_range = false;            ///< or a list; false: one value, as given

  /// The values in SI, for tables and files. Texts without a number are counted from 0.
  std::vector<double> numbers() const;
  bool has_words() const;    ///< a value is no number
  std::string unit() const;  ///< of numbers(): "m/s"; "" for plain numbers and words
};

/// The place of a case's value on each axis.
using Places = std::vector<std::size_t>;

/// All combinations, the last axis fastest.
std::vector<Places> combinations(const std::vector<SweepAxis>& axes);

/// Which of these combinations to solve first, second, ..., so that each is the best start of the
/// next: axes of the keys `downwards` last, from their largest value.
std::vector<std::size_t> solving_order(const std::vector<SweepAxis>& axes,
                                       const std::vector<Places>& all,
                                       const std::vector<std::string>& downwards);

}  // namespace tabor::study
