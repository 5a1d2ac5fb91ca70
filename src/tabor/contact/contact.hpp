#pragma once

#include <variant>

#include "tabor/contact/caps.hpp"
#include "tabor/contact/pressure_list.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/elastic/operator.hpp"

// Solves the contact of a rough elastic surface with a rigid flat under a given load, and
// summarises the result.
namespace tabor::contact {

/// Algorithm of the contact solver; both reach the same certificate.
enum class Solver {
  fast,  ///< preconditioned projected spectral gradient, one operator application per iteration
  polonsky_keer  ///< Polonsky & Keer 1999: the textbook baseline, two applications per iteration
};

/// Control by the mean pressure P.
struct MeanPressure {
  double value = 0;  ///< [Pa], load / nominal area, > 0
};
/// Control by the force on the whole map, for a surface that does not repeat.
struct Force {
  double value = 0;  ///< [N], > 0
};
/// Control by the place of the flat: its separation, as State::separation. Below the highest point
/// of the surface; above the mean height of an elastic surface that repeats, which the flat reaches
/// in full contact.
struct Separation {
  double value = 0;  ///< [m]
};
/// Given quantity of a contact; the others follow.
using Control = std::variant<MeanPressure, Force, Separation>;

/// Bounds on the pressure. The lower one is zero: no adhesion.
struct Bounds {
  double upper = kNoSaturation;  ///< p_sat [Pa]; must exceed P
  Field upper_of_each{};         ///< p_sat of each pixel [Pa], in place of `upper`; or empty

  /// Returns the upper bounds of all pixels; they refer to this object.
  Caps caps() const { return upper_of_each.size() > 0 ? Caps(upper_of_each.data()) : Caps(upper); }
};

/// Contact problem: a rigid flat is pressed on `height`.
struct Problem {
  Field height;       ///< [m], asperities up, shape (ny, nx), no NaN
  Control control{};  ///< what is given: mean pressure, force or separation
  Bounds bounds{};
  PressureList start{};     ///< pressure to start from, like that of a similar problem [Pa]; may be
                            ///< empty. The answer is the same within the tolerance.
  double tolerance = 1e-6;  ///< on the certificate
  int max_iterations = 5000;
};

/// Returns the mean pressure [Pa] that the control prescribes on a grid; NaN where it prescribes
/// the separation, so that the pressure is part of the solution.
double prescribed_pressure(const Problem& problem, const Grid& grid);

/// Solution of a contact problem. gap = separation + displacement - height; gap < 0 only at
/// saturated pixels, where -gap is the residual plastic indentation.
struct State {
  Field pressure;            ///< [Pa], 0 <= p <= p_sat, mean exactly P
  Field displacement;        ///< [m]
  Field gap;                 ///< [m]
  double mean_pressure = 0;  ///< P [Pa], that the pressure carries
  double separation = 0;     ///< [m], height of the flat: its distance from the zero of heights
  double gap_error = 0;  ///< [m], largest gap or overlap where the contact conditions allow none
  double gap_limit = 0;  ///< [m], the largest gap_error that counts as converged
  Convergence convergence;
  /// Steps of the fast solver without the long-wave correction, because with it the bounds made the
  /// direction an ascent.
  int compact_steps = 0;
};

/// Throws InputError where the flat at this separation [m] does not touch the heights [m], or where
/// no pressure brings it so near.
void require_reachable(const elastic::ElasticOperator& elasticity, const Field& height,
                       const Bounds& bounds, double separation);

/// Solves the contact problem. Throws InputError for invalid input (P >= p_sat, NaN, wrong shape).
/// Not reaching the tolerance is returned, and so is being stopped: the pressure then carries the
/// load within the bounds, and the certificate tells its quality.
State solve(elastic::ElasticOperator& elasticity, const Problem& problem,
            Solver solver = Solver::fast, const Observer& observer = {});

/// Numbers that a user reads about a contact.
struct Summary {
  double mean_pressure = 0;                 ///< [Pa]
  double contact_area_fraction = 0;         ///< perimeter-corrected (Yastrebov et al. 2017)
  double contact_area_fraction_pixels = 0;  ///< counted
  bool area_correction_valid = true;        ///< false where contact lines run along the grid
  double saturated_area_fraction = 0;
  double mean_gap = 0;           ///< [m], mean of max(gap, 0)
  double separation = 0;         ///< [m]
  double approach = 0;           ///< of the flat since it first touched the surface [m]
  double contact_gap_error = 0;  ///< [m], State::gap_error
  double max_pressure = 0;       ///< [Pa]
  double elastic_energy = 0;     ///< [J/m^2]
  Index n_patches = 0;
  double perimeter = 0;  ///< [m], along pixel edges (4/pi of a circle's)
};

/// Computes the summary of a state. `periodic`: opposite borders of the map are neighbours. Shapes
/// are those of the grid.
Summary summarise(const State& state, const Problem& problem, const Grid& grid, bool periodic);

/// Returns the surface after unloading: heights less the residual plastic indentation max(-gap, 0)
/// of the saturated pixels. Solving on it again at the same load or less is elastic.
Field unloaded_height(const Field& height, const State& state);

/// True where a pixel under this pressure is in contact. Solvers, masks and measures all use this
/// test.
inline bool touches(double pressure) { return pressure > 0; }

/// True where the pressure is at the cap but for rounding. Solvers, masks and measures all use this
/// test.
inline bool at_cap(double pressure, double saturation_pressure) {
  constexpr double rounding = 1e-12;
  return pressure >= (1 - rounding) * saturation_pressure;
}

/// Returns the contact pixels: touches() of each pressure.
Mask contact_mask(const Field& pressure);
Mask contact_mask(const State& state);

/// Returns the saturated pixels: at_cap() of each pressure.
Mask saturated_mask(const State& state, const Caps& saturation_pressure);

}  // namespace tabor::contact
