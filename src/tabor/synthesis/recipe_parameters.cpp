#include "tabor/synthesis/recipe_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tabor::synthesis {
namespace {

constexpr double kHighest = 1e6;  // of heights, as scan files are read [m]

const Bounds kHurst{.least = 0, .most = 1, .least_is_out = true, .text = "above 0 and at most 1"};
const Bounds kRms{
    .least = 0, .most = kHighest, .least_is_out = true, .text = "more than zero, at most 1000 km"};
const Bounds kHeight{
    .least = -kHighest, .most = kHighest, .text = "a finite height of at most 1000 km"};
const Bounds kShare{.least = 0, .most = std::nextafter(1, 0), .text = "0 to below 1"};

ParameterHead number(std::string name, std::string help, std::string example,
                     const Bounds& bounds) {
  return {.name = std::move(name),
          .help = std::move(help),
          .example = std::move(example),
          .bounds = bounds,
          .placeholder = "X"};
}

ParameterHead length(std::string name, std::string help, std::string example,
                     const Bounds& bounds) {
  ParameterHead head = number(std::move(name), std::move(help), std::move(example), bounds);
  head.dimension = dimension::length;
  head.placeholder = "LENGTH";
  return head;
}

ParameterHead hurst(std::string example) {
  return number("hurst", "Hurst exponent", std::move(example), kHurst);
}

ParameterHead rms_height(std::string example) {
  return length("rms_height", "rms height", std::move(example), kRms);
}

ParameterHead unless_given(std::string holds, ParameterHead head) {
  head.absent = std::move(holds);
  return head;
}

ParameterHead needed(ParameterHead head) {
  head.needed = Needed::yes;
  return head;
}

ParameterHead radius() { return needed(length("radius", "radius", "", bounds::above_zero)); }

bool is_after(const Edt& recipe) { return recipe.stage == EdtStage::after; }

}  // namespace

std::string value_text(const ParameterHead& parameter, const Cell& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr || std::isnan(*number)) return "";
  const bool is_none = *number == 0 && parameter.needed == Needed::no && parameter.example.empty();
  return is_none ? "none" : text_of(*number, parameter.dimension);
}

std::string plain_phrase(const ParameterHead& parameter, const Cell& value) {
  std::string name = parameter.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  if (const auto* is_on = std::get_if<bool>(&value)) return *is_on ? name : "";
  const std::string text = value_text(parameter, value);
  return text.empty() ? text : name + " " + text;
}

std::string as_named(std::string_view setting) { return std::string(setting); }

const Parameters<PixelSettings>& pixel_parameters() {
  static const Parameters<PixelSettings> all{
      {{.name = "pixels",
        .help = "number of pixels",
        .example = "512",
        .bounds = {.least = 1, .most = 1e6, .text = "numbers of pixels such as 512,256"},
        .placeholder = "NX[,NY]"},
       &PixelSettings::pixels},
      {{.name = "pixel",
        .help = "pixel size",
        .example = "0.67 um",
        .dimension = dimension::length,
        .bounds = bounds::above_zero,
        .placeholder = "DX[,DY]"},
       &PixelSettings::pixel}};
  return all;
}

template <>
const RecipeTable<SelfAffine>& recipe_table() {
  using One = RecipeParameter<SelfAffine>;
  static const RecipeTable<SelfAffine> table{
      "self-affine",
      {One(hurst("0.8"), &SelfAffine::hurst).said("H = "),
       One(rms_height(""), &SelfAffine::rms_height).said("rms height = "),
       One(number("rms_slope", "rms slope, instead of the rms height", "", bounds::above_zero),
           &SelfAffine::rms_slope)
           .said("rms slope = "),
       One(length("roll_off", "the spectrum is flat above this wavelength", "",
                  bounds::zero_or_more),
           &SelfAffine::roll_off_wavelength)
           .said("roll-off "),
       One(length("long_cutoff", "no waves above this wavelength", "", bounds::zero_or_more),
           &SelfAffine::long_cutoff_wavelength),
       One(unless_given("2 pixels", length("short_cutoff", "no waves below this wavelength", "",
                                           bounds::zero_or_more)),
           &SelfAffine::short_cutoff_wavelength),
       One(number("stretch", "features this much longer along x", "1", bounds::above_zero),
           &SelfAffine::stretch),
       One({.name = "random_amplitudes", .help = "Gaussian amplitudes, not random phases only"},
           &SelfAffine::random_amplitudes)
           .said_by([](const SelfAffine& one) {
             return one.random_amplitudes ? "random amplitudes" : "random phases";
           })}};
  return table;
}

template <>
const RecipeTable<Edt>& recipe_table() {
  using One = RecipeParameter<Edt>;
  static const RecipeTable<Edt> table{
      "edt",
      {One({.name = "stage", .help = "before or after sliding", .example = "before"}, &Edt::stage,
           kEdtStages)
           .said("", " sliding"),
       One({.name = "pressure",
            .help = "mean pressure of the sliding",
            .example = "7 MPa",
            .dimension = dimension::pressure,
            .bounds = bounds::above_zero,
            .placeholder = "P"},
           &Edt::sliding_pressure)
           .said(" under ")
           .only_with("stage", "after", is_after),
       One({.name = "density",
            .help = "lubricant density of the sliding",
            .example = "0.45 g/m^2",
            .dimension = dimension::areal_density,
            .bounds = bounds::zero_or_more,
            .placeholder = "D"},
           &Edt::sliding_density)
           .said(" with ")
           .only_with("stage", "after", is_after),
       One(length("mean_height", "mean absolute height Sa before sliding", "0.9 um", kRms),
           &Edt::mean_abs_height)
           .said("Sa before sliding "),
       One(hurst("0.75"), &Edt::hurst).said("H = "),
       One(length("waviness", "rms of waves of 250 um and longer", "0.6 um", bounds::zero_or_more),
           &Edt::waviness),
       One(number("plateau_share", "share of the area that is plateaus", "0.5", kShare),
           &Edt::plateau_share)
           .said_by([](const Edt& one) {
             return fmt::format("plateaus {} %", 100 * one.plateau_share);
           }),
       One(length("plateau_roughness", "rms of the roughness on the plateaus", "50 nm",
                  bounds::zero_or_more),
           &Edt::plateau_roughness)
           .said(" with "),
       One(length("noise", "rms of the microscope's noise", "40 nm", bounds::zero_or_more),
           &Edt::noise),
       One({.name = "periodic",
            .help = "a tile where it is periodic, else a cut-out",
            .flag = "--not-periodic"},
           &Edt::periodic)
           .said_by([](const Edt& one) { return one.periodic ? "periodic" : "not periodic"; })}};
  return table;
}

template <>
const RecipeTable<Ground>& recipe_table() {
  using One = RecipeParameter<Ground>;
  static const RecipeTable<Ground> table{
      "ground",
      {One(rms_height("0.3 um"), &Ground::rms_height).said("Sq = "),
       One(hurst("0.7"), &Ground::hurst).said("H = "),
       One(length("groove_spacing", "roll-off wavelength across the grooves", "20 um",
                  bounds::above_zero),
           &Ground::groove_spacing),
       One(length("groove_length", "length of the grooves along x", "400 um", bounds::above_zero),
           &Ground::groove_length)
           .said("length ")}};
  return table;
}

template <>
const RecipeTable<Sinusoid>& recipe_table() {
  using One = RecipeParameter<Sinusoid>;
  static const RecipeTable<Sinusoid> table{
      "sinusoid",
      {One(needed(length("amplitude", "amplitude", "", kHeight)), &Sinusoid::amplitude),
       One(unless_given("constant along x",
                        length("wavelength_x", "wavelength along x", "", bounds::zero_or_more)),
           &Sinusoid::wavelength_x)
           .said("wavelengths ", " along x"),
       One(unless_given("constant along y",
                        length("wavelength_y", "wavelength along y", "", bounds::zero_or_more)),
           &Sinusoid::wavelength_y)
           .said(" and ", " along y")}};
  return table;
}

template <>
const RecipeTable<Sphere>& recipe_table() {
  using One = RecipeParameter<Sphere>;
  static const RecipeTable<Sphere> table{"sphere", {One(radius(), &Sphere::radius)}};
  return table;
}

template <>
const RecipeTable<Bump>& recipe_table() {
  using One = RecipeParameter<Bump>;
  static const RecipeTable<Bump> table{
      "bump",
      {One(needed(length("height", "height", "", kHeight)), &Bump::height),
       One(radius(), &Bump::radius)}};
  return table;
}

std::string contradiction(const SelfAffine& recipe, const Spelling& spelling) {
  if (recipe.rms_height.has_value() != recipe.rms_slope.has_value()) return "";
  return fmt::format("give either {} or {}", spelling("rms_height"), spelling("rms_slope"));
}

std::string contradiction(const Sinusoid& recipe, const Spelling& spelling) {
  if (recipe.wavelength_x > 0 || recipe.wavelength_y > 0) return "";
  return fmt::format("give {}, {} or both", spelling("wavelength_x"), spelling("wavelength_y"));
}

}  // namespace tabor::synthesis
