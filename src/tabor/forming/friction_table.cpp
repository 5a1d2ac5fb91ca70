#include "tabor/forming/friction_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

namespace tabor::forming {
namespace {

/// All speeds at which a layer has a number.
std::set<std::optional<double>> speeds_of(const DensityLayer& layer) {
  std::set<std::optional<double>> speeds;
  for (const PressureRow& row : layer.rows) {
    for (const FrictionEntry& entry : row.entries) speeds.insert(entry.at.sliding_speed);
  }
  return speeds;
}

void leave_out(const PressureRow& row, FrictionTable& table) {
  for (const FrictionEntry& entry : row.entries) {
    table.left_out.push_back({.at = entry.at, .code = "incomplete", .scans = {}});
  }
}

}  // namespace

std::vector<DensityLayer> layers_of(const FrictionTable& table) {
  std::vector<DensityLayer> layers;
  for (const FrictionEntry& entry : table.entries) {
    const Condition& at = entry.at;
    if (layers.empty() || layers.back().lubricant_density != at.lubricant_density) {
      layers.push_back({at.lubricant_density, {}});
    }
    std::vector<PressureRow>& rows = layers.back().rows;
    if (rows.empty() || rows.back().mean_pressure != at.mean_pressure) {
      rows.push_back({at.mean_pressure, {}});
    }
    rows.back().entries.push_back(entry);
  }
  return layers;
}

std::size_t n_left_out(const FrictionTable& table) {
  return static_cast<std::size_t>(std::count_if(table.left_out.begin(), table.left_out.end(),
                                                [](const LeftOut& one) { return one.whole; }));
}

namespace {

std::string reasons(const FrictionTable& table, bool whole) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const LeftOut& one : table.left_out) {
    if (one.whole != whole) continue;
    const auto found = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == one.code; });
    std::size_t& n =
        found != counts.end() ? found->second : counts.emplace_back(one.code, 0).second;
    ++n;
  }
  std::string text;
  for (const auto& [code, n] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", code, n);
  }
  return text;
}

}  // namespace

std::string reasons_of(const FrictionTable& table) { return reasons(table, true); }

std::string reasons_for_fewer_scans(const FrictionTable& table) { return reasons(table, false); }

FrictionTable complete_rows(FrictionTable table) {
  const std::vector<DensityLayer> layers = layers_of(table);
  table.entries.clear();
  for (const DensityLayer& layer : layers) {
    const std::size_t n_speeds = speeds_of(layer).size();
    for (const PressureRow& row : layer.rows) {
      if (row.entries.size() == n_speeds) {
        table.entries.insert(table.entries.end(), row.entries.begin(), row.entries.end());
      } else {
        leave_out(row, table);
      }
    }
  }
  return table;
}

void require_two_pressures(const DensityLayer& layer, const std::string& left_out) {
  if (layer.rows.size() > 1) return;
  throw InputError("friction table",
                   fmt::format("one pressure alone ({}) at {} g/m^2{}",
                               format_si(layer.rows.front().mean_pressure, "Pa"),
                               in_g_per_m2(layer.lubricant_density),
                               left_out.empty() ? "" : "; left out: " + left_out),
                   "two pressures or more at each density",
                   left_out.empty()
                       ? "compute more pressures, choose others by <density>, or write <for=csv>"
                       : "compute more pressures, <keep> what is left out, or write <for=csv>");
}

void require_two_pressures(const FrictionTable& table) {
  for (const DensityLayer& layer : layers_of(table)) {
    require_two_pressures(layer, reasons_of(table));
  }
}

}  // namespace tabor::forming
