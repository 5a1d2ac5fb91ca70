#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// A treatment chain is an ordered list of steps in canonical text, exactly as a study file writes
/// them: "level=plane", "fill=harmonic", "lowpass=hann:512/L", "lowpass=gauss:8um",
/// "highpass=gauss:250um", "crop=x0,y0,nx,ny", "trim=125um", "despike=6,5", "resample=nx,ny",
/// "mirror", "flip=x". The command line's `--level plane` is the step "level=plane".
using Treatment = std::vector<std::string>;

/// Names of all steps with the form of their argument and one line of help each (for options.md,
/// `--help` and near-match hints).
struct StepDescription {
  std::string name;
  std::string argument;  ///< "none|mean|plane|poly2|poly3", "" for a flag
  std::string help;
};
std::vector<StepDescription> treatment_steps();

/// Checks names and arguments without a surface. Throws InputError naming the nearest match.
void check(const Treatment& treatment);

/// Applies the steps in order; each leaves a line in `history` with its numbers. Warnings about the
/// heights are asked anew of the result.
Topography apply(const Treatment& treatment, Topography topography, const Observer& observer = {});

}  // namespace tabor::topography
