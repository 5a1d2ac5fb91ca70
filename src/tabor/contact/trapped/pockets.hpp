#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/core/types.hpp"
#include "tabor/elastic/border.hpp"

// Finds the closed pockets of a contact that hold liquid.
namespace tabor::contact {

inline constexpr std::int32_t kNoPocket = -1;

/// Closed pockets that hold liquid. Pixels of one pocket stand together, ascending.
struct Pockets {
  PixelList pixels;                ///< of all pockets, pocket by pocket
  std::vector<std::size_t> first;  ///< place of a pocket's first pixel in `pixels`, and the end
  std::vector<double> volume;      ///< liquid of a pocket: sum of film [m]
  std::vector<std::int32_t> of;    ///< pocket of each pixel of the map, or kNoPocket
  std::vector<std::uint8_t> open;  ///< of each pixel of the map: gap with a way out
  double open_volume = 0;          ///< liquid that has a way out: sum of film [m]
  std::vector<int> copies;         ///< of a pocket in the whole map, of which this may be one image

  std::size_t size() const { return volume.size(); }
  std::size_t n_pixels(std::size_t pocket) const { return first[pocket + 1] - first[pocket]; }
};

/// Makes pockets of given labels: the pocket of each pixel, kNoPocket or from 0 on, and the liquid
/// [m] on it. Pixels outside pockets count as gap with a way out where `contact` is false.
Pockets pockets_of(std::vector<std::int32_t> labels, const Mask& contact, const Field& film);

/// Finds the pockets of a contact. Regions are connected by their four neighbours, of pixels
/// without contact or with liquid; those in which gap reaches the border of the map, or runs
/// through a cell that repeats, are open. The others with liquid are pockets: wet contact belongs
/// to its pocket, too. `film` [m], shape (ny, nx).
Pockets find_pockets(const Mask& contact, const Field& film, const Grid& grid,
                     elastic::Border border);

}  // namespace tabor::contact
