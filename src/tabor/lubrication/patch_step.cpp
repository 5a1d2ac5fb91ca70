#include "tabor/lubrication/patch_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/core/parallel.hpp"
#include "tabor/lubrication/full_cells.hpp"

namespace tabor::lubrication {
namespace {

using Eigen::VectorXd;

constexpr int kMaxIterations = 30;  // a step that needs more is finished by the next
constexpr int kMaxProducts = 400;
constexpr double kRoughTolerance = 1e-4;  // of the flows, while many cells still change sides
constexpr double kFairTolerance = 1e-6;   // while few do
constexpr double kTolerance = 1e-11;
constexpr double kOverfill = 1e-6;  // a fill above 1 by less is what the solver leaves
constexpr double kNearlyFull = 0.9;
// Sets of cells fit if at most one cell in so many still changes sides, which the pressure does not
// feel by more than this.
constexpr Index kFewChanges = 20000;
constexpr double kSamePressure = 1e-4;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// One implicit step. Per area of a cell, with flows as in PatchCells:
///   (theta h - oil)/time + outflow - inflow = 0
class Step {
 public:
  Step(const PatchCells& cells, const Rooms& rooms, const PatchOil& oil, double time,
       const Observer& observer)
      : cells_(cells),
        rooms_(rooms),
        oil_(oil),
        time_(time),
        observer_(observer),
        kinds_(at(cells.size()), CellKind::wall),
        pressure_(Field::Zero(cells.ny, cells.nx)),
        fill_(Field::Zero(cells.ny, cells.nx)),
        overfull_(at(rooms.count()), false) {
    find_overfull_rooms();
  }

  PatchFilm run(const Field& guess) {
    choose_first_kinds(guess);
    PatchFilm film;
    double tolerance = kRoughTolerance;
    bool settled = false;
    while (!settled && film.iterations < kMaxIterations) {
      ++film.iterations;
      film.balanced = solve_pressures(tolerance, film);
      const double before = film.mean_pressure;
      film.mean_pressure = sum(pressure_) / static_cast<double>(pressure_.size());
      const Index changes = change_sides();
      const bool same = std::abs(film.mean_pressure - before) <= kSamePressure * film.mean_pressure;
      const bool quiet = changes == 0 || (same && changes <= cells_.size() / kFewChanges);
      settled = quiet && tolerance == kTolerance;
      if (settled && changes > 0) film.balanced = solve_pressures(kTolerance, film);
      if (changes <= cells_.size() / 10000) tolerance = std::min(tolerance, kFairTolerance);
      if (quiet) tolerance = kTolerance;
    }
    if (!settled) film.balanced = solve_pressures(kTolerance, film);
    film.converged = settled && film.balanced;
    return finished(std::move(film));
  }

 private:
  CellKind& kind(Index cell) { return kinds_[at(cell)]; }
  CellKind kind(Index cell) const { return kinds_[at(cell)]; }
  double gap(Index cell) const { return cells_.gap.data()[cell]; }
  double oil(Index cell) const { return oil_.volume.data()[cell]; }
  double& pressure(Index cell) { return pressure_.data()[cell]; }
  double pressure(Index cell) const { return pressure_.data()[cell]; }
  double fill(Index cell) const { return fill_.data()[cell]; }
  bool is_reservoir(Index cell) const {
    return cells_.reservoir.size() > 0 && cells_.reservoir.data()[cell];
  }
  void choose_first_kinds(const Field& guess) {
    const bool guessed = guess.size() == pressure_.size();
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      const bool full = (guessed && guess.data()[cell] > 0) || oil(cell) >= kNearlyFull * gap(cell);
      set_kind(cell, full ? CellKind::full : CellKind::starved);
      if (is_reservoir(cell)) {
        pin(cell, cells_.reservoir_pressure);
      } else if (guessed && full) {
        pressure(cell) = guess.data()[cell];
      }
    }
    keep_rooms_determined();
  }

  void set_kind(Index cell, CellKind new_kind) {
    kind(cell) = new_kind;
    pressure(cell) = 0;
    fill_.data()[cell] = new_kind == CellKind::starved ? 0.0 : 1.0;
  }

  void pin(Index cell, double given_pressure) {
    set_kind(cell, CellKind::pinned);
    pressure(cell) = given_pressure;
  }

  void find_overfull_rooms() {
    std::vector<double> holds(at(rooms_.count()), 0);
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (cells_.is_open(cell)) holds[at(rooms_.of[at(cell)])] += gap(cell) - oil(cell);
    }
    for (std::size_t room = 0; room < holds.size(); ++room) overfull_[room] = holds[room] <= 0;
  }

  /// Where all cells of a room are full, nothing says at which pressure. If it has more oil than
  /// fits, its vent does; if not, a cell is not full after all: the one of the lowest pressure,
  /// or the emptiest.
  void keep_rooms_determined() {
    std::vector<Index> lowest(at(rooms_.count()), -1);
    std::vector<bool> determined(at(rooms_.count()), false);
    const auto before = [&](Index a, Index b) {
      if (pressure(a) != pressure(b)) return pressure(a) < pressure(b);
      return oil(a) * gap(b) < oil(b) * gap(a);
    };
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      const std::size_t room = at(rooms_.of[at(cell)]);
      if (kind(cell) != CellKind::full) determined[room] = true;
      if (lowest[room] < 0 || before(cell, lowest[room])) lowest[room] = cell;
    }
    for (std::size_t room = 0; room < lowest.size(); ++room) {
      if (determined[room]) continue;
      if (overfull_[room]) {
        pin(rooms_.widest[room], cells_.vent_pressure);
      } else {
        set_kind(lowest[room], CellKind::starved);
      }
    }
  }

  /// What pressure drives into a cell, less what its own pressure drives out [m/s].
  double driven_into(Index cell) const {
    const auto [left, right, up, down] = cells_.around(cell);
    const double p = pressure(cell);
    return cells_.conduct_x.data()[left] * (pressure(left) - p) +
           cells_.conduct_x.data()[cell] * (pressure(right) - p) +
           cells_.conduct_y.data()[up] * (pressure(up) - p) +
           cells_.conduct_y.data()[cell] * (pressure(down) - p);
  }

  double carried_into(Index cell) const {
    const Index left = cells_.around(cell).left;
    return cells_.carried.data()[left] * fill(left);
  }

  /// Fills of the starved cells of a row, from upstream.
  void sweep(Index row) {
    const Index begin = row * cells_.nx;
    Index start = -1;  // a cell whose fill does not depend on its neighbour
    for (Index cell = begin; cell < begin + cells_.nx && start < 0; ++cell) {
      if (kind(cell) != CellKind::starved) start = cell;
    }
    if (start < 0) {
      close_the_loop(begin);
      return;
    }
    for (Index i = 1; i < cells_.nx; ++i) {
      const Index cell = begin + (start - begin + i) % cells_.nx;
      if (kind(cell) == CellKind::starved) fill_.data()[cell] = fill_from_upstream(cell);
    }
  }

  double fill_from_upstream(Index cell) const {
    return (oil(cell) / time_ + carried_into(cell) + driven_into(cell)) /
           (gap(cell) / time_ + cells_.carried.data()[cell]);
  }

  /// A row that is starved all around: the fill of its last cell is what it is carried around with.
  void close_the_loop(Index begin) {
    const Index last = begin + cells_.nx - 1;
    double result[2] = {0, 0};
    for (const double start : {0.0, 1.0}) {
      fill_.data()[last] = start;
      for (Index cell = begin; cell <= last; ++cell) fill_.data()[cell] = fill_from_upstream(cell);
      result[start > 0] = fill(last);
    }
    fill_.data()[last] = result[0] / (1 - (result[1] - result[0]));
    for (Index cell = begin; cell < last; ++cell) fill_.data()[cell] = fill_from_upstream(cell);
  }

  void sweep_all() {
    parallel_for(cells_.ny, 16, [&](Index begin, Index end) {
      for (Index row = begin; row < end; ++row) sweep(row);
    });
  }

  /// What the full cells gain too much [m/s], and the size of the flows it is the difference of.
  double residual(const FullCells& system, VectorXd& r, double& rounding) {
    double scale = 0;
    rounding = 0;
    r.resize(system.count());
    for (Index i = 0; i < system.count(); ++i) {
      const Index cell = system.cell(i);
      r[i] = surplus(cell);
      const double flow = gap(cell) / time_ + cells_.carried.data()[cell];
      scale += flow * flow;
      const double pushed =
          pressure(cell) * (cells_.conduct_x.data()[cell] + cells_.conduct_y.data()[cell]);
      rounding += pushed * pushed;
    }
    rounding = kEpsilon * std::sqrt(rounding);
    return std::sqrt(scale);
  }

  bool solve_pressures(double tolerance, PatchFilm& film) {
    FullCells system(cells_, kinds_, time_);
    VectorXd r;
    VectorXd step(system.count());
    double rounding = 0;
    bool solved = false;
    for (int round = 0; round < 8 && !solved; ++round) {
      sweep_all();
      const double goal = tolerance * residual(system, r, rounding) + 16 * rounding;
      solved = r.norm() <= goal;
      if (solved) break;
      step.setZero();
      const double target = std::max(goal / 2, 1e-6 * r.norm());
      const bool went_well = system.solve(
          r, target, kMaxProducts, step, [&] { report_progress(observer_, "film", std::nan("")); });
      for (Index i = 0; i < system.count(); ++i) pressure(system.cell(i)) += step[i];
      if (!went_well && round > 2) break;
    }
    sweep_all();
    film.products += system.n_products();
    return solved;
  }

  /// Full cells under suction starve and starved ones that overflow are full. Once none does, a
  /// vent opens above its pressure and closes when it would have to draw oil in: together with its
  /// neighbours it could go to and fro forever. Returns how many cells change.
  Index change_sides() {
    const double suction = -1e-12 * pressure_.maxCoeff();
    Index changes = 0;
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (kind(cell) == CellKind::full && pressure(cell) < suction) {
        set_kind(cell, CellKind::starved);
        ++changes;
      } else if (kind(cell) == CellKind::starved && fill(cell) > 1 + kOverfill) {
        set_kind(cell, CellKind::full);
        ++changes;
      }
    }
    if (changes == 0) changes = change_vents();
    if (changes > 0) keep_rooms_determined();
    return changes;
  }

  Index change_vents() {
    Index changes = 0;
    for (const Index cell : rooms_.widest) {
      if (is_reservoir(cell)) continue;
      const double flow = gap(cell) / time_ + cells_.carried.data()[cell];
      if (kind(cell) == CellKind::full && pressure(cell) > cells_.vent_pressure * (1 + kOverfill)) {
        pin(cell, cells_.vent_pressure);
        ++changes;
      } else if (kind(cell) == CellKind::pinned && surplus(cell) < -kOverfill * flow) {
        set_kind(cell, CellKind::full);
        ++changes;
      }
    }
    return changes;
  }

  /// What a cell whose fill is 1 gains too much [m/s].
  double surplus(Index cell) const {
    return (oil(cell) - gap(cell)) / time_ + carried_into(cell) - cells_.carried.data()[cell] +
           driven_into(cell);
  }

  /// Oil moves face by face: what one cell gains another loses. A vent that is full keeps what fits
  /// and hands on the rest.
  PatchFilm finished(PatchFilm film) {
    film.oil = oil_;
    for (Index cell = 0; cell < cells_.size(); ++cell) {
      if (!cells_.is_open(cell)) continue;
      const auto [left, right, up, down] = cells_.around(cell);
      const double leaves = flow_right(cell) - flow_right(left) + flow_down(cell) - flow_down(up);
      double& volume = film.oil.volume.data()[cell];
      volume -= time_ * leaves;
      if (kind(cell) != CellKind::pinned) continue;
      film.oil.outside += volume - gap(cell);
      volume = gap(cell);
    }
    film.pressure = pressure_.max(0.0);
    film.fill = fill_.max(0.0).min(1.0);
    film.mean_pressure = sum(film.pressure) / static_cast<double>(pressure_.size());
    film.dissipation = dissipation();
    film.steps = 1;
    return film;
  }

  double flow_right(Index cell) const {
    const Index right = cells_.around(cell).right;
    return cells_.carried.data()[cell] * fill(cell) +
           cells_.conduct_x.data()[cell] * (pressure(cell) - pressure(right));
  }

  double flow_down(Index cell) const {
    return cells_.conduct_y.data()[cell] * (pressure(cell) - pressure(cells_.around(cell).down));
  }

  double dissipation() const {
    const double total = deterministic_sum(cells_.size(), [&](Index begin, Index end) {
      double partial = 0;
      for (Index cell = begin; cell < end; ++cell) {
        const Neighbours next = cells_.around(cell);
        const double x = pressure(cell) - pressure(next.right);
        const double y = pressure(cell) - pressure(next.down);
        partial += cells_.conduct_x.data()[cell] * x * x + cells_.conduct_y.data()[cell] * y * y;
      }
      return partial;
    });
    return total / static_cast<double>(cells_.size());
  }

  const PatchCells& cells_;
  const Rooms& rooms_;
  const PatchOil& oil_;
  double time_;
  const Observer& observer_;
  std::vector<CellKind> kinds_;
  Field pressure_;
  Field fill_;
  std::vector<bool> overfull_;  // rooms with no less oil than they hold
};

}  // namespace

PatchFilm advance(const PatchCells& cells, const Rooms& rooms, const PatchOil& oil, double time,
                  const Field& guess, const Observer& observer) {
  return Step(cells, rooms, oil, time, observer).run(guess);
}

}  // namespace tabor::lubrication
