#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "tabor/deposition/descent.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

// Finds where a full pool overflows when its rim has several lowest pixels of equal height.
namespace tabor::deposition {

/// Neighbour that a droplet may choose: compared by current height, then pixel number.
struct Candidate {
  Height height = kNoRim;
  Pixel pixel = kOutside;
  PoolId wet_by = kNoPool;

  bool before(const Candidate& other) const {
    return height < other.height || (height == other.height && pixel < other.pixel);
  }
};

/// Returns the candidate at a pixel for the present levels.
Candidate candidate_at(Pools& pools, Pixel q);

/// Lowest place beside a region of equal height. It stays the lowest while the region stays and
/// while its own height, or that of the liquid over it, is below `doubt`.
struct Drain {
  Candidate lowest;
  Height doubt = kNoRim;
};

/// Saddle of several pixels of one height. It knows its regions of equal height, made of these
/// pixels and of the pools that are full up to there, and the place that each region drains to.
///
/// As liquid only rises, regions only unite, and a place beside one that was the lowest stays so
/// until it has risen. So a region stores the places beside it in a heap by their last known
/// height, updates only those that come to its top, and of several places wet by one pool continues
/// with the one of the lowest number. Work is bounded by the size of the saddle and by how often
/// the pools around it have risen, whatever their number.
class Saddle {
 public:
  /// `above` is the pool that is made of `children` at this saddle.
  Saddle(Pools& pools, PoolId above, Children children, std::int64_t& n_looks);

  /// Unites the regions around a child that is now full.
  void close(PoolId child);

  /// Return the lowest place beside the region of a pixel of the saddle, or of a child that is
  /// full.
  Candidate drain_of_pixel(Pixel p) { return lowest_beside(place_of(p)); }
  Drain drain_of_child(PoolId child);

 private:
  using Place = std::int32_t;  ///< of a pixel among pixels_
  using Heap = std::vector<Candidate>;

  /// A pixel of the saddle beside a child.
  struct Contact {
    std::size_t child = 0;
    Place place = 0;
  };

  Place place_of(Pixel p) const;
  void find_contacts();
  void find_heaps();
  void unite(Place a, Place b);
  Candidate lowest_beside(Place place);
  Height next_beside(Place place, const Candidate& lowest);
  Heap& heap_of(Place place) { return heaps_[static_cast<std::size_t>(regions_.root(place))]; }

  Pools& pools_;
  std::span<const Pixel> pixels_;
  Height height_;
  Children children_;
  numerics::DisjointSets<Place> regions_;
  std::vector<std::int32_t> first_contact_;  ///< per child, and the end: its contacts among places_
  std::vector<Place> places_;
  std::vector<Heap> heaps_;  ///< per root of a region
  Heap risen_;
  std::int64_t& n_looks_;
};

/// All saddles of several pixels that droplets have come to.
class Saddles {
 public:
  Saddles(Pools& pools, const Descent& descent) : pools_(pools), descent_(descent) {}
  Saddles(const Saddles&) = delete;  // each saddle counts looks here
  Saddles& operator=(const Saddles&) = delete;

  /// Return where a droplet runs from the saddle where the children of `above` meet; the droplet is
  /// on one of its pixels, or in a child that is full.
  Candidate drain_of_pixel(PoolId above, Pixel p) { return at(above).drain_of_pixel(p); }
  Drain drain_of_child(PoolId above, PoolId child) { return at(above).drain_of_child(child); }

  /// Discards all saddles; to be called when pools get new numbers.
  void forget() { saddles_.clear(); }

  /// Returns the number of places visited so far: the same on every machine.
  std::int64_t n_looks() const { return n_looks_; }

 private:
  Saddle& at(PoolId above);

  Pools& pools_;
  const Descent& descent_;
  std::unordered_map<PoolId, Saddle> saddles_;
  std::int64_t n_looks_ = 0;
};

}  // namespace tabor::deposition
