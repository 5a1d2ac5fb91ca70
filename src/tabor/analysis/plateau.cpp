#include "tabor/analysis/plateau.hpp"

#include <cmath>
#include <cstddef>

namespace tabor::analysis {
namespace {

constexpr std::size_t kFewestPoints = 3;

double mean_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
}

bool is_flat(const std::vector<double>& values, std::size_t begin, std::size_t end,
             double tolerance) {
  const double mean = mean_of(values, begin, end);
  return std::all_of(values.begin() + static_cast<std::ptrdiff_t>(begin),
                     values.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](double value) { return std::abs(value - mean) <= tolerance * mean; });
}

}  // namespace

std::optional<Plateau> find_plateau(const std::vector<double>& places,
                                    const std::vector<double>& values, double tolerance) {
  std::optional<Plateau> best;
  double best_ratio = 1;
  for (std::size_t begin = 0; begin < values.size(); ++begin) {
    for (std::size_t end = begin + kFewestPoints; end <= values.size(); ++end) {
      const double ratio = places[end - 1] / places[begin];
      if (ratio <= best_ratio || !is_flat(values, begin, end, tolerance)) continue;
      best_ratio = ratio;
      best = Plateau{places[begin], places[end - 1], mean_of(values, begin, end)};
    }
  }
  return best;
}

}  // namespace tabor::analysis
