#pragma once

#include <string>
#include <vector>

#include "tabor/core/warning.hpp"
#include "tabor/ehl/asperities.hpp"
#include "tabor/material/lubricant.hpp"

/// Friction that a film or its solids cannot have, or that nobody can know.
namespace tabor::ehl {

/// Shear stress over pressure beyond which oils give way (Johnson & Tevaarwerk 1977,
/// doi:10.1098/rspa.1977.0129).
inline constexpr double kYieldRatio = 0.1;

/// The friction of a film, and what tells whether it can be.
struct FilmFriction {
  double max_pressure;       ///< [Pa]
  double solid_load_share;   ///< of the solids that need a law for their friction
  double& max_shear_stress;  ///< [Pa]
  double& fluid;             ///< part of the coefficient
  double& solid;             ///< NaN if the case gives no law for it
  double& coefficient;       ///< of both
};

/// Takes away (NaN) the friction of a film whose stress knows no limit where it is sheared harder
/// than oils can be, and that of the whole contact where solids carry load and the case says
/// nothing about their friction. Returns why.
/// `remedy` says what to do about such a film.
Warnings void_friction(const material::Shear& shear, const Asperities& asperities,
                       const FilmFriction& friction,
                       const std::string& remedy = "Give lubricant.eyring_stress");

}  // namespace tabor::ehl
