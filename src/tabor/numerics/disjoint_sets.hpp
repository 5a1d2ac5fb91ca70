#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "tabor/core/error.hpp"

// Joins numbered members into disjoint sets (union-find), with optional offsets for periodic cells.
namespace tabor::numerics {

/// Offset of sets whose members have no place in them.
struct NoOffset {
  NoOffset operator+(NoOffset) const { return {}; }
  NoOffset operator-(NoOffset) const { return {}; }
  bool operator==(const NoOffset&) const = default;
};

/// Joins the numbers 0 .. n - 1 into disjoint sets, in a forest with path halving (Tarjan & van
/// Leeuwen 1984, doi:10.1145/62.2160). The smallest member of a set is its root, so that sets and
/// what is counted in their order do not depend on the order of joins.
///
/// With an Offset (a group under + and -, zero when value-initialised) each member also has a place
/// relative to the root: joined along different paths that disagree, a set closes on itself, as a
/// region that runs through a periodic cell (Newman & Ziff 2001, doi:10.1103/PhysRevE.64.016706).
template <typename Number, typename Offset = NoOffset>
class DisjointSets {
 public:
  /// Place of a member: its root and its offset from it.
  struct Place {
    Number root;
    Offset from_root;
  };
  /// Result of join(): the root of the set that now holds both.
  struct Joined {
    Number root;
    bool were_one;      ///< both were in one set before
    Offset difference;  ///< then: of this join from the paths before it; zero where they agree
  };

  /// Makes each number a set of its own. Throws InputError if there are more than Number holds.
  explicit DisjointSets(std::size_t n = 0) : parent_(checked(n)), n_sets_(n) {
    std::iota(parent_.begin(), parent_.end(), Number{0});
    if constexpr (kHasOffsets) offset_.resize(n);
  }

  std::size_t size() const { return parent_.size(); }
  std::size_t n_sets() const { return n_sets_; }

  /// Adds a number, in a set of its own.
  Number add() {
    parent_.push_back(static_cast<Number>(parent_.size()));
    if constexpr (kHasOffsets) offset_.emplace_back();
    ++n_sets_;
    return parent_.back();
  }

  Number root(Number member) { return find(member).root; }

  /// Asks the processor to fetch a member before it is needed.
  void prefetch(Number member) const { __builtin_prefetch(&parent_[at(member)]); }

  Place find(Number member) {
    Offset total{};
    while (parent_[at(member)] != member) {
      const Number next = parent_[at(member)];
      if constexpr (kHasOffsets) {
        offset_[at(member)] = offset_[at(member)] + offset_[at(next)];
        total = total + offset_[at(member)];
      }
      member = parent_[at(member)] = parent_[at(next)];
    }
    return {member, total};
  }

  /// Joins the sets of `a` and `b`; b lies `step` further than a.
  Joined join(Number a, Number b, Offset step = {}) {
    const Place from = find(a);
    const Place to = find(b);
    const Offset between = from.from_root + step - to.from_root;  // from the root of a to that of b
    if (from.root == to.root) return {from.root, true, between};
    const Number root = std::min(from.root, to.root);
    const Number other = std::max(from.root, to.root);
    parent_[at(other)] = root;
    if constexpr (kHasOffsets) {
      offset_[at(other)] = other == to.root ? between : Offset{} - between;
    }
    --n_sets_;
    return {root, false, {}};
  }

 private:
  static constexpr bool kHasOffsets = !std::is_same_v<Offset, NoOffset>;
  static std::size_t at(Number number) { return static_cast<std::size_t>(number); }
  static std::size_t checked(std::size_t n) {
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<Number>::max());
    if (n <= kMost) return n;
    throw InputError("map", std::to_string(n) + " regions or parts of rows",
                     std::to_string(kMost) + " at most", "take fewer pixels");
  }

  std::vector<Number> parent_;
  std::vector<Offset> offset_;  // from the parent; empty without
  std::size_t n_sets_;
};

}  // namespace tabor::numerics
