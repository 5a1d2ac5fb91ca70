#pragma once

#include <functional>
#include <limits>
#include <string_view>

namespace tabor {

/// What an iterative solver can prove about its result. Not converging is returned, never thrown.
struct Convergence {
  int iterations = 0;
  int operator_applications = 0;  ///< on the problem's own grid
  double fft_pairs = 0;  ///< all of them: coarse grids by their share of pixels, preconditioner too
  double certificate = std::numeric_limits<double>::infinity();  ///< dimensionless; proves quality
  double tolerance = 0;                                          ///< the certificate asked for
  bool converged = false;
};

/// Share of an iterative solve that is done, from the logarithm of its certificate: 0 at the first.
double share_done(double first_certificate, const Convergence& convergence);

/// One message from a long computation to whoever watches it.
struct Progress {
  std::string_view stage;  ///< "contact 7 MPa", "rain", "read", ...
  double fraction = std::numeric_limits<double>::quiet_NaN();  ///< done share 0..1, NaN if unknown
  const Convergence* convergence = nullptr;                    ///< of an iterative solver, or null
  double whole = std::numeric_limits<double>::quiet_NaN();     ///< done share of all stages, or NaN
};

/// Called once per iteration (or every few per cent of a loop). Returns false to stop: the
/// computation then returns (solvers) or throws Interrupted (everything without a partial answer).
using Observer = std::function<bool(const Progress&)>;

/// Tells the observer if there is one; throws Interrupted when it asks to stop.
void report_progress(const Observer& observer, std::string_view stage, double fraction);

}  // namespace tabor
