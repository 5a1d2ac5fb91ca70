#pragma once

#include <cstdint>
#include <optional>

#include "tabor/cli/verb.hpp"
#include "tabor/engine/engine.hpp"

// Declares --jobs, --shard and --retry, which studies and sweeps of films share.
namespace tabor::cli {

/// Options for running the cases of a study or a sweep.
struct RunRequest {
  std::uint64_t jobs = 0;
  std::optional<engine::Shard> shard;
  bool retry = false;
};

/// Declares --jobs, --shard and --retry.
void declare_run_options(OptionSet& set, RunRequest& request);

engine::RunOptions run_options(const RunRequest& request, const Context& context);

}  // namespace tabor::cli
