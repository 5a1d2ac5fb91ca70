#include "tabor/core/convergence.hpp"

#include "tabor/core/error.hpp"

namespace tabor {

void report_progress(const Observer& observer, std::string_view stage, double fraction) {
  if (observer && !observer({stage, fraction, nullptr})) {
    throw Interrupted();
  }
}

}  // namespace tabor
