#include "tabor/study/work_share.hpp"

namespace tabor::study {
namespace {

// Seconds a surface, a film and a contact took in the full-size study (tools/bench/study), and a
// film that flows on a patch of that size, rounded.
constexpr std::array<double, 4> kTypical{2, 12, 3, 100};

}  // namespace

WorkShare::WorkShare(const std::vector<Task>& tasks) : done_(tasks.size(), 0.0) {
  for (const Task& task : tasks) {
    kinds_.push_back(static_cast<std::size_t>(task.kind));
  }
}

void WorkShare::end(std::size_t task, double seconds) {
  done_[task] = 1;
  seconds_[kinds_[task]] += seconds;
  ended_[kinds_[task]] += 1;
}

double WorkShare::share() const {
  double gone = 0;
  double all = 0;
  for (std::size_t task = 0; task < kinds_.size(); ++task) {
    const double seconds = expected(kinds_[task]);
    gone += done_[task] * seconds;
    all += seconds;
  }
  return all > 0 ? gone / all : 0;
}

double WorkShare::expected(std::size_t kind) const {
  if (ended_[kind] > 0) {
    return seconds_[kind] / ended_[kind];
  }
  double measured = 0;
  double typical = 0;
  for (std::size_t other = 0; other < kKinds; ++other) {
    measured += seconds_[other];
    typical += ended_[other] * kTypical[other];
  }
  return kTypical[kind] * (measured > 0 ? measured / typical : 1);
}

}  // namespace tabor::study
