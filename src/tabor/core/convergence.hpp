#pragma once

#include <functional>
#include <limits>
#include <string_view>

// Reports how an iterative computation ended, and lets an observer follow and stop it.
namespace tabor {

/// End of an iterative solver.
enum class Status {
  converged,        ///< to the tolerance asked for
  stalled,          ///< no step brought it any nearer
  iteration_limit,  ///< it was not there after as many iterations as it was given
  stopped           ///< the observer said stop: not a failure, and nothing is tried after it
};

/// Returns "converged", "stalled", "iteration limit" or "stopped".
std::string_view name_of(Status status);

/// Proven quality of the result of an iterative solver. Not converging is returned, never thrown.
struct Convergence {
  int iterations = 0;
  int operator_applications = 0;  ///< on the problem's own grid
  double fft_pairs = 0;  ///< all of them: coarse grids by their share of pixels, preconditioner too
  double certificate = std::numeric_limits<double>::infinity();  ///< dimensionless; proves quality
  double tolerance = 0;                                          ///< the certificate asked for
  Status status = Status::iteration_limit;                       ///< also while it runs

  /// True where the certificate is within the tolerance.
  bool converged() const { return status == Status::converged; }
  /// True where the observer asked to stop.
  bool stopped() const { return status == Status::stopped; }
  /// True where it neither converged nor was stopped: another method may be tried.
  bool failed() const { return !converged() && !stopped(); }
};

/// Returns `now` with the work of `before` added.
Convergence after(const Convergence& before, Convergence now);

/// Returns the convergence of a result that needed no iteration.
Convergence exact(double tolerance = 0);

/// Returns the share of an iterative solve that is done, from the logarithm of its certificate: 0
/// at the first.
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

/// Tells the observer if there is one; true if it asks to stop.
bool asks_to_stop(const Observer& observer, const Progress& progress);

/// Throws Interrupted if the solver was stopped: for callers that cannot use an unfinished result.
void throw_if_stopped(const Convergence& convergence);

/// Tells the observer if there is one; throws Interrupted when it asks to stop.
void report_progress(const Observer& observer, std::string_view stage, double fraction);

}  // namespace tabor
