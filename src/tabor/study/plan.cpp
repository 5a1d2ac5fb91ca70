#include "tabor/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::study {
namespace {

enum class Found { absent, damaged, complete };

class Planner {
 public:
  Planner(const Store& store, const Study& study, bool retry, std::vector<std::string>& warnings,
          const Observer& observer)
      : store_(store), study_(study), retry_(retry), warnings_(warnings), observer_(observer) {}

  ScanPlan plan(const ScanUnits& units, const std::vector<std::size_t>& mine) {
    ScanPlan plan;
    plan.retry.assign(study_.mean_pressures.size(), false);
    bool film_wanted = false;
    for (const std::size_t pressure : mine) {
      const Rows rows = look_at(units.cases[pressure]);
      const Found contact = find(units.contacts[pressure]);
      // A contact that could not be solved leaves failed rows and no file: it is not tried again.
      const bool contact_wanted =
          contact == Found::damaged || (contact == Found::absent && !rows.all_failed);
      const bool flow_wanted = add_flows(units, pressure, plan);
      if (rows.missing || contact_wanted || flow_wanted) {
        plan.pressures.push_back(pressure);
      }
      plan.retry[pressure] = rows.not_converged;
      film_wanted = film_wanted || rows.missing || !rows.all_failed;
    }
    if (!mine.empty()) {
      const bool rows_missing = !plan.pressures.empty();
      const Found film = find(units.film);
      plan.film = film == Found::damaged || rows_missing || (film == Found::absent && film_wanted);
      plan.surface = find(units.surface) != Found::complete && (film_wanted || rows_missing);
    }
    return plan;
  }

 private:
  struct Rows {
    bool missing = false;        ///< at least one is to be computed
    bool all_failed = true;      ///< each is there and holds an error
    bool not_converged = false;  ///< one is to be tried again
  };

  /// A film that could not flow leaves a failed row and no file, as a contact does.
  bool add_flows(const ScanUnits& units, std::size_t pressure, ScanPlan& plan) {
    const std::size_t n_before = plan.flows.size();
    for (std::size_t i = 0; i < units.fluids[pressure].size(); ++i) {
      const Rows row = look_at({units.cases[pressure][i]});
      const Found fluid = find(units.fluids[pressure][i]);
      if (row.missing || fluid == Found::damaged || (fluid == Found::absent && !row.all_failed)) {
        plan.flows.push_back({pressure, i, row.not_converged});
      }
    }
    return plan.flows.size() > n_before;
  }

  Rows look_at(const std::vector<Unit>& cases) {
    Rows rows;
    for (const Unit& unit : cases) {
      if (find(unit) != Found::complete) {
        rows.missing = true;
        rows.all_failed = false;
        continue;
      }
      const Row row = read_row(store_, unit);
      const bool again = retry_ && (row.failed() || !row.converged);
      rows.not_converged = rows.not_converged || again;
      rows.missing = rows.missing || again;
      rows.all_failed = rows.all_failed && row.failed() && !again;
    }
    return rows;
  }

  Found find(const Unit& unit) {
    if (!store_.has(unit)) {
      return Found::absent;
    }
    report_progress(observer_, "look at the store", std::nan(""));
    const std::string problem = defect(store_, unit);
    if (problem.empty()) {
      return Found::complete;
    }
    warnings_.push_back(fmt::format("damaged, computed again: {}", problem));
    store_.remove(unit);
    return Found::damaged;
  }

  const Store& store_;
  const Study& study_;
  bool retry_;
  std::vector<std::string>& warnings_;
  const Observer& observer_;
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

std::vector<ScanPlan> plan(const Store& store, const Study& study,
                           const std::vector<ScanUnits>& units, const Shard& shard, bool retry,
                           std::vector<std::string>& warnings, const Observer& observer) {
  Planner planner(store, study, retry, warnings, observer);
  std::vector<ScanPlan> plans;
  std::size_t pair = 0;
  for (const ScanUnits& scan : units) {
    std::vector<std::size_t> mine;
    for (std::size_t pressure = 0; pressure < study.mean_pressures.size(); ++pressure, ++pair) {
      if (pair % static_cast<std::size_t>(shard.count) ==
          static_cast<std::size_t>(shard.index - 1)) {
        mine.push_back(pressure);
      }
    }
    plans.push_back(planner.plan(scan, mine));
  }
  return plans;
}

int jobs_that_fit(Index n_pixels, std::size_t available_bytes, int n_threads, bool oil_flows) {
  // Of one unit with its surface; tools/bench/study prints it. With oil that flows, what the peak
  // of `tabor friction --fluid reynolds` grows by with the pixels of a flooded scan, and a little.
  const std::size_t bytes_per_pixel = oil_flows ? 500 : 80;
  const std::size_t fitting =
      available_bytes / 2 /
      (bytes_per_pixel * static_cast<std::size_t>(std::max<Index>(1, n_pixels)));
  return static_cast<int>(std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(n_threads)));
}

}  // namespace tabor::study
