#include "tabor/engine/work_share.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tabor::engine {
namespace {

/// From here on a running job tells how long its kind takes. Earlier its set-up weighs too much.
constexpr double kTellingShare = 0.2;

}  // namespace

WorkShare::WorkShare(std::vector<std::string> kinds, Clock clock)
    : kinds_(std::move(kinds)),
      done_(kinds_.size(), 0.0),
      started_(kinds_.size()),
      clock_(std::move(clock)) {}

void WorkShare::end(std::size_t job) {
  done_[job] = 1;
  Cost& cost = ended_[kinds_[job]];
  cost.seconds += clock_() - started_[job].value_or(clock_());
  cost.n += 1;
}

std::map<std::string, WorkShare::Cost> WorkShare::costs() const {
  std::map<std::string, Cost> costs = ended_;
  for (std::size_t job = 0; job < kinds_.size(); ++job) {
    const bool tells = done_[job] >= kTellingShare && done_[job] < 1 && started_[job];
    if (!tells || ended_.contains(kinds_[job])) continue;
    Cost& cost = costs[kinds_[job]];
    cost.seconds += (clock_() - *started_[job]) / done_[job];
    cost.n += 1;
  }
  return costs;
}

std::optional<double> WorkShare::seconds_left() const {
  const auto costs = this->costs();
  double all = 0;
  double longest = 0;  // no job is shared between workers
  for (std::size_t job = 0; job < kinds_.size(); ++job) {
    if (done_[job] >= 1 || kinds_[job].empty()) continue;
    const auto cost = costs.find(kinds_[job]);
    if (cost == costs.end()) return std::nullopt;
    const double expected = cost->second.seconds / cost->second.n;
    // A job that does not say how far it is has used its time up to now.
    const double gone = done_[job] > 0  ? done_[job] * expected
                        : started_[job] ? clock_() - *started_[job]
                                        : 0;
    const double left = std::max(0.0, expected - gone);
    all += left;
    longest = std::max(longest, left);
  }
  return std::max(longest, all / n_workers_);
}

double WorkShare::share() const {
  const auto left = seconds_left();
  const double gone = clock_();
  if (!left || gone <= 0) return std::numeric_limits<double>::quiet_NaN();
  return gone / (gone + *left);
}

}  // namespace tabor::engine
