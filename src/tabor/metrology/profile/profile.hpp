#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/metrology/areal/parameter.hpp"
#include "tabor/topography/topography.hpp"

// Computes the profile parameters of ISO 21920-2 and ISO 4287 for all rows or columns of a map.
namespace tabor::metrology {

/// iso21920: ISO 21920-2:2021, Ra Rq Rsk Rku and the elements over the evaluation length.
/// iso4287: ISO 4287:1997, means of the values of the sampling lengths.
enum class ProfileStandard { iso21920, iso4287 };

/// primary: form removed, S-filtered; waviness: then low-passed at lc; roughness: the rest.
/// Primary and waviness profiles are one section, the whole profile.
enum class ProfileKind { roughness, primary, waviness };

/// x: the rows are the profiles; y: the columns.
enum class ProfileAxis { x, y };

/// Treatment of the profile within lc/2 of both ends: weights renormalised (regression of order 0),
/// or cut off.
enum class ProfileEnds { regression, trim };

/// Settings of profile_parameters().
struct ProfileOptions {
  ProfileStandard standard = ProfileStandard::iso21920;
  ProfileKind kind = ProfileKind::roughness;
  std::optional<double> cutoff = {};        ///< lc [m]; empty: choose_setting()
  std::optional<double> short_cutoff = {};  ///< ls [m], 0 for no S-filter; empty: choose_setting()
  std::optional<int> sections = {};         ///< empty: five; 0: as many as fit
  int form_degree = 1;  ///< polynomial removed from each profile first; -1: none, at most 4
  ProfileEnds ends = ProfileEnds::regression;
  bool filtered = false;  ///< the heights are filtered already: no form, no filter, lc divides
  bool forward_slopes = false;  ///< Rdq by forward differences, not the seven-point stencil
  std::optional<double> ratio_height = {};  ///< c of Rmr(c) [m], above the mean line. Empty: 0;
                                            ///< parameters(): that of Smr(c)
};

/// Filters and sections of every profile along one axis.
struct ProfileSetting {
  double cutoff = 0;        ///< lc [m]
  double short_cutoff = 0;  ///< ls [m], 0: no S-filter
  int sections = 0;         ///< sampling lengths of lc each (the whole profile if it is shorter)
  double trim = 0;          ///< [m] left out at either end
  std::string reason;       ///< one line: what was chosen by whom and why
};

/// Chooses cut-offs after ISO 21920-3: the setting class of the surface's Rz (0.08, 0.25, 0.8, 2.5,
/// 8 mm below Rz of 0.16, 0.8, 16, 80 um and above), Rz being the mean range of the fifths of the
/// profiles before filtering (of both axes the larger); the next smaller class as long as five lc
/// do not fit; a fifth of the profile where no class fits. ls: 2.5, 2.5, 2.5, 8, 25 um, or lc/30
/// where no class fits; none where ls is below two pixels. Values that the options fix stay. "The
/// profile" is the shorter side of the map, so that both axes have one lc, unless it is less than a
/// quarter of the other. Throws InputError for invalid options.
ProfileSetting choose_setting(const topography::Topography& topography, ProfileAxis axis,
                              const ProfileOptions& options = {});

/// Computes the profile parameters along one axis: lc_x ls_x sections_x (the setting, its reason in
/// the note of lc), then Ra Rq Rsk Rku Rp Rv Rz Rzx Rt Rdq RSm Rc Rpd Rk Rpk Rvk Rmrk1 Rmrk2
/// Rmr(c), each with _x or _y, P or W instead of R for the primary and the waviness profile (ISO
/// 4287: Rz1max, Mr1, Mr2). Each is the mean over all profiles, with the standard deviation over
/// the profiles and their number in the note. The sections lie in the middle of the profile, alike
/// from both ends, so that a map turned or mirrored has the same parameters. Heights count from the
/// mean line z = 0 that the filters leave, not centred again. Holes have no weight: in a filter the
/// weights, in a section the means are renormalised; a section, or a profile, with less than half
/// of its points is left out. Throws InputError for invalid options; Interrupted when the observer
/// stops it.
std::vector<Parameter> profile_parameters(const topography::Topography& topography,
                                          ProfileAxis axis, const ProfileOptions& options = {},
                                          const Observer& observer = {});

/// Computes the profile parameters of both axes, x first; a map of one row has profiles along x
/// only, a map of one column along y only.
std::vector<Parameter> profile_parameters(const topography::Topography& topography,
                                          const ProfileOptions& options = {},
                                          const Observer& observer = {});

}  // namespace tabor::metrology
