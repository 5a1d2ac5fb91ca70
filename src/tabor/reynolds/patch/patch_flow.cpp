#include "tabor/reynolds/patch/patch_flow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::reynolds {
namespace {

constexpr Index kCoarsest = 48;   // pixels a side below which no coarser patch is solved first
constexpr double kSteady = 3e-4;  // change of the mean pressure in a step
constexpr int kMaxSteps = 40;
constexpr double kFirstStep = 1;  // lengths of the patch
constexpr double kLongStep = 10;
// A film that is not steady after so many steps changes slowly: longer steps, which are harder to
// solve, are then the shorter way.
constexpr int kPatience = 10;
constexpr double kLongestStep = 100;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Which cell of a grid of `coarse` cells a cell of one of `fine` cells lies in.
Index place_in(Index coarse, Index cell, Index fine) { return cell * coarse / fine; }

/// Means of a map over the cells of a coarser grid, of those where `counts`; 0 where less than half
/// of them do.
Field averaged(const Field& fine, const Field& counts, Index ny, Index nx) {
  Field total = Field::Zero(ny, nx);
  Field weight = total;
  Field all = total;
  for (Index row = 0; row < fine.rows(); ++row) {
    const Index coarse_row = place_in(ny, row, fine.rows());
    for (Index column = 0; column < fine.cols(); ++column) {
      const Index coarse_column = place_in(nx, column, fine.cols());
      all(coarse_row, coarse_column) += 1;
      if (!(counts(row, column) > 0)) continue;
      total(coarse_row, coarse_column) += fine(row, column);
      weight(coarse_row, coarse_column) += 1;
    }
  }
  return (2 * weight >= all).select(total / weight.max(1.0), 0.0);
}

Field sampled(const Field& coarse, Index ny, Index nx) {
  Field fine(ny, nx);
  for (Index row = 0; row < ny; ++row) {
    const Index coarse_row = place_in(coarse.rows(), row, ny);
    for (Index column = 0; column < nx; ++column) {
      fine(row, column) = coarse(coarse_row, place_in(coarse.cols(), column, nx));
    }
  }
  return fine;
}

Field viscosity_on(const Field& fine, Index ny, Index nx) {
  if (fine.size() == 0) return fine;
  Field coarse(ny, nx);
  for (Index row = 0; row < ny; ++row) {
    for (Index column = 0; column < nx; ++column) {
      coarse(row, column) = fine(row * fine.rows() / ny, column * fine.cols() / nx);
    }
  }
  return coarse;
}

bool can_be_coarser(const PatchProblem& problem) {
  return problem.reservoir.size() == 0 && std::max(problem.grid.nx, problem.grid.ny) > kCoarsest;
}

PatchProblem coarser(const PatchProblem& problem) {
  PatchProblem coarse = problem;
  coarse.grid.nx = (problem.grid.nx + 1) / 2;
  coarse.grid.ny = (problem.grid.ny + 1) / 2;
  const Field open = (problem.gap > problem.thinnest_film).cast<double>();
  coarse.gap = averaged(problem.gap, open, coarse.grid.ny, coarse.grid.nx);
  coarse.viscosity_along = viscosity_on(problem.viscosity_along, coarse.grid.ny, coarse.grid.nx);
  coarse.viscosity_across = viscosity_on(problem.viscosity_across, coarse.grid.ny, coarse.grid.nx);
  return coarse;
}

/// Distributes the oil of each connected component by the fills, at constant volume: fills are
/// scaled down if there is less oil than they would take, voids if there is more.
void redistribute(const PatchCells& cells, const Components& components, const Field& fill,
                  Field& oil) {
  struct Component {
    double oil = 0;
    double wanted = 0;
    double holds = 0;
  };
  std::vector<Component> sums(at(components.count()));
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    Component& component = sums[at(components.of[at(cell)])];
    component.oil += oil.data()[cell];
    component.wanted += fill.data()[cell] * cells.gap.data()[cell];
    component.holds += cells.gap.data()[cell];
  }
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    const Component& component = sums[at(components.of[at(cell)])];
    const double gap = cells.gap.data()[cell];
    const double wanted = fill.data()[cell] * gap;
    if (component.oil <= component.wanted && component.wanted > 0) {
      oil.data()[cell] = wanted * (component.oil / component.wanted);
    } else if (component.oil < component.holds && component.wanted < component.holds) {
      oil.data()[cell] = gap - (gap - wanted) * ((component.holds - component.oil) /
                                                 (component.holds - component.wanted));
    }
  }
}

/// Adds the work of a film before to a later one.
void add_work(const PatchFilm& before, PatchFilm& film) {
  film.steps += before.steps;
  film.convergence = after(before.convergence, film.convergence);
}

/// A step is easier if it is shorter; the oil stays where it was.
void reject(const PatchFilm& next, PatchFilm& film) {
  film.convergence.iterations = next.convergence.iterations;
  film.convergence.operator_applications = next.convergence.operator_applications;
  film.convergence.status = Status::stalled;
}

void slide(const PatchProblem& problem, const PatchCells& cells, const Components& components,
           const Observer& observer, PatchFilm& film) {
  const double crossing = problem.grid.lx / problem.entrainment_speed;  // [s]
  double length = kFirstStep;
  for (int step = 1; step <= kMaxSteps; ++step) {
    PatchFilm next = advance(cells, components, film.oil, length * crossing, film, observer);
    add_work(film, next);
    if (next.convergence.status == Status::stalled) {
      length /= 4;
      reject(next, film);
      continue;
    }
    const double change = std::abs(next.mean_pressure - film.mean_pressure);
    const double steady = std::max(kSteady * next.mean_pressure, problem.pressure_resolution);
    next.convergence.certificate = next.mean_pressure > 0 ? change / next.mean_pressure : change;
    next.convergence.tolerance = next.mean_pressure > 0 ? steady / next.mean_pressure : steady;
    if (!(step > 2 && change <= steady)) next.convergence.status = Status::iteration_limit;
    film = std::move(next);
    if (film.convergence.converged()) return;
    length = std::min(3 * length, step < kPatience ? kLongStep : kLongestStep);
  }
}

void slide_from(const PatchProblem& problem, const Field& oil, const PatchFilm* guess,
                const Observer& observer, PatchFilm& film) {
  const PatchCells cells = patch_cells(problem);
  const Components components = components_of(cells);
  film.oil = settle(cells, components, oil, 0);
  film.pressure = Field::Zero(cells.ny, cells.nx);
  film.fill = film.pressure;
  const bool is_at_rest = problem.entrainment_speed == 0 || !(oil > 0).any();
  film.convergence = is_at_rest ? exact() : Convergence();
  if (is_at_rest) return;
  if (guess) {
    add_work(*guess, film);
    film.pressure = sampled(guess->pressure, cells.ny, cells.nx);
    if (guess->unit.size() > 0) film.unit = sampled(guess->unit, cells.ny, cells.nx);
    redistribute(cells, components, sampled(guess->fill, cells.ny, cells.nx), film.oil.volume);
  }
  slide(problem, cells, components, observer, film);
}

void check_oil(const PatchProblem& problem, const Field& oil) {
  if (oil.rows() != problem.grid.ny || oil.cols() != problem.grid.nx || !oil.isFinite().all() ||
      !(oil >= 0).all()) {
    throw InputError("oil on a patch: expected a film thickness of zero or more at every pixel");
  }
}

PatchFilm watched_film(const PatchProblem& problem, const Field& oil, const PatchFilm* guess,
                       const Observer& observer) {
  PatchFilm film;
  film.convergence.status = Status::stopped;
  if (guess && guess->convergence.stopped()) return film;
  const auto work = [&](Watch&) { slide_from(problem, oil, guess, observer, film); };
  if (!finishes(observer, "film", work)) film.convergence.status = Status::stopped;
  return film;
}

}  // namespace

PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const Observer& observer) {
  check_oil(problem, oil);
  if (!can_be_coarser(problem)) return watched_film(problem, oil, nullptr, observer);
  const PatchProblem coarse = coarser(problem);
  const Field everywhere = Field::Ones(problem.grid.ny, problem.grid.nx);
  const Field coarse_oil = averaged(oil, everywhere, coarse.grid.ny, coarse.grid.nx);
  const PatchFilm guess = steady_film(coarse, coarse_oil, observer);
  return watched_film(problem, oil, &guess, observer);
}

PatchFilm steady_film(const PatchProblem& problem, const Field& oil, const PatchFilm& guess,
                      const Observer& observer) {
  check_oil(problem, oil);
  return watched_film(problem, oil, &guess, observer);
}

}  // namespace tabor::reynolds
