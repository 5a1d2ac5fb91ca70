#pragma once

#include <Eigen/Core>

/// What the films of all programs have in common.
namespace tabor::ehl {

/// The smallest film [m], by a parabola through the thinnest node and its neighbours.
double smallest_film(const Eigen::ArrayXd& film);

}  // namespace tabor::ehl
