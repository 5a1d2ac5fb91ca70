#include "tabor/study/work_share.hpp"

#include <algorithm>
#include <limits>

namespace tabor::study {
namespace {

/// From here on a running task tells how long its kind takes. Earlier its set-up weighs too much.
constexpr double kTellingShare = 0.2;

}  // namespace

WorkShare::WorkShare(const std::vector<Task>& tasks, Clock clock)
    : done_(tasks.size(), 0.0), started_(tasks.size()), clock_(std::move(clock)) {
  for (const Task& task : tasks) {
    kinds_.push_back(static_cast<std::size_t>(task.kind));
  }
}

void WorkShare::end(std::size_t task) {
  done_[task] = 1;
  ended_[kinds_[task]].seconds += clock_() - started_[task].value_or(clock_());
  ended_[kinds_[task]].n += 1;
}

std::array<WorkShare::Cost, WorkShare::kKinds> WorkShare::costs() const {
  std::array<Cost, kKinds> costs = ended_;
  for (std::size_t task = 0; task < kinds_.size(); ++task) {
    const bool tells = done_[task] >= kTellingShare && done_[task] < 1 && started_[task];
    if (!tells || ended_[kinds_[task]].n > 0) continue;
    costs[kinds_[task]].seconds += (clock_() - *started_[task]) / done_[task];
    costs[kinds_[task]].n += 1;
  }
  return costs;
}

std::optional<double> WorkShare::seconds_left() const {
  const auto costs = this->costs();
  double all = 0;
  double longest = 0;  // no task is shared between workers
  for (std::size_t task = 0; task < kinds_.size(); ++task) {
    if (done_[task] >= 1) continue;
    const Cost& cost = costs[kinds_[task]];
    if (cost.n == 0) return std::nullopt;
    const double expected = cost.seconds / cost.n;
    // A task that does not say how far it is has used its time up to now.
    const double gone = done_[task] > 0  ? done_[task] * expected
                        : started_[task] ? clock_() - *started_[task]
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

}  // namespace tabor::study
