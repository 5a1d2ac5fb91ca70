#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"
#include "tabor/ehl/point.hpp"
#include "tabor/io/toml.hpp"

/// A case of `tabor ehl point`.
namespace tabor::cli {

/// Bodies, load, motion, liquid and grid; smooth. [groups] with M and L takes the place of load and
/// speed: a ball on a flat, steel and mineral oil unless the case says otherwise.
ehl::PointProblem read_point(const io::Config& config);

/// [roughness]: a scan, a bump, a generated finish, or their sum [m] at the nodes of the problem;
/// empty if the case has none.
Field read_point_roughness(const io::Config& config, const ehl::PointProblem& problem,
                           Context& context);

/// The scan that `roughness.file` names, from where the case lies.
std::filesystem::path point_scan(const io::Config& config);

/// All keys of a case.
std::vector<std::string> point_keys();

}  // namespace tabor::cli
