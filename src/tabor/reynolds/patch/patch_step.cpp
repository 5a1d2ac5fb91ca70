#include "tabor/reynolds/patch/patch_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/core/parallel.hpp"
#include "tabor/reynolds/patch/patch_balance.hpp"

namespace tabor::reynolds {
namespace {

using Eigen::VectorXd;

constexpr int kMaxIterations = 30;  // a step that needs more is finished by the next
constexpr int kMaxProducts = 400;
constexpr double kRoughTolerance = 1e-4;  // of the flows, while many cells still change sides
constexpr double kFairTolerance = 1e-6;   // while few do
constexpr double kTolerance = 1e-11;
constexpr double kReduction = 3e-3;  // of what the changed cells leave, while any still change
constexpr double kCloser = 0.01;     // where no fewer cells change sides than before
constexpr double kOverfill = 1e-6;   // a fill above 1 by less is what the solver leaves
// Sets of cells fit if at most one cell in so many still changes sides, which the pressure does not
// feel by more than this.
constexpr Index kFewChanges = 20000;
constexpr double kSamePressure = 1e-4;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// One implicit step: finds the sets of full and starved cells.
class Step {
 public:
  Step(const PatchCells& cells, const Components& components, const PatchOil& oil, double time,
       const Field& unit, const Observer& observer)
      : cells_(cells),
        components_(components),
        oil_(oil),
        time_(time),
        observer_(observer),
        balance_(cells, oil, time),
        unit_(unit.size() > 0 ? unit : Field::Ones(cells.ny, cells.nx)),
        overfull_(at(components.count()), false) {
    find_overfull_components();
  }

  PatchFilm run(const Field& guess) {
    choose_first_kinds(guess);
    PatchFilm film;
    double tolerance = kRoughTolerance;
    Index last_changes = cells_.size();
    bool quiet = false;
    bool settled = false;
    bool balanced = false;
    film.convergence.tolerance = kTolerance;
    while (!settled && film.convergence.iterations < kMaxIterations) {
      ++film.convergence.iterations;
      const bool is_last = quiet;
      balanced = solve_pressures(tolerance, is_last ? 0 : kReduction, film.convergence);
      const double before = film.mean_pressure;
      film.mean_pressure =
          sum(balance_.pressures()) / static_cast<double>(balance_.pressures().size());
      const Index changes = change_sides();
      const bool same = std::abs(film.mean_pressure - before) <= kSamePressure * film.mean_pressure;
      quiet = changes == 0 || (same && changes <= cells_.size() / kFewChanges);
      settled = is_last && quiet;
      if (settled && changes > 0) balanced = solve_pressures(kTolerance, 0, film.convergence);
      if (changes <= cells_.size() / 10000) tolerance = std::min(tolerance, kFairTolerance);
      if (changes >= last_changes) tolerance *= kCloser;
      tolerance = quiet ? kTolerance : std::max(tolerance, kTolerance);
      last_changes = changes;
    }
    if (!settled) balanced = solve_pressures(kTolerance, 0, film.convergence);
    film.convergence.status = !balanced ? Status::stalled
                              : settled ? Status::converged
                                        : Status::iteration_limit;
    return finished(std::move(film));
  }

 private:
  void choose_first_kinds(const Field& guess) {
    const bool guessed = guess.size() == balance_.pressures().size();
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      const bool full =
          (guessed && guess.data()[cell] > 0) || balance_.oil(cell) >= balance_.gap(cell);
      balance_.set_kind(cell, full ? CellKind::full : CellKind::starved);
      if (balance_.is_reservoir(cell)) {
        balance_.pin(cell, cells_.reservoir_pressure);
      } else if (guessed && full) {
        balance_.pressure(cell) = guess.data()[cell];
      }
    }
    keep_components_determined();
  }

  void find_overfull_components() {
    std::vector<double> holds(at(components_.count()), 0);
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      holds[at(components_.of[at(cell)])] += balance_.gap(cell) - balance_.oil(cell);
    }
    for (std::size_t component = 0; component < holds.size(); ++component) {
      overfull_[component] = holds[component] <= 0;
    }
  }

  /// Fixes the pressure of connected components whose cells are all full. If a component has more
  /// oil than fits, its vent fixes it; if not, one cell is starved after all: that of the lowest
  /// pressure, or the emptiest.
  void keep_components_determined() {
    std::vector<Index> lowest(at(components_.count()), -1);
    std::vector<bool> determined(at(components_.count()), false);
    const auto before = [&](Index a, Index b) {
      const double lower = balance_.pressure(a) - balance_.pressure(b);
      if (lower != 0) return lower < 0;
      return balance_.oil(a) * balance_.gap(b) < balance_.oil(b) * balance_.gap(a);
    };
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      const std::size_t component = at(components_.of[at(cell)]);
      if (balance_.kind(cell) != CellKind::full) determined[component] = true;
      if (lowest[component] < 0 || before(cell, lowest[component])) lowest[component] = cell;
    }
    for (std::size_t component = 0; component < lowest.size(); ++component) {
      if (determined[component]) continue;
      if (overfull_[component]) {
        balance_.pin(components_.widest[component], cells_.vent_pressure);
      } else {
        balance_.set_kind(lowest[component], CellKind::starved);
      }
    }
  }

  /// What the full cells gain too much [m/s], and the size of the flows it is the difference of.
  double residual(const FullCells& system, VectorXd& r, double& rounding) {
    double scale = 0;
    rounding = 0;
    r.resize(system.count());
    for (Index i = 0; i < system.count(); ++i) {
      const Index cell = system.cell(i);
      r[i] = balance_.surplus(cell);
      const double flow = balance_.throughput(cell);
      scale += flow * flow;
      const double pushed =
          balance_.pressure(cell) * (cells_.conduct_x.data()[cell] + cells_.conduct_y.data()[cell]);
      rounding += pushed * pushed;
    }
    rounding = kEpsilon * std::sqrt(rounding);
    return std::sqrt(scale);
  }

  /// Solves until the residual is below `tolerance` of the flows or `reduction` of what it was;
  /// returns whether it is.
  bool solve_pressures(double tolerance, double reduction, Convergence& convergence) {
    FullCells system(cells_, balance_.kinds(), time_, unit_);
    VectorXd r;
    VectorXd step;
    double rounding = 0;
    double left = 0;
    bool solved = false;
    for (int round = 0; round < 8 && !solved; ++round) {
      balance_.sweep();
      const double flows = residual(system, r, rounding);
      if (round == 0) left = reduction * r.norm();
      const double goal = std::max(tolerance * flows, left) + 16 * rounding;
      convergence.certificate = flows > 0 ? r.norm() / flows : 0;
      solved = r.norm() <= goal;
      if (solved) break;
      const double target = std::max(goal / 2, 1e-6 * r.norm());
      const bool went_well = system.solve(
          r, target, kMaxProducts, step, [&] { report_progress(observer_, "film", std::nan("")); });
      for (Index i = 0; i < system.count(); ++i) balance_.pressure(system.cell(i)) += step[i];
      if (!went_well && round > 2) break;
    }
    balance_.sweep();
    convergence.operator_applications += system.n_products();
    return solved;
  }

  /// Full cells under suction starve and starved ones that overflow are full. Once none does, a
  /// vent opens above its pressure and closes when it would have to draw oil in: together with its
  /// neighbours it could go to and fro forever. Returns how many cells change.
  Index change_sides() {
    const double suction = -1e-12 * balance_.pressures().maxCoeff();
    Index changes = 0;
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (balance_.kind(cell) == CellKind::full && balance_.pressure(cell) < suction) {
        balance_.set_kind(cell, CellKind::starved);
        ++changes;
      } else if (balance_.kind(cell) == CellKind::starved && balance_.fill(cell) > 1 + kOverfill) {
        balance_.set_kind(cell, CellKind::full);
        ++changes;
      }
    }
    if (changes == 0) changes = change_vents();
    if (changes > 0) keep_components_determined();
    return changes;
  }

  Index change_vents() {
    Index changes = 0;
    for (const Index cell : components_.widest) {
      if (balance_.is_reservoir(cell)) continue;
      const double flow = balance_.throughput(cell);
      if (balance_.kind(cell) == CellKind::full &&
          balance_.pressure(cell) > cells_.vent_pressure * (1 + kOverfill)) {
        balance_.pin(cell, cells_.vent_pressure);
        ++changes;
      } else if (balance_.kind(cell) == CellKind::pinned &&
                 balance_.surplus(cell) < -kOverfill * flow) {
        balance_.set_kind(cell, CellKind::full);
        ++changes;
      }
    }
    return changes;
  }

  /// Oil moves face by face: what one cell gains another loses. A vent that is full keeps what fits
  /// and hands on the rest.
  PatchFilm finished(PatchFilm film) {
    film.oil = oil_;
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      double& volume = film.oil.volume.data()[cell];
      volume -= time_ * balance_.outflow(cell);
      if (balance_.kind(cell) != CellKind::pinned) continue;
      film.oil.outside += volume - balance_.gap(cell);
      volume = balance_.gap(cell);
    }
    film.pressure = balance_.pressures().max(0.0);
    film.fill = balance_.fills().max(0.0).min(1.0);
    film.mean_pressure = sum(film.pressure) / static_cast<double>(balance_.pressures().size());
    film.dissipation = balance_.dissipation();
    film.steps = 1;
    film.unit = std::move(unit_);
    return film;
  }

  const PatchCells& cells_;
  const Components& components_;
  const PatchOil& oil_;
  double time_;
  const Observer& observer_;
  PatchBalance balance_;
  Field unit_;
  std::vector<bool> overfull_;  // connected components with no less oil than they hold
};

}  // namespace

PatchFilm advance(const PatchCells& cells, const Components& components, const PatchOil& oil,
                  double time, const PatchFilm& guess, const Observer& observer) {
  return Step(cells, components, oil, time, guess.unit, observer).run(guess.pressure);
}

}  // namespace tabor::reynolds
