#pragma once

#include "tabor/cli/ehl.hpp"

/// Cases of `tabor ehl point` one after the other.
namespace tabor::cli {

/// Each film starts from the one before where that is near: a film of touching solids is hardly
/// found without. The film before goes into a file and comes back bit for bit.
EhlChain make_point_chain();

}  // namespace tabor::cli
