#include "tabor/core/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"

namespace tabor {
namespace {

constexpr auto kStatuses = names<Status>("converged", "stalled", "iteration limit", "stopped");

}  // namespace

std::string_view name_of(Status status) { return kStatuses.of(status); }

Convergence after(const Convergence& before, Convergence now) {
  now.iterations += before.iterations;
  now.operator_applications += before.operator_applications;
  now.fft_pairs += before.fft_pairs;
  return now;
}

Convergence exact(double tolerance) {
  return {.certificate = 0, .tolerance = tolerance, .status = Status::converged};
}

double share_done(double first_certificate, const Convergence& convergence) {
  const auto log = [](double certificate) { return std::log10(std::max(certificate, 1e-300)); };
  const double way = log(first_certificate) - log(convergence.tolerance);
  const double gone = log(first_certificate) - log(convergence.certificate);
  return std::isfinite(gone) && way > 0 ? std::clamp(gone / way, 0.0, 1.0) : 0.0;
}

bool asks_to_stop(const Observer& observer, const Progress& progress) {
  return observer && !observer(progress);
}

void throw_if_stopped(const Convergence& convergence) {
  if (convergence.stopped()) throw Interrupted();
}

void report_progress(const Observer& observer, std::string_view stage, double fraction) {
  if (asks_to_stop(observer, {stage, fraction, nullptr})) throw Interrupted();
}

}  // namespace tabor
