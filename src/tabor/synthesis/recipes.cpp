#include "tabor/synthesis/recipes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::synthesis {
namespace {

using topography::Topography;

/// The numbers given. A recipe takes those it knows; whatever is left at the end does not belong to
/// its kind and is rejected.
class Given {
 public:
  Given(const Request& request, const NumberSpelling& spelling)
      : request_(request), spelling_(spelling), values_(request.numbers) {}

  std::optional<double> take(const std::string& name) {
    const auto node = values_.extract(name);
    return node ? std::optional(node.mapped()) : std::nullopt;
  }

  double take_or(const std::string& name, double fallback) { return take(name).value_or(fallback); }

  double need(const std::string& name) {
    if (const auto value = take(name)) return *value;
    throw UsageError(fmt::format("generate {}: {} is missing", request_.kind, spelling_(name)));
  }

  void reject_rest() const {
    if (values_.empty()) return;
    throw UsageError(fmt::format("generate {}: {} does not belong to this kind", request_.kind,
                                 spelling_(values_.begin()->first)));
  }

  const Request& request() const { return request_; }
  std::string spelt(const std::string& name) const { return spelling_(name); }

 private:
  const Request& request_;
  const NumberSpelling& spelling_;
  std::map<std::string, double> values_;
};

Topography make_self_affine(Given& given) {
  SelfAffine recipe;
  recipe.grid = given.request().grid;
  recipe.hurst = given.take_or("hurst", recipe.hurst);
  recipe.rms_height = given.take("rms_height");
  recipe.rms_slope = given.take("rms_slope");
  recipe.roll_off_wavelength = given.take_or("roll_off", 0);
  recipe.long_cutoff_wavelength = given.take_or("long_cutoff", 0);
  recipe.short_cutoff_wavelength = given.take_or("short_cutoff", 0);
  recipe.stretch = given.take_or("stretch", 1);
  recipe.random_amplitudes = given.request().random_amplitudes;
  recipe.seed = given.request().seed;
  if (recipe.rms_height.has_value() == recipe.rms_slope.has_value()) {
    throw UsageError(fmt::format("generate self-affine: give either {} or {}",
                                 given.spelt("rms_height"), given.spelt("rms_slope")));
  }
  return self_affine(recipe);
}

Topography make_edt(Given& given) {
  Edt recipe{.grid = given.request().grid};
  recipe.mean_abs_height = given.take_or("mean_height", recipe.mean_abs_height);
  recipe.hurst = given.take_or("hurst", recipe.hurst);
  recipe.stage = given.request().stage;
  recipe.waviness = given.take_or("waviness", recipe.waviness);
  recipe.plateau_share = given.take_or("plateau_share", recipe.plateau_share);
  recipe.plateau_roughness = given.take_or("plateau_roughness", recipe.plateau_roughness);
  recipe.noise = given.take_or("noise", recipe.noise);
  if (recipe.stage == EdtStage::after) {
    recipe.sliding_pressure = given.take_or("pressure", recipe.sliding_pressure);
    recipe.sliding_density = given.take_or("density", recipe.sliding_density);
  }
  recipe.periodic = given.request().periodic;
  recipe.seed = given.request().seed;
  return edt(recipe);
}

Topography make_ground(Given& given) {
  Ground recipe{.grid = given.request().grid};
  recipe.rms_height = given.take_or("rms_height", recipe.rms_height);
  recipe.hurst = given.take_or("hurst", recipe.hurst);
  recipe.groove_spacing = given.take_or("groove_spacing", recipe.groove_spacing);
  recipe.groove_length = given.take_or("groove_length", recipe.groove_length);
  recipe.seed = given.request().seed;
  return ground(recipe);
}

Topography make_sinusoid(Given& given) {
  Sinusoid recipe{.grid = given.request().grid};
  recipe.amplitude = given.need("amplitude");
  recipe.wavelength_x = given.take_or("wavelength_x", 0);
  recipe.wavelength_y = given.take_or("wavelength_y", 0);
  return sinusoid(recipe);
}

Topography make_sphere(Given& given) {
  return sphere({.grid = given.request().grid, .radius = given.need("radius")});
}

Topography make_bump(Given& given) {
  return bump({.grid = given.request().grid,
               .height = given.need("height"),
               .radius = given.need("radius")});
}

using Maker = Topography (*)(Given&);

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"self-affine", make_self_affine}, {"edt", make_edt},       {"ground", make_ground},
      {"sinusoid", make_sinusoid},       {"sphere", make_sphere}, {"bump", make_bump}};
  return table;
}

void reject_unknown(const Request& request) {
  std::vector<std::string> names;
  names.reserve(recipe_numbers().size());
  for (const RecipeNumber& number : recipe_numbers()) names.push_back(number.name);
  for (const auto& [name, value] : request.numbers) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw UsageError(fmt::format("generate: got '{}'; expected one of {}{}", name,
                                 fmt::join(names, ", "), suggestion(name, names)));
  }
}

}  // namespace

const std::vector<RecipeNumber>& recipe_numbers() {
  using namespace dimension;
  static const std::vector<RecipeNumber> all = {
      {"hurst", none, "Hurst exponent [0.8, edt 0.75, ground 0.7]"},
      {"rms_height", length, "self-affine, ground: rms height [ground 0.3um]"},
      {"rms_slope", none, "self-affine: rms slope, instead of the rms height"},
      {"roll_off", length, "self-affine: the spectrum is flat above this wavelength"},
      {"long_cutoff", length, "self-affine: no waves above this wavelength"},
      {"short_cutoff", length, "self-affine: no waves below this wavelength [2 pixels]"},
      {"stretch", none, "self-affine: features this much longer along x [1]"},
      {"mean_height", length, "edt: mean absolute height Sa before sliding [0.9um]"},
      {"waviness", length, "edt: rms of waves of 250 um and longer [0.6um]"},
      {"plateau_share", none, "edt: share of the area that is plateaus [0.5]"},
      {"plateau_roughness", length, "edt: rms of the roughness on the plateaus [50nm]"},
      {"noise", length, "edt: rms of the microscope's noise [40nm]"},
      {"pressure", pressure, "edt after sliding: mean pressure of it [7MPa]"},
      {"density", areal_density, "edt after sliding: lubricant density of it [0.45g/m^2]"},
      {"groove_spacing", length, "ground: roll-off wavelength across the grooves [20um]"},
      {"groove_length", length, "ground: length of the grooves along x [400um]"},
      {"amplitude", length, "sinusoid: amplitude", false},
      {"wavelength_x", length, "sinusoid: wavelength along x [constant along x]", false},
      {"wavelength_y", length, "sinusoid: wavelength along y [constant along y]", false},
      {"radius", length, "sphere, bump: radius", false},
      {"height", length, "bump: height", false}};
  return all;
}

const std::vector<std::string>& recipe_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& [kind, unused] : makers()) names.push_back(kind);
    return names;
  }();
  return kinds;
}

Topography generate(const Request& request, const NumberSpelling& spelling) {
  const auto maker = makers().find(request.kind);
  if (maker == makers().end()) {
    throw UsageError(fmt::format("generate: got kind '{}'; expected {}{}", request.kind,
                                 fmt::join(recipe_kinds(), ", "),
                                 suggestion(request.kind, recipe_kinds())));
  }
  reject_unknown(request);
  Given given(request, spelling);
  Topography surface = maker->second(given);
  given.reject_rest();
  return surface;
}

}  // namespace tabor::synthesis
