#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/record/parameter.hpp"
#include "tabor/synthesis/synthesis.hpp"

// Surfaces by names, as a person asks for them: "edt" with "plateau_share" 0.6.
namespace tabor::synthesis {

/// A setting that some kinds of surfaces take.
struct RecipeSetting : ParameterHead {
  std::vector<std::string> kinds = {};  ///< that take it; `help` names them
  /// The defaults of the kinds that have one: {"edt", "0.75"}.
  std::vector<std::pair<std::string, std::string>> defaults = {};
  bool is_of_a_rough = true;  ///< of self-affine, edt and ground; else of sinusoid, sphere and bump
  Cell default_value = {};    ///< the default of the first kind; NaN or nothing: none
  std::function<Cell(const Given&)> taken = {};  ///< what was given, for Request::settings
};

/// All settings of all kinds, each once, in the order of the kinds.
const std::vector<RecipeSetting>& recipe_settings();

/// "self-affine", "edt", ...
const std::vector<std::string>& recipe_kinds();
/// Returns the kinds of rough surfaces, or the others.
std::vector<std::string> recipe_kinds(bool are_rough);

/// The pixels of a generated surface, along x and along y, or one number for both.
struct PixelSettings {
  std::vector<double> pixels{512};     ///< their number
  std::vector<double> pixel{0.67e-6};  ///< their size [m]
};
const Parameters<PixelSettings>& pixel_parameters();

/// What is asked for. Settings that are not given have their defaults.
struct Request {
  std::string kind;
  Grid grid;
  std::map<std::string, Cell> settings = {};  ///< numbers in SI, by the names of recipe_settings()
  std::uint64_t seed = 1;
};

/// How those who asked call a setting: "--rms-height" for "rms_height".
using Spelling = std::function<std::string(std::string_view setting)>;

/// Throws InputError for pixels that are none, UsageError for more than two numbers.
Grid grid_of(const PixelSettings& settings, const Spelling& spelling);

/// The surface. Throws UsageError for a kind or a setting that does not exist, or does not belong
/// to the kind, or is missing; InputError for values out of range.
topography::Topography generate(const Request& request, const Spelling& spelling);

}  // namespace tabor::synthesis
