#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tabor/cases/ehl/parameters.hpp"
#include "tabor/ehl/impact/impact.hpp"

// What a case of `tabor ehl impact` may say.
namespace tabor::ehl {

/// A ball that falls on a flat covered with a layer of liquid.
struct ImpactSettings {
  double radius = 0;  ///< R [m]
  double mass = 0;    ///< m [kg]
  double speed = 0;   ///< [m/s]
  SolidSettings solids = {};
  LubricantSettings lubricant = {.viscosity_law = material::ViscosityLaw::roelands};
  double layer = 0;  ///< h00 [m]
  bool gravity = false;
  ImpactStart start = ImpactStart::rigid;
  std::vector<double> profile_times = {};  ///< [s]; empty: some at about equal times
  std::uint64_t nodes = static_cast<std::uint64_t>(ImpactProblem{}.nodes);
  std::optional<double> domain = {};     ///< r_max [m]
  std::optional<double> time_step = {};  ///< nominal [s]
};

const Parameters<ImpactSettings>& impact_parameters();

/// Reads the settings of a case. Throws InputError, with file, line and key, for invalid ones.
ImpactSettings read_impact_settings(const io::Config& file);
ImpactProblem read_impact(const io::Config& file);

}  // namespace tabor::ehl
