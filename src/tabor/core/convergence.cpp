#include "tabor/core/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor {

double share_done(double first_certificate, const Convergence& convergence) {
  const auto log = [](double certificate) { return std::log10(std::max(certificate, 1e-300)); };
  const double way = log(first_certificate) - log(convergence.tolerance);
  const double gone = log(first_certificate) - log(convergence.certificate);
  return std::isfinite(gone) && way > 0 ? std::clamp(gone / way, 0.0, 1.0) : 0.0;
}

void report_progress(const Observer& observer, std::string_view stage, double fraction) {
  if (observer && !observer({stage, fraction, nullptr})) {
    throw Interrupted();
  }
}

}  // namespace tabor
