#pragma once

#include <string>

#include "tabor/study/axis.hpp"

namespace tabor::cli {

/// Parses one axis of a sweep: "ball.speed=0.2m/s", "ball.speed=0.05m/s..1m/s:log:5",
/// "grid.nodes=100..300:3" (linear unless it says log; 5 values unless it says how many),
/// "grid.nodes=65,97,145". Two dots that do not stand between numbers belong to a path; commas
/// beside quotes, brackets or braces to a TOML value. Throws UsageError.
study::SweepAxis parse_axis(const std::string& text);

}  // namespace tabor::cli
