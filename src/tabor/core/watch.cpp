#include "tabor/core/watch.hpp"

#include <chrono>
#include <limits>
#include <utility>

#include "tabor/core/error.hpp"

namespace tabor {
namespace {

thread_local double period = kWatchPeriod;  // [s] between two questions

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

thread_local Watch* innermost = nullptr;

}  // namespace

Watch::Watch(const Observer& observer, std::string_view stage)
    : observer_(observer),
      stage_(stage),
      fraction_(std::numeric_limits<double>::quiet_NaN()),
      outer_(innermost) {
  ask();  // before it is the innermost: a constructor that throws has no destructor to undo that
  if (observer_) innermost = this;
}

Watch::~Watch() { innermost = outer_; }

Unwatched::Unwatched() : outer_(std::exchange(innermost, nullptr)) {}

Unwatched::~Unwatched() { innermost = outer_; }

void Watch::tell(double fraction) {
  fraction_ = fraction;
  ask();
}

void Watch::ask() {
  asked_ = now();
  if (observer_ && !observer_({stage_, fraction_, nullptr})) throw Interrupted();
}

void go_on_or_throw() {
  if (innermost == nullptr || now() - innermost->asked_ < period) return;
  // What the observer itself computes is not watched: it would ask itself for ever.
  Watch* const asking = innermost;
  innermost = nullptr;
  try {
    asking->ask();
  } catch (...) {
    innermost = asking;
    throw;
  }
  innermost = asking;
}

void set_watch_period(double seconds) { period = seconds; }

}  // namespace tabor
