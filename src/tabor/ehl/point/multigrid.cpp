#include "tabor/ehl/point/multigrid.hpp"

#include <utility>

namespace tabor::ehl {
namespace {

Mask mostly(const numerics::NodeTransfer& transfer, const Mask& fine) {
  return fine.size() == 0 ? Mask() : Mask(transfer.mean(fine.cast<double>()) > 0.5);
}

void hold_border(Mask& held) {
  held.row(0) = held.row(held.rows() - 1) = true;
  held.col(0) = held.col(held.cols() - 1) = true;
}

}  // namespace

PointMultigrid::PointMultigrid(const std::vector<PointLevel>& levels, const PointBalance& balance,
                               const Mask& held, const PointFlow& flow, const PointStorage& storage,
                               const PointUnits& units, const PointExceptions& exceptions) {
  stages_.reserve(levels.size());
  add_stage(levels.front(), balance, held, exceptions.depth);
  if (exceptions.depth.size() > 0) uncorrected_ = exceptions.depth || exceptions.contact;
  Mask fine_held = uncorrected_.size() > 0 ? Mask(held || uncorrected_) : held;
  Field pressure = flow.pressure;
  Field film = flow.film;
  PointStorage stored = storage;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const numerics::NodeTransfer& transfer = *levels[l - 1].to_coarser;
    pressure = transfer.mean(pressure);
    film = transfer.mean(film);
    if (stored.time_step > 0) stored.old_mass = transfer.mean(stored.old_mass);
    Mask coarse_held = mostly(transfer, fine_held);
    hold_border(coarse_held);
    const PointFlow coarse_flow{.grid = levels[l].grid,
                                .lubricant = flow.lubricant,
                                .speed = flow.speed,
                                .sliding_speed = flow.sliding_speed,
                                .pressure = pressure,
                                .film = film};
    add_stage(levels[l], point_balance(coarse_flow, stored, units), coarse_held, {});
    fine_held = std::move(coarse_held);
  }
}

void PointMultigrid::add_stage(const PointLevel& level, PointBalance balance, const Mask& held,
                               const Mask& depth) {
  PointLocal local(balance, held, level.elastic, depth);
  Stage stage{.level = &level,
              .balance = std::move(balance),
              .held = held,
              .depth = depth,
              .lines = nullptr,
              .direct = nullptr};
  if (level.to_coarser) {
    stage.lines = std::make_unique<PointLines>(std::move(local));
    ok_ = ok_ && stage.lines->ok();
  } else {
    stage.direct = std::make_unique<PointDirect>(std::move(local));
    ok_ = ok_ && stage.direct->ok();
  }
  stages_.push_back(std::move(stage));
}

Field PointMultigrid::cycle(std::size_t index, const Field& right) const {
  const Stage& stage = stages_[index];
  if (stage.direct) return (*stage.direct)(right);
  const PointLevel& level = *stage.level;
  const Stage& coarse = stages_[index + 1];
  const auto rest = [&](const Field& unknown) -> Field {
    Field product = Field::Zero(right.rows(), right.cols());
    const bool mixed = stage.depth.size() > 0;
    const Field pressure = mixed ? Field(stage.depth.select(0, unknown)) : unknown;
    Field film = level.elastic(pressure);
    if (mixed) film += stage.depth.select(unknown, 0);
    stage.balance.by_pressure.add_product(pressure, product);
    stage.balance.by_film.add_product(film, product);
    return stage.held.select(0, right - product);
  };
  const auto corrected = [&](const Field& field) -> Field {
    const bool all = index > 0 || uncorrected_.size() == 0;
    return all ? field : Field(uncorrected_.select(0, field));
  };
  Field pressure = (*stage.lines)(right);
  // A balance is a flow through a cell's width: it grows with the length of the cell alone.
  const double scale = level.grid.dy() / coarse.level->grid.dy();
  const Field missing = scale * level.to_coarser->transposed(corrected(rest(pressure)));
  const Field correction = cycle(index + 1, coarse.held.select(0, missing));
  pressure += stage.held.select(0, corrected(level.to_coarser->to_fine(correction)));
  pressure += (*stage.lines)(rest(pressure));
  return pressure;
}

Field PointMultigrid::operator()(const Field& right) const {
  const Mask& held = stages_.front().held;
  return held.select(right, cycle(0, held.select(0, right)));
}

}  // namespace tabor::ehl
