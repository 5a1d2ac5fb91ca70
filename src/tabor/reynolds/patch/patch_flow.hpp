#pragma once

#include "tabor/reynolds/patch/patch_step.hpp"

// Solves the steady flow of oil in the gap of a rough patch with a flat that slides over it.
namespace tabor::reynolds {

/// Solves for the steady film between surfaces of fixed distance that have slid far: the end of
/// many implicit steps (advance() of patch_step.hpp) that begin with `oil`, a film thickness [m] of
/// shape (ny, nx), settled in the gap. A patch of half as many pixels a side is solved first; it
/// gives the distribution of the oil within each connected component of the gap, whose volume it
/// does not change, and saves most steps. Not converging is returned, and so is being stopped: with
/// the film so far, which has no fields before the first step. Throws InputError as patch_cells().
PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const Observer& observer = {});

/// Solves for the steady film from the oil of another steady film of the patch.
PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const PatchFilm& guess,
                      const Observer& observer = {});

}  // namespace tabor::reynolds
