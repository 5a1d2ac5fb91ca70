#pragma once

#include <optional>
#include <string_view>

#include "tabor/core/convergence.hpp"
#include "tabor/core/resources.hpp"

// Defines how a list of cases is run: jobs at a time, shard, retry, observer.
namespace tabor::engine {

/// Part `index` of `count` of a study, from 1; the parts together are the whole.
struct Shard {
  int index = 1;
  int count = 1;
};

/// Parses "2/8". Throws InputError.
Shard parse_shard(std::string_view text);

/// Settings for running many cases: of studies, of one scan and of films under load.
struct RunOptions {
  int jobs = 0;  ///< that run at the same time; 0: as many as there are threads and memory
  std::optional<Shard> shard;  ///< this process does only its part; the store must be shared
  bool retry = false;          ///< what failed or did not converge is computed again
  Observer observer;           ///< called by one thread at a time, not always the same
  Stopwatch since_start;       ///< of the whole command: the time left is counted on from it
};

}  // namespace tabor::engine
