#pragma once

#include <optional>
#include <string>

#include "tabor/ehl/asperities.hpp"
#include "tabor/material/lubricant.hpp"

/// Friction that a film or its solids cannot have, or that nobody can know.
namespace tabor::cli {

/// A warning where a film whose stress knows no limit is sheared at `stress` [Pa] under `pressure`
/// [Pa], harder than oils can be: then its friction is void.
std::optional<std::string> sheared_too_hard(const material::Shear& shear, double stress,
                                            double pressure);

/// A warning where solids carry a share of the load and the case says nothing about their friction:
/// then that of the whole contact is void, too.
std::optional<std::string> frictionless(const ehl::Asperities& asperities, double load_share);

}  // namespace tabor::cli
