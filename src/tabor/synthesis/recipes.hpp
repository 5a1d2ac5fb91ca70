#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/units.hpp"
#include "tabor/synthesis/synthesis.hpp"

// Surfaces by names, as a person asks for them: "edt" with "plateau_share" 0.6.
namespace tabor::synthesis {

/// A number that some kinds of surfaces take.
struct RecipeNumber {
  std::string name;  ///< "rms_height"
  Dimension dimension;
  std::string help;           ///< which kinds take it, what it is, and its usual value
  bool is_of_a_rough = true;  ///< self-affine, edt, ground; else sinusoid, sphere, bump
};
const std::vector<RecipeNumber>& recipe_numbers();

/// "self-affine", "edt", ...
const std::vector<std::string>& recipe_kinds();

/// What is asked for. Numbers that are not given have their usual values.
struct Request {
  std::string kind;
  Grid grid;
  std::map<std::string, double> numbers = {};  ///< SI, by the names of recipe_numbers()
  EdtStage stage = EdtStage::before;           ///< of edt
  bool periodic = true;                        ///< edt: a tile, or a cut-out
  bool random_amplitudes = false;              ///< of self-affine
  std::uint64_t seed = 1;
};

/// How those who asked call a number: "--rms-height" for "rms_height".
using NumberSpelling = std::function<std::string(std::string_view name)>;

/// The surface. Throws UsageError for a kind or a number that does not exist, or does not belong to
/// the kind, or is missing; InputError for values out of range.
topography::Topography generate(const Request& request, const NumberSpelling& spelling);

}  // namespace tabor::synthesis
