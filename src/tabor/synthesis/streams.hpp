#pragma once

#include <cstdint>

namespace tabor::synthesis {

/// Parts of an EDT surface that draw independent random numbers from one seed.
enum EdtStream : std::uint64_t {
  kRoughnessStream = 1,
  kCraterStream = 2,
  kGrooveStream = 3,
  kPlateauStream = 4,
  kWavinessStream = 5,
  kNoiseStream = 6
};

}  // namespace tabor::synthesis
