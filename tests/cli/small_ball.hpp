#pragma once

namespace tabor::test {

/// A case of `tabor ehl point` that takes a moment.
inline constexpr const char* kBall = R"([ball]
radius = "1.5 mm"
load = "16.6 N"
[solids]
e_prime = "230.8 GPa"
[lubricant]
viscosity = "0.149 Pa s"
viscosity_law = "roelands"
pressure_viscosity = "2.131e-8 1/Pa"
[motion]
speed = "0.1 m/s"
[grid]
nodes_x = 33
nodes_y = 33
)";

}  // namespace tabor::test
