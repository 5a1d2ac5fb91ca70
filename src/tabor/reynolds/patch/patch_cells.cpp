#include "tabor/reynolds/patch/patch_cells.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::reynolds {
namespace {

void check_shape(const char* what, Index rows, Index cols, const Grid& grid) {
  if (rows != grid.ny || cols != grid.nx) {
    throw InputError(what, fmt::format("{} x {} pixels", cols, rows),
                     fmt::format("{} x {} as the grid", grid.nx, grid.ny), "");
  }
}

void check_positive(const char* what, const Field& field, const Grid& grid) {
  if (field.size() == 0) return;
  check_shape(what, field.rows(), field.cols(), grid);
  if (!(field > 0).all() || !field.isFinite().all()) {
    throw InputError(what, "values that are not positive and finite", "a viscosity everywhere", "");
  }
}

void check(const PatchProblem& problem) {
  check_shape("gap", problem.gap.rows(), problem.gap.cols(), problem.grid);
  if (!problem.gap.isFinite().all()) throw InputError("gap has NaN or infinite values");
  check_positive("viscosity along", problem.viscosity_along, problem.grid);
  check_positive("viscosity across", problem.viscosity_across, problem.grid);
  const bool has_field = problem.viscosity_along.size() > 0 && problem.viscosity_across.size() > 0;
  if (!has_field && !(problem.viscosity > 0 && std::isfinite(problem.viscosity))) {
    throw InputError("viscosity", fmt::format("{} Pa s", problem.viscosity), "more than zero", "");
  }
  if (!(problem.entrainment_speed >= 0 && std::isfinite(problem.entrainment_speed))) {
    throw InputError("speed", fmt::format("{} m/s", problem.entrainment_speed), "zero or more",
                     "flip the scan to slide the other way");
  }
  if (!(problem.thinnest_film > 0)) {
    throw InputError("thinnest film", fmt::format("{} m", problem.thinnest_film), "more than zero",
                     "");
  }
  if (problem.reservoir.size() > 0) {
    check_shape("reservoir", problem.reservoir.rows(), problem.reservoir.cols(), problem.grid);
  }
}

/// What one face lets through, of two cells with gaps a, b > 0.
struct Face {
  double film;         ///< h [m]
  double conductance;  ///< h^3/(12 eta) [m^3/(Pa s)]
};

Face face_between(double a, double b, double viscosity_a, double viscosity_b) {
  const double film = (a + b) / 2;
  return {film, film * film * film / (6 * (viscosity_a + viscosity_b))};
}

void set_row(const PatchProblem& problem, Index row, PatchCells& cells) {
  const Grid& grid = problem.grid;
  const auto along = [&](Index cell) {
    return problem.viscosity_along.size() > 0 ? problem.viscosity_along.data()[cell]
                                              : problem.viscosity;
  };
  const auto across = [&](Index cell) {
    return problem.viscosity_across.size() > 0 ? problem.viscosity_across.data()[cell]
                                               : problem.viscosity;
  };
  for (Index cell = row * grid.nx; cell < (row + 1) * grid.nx; ++cell) {
    const auto [left, right, up, down] = cells.around(cell);
    const double film = cells.gap.data()[cell];
    const double film_right = cells.gap.data()[right];
    const double film_below = cells.gap.data()[down];
    if (film > 0 && film_right > 0 && right != cell) {
      const Face face = face_between(film, film_right, along(cell), along(right));
      cells.conduct_x.data()[cell] = face.conductance / (grid.dx() * grid.dx());
      cells.carried.data()[cell] = problem.entrainment_speed * face.film / grid.dx();
    }
    if (film > 0 && film_below > 0 && down != cell) {
      const Face face = face_between(film, film_below, across(cell), across(down));
      cells.conduct_y.data()[cell] = face.conductance / (grid.dy() * grid.dy());
    }
  }
}

}  // namespace

Neighbours PatchCells::around(Index cell) const {
  const Index row = cell / nx;
  const Index column = cell - row * nx;
  return {column > 0 ? cell - 1 : cell + nx - 1, column + 1 < nx ? cell + 1 : cell + 1 - nx,
          row > 0 ? cell - nx : cell + (ny - 1) * nx, row + 1 < ny ? cell + nx : column};
}

PatchCells patch_cells(const PatchProblem& problem) {
  check(problem);
  PatchCells cells;
  cells.nx = problem.grid.nx;
  cells.ny = problem.grid.ny;
  cells.gap = (problem.gap > problem.thinnest_film).select(problem.gap, 0.0);
  cells.conduct_x = Field::Zero(cells.ny, cells.nx);
  cells.conduct_y = cells.conduct_x;
  cells.carried = cells.conduct_x;
  cells.reservoir = problem.reservoir;
  cells.reservoir_pressure = problem.reservoir_pressure;
  cells.vent_pressure = problem.vent_pressure;
  parallel_for(cells.ny, 64, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) set_row(problem, row, cells);
  });
  return cells;
}

Components components_of(const PatchCells& cells) {
  Components components{std::vector<std::int32_t>(static_cast<std::size_t>(cells.size()), -1), {}};
  std::vector<std::int32_t> waiting;
  const auto enter = [&](Index cell) {
    std::int32_t& component = components.of[static_cast<std::size_t>(cell)];
    if (!cells.is_open(cell) || component >= 0) return;
    component = static_cast<std::int32_t>(components.widest.size());
    waiting.push_back(static_cast<std::int32_t>(cell));
  };
  for (Index first = 0; first < cells.size(); ++first) {
    enter(first);
    if (waiting.empty()) continue;
    std::int32_t widest = waiting.back();
    while (!waiting.empty()) {
      const std::int32_t cell = waiting.back();
      waiting.pop_back();
      if (cells.gap.data()[cell] > cells.gap.data()[widest]) widest = cell;
      const Neighbours next = cells.around(cell);
      for (const Index other : {next.left, next.right, next.up, next.down}) enter(other);
    }
    components.widest.push_back(widest);
  }
  return components;
}

}  // namespace tabor::reynolds
