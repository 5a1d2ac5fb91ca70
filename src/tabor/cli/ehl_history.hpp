#pragma once

#include <string>
#include <vector>

#include "tabor/io/hdf5.hpp"

namespace tabor::cli {

/// One number of every instant of a history, as a result file names it.
template <typename Instant>
struct HistoryCurve {
  const char* name;
  const char* unit;
  const char* long_name;
  double Instant::*value;
};

/// Writes a dataset per curve, one entry per instant, below a new group such as "/history".
template <typename Instant, std::size_t n>
void write_history(io::Hdf5Writer& writer, const std::string& group,
                   const HistoryCurve<Instant> (&curves)[n], const std::vector<Instant>& history) {
  writer.group(group);
  std::vector<double> values(history.size());
  for (const HistoryCurve<Instant>& curve : curves) {
    for (std::size_t i = 0; i < history.size(); ++i) values[i] = history[i].*curve.value;
    const std::string path = group + "/" + curve.name;
    writer.write(path, values);
    writer.describe(path, curve.unit, curve.long_name);
  }
}

}  // namespace tabor::cli
