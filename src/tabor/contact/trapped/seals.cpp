#include "tabor/contact/trapped/seals.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "tabor/contact/contact.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/numerics/runs.hpp"

namespace tabor::contact {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Sets of nodes that are joined at rising levels, some of them open. A tree without path
/// compression keeps the level at which each set became open, or was joined to another.
class SetsByLevel {
 public:
  explicit SetsByLevel(std::size_t n)
      : parent_(n), size_(n, 1), level_(n, kNever), is_open_(n, 0), is_there_(n, 0) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }

  bool is_there(std::size_t node) const { return is_there_[node] != 0; }

  void add(std::size_t node, bool open, double level) {
    is_there_[node] = 1;
    if (open) set_open(node, level);
  }

  /// Joins nodes at level 0, before any higher one: there, trees may be compressed.
  void join_at_zero(std::size_t a, std::size_t b) {
    link(compressed_root(a), compressed_root(b), 0);
  }

  void join(std::size_t a, std::size_t b, double level) { link(root(a), root(b), level); }
  /// Returns the level at which a node first had a way out; kNever if it has none.
  double opened_at(std::size_t node) const {
    if (is_there_[node] == 0) return kNever;
    double reached = 0;
    while (is_open_[node] == 0) {
      if (parent_[node] == node) return kNever;
      reached = std::max(reached, level_[node]);
      node = parent_[node];
    }
    return std::max(reached, level_[node]);
  }

 private:
  std::size_t root(std::size_t node) const {
    while (parent_[node] != node) node = parent_[node];
    return node;
  }
  std::size_t compressed_root(std::size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void link(std::size_t a, std::size_t b, double level) {
    if (a == b) return;
    if (is_open_[a] != is_open_[b]) set_open(is_open_[a] != 0 ? b : a, level);
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = static_cast<std::uint32_t>(a);
    size_[a] += size_[b];
    if (is_open_[b] == 0) level_[b] = level;
  }
  void set_open(std::size_t root, double level) {
    is_open_[root] = 1;
    level_[root] = level;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
  std::vector<double> level_;          // it became open, else it was joined to its parent
  std::vector<std::uint8_t> is_open_;  // when it was a root last
  std::vector<std::uint8_t> is_there_;
};

/// Node of a pixel that nothing flows through: contact at the cap.
constexpr std::int32_t kNoNode = -1;

/// The landscape of pressures with its pockets. Runs of gap outside pockets are nodes, then pixels
/// of contact below the cap, then pockets.
class Landscape {
 public:
  Landscape(const Field& pressure, const Pockets& pockets, const std::vector<double>& liquid,
            const Grid& grid, bool periodic, double cap)
      : pressure_(pressure),
        pockets_(pockets),
        liquid_(liquid),
        grid_(grid),
        periodic_(periodic),
        cap_(cap),
        gap_(grid.ny, grid.nx, [this](Index i) { return is_outside(i) && !touches(pressure_(i)); }),
        contact_(list_where(grid.size(),
                            [this](Index i) {
                              return is_outside(i) && touches(pressure_(i)) &&
                                     !at_cap(pressure_(i), cap_);
                            })),
        first_pocket_(gap_.size() + contact_.size()),
        nodes_(static_cast<std::size_t>(grid.size()), kNoNode),
        sets_(first_pocket_ + pockets.size()) {
    number_nodes();
  }

  std::vector<double> seals() {
    fill_gap();
    raise();
    std::vector<double> seals(pockets_.size());
    for_each(
        seals.size(), [&](std::size_t k) { seals[k] = std::min(seal_of(k), cap_); },
        kPocketsPerBlock);
    return seals;
  }

 private:
  static constexpr Index kPocketsPerBlock = 64;

  bool is_outside(Index pixel) const {
    return pockets_.of[static_cast<std::size_t>(pixel)] == kNoPocket;
  }

  void number_nodes() {
    for_each(gap_.size(), [&](std::size_t run) {
      std::fill(nodes_.begin() + gap_[run].begin, nodes_.begin() + gap_[run].end,
                static_cast<std::int32_t>(run));
    });
    for_each(contact_.size(), [&](std::size_t i) {
      nodes_[contact_[i]] = static_cast<std::int32_t>(gap_.size() + i);
    });
    for_each(pockets_.size(), [&](std::size_t k) {
      for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
        nodes_[pockets_.pixels[j]] = static_cast<std::int32_t>(first_pocket_ + k);
      }
    });
  }

  /// Calls visit(node) for the nodes of the four neighbours of a pixel that the map has.
  template <typename Visit>
  void visit_neighbours(std::size_t pixel, const Visit& visit) const {
    const auto nx = static_cast<std::size_t>(grid_.nx);
    const auto ny = static_cast<std::size_t>(grid_.ny);
    const std::size_t y = pixel / nx;
    const std::size_t x = pixel % nx;
    const auto look = [&](std::size_t neighbour) {
      if (nodes_[neighbour] != kNoNode) visit(static_cast<std::size_t>(nodes_[neighbour]));
    };
    if (periodic_ || x + 1 < nx) look(y * nx + (x + 1 < nx ? x + 1 : 0));
    if (periodic_ || x > 0) look(y * nx + (x > 0 ? x : nx) - 1);
    if (periodic_ || y + 1 < ny) look((y + 1 < ny ? y + 1 : 0) * nx + x);
    if (periodic_ || y > 0) look(((y > 0 ? y : ny) - 1) * nx + x);
  }

  void join_around(std::size_t pixel, std::size_t node, double level) {
    visit_neighbours(pixel, [&](std::size_t other) {
      if (other != node && sets_.is_there(other)) sets_.join(node, other, level);
    });
  }

  /// All gap outside pockets, at level 0.
  void fill_gap() {
    std::vector<std::uint8_t> is_open(gap_.size(), 0);
    for_each(gap_.size(), [&](std::size_t run) {
      const auto begin = pockets_.open.begin() + gap_[run].begin;
      const auto end = pockets_.open.begin() + gap_[run].end;
      is_open[run] = std::any_of(begin, end, [](std::uint8_t open) { return open != 0; });
    });
    for (std::size_t run = 0; run < gap_.size(); ++run) sets_.add(run, is_open[run] != 0, 0);
    gap_.join_neighbours(periodic_,
                         [&](std::size_t a, std::size_t b, int, int) { sets_.join_at_zero(a, b); });
  }

  /// The contact outside pockets below the cap, and pockets, in the order of rising pressure.
  void raise() {
    std::vector<std::pair<double, std::size_t>> rising;
    for (std::size_t i = 0; i < contact_.size(); ++i) {
      rising.emplace_back(pressure_.data()[contact_[i]], gap_.size() + i);
    }
    for (std::size_t k = 0; k < pockets_.size(); ++k) {
      rising.emplace_back(liquid_[k], first_pocket_ + k);
    }
    std::sort(rising.begin(), rising.end());
    for (const auto& [level, node] : rising) {
      sets_.add(node, false, level);
      if (node < first_pocket_) {
        join_around(contact_[node - gap_.size()], node, level);
        continue;
      }
      const std::size_t pocket = node - first_pocket_;
      for (std::size_t j = pockets_.first[pocket]; j < pockets_.first[pocket + 1]; ++j) {
        join_around(pockets_.pixels[j], node, level);
      }
    }
  }

  double seal_of(std::size_t pocket) const {
    double seal = kNever;
    for (std::size_t j = pockets_.first[pocket]; j < pockets_.first[pocket + 1]; ++j) {
      visit_neighbours(pockets_.pixels[j], [&](std::size_t other) {
        if (other != first_pocket_ + pocket) seal = std::min(seal, sets_.opened_at(other));
      });
    }
    return seal;
  }

  const Field& pressure_;
  const Pockets& pockets_;
  const std::vector<double>& liquid_;
  Grid grid_;
  bool periodic_;
  double cap_;
  numerics::Runs gap_;
  PixelList contact_;
  std::size_t first_pocket_;
  std::vector<std::int32_t> nodes_;  // of each pixel
  SetsByLevel sets_;
};

}  // namespace

std::vector<double> seals_of(const Field& pressure, const Pockets& pockets,
                             const std::vector<double>& liquid, const Grid& grid, bool periodic,
                             double cap) {
  return Landscape(pressure, pockets, liquid, grid, periodic, cap).seals();
}

}  // namespace tabor::contact
