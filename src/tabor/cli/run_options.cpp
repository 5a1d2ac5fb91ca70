#include "tabor/cli/run_options.hpp"

#include <algorithm>
#include <string>

namespace tabor::cli {

namespace {

constexpr std::uint64_t kMostJobs = 1024;

}  // namespace

void declare_run_options(OptionSet& set, RunRequest& request) {
  set.count("--jobs",
            "number of cases computed at the same time, each with its own memory [as many as "
            "threads and memory allow]",
            request.jobs);
  set.add({.flag = "--shard",
           .placeholder = "I/N",
           .help = "compute only part I of N; all parts may share one folder",
           .assign = [&](const std::string& text) { request.shard = engine::parse_shard(text); }});
  set.toggle("--retry", "compute failed and unconverged cases again", request.retry);
}

engine::RunOptions run_options(const RunRequest& request, const Context& context) {
  engine::RunOptions options;
  options.jobs = static_cast<int>(std::min(request.jobs, kMostJobs));
  options.shard = request.shard;
  options.retry = request.retry;
  options.observer = context.observer();
  return options;
}

}  // namespace tabor::cli
