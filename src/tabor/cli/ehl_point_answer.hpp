#pragma once

#include "tabor/cli/ehl.hpp"
#include "tabor/ehl/point/point.hpp"

/// What `tabor ehl point` says of a film (docs/ehl_point.md).
namespace tabor::cli {

/// Numbers, text, warnings and maps.
EhlAnswer point_answer(const io::Config& config, const ehl::PointProblem& problem,
                       const ehl::PointResult& result, const Context& context);

/// Adds the rough bodies without liquid: what the film tends to as the speed vanishes.
void add_dry_contact(const ehl::PointProblem& problem, const Observer& observer, EhlAnswer& answer);

}  // namespace tabor::cli
