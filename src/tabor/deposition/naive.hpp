#pragma once

#include <vector>

#include "tabor/deposition/terrain.hpp"

namespace tabor::deposition {

/// Implements the rule of deposition word for word, by walks and flood fills. Its cost grows like
/// the fourth power of the side of the map; tests compare the fast engine with it.
class NaiveRain {
 public:
  NaiveRain(Terrain terrain, Reading reading);

  /// Adds one droplet of `volume` starting at `start`. Returns the volume it added (less in the
  /// literal reading where the rest is dropped, more where a whole region rises by a droplet).
  Volume drop(Pixel start, Height volume);

  /// Returns solid plus liquid [quanta]; 64 bits because a flooded closed map rises without limit.
  const std::vector<std::int64_t>& levels() const { return level_; }
  Volume lost() const { return lost_; }

  /// Returns the liquid of all pools that is not yet enough to raise them by a quantum.
  Volume remainders() const;

 private:
  struct Place {
    std::int64_t level = 0;
    Pixel pixel = 0;
    auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
  };

  Place place(Pixel p) const;
  Place lowest_neighbour(Pixel p) const;
  std::vector<Pixel> region_of(Pixel p) const;
  Place lowest_around(const std::vector<Pixel>& region) const;
  Volume fill(const std::vector<Pixel>& region, std::int64_t rim, Volume carried);
  Volume fill_literally(const std::vector<Pixel>& region, std::int64_t rim, Height volume);

  Terrain terrain_;
  Reading reading_;
  std::vector<std::int64_t> level_;
  std::vector<Volume> remainder_;  ///< stored at the lowest pixel number of its region
  Volume lost_ = 0;
};

}  // namespace tabor::deposition
