#pragma once

#include "tabor/reynolds/patch_step.hpp"

namespace tabor::reynolds {

/// The film that the oil makes between surfaces which keep their distance once they have slid far:
/// the end of many implicit steps (advance() of patch_step.hpp) that begin with `oil`, a film
/// thickness [m] of shape (ny, nx), settled in the gap. A patch of half as many pixels a side is
/// solved first and says within each room of the gap where the oil goes, which changes no room's
/// volume and saves most of the way. Not converging is returned, and so is being stopped:
/// with what was reached, which has no fields if that is nothing. Throws InputError as
/// patch_cells().
PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const Observer& observer = {});

/// The same, beginning where another steady film of the patch has its oil.
PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const PatchFilm& guess,
                      const Observer& observer = {});

}  // namespace tabor::reynolds
