#include "tabor/study/averages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace tabor::study {
namespace {

using Key = std::tuple<std::string, double, double>;

Key key_of(const Row& row) { return {row.group, row.mean_pressure, row.lubricant_density}; }

template <typename Value>
std::size_t position(std::vector<Value>& seen, const Value& value) {
  const auto found = std::find(seen.begin(), seen.end(), value);
  if (found != seen.end()) {
    return static_cast<std::size_t>(found - seen.begin());
  }
  seen.push_back(value);
  return seen.size() - 1;
}

/// The keys that occur, ordered by the first occurrence of group, then pressure, then density.
std::vector<Key> ordered_keys(const std::vector<Row>& rows) {
  std::vector<std::string> groups;
  std::vector<double> pressures;
  std::vector<double> densities;
  std::vector<std::pair<std::tuple<std::size_t, std::size_t, std::size_t>, Key>> ranked;
  for (const Row& row : rows) {
    const std::tuple rank{position(groups, row.group), position(pressures, row.mean_pressure),
                          position(densities, row.lubricant_density)};
    ranked.emplace_back(rank, key_of(row));
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.erase(std::unique(ranked.begin(), ranked.end()), ranked.end());
  std::vector<Key> keys;
  for (const auto& [rank, key] : ranked) {
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

Mean mean_of(const std::vector<double>& values) {
  Mean result;
  result.n = values.size();
  const double n = static_cast<double>(values.size());
  if (values.empty()) {
    return result;
  }
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() >= 2) {
    double squares = 0;
    for (const double value : values) {
      squares += (value - result.mean) * (value - result.mean);
    }
    result.standard_deviation = std::sqrt(squares / (n - 1));
    result.standard_error = result.standard_deviation / std::sqrt(n);
  }
  return result;
}

std::vector<Average> averages(const std::vector<Row>& rows) {
  std::vector<Average> result;
  for (const Key& key : ordered_keys(rows)) {
    std::vector<double> dry;
    std::vector<double> lubricated;
    for (const Row& row : rows) {
      if (key_of(row) == key && !row.failed() && row.converged) {
        dry.push_back(row.friction_dry);
        lubricated.push_back(row.friction_lubricated);
      }
    }
    result.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), dry.size(),
                      mean_of(dry), mean_of(lubricated)});
  }
  return result;
}

}  // namespace tabor::study
