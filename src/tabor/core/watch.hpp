#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tabor/core/convergence.hpp"
#include "tabor/core/error.hpp"

// Lets an observer stop any computation below the place where it was handed over.
namespace tabor {

/// Lets an observer stop the computation while this object lives: it is asked at once, and then
/// about ten times a second by every loop of core/parallel.hpp and every go_on_or_throw() that its
/// thread reaches, at any depth. The code there need not know the observer.
///
/// A watch within a watch replaces it until it ends. Both may have the same observer.
class Watch {
 public:
  /// Asks for the first time. A watch without a stage has nothing to show and only asks. Throws
  /// Interrupted when the observer says stop, here and later. `observer` must outlive the watch; an
  /// empty one leaves the outer watch in force.
  Watch(const Observer& observer, std::string_view stage);
  Watch(Observer&&, std::string_view) = delete;
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Sets the done share 0..1 and tells it to the observer at once.
  void tell(double fraction);

 private:
  friend void go_on_or_throw();
  void ask();

  const Observer& observer_;
  std::string stage_;
  double fraction_;
  double asked_ = 0;  ///< [s]
  Watch* outer_;
};

/// Lets no watch stop the computation while this object lives: for work that must not end halfway,
/// such as saving what was reached before a watch said stop. A watch within it works as ever.
class Unwatched {
 public:
  Unwatched();
  ~Unwatched();
  Unwatched(const Unwatched&) = delete;
  Unwatched& operator=(const Unwatched&) = delete;

 private:
  Watch* outer_;
};

/// Runs `work` under a watch. Returns false, without an exception, if the observer stopped it; an
/// outer watch ends the work by Interrupted.
template <typename Work>
bool finishes(const Observer& observer, std::string_view stage, const Work& work) {
  try {
    Watch watch(observer, stage);
    work(watch);
    return true;
  } catch (const Interrupted&) {
    if (!observer) throw;
    return false;
  }
}

/// Asks the observer that watches this thread, if there is one and a tenth of a second has passed
/// since it was asked. Throws Interrupted when it says stop. To be called every few thousand items
/// in serial loops that last longer than a tenth of a second.
void go_on_or_throw();

/// Does the same every 16384 items i of a loop, where reading the clock for each item would take
/// too long.
inline void go_on_or_throw(std::size_t i) {
  if (i % 16384 == 0) go_on_or_throw();
}

/// Seconds between two questions of a watch.
inline constexpr double kWatchPeriod = 0.1;
/// Sets the period of the watches of this thread; tests set 0, which asks at every opportunity.
void set_watch_period(double seconds);

}  // namespace tabor
