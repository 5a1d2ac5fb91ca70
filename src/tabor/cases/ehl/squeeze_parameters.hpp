#pragma once

#include <optional>

#include "tabor/cases/ehl/parameters.hpp"
#include "tabor/ehl/impact/squeeze.hpp"

// What a case of `tabor ehl squeeze` may say.
namespace tabor::ehl {

/// What the film is.
enum class SqueezeModel {
  hydrodynamic,  ///< a liquid between rigid surfaces
  linear         ///< a spring and a damper
};

/// A roller that closes on a flat under a layer of liquid.
struct SqueezeSettings {
  double mass = 0;                     ///< m [kg/m]
  std::optional<double> radius = {};   ///< R [m], of the hydrodynamic model
  double spring = 0;                   ///< k_e [N/m^2]
  std::optional<double> damping = {};  ///< c [N s/m^2], of the linear model
  double speed = 0;                    ///< of approach [m/s]
  LubricantSettings lubricant = {};    ///< under Barus' law unless it says otherwise
  double layer = 0;                    ///< h00 [m]
  double sliding_speed = 0;            ///< Vs [m/s]
  bool gravity = true;
  std::optional<double> time_step = {};  ///< nominal [s]
  SqueezeModel model = SqueezeModel::hydrodynamic;
};

const Parameters<SqueezeSettings>& squeeze_parameters();

/// Reads the settings of a case. Throws InputError, with file, line and key, for invalid ones.
SqueezeSettings read_squeeze_settings(const io::Config& file);

/// Makes the problem of the hydrodynamic model; throws InputError for what it lacks.
SqueezeProblem squeeze_problem(const SqueezeSettings& settings, const io::Config& file);
/// Makes the problem of the linear model; throws InputError for what it lacks, and where it would
/// not swing.
LinearSqueeze linear_squeeze(const SqueezeSettings& settings, const io::Config& file);

}  // namespace tabor::ehl
