#pragma once

#include <functional>
#include <vector>

#include "tabor/contact/certificate.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/types.hpp"

// Holds the pixels that one step of the fast solver updates, and collects them from a map.
namespace tabor::contact {

/// Pixels that a step of the fast solver updates: all that carry pressure, and those without
/// pressure that the next step may press. All other pixels have zero pressure. Parallel arrays in
/// the order of the pixels.
struct CandidateSet {
  PixelList pixels;
  Candidates values;             ///< p [Pa] and v [m]
  std::vector<float> response;   ///< S dp of the last step [m]
  std::vector<float> direction;  ///< M (v - sep) of the last step [Pa], 0 where it moved nothing

  std::size_t size() const { return pixels.size(); }
};

/// Returns the pixels of a map that carry pressure.
CandidateSet pressed_pixels(const Field& pressure);

/// Writes the pressure as a map; `map` has its shape already.
void spread_pressure(const CandidateSet& set, Field& map);

/// Returns a v above which a pixel without pressure changes neither the certificate nor the next
/// separation, from a set whose v is up to date, and caps of the map. Both only fall when more
/// pixels join, so that the pixels with pressure alone give a bound: the mean of v in an elastic
/// contact, else the larger of their separation, for the step `diagonal_step` [Pa/m], and of their
/// own knapsack's threshold.
double candidate_threshold(const CandidateSet& set, double load, const Caps& caps,
                           double diagonal_step);

/// Collects the set as collect_candidates() does, with an update of blocks of pixels.
void collect_in_blocks(const Field& residual, FieldF* change, double threshold,
                       const std::function<void(Index begin, Index end)>& update,
                       CandidateSet& set);

/// Collects the set anew: pixels with pressure and those whose v is at most `threshold`. update(i)
/// is called for every pixel first and brings its v up to date. `change` is S dp of the last step,
/// taken as the response and set to zero; where it is null, the responses of the old set stay.
template <typename Update>
void collect_candidates(const Field& residual, FieldF* change, double threshold,
                        const Update& update, CandidateSet& set) {
  collect_in_blocks(residual, change, threshold, blockwise<Index>(update), set);
}

}  // namespace tabor::contact
