#include "tabor/engine/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::engine {
namespace {

class Planner {
 public:
  Planner(const std::vector<Job>& jobs, const Store* store, bool retry, const Observer& observer)
      : jobs_(jobs),
        store_(store),
        retry_(retry),
        observer_(observer),
        looks_(jobs.size()),
        users_(jobs.size()) {
    plan_.entries.resize(jobs.size());
  }

  Plan plan(const Shard& shard) {
    const std::vector<bool> mine = jobs_of(shard);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (mine[i]) want_what_is_missing(i);
    }
    for (std::size_t i = jobs_.size(); i-- > 0;) {
      if (mine[i]) ask_its_users(i);
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      plan_.n_found += looks_[i].is_whole && !plan_.entries[i].wanted ? 1 : 0;
    }
    return std::move(plan_);
  }

 private:
  /// What the store holds of a job.
  struct Look {
    bool is_whole = false;
    bool is_damaged = false;
    Quality quality = Quality::converged;
    bool failed_before = false;  ///< has no file, since it failed
  };

  /// Fills users_ with the jobs of the shard.
  std::vector<bool> jobs_of(const Shard& shard) {
    std::vector<bool> mine(jobs_.size(), false);
    std::vector<bool> is_needed(jobs_.size(), false);
    for (const Job& job : jobs_) {
      for (const std::size_t other : others_of(job)) is_needed[other] = true;
    }
    for (std::size_t i = jobs_.size(); i-- > 0;) {
      const Job& job = jobs_[i];
      mine[i] = mine[i] || (job.part ? belongs(*job.part, shard) : !is_needed[i]);
      if (!mine[i]) continue;
      for (const std::size_t other : others_of(job)) {
        mine[other] = true;
        users_[other].push_back(i);
      }
    }
    return mine;
  }

  static std::vector<std::size_t> others_of(const Job& job) {
    std::vector<std::size_t> others = job.needs;
    others.insert(others.end(), job.wants.begin(), job.wants.end());
    return others;
  }

  static bool belongs(std::size_t part, const Shard& shard) {
    return part % static_cast<std::size_t>(shard.count) ==
           static_cast<std::size_t>(shard.index - 1);
  }

  void want_what_is_missing(std::size_t i) {
    const Job& job = jobs_[i];
    Look& look = looks_[i] = look_at(job);
    Plan::Entry& entry = plan_.entries[i];
    const bool needs_retried =
        std::any_of(job.needs.begin(), job.needs.end(),
                    [&](std::size_t need) { return plan_.entries[need].retried; });
    entry.retried =
        look.is_whole && (needs_retried || (retry_ && look.quality != Quality::converged));
    entry.wanted = !look.is_whole || entry.retried;
  }

  void ask_its_users(std::size_t i) {
    const Job& job = jobs_[i];
    const auto& users = users_[i];
    Plan::Entry& entry = plan_.entries[i];
    const bool used = std::any_of(users.begin(), users.end(),
                                  [&](std::size_t user) { return plan_.entries[user].wanted; });
    if (job.task.file.empty()) entry.wanted = users.empty() || used;
    if (looks_[i].is_whole && used && job.can_serve && !job.can_serve()) entry.wanted = true;
    looks_[i].failed_before = !looks_[i].is_whole && !looks_[i].is_damaged && !users.empty() &&
                              !job.record_failure && !job.task.file.empty() &&
                              std::all_of(users.begin(), users.end(),
                                          [&](std::size_t user) { return stays_failed(user); });
    if (looks_[i].failed_before) entry.wanted = false;
  }

  bool stays_failed(std::size_t i) const {
    const bool is_recorded = looks_[i].is_whole && looks_[i].quality == Quality::failed;
    return !plan_.entries[i].wanted && (is_recorded || looks_[i].failed_before);
  }

  Look look_at(const Job& job) {
    Look look;
    if (store_ == nullptr || job.task.file.empty() || !store_->has(job.task)) return look;
    report_progress(observer_, "look at the store", std::nan(""));
    const std::string problem = job.defect ? job.defect() : "";
    look.is_whole = problem.empty();
    look.is_damaged = !look.is_whole;
    if (look.is_damaged) {
      plan_.warnings.push_back("damaged, computed again: " + problem);
      store_->remove(job.task);
    } else if (job.quality && (retry_ || job.record_failure)) {
      look.quality = job.quality();
    }
    return look;
  }

  const std::vector<Job>& jobs_;
  const Store* store_;
  bool retry_;
  const Observer& observer_;
  Plan plan_;
  std::vector<Look> looks_;
  std::vector<std::vector<std::size_t>> users_;  // jobs of this shard that need or want it
};

}  // namespace

Shard parse_shard(std::string_view text) {
  const std::vector<std::string> parts = split(text, '/');
  if (parts.size() == 2) {
    const auto index = parse_number(parts[0]);
    const auto count = parse_number(parts[1]);
    if (index && count && *count >= 1 && *count <= 1e6 && *index >= 1 && *index <= *count &&
        *index == static_cast<int>(*index) && *count == static_cast<int>(*count)) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  throw InputError("--shard", "'" + std::string(text) + "'", "i/n with 1 <= i <= n, such as 2/8",
                   "");
}

Plan plan_jobs(const std::vector<Job>& jobs, const Store* store, const Shard& shard, bool retry,
               const Observer& observer) {
  return Planner(jobs, store, retry, observer).plan(shard);
}

int jobs_that_fit(std::size_t bytes_per_job, std::size_t available_bytes, int n_threads) {
  const std::size_t fitting = available_bytes / 2 / std::max<std::size_t>(1, bytes_per_job);
  return static_cast<int>(std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(n_threads)));
}

}  // namespace tabor::engine
