#pragma once

#include "tabor/contact/load_problem.hpp"

// Finds a first pressure for a contact solver, from coarser grids or from the bearing area.
namespace tabor::contact {

/// True where a grid is fine enough to be solved on a coarser one first.
bool has_coarser(const Grid& grid);
/// Returns the grid of half the resolution.
Grid coarser(const Grid& grid);
/// Returns means of 2 x 2 pixels; the last row and column of odd sizes stand for themselves.
Field halved(const Field& fine);
/// Returns a map of ny x nx pixels, each with the value of the coarse pixel that it lies in.
Field doubled(const Field& coarse, Index ny, Index nx);

/// Returns a first pressure that carries the load: the start of the problem, else the solution of
/// the same problem on a grid of half the resolution where that exists (recursively), else the
/// bearing area of the heights. Adds the work of the coarse grids to fft_pairs, weighted by their
/// share of pixels. The observer is asked on the coarse grids, too, but gets no certificate of
/// theirs; if it stops there, `convergence` says so.
Field starting_pressure(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                        const Observer& observer, Convergence& convergence);

/// Scales or shifts p on its support so that mean(p) = P exactly, within the bounds; a support too
/// small for the load is widened to all pixels.
void fit_to_load(Field& pressure, double mean_pressure, const Caps& caps);

}  // namespace tabor::contact
