#pragma once

#include <cstdint>
#include <optional>

#include "tabor/core/names.hpp"
#include "tabor/topography/topography.hpp"

// Generates rough surfaces with given statistics, and simple shapes.
namespace tabor::synthesis {

/// Periodic self-affine roughness. The amplitude of each wavevector is drawn from (seed,
/// wavevector) alone: the same seed gives the same bits on any number of threads, and the same
/// large features at any resolution. Power spectrum: 0 below the long cutoff, flat up to the
/// roll-off, ~ q^-2(1+H) up to the short cutoff, 0 beyond.
struct SelfAffine {
  Grid grid;
  double hurst = 0.8;
  std::optional<double> rms_height;    ///< [m], exact; give this or rms_slope
  std::optional<double> rms_slope;     ///< exact, by spectral derivative
  double roll_off_wavelength = 0;      ///< [m], 0 = none (the scan side)
  double long_cutoff_wavelength = 0;   ///< [m], 0 = none (the scan side)
  double short_cutoff_wavelength = 0;  ///< [m], 0 = Nyquist (2 pixels), along the axes
  double stretch = 1;                  ///< features this much longer along x than along y
  bool random_amplitudes = false;      ///< Gaussian amplitudes instead of random phases only
  std::uint64_t seed = 1;
};
topography::Topography self_affine(const SelfAffine& recipe);

/// Before or after sliding.
enum class EdtStage { before, after };
inline constexpr auto kEdtStages = names<EdtStage>("before", "after");

/// A sheet textured by electro-discharge rolls: overlapping craters and plateaus with smaller
/// asperities on top, on a wavy sheet, with the noise of a microscope. `after` sliding: tops
/// flattened, the more the higher the pressure and the less the oil, shallow grooves along x.
/// Throws InputError where waviness, plateau roughness and noise alone exceed Sa.
struct Edt {
  Grid grid{512, 512, 512 * 0.67e-6, 512 * 0.67e-6};
  double mean_abs_height = 0.9e-6;  ///< Sa of the surface before sliding [m], exact
  double hurst = 0.75;              ///< of the roughness in craters and on plateaus
  double waviness = 0.6e-6;         ///< rms [m] of waves longer than 250 um; none on smaller maps
  double plateau_share = 0.5;       ///< of the area that rolling makes plateaus of
  double plateau_roughness = 0.05e-6;  ///< rms [m], with a roll-off of 20 um
  double noise = 40e-9;                ///< rms [m] of each pixel, independent
  EdtStage stage = EdtStage::before;
  double sliding_pressure = 7e6;     ///< [Pa], mean; of a surface after sliding
  double sliding_density = 0.45e-3;  ///< [kg/m^2], of the lubricant; the same
  bool periodic = true;              ///< false: a cut-out of a larger periodic surface
  std::uint64_t seed = 1;
};
topography::Topography edt(const Edt& recipe);

/// Ground finish: grooves along x, self-affine across.
struct Ground {
  Grid grid;
  double rms_height = 0.3e-6;  ///< [m], exact
  double hurst = 0.7;
  double groove_spacing = 20e-6;  ///< [m], roll-off wavelength across the grooves
  double groove_length = 400e-6;  ///< [m], correlation length along x
  std::uint64_t seed = 1;
};
topography::Topography ground(const Ground& recipe);

/// amplitude cos(2 pi x / wavelength_x) cos(2 pi y / wavelength_y); a wavelength of 0 drops its
/// factor. Pixel (0, 0) is a crest. Periodic if whole wavelengths fit. Throws InputError below two
/// pixels a wave.
struct Sinusoid {
  Grid grid;
  double amplitude = 1e-6;  ///< [m]
  double wavelength_x = 0;  ///< [m]
  double wavelength_y = 0;  ///< [m]
};
topography::Topography sinusoid(const Sinusoid& recipe);

/// A sphere (exact, not the parabola) touching z = 0 from below at the centre of the scan; pixels
/// outside the sphere's shadow are as deep as its equator.
struct Sphere {
  Grid grid;
  double radius = 1e-3;  ///< [m]
};
topography::Topography sphere(const Sphere& recipe);

/// A smooth bump height * cos^2(pi r / (2 radius)) inside `radius` on a flat surface, in the
/// centre.
struct Bump {
  Grid grid;
  double height = 1e-6;   ///< [m]
  double radius = 10e-6;  ///< [m]
};
topography::Topography bump(const Bump& recipe);

}  // namespace tabor::synthesis
