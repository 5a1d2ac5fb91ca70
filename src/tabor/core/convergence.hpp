#pragma once

#include <functional>
#include <limits>
#include <string_view>

namespace tabor {

/// How an iterative solver ended.
enum class Status {
  converged,        ///< to the tolerance asked for
  stalled,          ///< no step brought it any nearer
  iteration_limit,  ///< it was not there after as many iterations as it was given
  stopped           ///< the observer said stop: not a failure, and nothing is tried after it
};

/// "converged", "stalled", "iteration limit", "stopped".
std::string_view name_of(Status status);

/// What an iterative solver can prove about its result. Not converging is returned, never thrown.
struct Convergence {
  int iterations = 0;
  int operator_applications = 0;  ///< on the problem's own grid
  double fft_pairs = 0;  ///< all of them: coarse grids by their share of pixels, preconditioner too
  double certificate = std::numeric_limits<double>::infinity();  ///< dimensionless; proves quality
  double tolerance = 0;                                          ///< the certificate asked for
  Status status = Status::iteration_limit;                       ///< while it still goes on, too

  /// The certificate is within the tolerance.
  bool converged() const { return status == Status::converged; }
  /// The observer asked to stop.
  bool stopped() const { return status == Status::stopped; }
  /// Neither converged nor stopped: another way may be tried.
  bool failed() const { return !converged() && !stopped(); }
};

/// `now` with the work of what came before it.
Convergence after(const Convergence& before, Convergence now);

/// Of a result that needed no iteration.
Convergence exact(double tolerance = 0);

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

/// Tells the observer if there is one; true if it asks to stop.
bool asks_to_stop(const Observer& observer, const Progress& progress);

/// For callers to whom an unfinished result is of no use. Throws Interrupted if it was stopped.
void throw_if_stopped(const Convergence& convergence);

/// Tells the observer if there is one; throws Interrupted when it asks to stop.
void report_progress(const Observer& observer, std::string_view stage, double fraction);

}  // namespace tabor
