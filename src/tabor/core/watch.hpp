#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tabor/core/convergence.hpp"
#include "tabor/core/error.hpp"

namespace tabor {

/// Keeps an observer asked while this object lives: at once, and from then on about ten times a
/// second by every loop of core/parallel.hpp and every go_on_or_throw() that its thread comes to,
/// however deep below. What is computed there need not know who watches it.
///
/// A watch within a watch speaks in its place until it ends. Both may have the same observer.
class Watch {
 public:
  /// Asks for the first time. A watch without a stage has nothing to show and only asks. Throws
  /// Interrupted when the observer says stop, here and later.
  /// `observer` must outlive the watch; an empty one leaves the word to the watch around.
  Watch(const Observer& observer, std::string_view stage);
  Watch(Observer&&, std::string_view) = delete;
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// The done share 0..1 that is told from now on, and at once.
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

/// Works under a watch, which is handed to `work`. False, and no exception, if the observer stopped
/// it; what a watch around says ends the work by Interrupted as ever.
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

/// For serial loops that take longer than an eye blink, every few thousand items: asks the observer
/// that watches this thread, if there is one and a tenth of a second has passed since it was asked.
/// Throws Interrupted when it says stop.
void go_on_or_throw();

/// The same for item i of such a loop, where asking for the time each time would be felt.
inline void go_on_or_throw(std::size_t i) {
  if (i % 16384 == 0) go_on_or_throw();
}

/// For tests: seconds between two questions of a watch, 0 for every opportunity.
inline constexpr double kWatchPeriod = 0.1;
void set_watch_period(double seconds);

}  // namespace tabor
