#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

// Parses and applies chains of treatment steps such as "level=plane".
namespace tabor::topography {

/// A treatment chain is an ordered list of steps in canonical text, exactly as a study file writes
/// them: "level=plane", "fill=harmonic", "lowpass=hann:512/L", "lowpass=gauss:8um",
/// "highpass=gauss:250um", "crop=x0,y0,nx,ny", "trim=125um", "despike=6,5", "resample=nx,ny",
/// "mirror", "edges=cut", "flip=x", "recipe=sheet". The command line's `--level plane` is the step
/// "level=plane".
using Treatment = std::vector<std::string>;

/// Name of a step with the form of its argument and one line of help (for options.md, `--help` and
/// near-match hints).
struct StepDescription {
  std::string name;
  std::string argument;  ///< "none|mean|plane|poly2|poly3", "" for a flag
  std::string help;
};
std::vector<StepDescription> treatment_steps();

/// Returns the chain with each recipe, such as "recipe=sheet", replaced by its steps (recipes.hpp).
Treatment expanded(const Treatment& treatment);

/// Checks names and arguments without a surface. Throws InputError naming the nearest match, and
/// for steps that contradict each other.
void check(const Treatment& treatment);

/// Returns the argument of the step "edges", if there is one. Throws InputError where other steps
/// contradict it.
std::optional<Edges> edges_of(const Treatment& treatment);

/// True if a step adds mirror images.
bool mirrors(const Treatment& treatment);

/// Applies the steps in order; each leaves a line in `history` with its numbers. Warnings about the
/// heights are found anew for the result.
Topography apply(const Treatment& treatment, Topography topography, const Observer& observer = {});

}  // namespace tabor::topography
