#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tabor/study/record.hpp"

namespace tabor::study {

/// Part `index` of `count` of a study, from 1; the parts together are the whole.
struct Shard {
  int index = 1;
  int count = 1;
};

/// "2/8". Throws InputError.
Shard parse_shard(std::string_view text);

/// What one scan still needs.
struct ScanPlan {
  bool surface = false;  ///< the stored surface itself
  bool film = false;
  std::vector<std::size_t> pressures;  ///< whose rows, or whose contact, are still to be computed
  std::vector<bool> retry;             ///< per pressure of the study: solve again although stored
  /// Positions of pressure and condition of the films still to flow, and of their rows; none where
  /// the oil of the study does not flow: there a row comes with its contact.
  struct Flow {
    std::size_t pressure;
    std::size_t condition;
    bool retry;  ///< solve again although stored
  };
  std::vector<Flow> flows;

  bool empty() const { return !surface && !film && pressures.empty(); }
  std::size_t n_tasks() const {
    return (surface ? 1 : 0) + (film ? 1 : 0) + pressures.size() + flows.size();
  }
};

/// Compares the study with its store. Whole (scan, pressure) pairs are dealt out to the shards in
/// turn. With `retry`, cases that failed or did not converge count as missing. Damaged files are
/// named in `warnings`; they are computed again. Throws Interrupted when the observer stops it.
std::vector<ScanPlan> plan(const Store& store, const Study& study,
                           const std::vector<ScanUnits>& units, const Shard& shard, bool retry,
                           std::vector<std::string>& warnings, const Observer& observer = {});

/// How many units on surfaces of `n_pixels` are computed at the same time: one per thread, a film
/// being laid down by one thread, as long as they fit in half of the free memory; at least one.
int jobs_that_fit(Index n_pixels, std::size_t available_bytes, int n_threads,
                  bool oil_flows = false);

}  // namespace tabor::study
