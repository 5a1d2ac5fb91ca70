#include "tabor/cases/plateau.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace tabor::cases {
namespace {

constexpr std::size_t kFewestPoints = 3;

/// What is known of the values from one place on, as the range grows.
class GrowingRange {
 public:
  void add(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
    sum_ += value;
    ++n_;
  }
  std::size_t size() const { return n_; }
  double mean() const { return sum_ / static_cast<double>(n_); }
  bool is_flat(double tolerance) const {
    const double most_apart = tolerance * mean();
    return most_ - mean() <= most_apart && mean() - least_ <= most_apart;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
  double sum_ = 0;
  std::size_t n_ = 0;
};

}  // namespace

std::optional<Plateau> find_plateau(const std::vector<double>& places,
                                    const std::vector<double>& values, double tolerance) {
  std::optional<Plateau> best;
  double best_ratio = 1;
  for (std::size_t begin = 0; begin < values.size(); ++begin) {
    GrowingRange range;
    for (std::size_t end = begin; end < values.size(); ++end) {
      range.add(values[end]);
      const double ratio = places[end] / places[begin];
      if (range.size() < kFewestPoints || ratio <= best_ratio || !range.is_flat(tolerance)) {
        continue;
      }
      best_ratio = ratio;
      best = Plateau{places[begin], places[end], range.mean()};
    }
  }
  return best;
}

}  // namespace tabor::cases
