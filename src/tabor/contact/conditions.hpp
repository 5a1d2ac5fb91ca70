#pragma once

#include <span>

#include "tabor/contact/certificate.hpp"
#include "tabor/contact/load_problem.hpp"

// Tests whether a pressure satisfies load, bounds and complementarity; both contact solvers stop by
// it.
namespace tabor::contact {

/// A pixel's own gap would change its pressure this many times over: it is at the bound next to it.
/// Rough surfaces solved to 1e-6 stay below 200.
inline constexpr double kFalseContact = 1000;
/// Share of the load that pixels settling on their bounds may move: more is for iterations to move.
inline constexpr double kMostSettled = 1e-6;

/// Conditions of a solution, by which both solvers stop: it carries the load, its duality gap is
/// small, and the gap is closed wherever the pressure is inside its bounds. The duality gap weighs
/// gaps with pressure; a pixel with next to no pressure could have any gap without it. Takes
/// pressures p, residuals v = S p - z and caps of all pixels that matter, in the same order.
class Conditions {
 public:
  Conditions(const elastic::ElasticOperator& elasticity, const LoadProblem& problem);

  double load() const { return load_; }  ///< sum of the pressures [Pa]

  /// Returns the certificate (docs/theory.md); infinite for a pressure that does not carry the
  /// load.
  double certificate(const Candidates& all, const Caps& caps) const;

  /// Returns sep with gap = v + sep [m], such that the mean gap of the pixels inside the bounds is
  /// zero, each weighted by its distance from the bounds, p (1 - p / p_sat). If all are at the cap,
  /// their largest gap is zero.
  double separation(std::span<const double> p, std::span<const double> v, const Caps& caps) const;

  /// Returns the largest violation [m] of: gap = 0 inside the bounds, gap >= 0 without pressure,
  /// gap <= 0 at the cap.
  double gap_error(std::span<const double> p, std::span<const double> v, const Caps& caps,
                   double separation) const;

  /// Returns the largest gap_error that counts as converged (docs/theory.md, "Certificate").
  double gap_limit() const { return gap_limit_; }

  bool gaps_close(std::span<const double> p, std::span<const double> v, const Caps& caps) const {
    return gap_error(p, v, caps, separation(p, v, caps)) <= gap_limit_;
  }

  enum class Settled { already, now, not_yet };
  /// Moves pixels to a bound whose pressure is not clearly between the bounds: their gap would
  /// change it many times over. The other pixels share the moved load. `now`: pressures changed, v
  /// must be computed again; `not_yet`: too much load would move, the pressures stay as they were.
  Settled settle(std::span<double> p, std::span<const double> v, const Caps& caps) const;

 private:
  double relaxed_separation(std::span<const double> p, std::span<const double> v,
                            const Caps& caps) const;
  double settled_pressure(double p, double gap, double cap) const;
  bool share_rest(std::span<double> p, const Caps& caps) const;

  double load_;
  double gap_scale_;         // of the duality gap [Pa m]
  double pixel_compliance_;  // displacement of a pixel by its own pressure [m/Pa]
  double rounding_;          // of gaps [m]
  double gap_limit_;         // [m]
};

}  // namespace tabor::contact
