#pragma once

#include <vector>

#include "tabor/study/density_curves.hpp"
#include "tabor/study/store.hpp"

// What the store keeps for the curves of friction against density: wet shares, which no shear
// strength changes.
namespace tabor::study {

struct ScanTasks;

/// The wet shares of one contact.
struct WetShares {
  std::vector<double> lubricant_densities;  ///< [kg/m^2], rising
  std::vector<double> lubricated_shares;
};
void write_wet_shares(const Store& store, const Task& task, const WetShares& shares);
WetShares read_wet_shares(const Store& store, const Task& task);  ///< throws InputError if damaged

/// Those the store holds, scans and pressures in the order of the study.
std::vector<ScanCurve> density_curves_in(const Store& store, const Study& study,
                                         const std::vector<ScanTasks>& tasks);

}  // namespace tabor::study
