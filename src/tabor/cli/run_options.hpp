#pragma once

#include <cstdint>
#include <optional>

#include "tabor/cli/verb.hpp"
#include "tabor/study/engine.hpp"

namespace tabor::cli {

/// How the cases of a study or a sweep are to be run.
struct RunRequest {
  std::uint64_t jobs = 0;
  std::optional<study::Shard> shard;
  bool retry = false;
};

/// Declares --jobs, --shard and --retry.
void declare_run_options(OptionSet& set, RunRequest& request);

study::RunOptions run_options(const RunRequest& request, const Context& context);

}  // namespace tabor::cli
