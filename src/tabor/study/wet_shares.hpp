#pragma once

#include <vector>

#include "tabor/engine/store.hpp"
#include "tabor/study/density_curves.hpp"

// Stores the wet shares of contacts against the density, from which curves of friction follow; no
// shear strength changes them.
namespace tabor::study {

struct ScanTasks;

/// Wet shares of one contact.
struct WetShares {
  std::vector<double> lubricant_densities;  ///< [kg/m^2], rising
  std::vector<double> lubricated_shares;
};
void write_wet_shares(const engine::Store& store, const engine::Task& task,
                      const WetShares& shares);
WetShares read_wet_shares(const engine::Store& store,
                          const engine::Task& task);  ///< throws InputError if damaged

/// Returns the curves that the store holds, scans and pressures in the order of the study.
std::vector<ScanCurve> density_curves_in(const engine::Store& store, const Study& study,
                                         const std::vector<ScanTasks>& tasks);

}  // namespace tabor::study
