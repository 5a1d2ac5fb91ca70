#pragma once

#include <cmath>
#include <functional>

#include "tabor/reynolds/line/reynolds_film.hpp"

namespace tabor::test {

/// A problem on a line with a film given as a function of position; 0.1 Pa s, 1 m/s, p = 0 outside.
inline reynolds::FilmProblem line_problem(double begin, double end, Index n,
                                          const std::function<double(double)>& film) {
  reynolds::FilmProblem problem;
  problem.grid = reynolds::line_grid(begin, end, n);
  problem.film = problem.grid.node.unaryExpr(film);
  problem.speed = 1;
  problem.liquid = reynolds::constant_liquid(0.1);
  return problem;
}

/// The same between a disc and a body of revolution; nothing slides.
inline reynolds::FilmProblem disc_problem(double radius, Index n,
                                          const std::function<double(double)>& film) {
  reynolds::FilmProblem problem;
  problem.grid = reynolds::disc_grid(radius, n);
  problem.film = problem.grid.node.unaryExpr(film);
  problem.liquid = reynolds::constant_liquid(0.1);
  return problem;
}

inline double relative_error(double value, double expected) {
  return std::abs(value / expected - 1);
}

/// The order p of an error that goes with the cell to the p, from two grids, the second twice as
/// fine.
inline double observed_order(double coarse_error, double fine_error) {
  return std::log2(std::abs(coarse_error / fine_error));
}

}  // namespace tabor::test
