// Spatial parameters: how far heights stay alike, and where the texture points.
#include <fmt/format.h>

#include <numbers>

#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/metrology/areal/sets.hpp"
#include "tabor/metrology/areal/texture.hpp"
#include "tabor/metrology/spectra/correlation.hpp"

namespace tabor::metrology {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

std::string no_length_note(double threshold) {
  return fmt::format("the ACF does not fall to {:g} within the field in any direction", threshold);
}

Parameter decay_length(const CorrelationLengths& lengths, double threshold) {
  Parameter sal{"Sal", lengths.shortest, "m",
                fmt::format("autocorrelation length: shortest lag at which the unbiased ACF first "
                            "falls to s = {:g}, rays every 0.25 degrees",
                            threshold)};
  if (std::isnan(sal.value)) sal.note = no_length_note(threshold);
  return sal;
}

Parameter aspect_ratio(const CorrelationLengths& lengths, double threshold) {
  Parameter str{"Str", lengths.texture_aspect().value_or(kNoValue), "1",
                "texture aspect ratio: Sal over the longest such lag (1: isotropic, 0: a lay)"};
  if (std::isnan(lengths.shortest)) {
    str.note = no_length_note(threshold);
  } else if (!lengths.longest) {
    str.note = fmt::format("< {:.3g}: the ACF does not fall to {:g} along the lay within the field",
                           lengths.texture_bound(), threshold);
  }
  return str;
}

std::vector<Parameter> correlation_parameters(const topography::Topography& topography,
                                              double threshold) {
  const auto acf = autocorrelation(topography.height, topography.grid);
  CorrelationLengths lengths;
  lengths.shortest = kNoValue;
  if (acf.mean_square() > 0) lengths = correlation_lengths(acf, threshold);
  return {decay_length(lengths, threshold), aspect_ratio(lengths, threshold)};
}

std::string texture_note(const topography::Topography& topography, const Texture& texture) {
  if (std::isnan(texture.wavelength)) return "a flat surface has none";
  std::string note;
  const Grid& grid = topography.grid;
  if (texture.n_holes > 0) note = fmt::format("{} holes count as the mean", texture.n_holes);
  if (const double ratio = grid.lx / grid.ly; ratio > 1.01 || ratio < 0.99) {
    note += fmt::format("{}the field is not square: directions are resolved unevenly",
                        note.empty() ? "" : "; ");
  }
  return note;
}

/// The note of the texture and what holds for its direction alone.
std::string direction_note(const std::string& note, const Texture& texture) {
  constexpr double least_said = 5;
  const double degrees = texture.uncertainty * kDegrees;
  if (std::isnan(texture.wavelength) || degrees < least_said) return note;
  const std::string known =
      texture.is_narrow
          ? fmt::format("the strip is too narrow to tell, to {:.2g} degrees at best", degrees)
          : fmt::format("known to {:.2g} degrees by the waves that fit into the field", degrees);
  return note.empty() ? known : known + "; " + note;
}

}  // namespace

std::vector<Parameter> spatial_parameters(const topography::Topography& topography,
                                          const ParameterOptions& options,
                                          const Observer& observer) {
  const Watch watch(observer, "autocorrelation");
  std::vector<Parameter> found = correlation_parameters(topography, options.acf_threshold);
  report_progress(observer, "texture direction", kNoValue);
  const Texture texture = texture_of(topography);
  const std::string note = texture_note(topography, texture);
  found.push_back({"Std", texture.direction * kDegrees, "deg",
                   "texture direction: angle of the wavevector with the largest angular power "
                   "spectrum of z - <z>, from x counter-clockwise, 0 to 180; the lay runs across",
                   direction_note(note, texture)});
  found.push_back({"Ssw", texture.wavelength, "m",
                   "dominant spatial wavelength: of the largest Fourier magnitude of z - <z>",
                   note});
  return found;
}

}  // namespace tabor::metrology
