#include "tabor/contact/trapped_liquid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "tabor/contact/images.hpp"
#include "tabor/contact/trapped/in_pockets.hpp"
#include "tabor/contact/trapped/seals.hpp"
#include "tabor/contact/trapped/trapped_solver.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/units.hpp"

namespace tabor::contact {
namespace {

constexpr int kMostRounds = 8;
constexpr double kAboveSeal = 1e-9;  // relative: rounding of levels and seals

void check(const Problem& problem, const GapLiquid& liquid, const State& dry) {
  if (std::holds_alternative<Separation>(problem.control)) {
    throw InputError("trapped liquid", "a contact at a given separation",
                     "one under a mean pressure or a force",
                     "the liquid carries a part of the load");
  }
  if (!problem.bounds.caps().are_one()) {
    throw InputError("trapped liquid", "a saturation pressure of each pixel", "one for all",
                     "leave out either");
  }
  if (!(liquid.bulk_modulus > 0)) {
    throw InputError("bulk modulus", format_si(liquid.bulk_modulus, "Pa"), "more than zero", "");
  }
  if (liquid.film.rows() != problem.height.rows() || liquid.film.cols() != problem.height.cols() ||
      dry.pressure.rows() != problem.height.rows() ||
      dry.pressure.cols() != problem.height.cols()) {
    throw InputError(
        "trapped liquid",
        fmt::format("a film of {} x {} pixels and a contact of {} x {}", liquid.film.cols(),
                    liquid.film.rows(), dry.pressure.cols(), dry.pressure.rows()),
        fmt::format("{} x {} as the heights", problem.height.cols(), problem.height.rows()), "");
  }
  if (!all_finite(liquid.film) || extent_of(liquid.film).lowest < 0) {
    throw InputError("trapped liquid", "a film that is negative or NaN somewhere",
                     "zero or more at every pixel", "");
  }
}

/// Makes pressure and gap exactly complementary, which moves the gap by no more than its error.
void close_gap(const Pockets& pockets, const std::vector<double>& levels, double cap,
               State& state) {
  for_each(state.gap.size(), [&](Index i) {
    const std::int32_t pocket = pockets.of[static_cast<std::size_t>(i)];
    const double level = pocket == kNoPocket ? 0 : levels[static_cast<std::size_t>(pocket)];
    double& p = state.pressure(i);
    double& gap = state.gap(i);
    if (at_cap(p, cap)) {
      p = cap;
      gap = at_level(p, level) ? gap : std::min(gap, 0.0);
    } else if (!touches(p) || at_level(p, level)) {
      gap = std::max(gap, 0.0);
    } else {
      gap = 0;
    }
  });
}

/// Lowers the bounds that the liquid has broken; true where it broke one.
bool lower(const std::vector<double>& levels, const std::vector<double>& seals,
           std::vector<double>& bounds) {
  bool is_broken = false;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (!(levels[k] > (1 + kAboveSeal) * seals[k])) continue;
    bounds[k] = std::min(bounds[k], seals[k]);
    is_broken = true;
  }
  return is_broken;
}

/// Volume between the surfaces over a pocket, over the area of a pixel [m].
double gap_over(const Pockets& pockets, std::size_t k, const Field& gap) {
  double sum = 0;
  for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
    sum += std::max(gap.data()[pockets.pixels[j]], 0.0);
  }
  return sum;
}

/// A pocket whose gap has closed has lost all its oil: the solids carry what it carried.
void empty_closed_pockets(const Pockets& pockets, SealedState& state, LiquidSummary& summary) {
  for (std::size_t k = 0; k < pockets.size(); ++k) {
    if (!(state.levels[k] > 0) || gap_over(pockets, k, state.contact.gap) > 0) continue;
    state.levels[k] = 0;
    summary.leaked_volume += pockets.volume[k];
  }
}

/// What the pockets hold and carry.
LiquidSummary summary_of(const SealedPockets& liquid, SealedState& state, const Grid& grid) {
  const Pockets& pockets = liquid.pockets;
  LiquidSummary summary;
  empty_closed_pockets(pockets, state, summary);
  double carried = 0;
  for (std::size_t k = 0; k < pockets.size(); ++k) {
    const double level = state.levels[k];
    const double volume = pockets.volume[k];
    summary.n_pockets += pockets.copies[k];
    summary.pocket_volume += volume;
    summary.max_pressure = std::max(summary.max_pressure, level);
    if (!(level > 0)) continue;
    summary.n_squeezed += pockets.copies[k];
    for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
      if (at_level(state.contact.pressure.data()[pockets.pixels[j]], level)) carried += level;
    }
    if (level < (1 - kAboveSeal) * liquid.seals[k]) continue;
    summary.n_at_seal += pockets.copies[k];
    const double left = gap_over(pockets, k, state.contact.gap) / (1 - level / liquid.bulk_modulus);
    summary.leaked_volume += std::max(volume - left, 0.0);
  }
  const double load = state.contact.mean_pressure * static_cast<double>(grid.size());
  summary.load_share = carried / load;
  if (summary.pocket_volume > 0) {
    summary.leaked_fraction = summary.leaked_volume / summary.pocket_volume;
  }
  summary.pocket_volume *= grid.pixel_area();
  summary.leaked_volume *= grid.pixel_area();
  summary.open_volume = pockets.open_volume * grid.pixel_area();
  return summary;
}

/// Solves on the first of 2 x 2 mirror images, if everything is made of them; else returns nothing.
std::optional<TrappedState> solve_on_image(elastic::ElasticOperator& elasticity,
                                           const Problem& problem, const GapLiquid& liquid,
                                           const State& dry, const Observer& observer) {
  elastic::ElasticOperator* const of_image = elasticity.of_image();
  if (of_image == nullptr || !liquid.periodic || !consists_of_images(liquid.film, 0)) return {};
  const std::optional<State> dry_image = state_of_image(dry);
  const std::optional<Problem> image = dry_image ? problem_of_image(problem) : std::nullopt;
  if (!image) return {};
  const Field film = first_image(liquid.film);
  const Pockets pockets =
      find_pockets(contact_mask(*dry_image), film, of_image->grid(), elastic::Border::mirrors);
  const GapLiquid liquid_of_image{film, liquid.bulk_modulus, false};  // nothing crosses a seam
  TrappedState found =
      solve_in_pockets(*of_image, *image, pockets, liquid_of_image, *dry_image, observer);
  found.contact = with_images(std::move(found.contact));
  found.liquid_pressure = mirror_images(found.liquid_pressure);
  constexpr double n_images = 4;
  found.liquid.pocket_volume *= n_images;
  found.liquid.open_volume *= n_images;
  found.liquid.leaked_volume *= n_images;
  return found;
}

Field map_of(const Pockets& pockets, const std::vector<double>& levels, const Grid& grid) {
  Field map = Field::Zero(grid.ny, grid.nx);
  for (std::size_t k = 0; k < pockets.size(); ++k) {
    for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
      map.data()[pockets.pixels[j]] = levels[k];
    }
  }
  return map;
}

}  // namespace

TrappedState solve_in_pockets(elastic::ElasticOperator& elasticity, const Problem& problem,
                              const Pockets& pockets, const GapLiquid& liquid, const State& dry,
                              const Observer& observer) {
  check(problem, liquid, dry);
  const Grid& grid = elasticity.grid();
  const LoadProblem under = under_pressure(problem, dry.mean_pressure);
  const double cap = problem.bounds.upper;
  SealedState state{.contact = {}, .levels = std::vector<double>(pockets.size(), 0)};
  const State* last = &dry;
  const auto seals_now = [&] {
    return seals_of(last->pressure, pockets, state.levels, grid, liquid.periodic, cap);
  };
  std::vector<double> bounds = seals_now();
  const SealedPockets sealed{pockets, liquid.bulk_modulus, bounds};
  Convergence work;
  int round = 0;
  bool is_settled = pockets.size() == 0;
  bool is_dry = is_settled;  // to the bit
  while (!is_settled && round < kMostRounds) {
    ++round;
    state = solve_sealed(elasticity, under, sealed, *last, state.levels, observer);
    last = &state.contact;
    work = after(work, state.contact.convergence);
    is_dry = round == 1 && state.is_start;
    is_settled =
        is_dry || state.contact.convergence.stopped() || !lower(state.levels, seals_now(), bounds);
  }
  if (!is_dry) {
    close_gap(pockets, state.levels, cap, state.contact);
    state.contact.convergence = work;
  }
  if (round == 0) state.contact = dry;
  TrappedState found;
  found.liquid = summary_of(sealed, state, grid);
  found.liquid.seal_rounds = round;
  found.liquid.seals_settled = is_settled;
  found.liquid_pressure = map_of(pockets, state.levels, grid);
  found.contact = std::move(state.contact);
  return found;
}

TrappedState solve_trapped(elastic::ElasticOperator& elasticity, const Problem& problem,
                           const GapLiquid& liquid, const State& dry, const Observer& observer) {
  check(problem, liquid, dry);
  if (auto of_image = solve_on_image(elasticity, problem, liquid, dry, observer)) {
    return *std::move(of_image);
  }
  const Pockets pockets =
      find_pockets(contact_mask(dry), liquid.film, elasticity.grid(),
                   liquid.periodic ? elastic::Border::repeats : elastic::Border::ends);
  return solve_in_pockets(elasticity, problem, pockets, liquid, dry, observer);
}

Mask solid_contact(const TrappedState& state) {
  const Field& pressure = state.contact.pressure;
  Mask solid(pressure.rows(), pressure.cols());
  for_each(solid.size(), [&](Index i) {
    solid(i) = touches(pressure(i)) && !at_level(pressure(i), state.liquid_pressure(i));
  });
  return solid;
}

Summary summarise_solids(TrappedState& state, const Problem& problem, const Grid& grid,
                         bool periodic) {
  State& all = state.contact;
  const Mask touching = solid_contact(state);
  Field pressure(all.pressure.rows(), all.pressure.cols());
  for_each(pressure.size(), [&](Index i) { pressure(i) = touching(i) ? all.pressure(i) : 0; });
  const double mean = sum(pressure) / static_cast<double>(pressure.size());
  std::swap(all.pressure, pressure);
  const double mean_of_all = std::exchange(all.mean_pressure, mean);
  const Summary summary = summarise(all, problem, grid, periodic);
  std::swap(all.pressure, pressure);
  all.mean_pressure = mean_of_all;
  return summary;
}

}  // namespace tabor::contact
