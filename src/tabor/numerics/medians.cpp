#include "tabor/numerics/medians.hpp"

#include <algorithm>
#include <cstddef>

namespace tabor::numerics {
namespace {

/// Lets `low` and `high` have the smaller and the larger value of each list.
void order(Lanes& low, Lanes& high) {
  const Lanes smaller = low < high ? low : high;
  high = low < high ? high : low;
  low = smaller;
}

/// Moves the least of values[first..last] to `first` and the greatest to `last`.
void part_ends(std::vector<Lanes>& values, std::size_t first, std::size_t last) {
  const std::size_t half = (last - first + 1) / 2;
  for (std::size_t i = 0; i < half; ++i) order(values[first + i], values[last - i]);
  for (std::size_t i = 1; i < half; ++i) {
    order(values[first], values[first + i]);
    order(values[last - i], values[last]);
  }
  const std::size_t middle = first + half;
  if (middle == last - half) {  // an odd number of values
    order(values[first], values[middle]);
    order(values[middle], values[last]);
  }
}

}  // namespace

const Lanes& upper_medians(std::vector<Lanes>& values) {
  const std::size_t n = values.size();
  std::size_t first = 0;
  std::size_t next = std::min(n, n / 2 + 2);
  std::size_t last = next - 1;
  while (last > first + 1) {
    part_ends(values, first, last);
    ++first;
    if (next < n) {
      values[last] = values[next++];
    } else {
      --last;
    }
  }
  order(values[first], values[last]);
  return values[last];
}

}  // namespace tabor::numerics
