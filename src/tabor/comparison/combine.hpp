#pragma once

#include <optional>
#include <string_view>

#include "tabor/comparison/registration.hpp"
#include "tabor/topography/topography.hpp"

// Combines two scans: wear between two states, their difference, or the composite of two faces in
// contact.
namespace tabor::comparison {

/// wear:       A (before) minus B (after) at the same place: positive where material is gone
/// difference: the same map without volumes
/// composite:  A + B turned over about the y axis: two faces in contact. The gap between them is a
///             constant minus this map. Nothing is searched: the faces are two places.
enum class CombineMode { wear, difference, composite };

/// Mounting offset or tilt of B against A, removed from the difference. A plane is fitted robustly,
/// then once more to the unchanged places alone: without the changes that wear_volumes() would find
/// and their rims.
enum class LevelMatch { none, offset, plane };

/// Settings of combine().
struct CombineOptions {
  CombineMode mode = CombineMode::wear;
  bool search = true;  ///< for the shift (wear, difference)
  std::optional<double> shift_x =
      {};  ///< [m], instead; see Registration. Default without search: 0;
  std::optional<double> shift_y = {};  ///< composite: centre on centre
  LevelMatch level = LevelMatch::plane;
  double threshold = 4;  ///< a change counts from here on, in standard deviations of the noise
  RegistrationOptions registration = {};
};

/// A volume [m^3] with one standard deviation, and the area [m^2] it was summed over.
struct Volume {
  double value = 0;
  double uncertainty = 0;
  double area = 0;
};

/// Volumes between two states of a surface. Changes are looked for in the difference smoothed by a
/// Gaussian of cutoff 5 pixels, at `threshold` times its noise, and summed in the difference
/// itself, with the rims around them that only the mean over a ring shows. Uncertainties come from
/// the noise of unchanged places: its standard deviation, the area over which it is correlated, and
/// the plane or offset fitted to it, which shares the noise of the places that it rests on.
struct WearVolumes {
  Volume worn;             ///< removed material
  Volume piled_up;         ///< more than before (as a positive volume)
  Volume net;              ///< worn - piled up over the whole overlap, without a threshold
  double noise = 0;        ///< [m], robust standard deviation of the difference
  double noise_area = 0;   ///< [m^2], area of independent noise: pixel area * sum of its ACF
  double noise_floor = 0;  ///< [m^3] that noise alone would add to worn, and to piled up
  double threshold = 0;    ///< [m], on the smoothed difference
};

/// Result of combine().
struct Combination {
  topography::Topography
      map;  ///< on A's pixels (averaged onto B's where those are larger), cut to the overlap
  double shift_x = 0;  ///< [m]
  double shift_y = 0;
  std::optional<Registration> registration;
  RobustPlane plane;  ///< what was taken out of A - B
  double rms_a = 0;   ///< [m], over the common valid points, about their mean
  double rms_b = 0;
  double rms_map = 0;
  double correlation = 0;  ///< of both heights there
  Index n_common = 0;
  std::optional<WearVolumes> wear;
};

/// Returns the mode of a name, "wear" and so on; nullopt if there is none.
std::optional<CombineMode> combine_mode_from(std::string_view name);
/// Returns the name of a mode.
std::string_view name_of(CombineMode mode);
/// Returns the match of a name, "plane" and so on; nullopt if there is none.
std::optional<LevelMatch> level_match_from(std::string_view name);
/// Returns the name of a match.
std::string_view name_of(LevelMatch match);

/// Combines two scans. Throws InputError when the scans do not overlap, or cannot be matched (see
/// register_scans).
Combination combine(const topography::Topography& a, const topography::Topography& b,
                    const CombineOptions& options = {}, const Observer& observer = {});

/// How the zero of a map of height losses was found, and how finely heights are known.
struct LossOptions {
  double threshold = 4;                  ///< see CombineOptions
  LevelMatch level = LevelMatch::plane;  ///< what was fitted to the unchanged places and removed
  double resolution = 0;                 ///< [m]; smaller differences of heights are rounding
};

/// Computes the volumes of a map of height losses whose zero is the unchanged surface.
WearVolumes wear_volumes(const Field& loss, const Grid& grid, const LossOptions& options = {});

}  // namespace tabor::comparison
