#include "tabor/contact/trapped/seals.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "tabor/contact/contact.hpp"
#include "tabor/contact/trapped/regions.hpp"

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

/// The landscape of pressures with its pockets: pixels outside pockets are nodes, each pocket is
/// one.
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
        n_pixels_(static_cast<std::size_t>(grid.size())),
        sets_(n_pixels_ + pockets.size()) {}

  std::vector<double> seals() {
    fill_gap();
    raise();
    std::vector<double> seals(pockets_.size(), kNever);
    for (std::size_t k = 0; k < seals.size(); ++k) seals[k] = std::min(seal_of(k), cap_);
    return seals;
  }

 private:
  std::size_t node_of(std::size_t pixel) const {
    const std::int32_t pocket = pockets_.of[pixel];
    return pocket == kNoPocket ? pixel : n_pixels_ + static_cast<std::size_t>(pocket);
  }

  /// Calls visit(neighbour) for the four neighbours of a pixel that the map has.
  template <typename Visit>
  void visit_neighbours(std::size_t pixel, const Visit& visit) const {
    const auto nx = static_cast<std::size_t>(grid_.nx);
    const auto ny = static_cast<std::size_t>(grid_.ny);
    const std::size_t y = pixel / nx;
    const std::size_t x = pixel % nx;
    if (periodic_ || x + 1 < nx) visit(y * nx + (x + 1) % nx);
    if (periodic_ || x > 0) visit(y * nx + (x + nx - 1) % nx);
    if (periodic_ || y + 1 < ny) visit((y + 1) % ny * nx + x);
    if (periodic_ || y > 0) visit((y + ny - 1) % ny * nx + x);
  }

  void join_around(std::size_t pixel, double level) {
    const std::size_t node = node_of(pixel);
    visit_neighbours(pixel, [&](std::size_t neighbour) {
      const std::size_t other = node_of(neighbour);
      if (other != node && sets_.is_there(other)) sets_.join(node, other, level);
    });
  }

  /// All gap outside pockets, at level 0.
  void fill_gap() {
    const auto is_gap = [&](Index i) {
      return pockets_.of[static_cast<std::size_t>(i)] == kNoPocket && !touches(pressure_(i));
    };
    for (Index i = 0; i < grid_.size(); ++i) {
      const auto pixel = static_cast<std::size_t>(i);
      if (is_gap(i)) sets_.add(pixel, pockets_.open[pixel] != 0, 0);
    }
    const auto join = [&](Index a, Index b, Cells) {
      sets_.join_at_zero(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    };
    periodic_ ? join_neighbours<true>(grid_, is_gap, join)
              : join_neighbours<false>(grid_, is_gap, join);
  }

  /// The contact outside pockets below the cap, and pockets, in the order of rising pressure.
  void raise() {
    std::vector<std::pair<double, std::size_t>> nodes;
    for (std::size_t i = 0; i < n_pixels_; ++i) {
      const double p = pressure_.data()[i];
      if (pockets_.of[i] == kNoPocket && touches(p) && !at_cap(p, cap_)) nodes.emplace_back(p, i);
    }
    for (std::size_t k = 0; k < pockets_.size(); ++k) nodes.emplace_back(liquid_[k], n_pixels_ + k);
    std::sort(nodes.begin(), nodes.end());
    for (const auto& [level, node] : nodes) {
      sets_.add(node, false, level);
      if (node < n_pixels_) {
        join_around(node, level);
        continue;
      }
      const std::size_t pocket = node - n_pixels_;
      for (std::size_t j = pockets_.first[pocket]; j < pockets_.first[pocket + 1]; ++j) {
        join_around(pockets_.pixels[j], level);
      }
    }
  }

  double seal_of(std::size_t pocket) const {
    double seal = kNever;
    for (std::size_t j = pockets_.first[pocket]; j < pockets_.first[pocket + 1]; ++j) {
      visit_neighbours(pockets_.pixels[j], [&](std::size_t neighbour) {
        if (node_of(neighbour) == n_pixels_ + pocket) return;
        seal = std::min(seal, sets_.opened_at(node_of(neighbour)));
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
  std::size_t n_pixels_;
  SetsByLevel sets_;
};

}  // namespace

std::vector<double> seals_of(const Field& pressure, const Pockets& pockets,
                             const std::vector<double>& liquid, const Grid& grid, bool periodic,
                             double cap) {
  return Landscape(pressure, pockets, liquid, grid, periodic, cap).seals();
}

}  // namespace tabor::contact
