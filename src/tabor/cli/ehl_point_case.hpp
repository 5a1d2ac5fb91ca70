#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tabor/cli/ehl_keys.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/ehl/point/point.hpp"
#include "tabor/io/toml.hpp"

/// A case of `tabor ehl point`.
namespace tabor::cli {

/// Bodies, load, motion, liquid and grid; smooth. [groups] with M and L takes the place of load and
/// speed: a ball on a flat, steel and mineral oil unless the case says otherwise.
ehl::PointProblem read_point(const io::Config& config);

/// Heights [m] at the nodes of a problem once the surface has moved so far along the flow [m].
using PointRoughness = std::function<Field(double moved)>;

/// [roughness]: a scan, a bump, a generated finish, or their sum; empty if the case has none. A
/// generated finish is long enough to move by `travel` [m], of either sign.
PointRoughness read_point_roughness(const io::Config& config, const ehl::PointProblem& problem,
                                    double travel, Context& context);

/// The whole case: read_point() with the roughness where it lies at rest.
ehl::PointProblem read_rough_point(const io::Config& config, Context& context);

/// All keys of a case, and those of [roughness] alone.
EhlKeys point_keys();
EhlKeys point_roughness_keys();

}  // namespace tabor::cli
