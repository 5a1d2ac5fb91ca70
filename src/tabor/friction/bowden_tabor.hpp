#pragma once

#include <limits>
#include <string_view>

#include "tabor/core/names.hpp"

// Estimates dry and lubricated friction coefficients from the real contact area (Bowden & Tabor).
namespace tabor::friction {

/// Count of the real contact area that friction uses.
enum class Area {
  corrected,  ///< perimeter-corrected (Yastrebov et al. 2017)
  pixels      ///< counted contact pixels, as Costagliola et al. 2021 do
};

inline constexpr auto kAreas = names<Area>("corrected", "pixels");

/// Returns the name of a count, as on the command line.
std::string_view name(Area area);
/// Returns "contact area" (perimeter-corrected) or "counted contact" (pixels), for headings and
/// sentences.
std::string_view words_of(Area area);
Area parse_area(std::string_view text);  ///< throws InputError with the nearest match

/// Numbers of one contact and film that a Bowden-Tabor estimate needs.
struct Contact {
  double mean_pressure = 0;                 ///< P [Pa], > 0
  double contact_area_fraction = 0;         ///< A_real / A0, perimeter-corrected
  double contact_area_fraction_pixels = 0;  ///< A_real / A0, counted
  double saturation_pressure = std::numeric_limits<double>::infinity();  ///< p_sat [Pa]
  double lubricated_share = 0;  ///< wet contact pixels / contact pixels
};

/// Friction of one state by Bowden and Tabor's rule.
struct Estimate {
  double area_fraction = 0;         ///< A_real / A0 that was used
  Area area = Area::corrected;      ///< and how it was counted
  double friction_dry = 0;          ///< mu of the whole real contact
  double friction_lubricated = 0;   ///< mu of its dry part and of the boundary film on the rest
  bool at_bound = false;            ///< the area is P / p_sat: dry friction is tau_y / p_sat
  bool corrected_at_bound = false;  ///< the corrected area is, whichever was used
};

/// Estimates friction (Bowden & Tabor): the friction force is the shear strength tau_y [Pa] times
/// the real contact area,
///
///   dry         mu = (A_real / A0) tau_y / P
///   lubricated  mu = ((A_real - A_lub) tau_y + A_lub tau_b) / (A0 P)
///
/// (Bowden & Tabor 1950; Costagliola et al. 2021, section 4, with tau_b = 0). tau_b [Pa]: shear
/// strength of the boundary film on wet contact. A corrected area is never taken below P / p_sat,
/// which bounds the continuum too. Throws InputError for values out of range.
Estimate estimate(const Contact& contact, double shear_strength, Area area = Area::corrected,
                  double boundary_shear_strength = 0);

}  // namespace tabor::friction
