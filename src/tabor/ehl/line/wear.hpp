#pragma once

#include <string>
#include <vector>

#include "tabor/core/warning.hpp"
#include "tabor/ehl/line/line.hpp"

// Follows the wear of a track that runs under a lubricated cylinder.
namespace tabor::ehl {

/// A track that runs under a standing cylinder, round and round or to and fro, and is worn by what
/// it carries (Archard 1953, in each point): d(depth)/dt = kw |u_s| p, following the material.
struct WearProblem {
  /// The film; its sliding speed is the speed of the track, and its roughness is not used.
  LineProblem contact;
  double wear_coefficient = 0;  ///< kw [m^2/N], wear volume over load and distance
  /// [m], longer than the domain and the stroke together; a whole number of nodes is taken. 0 with
  /// a stroke: just as long.
  double track_length = 0;
  /// [m]: the track goes to and fro as a sine, with the speeds of `contact` in the middle of the
  /// stroke. 0: it runs on.
  double stroke = 0;
  double wave_amplitude = 0;    ///< [m] of the unworn track
  Index n_waves = 0;            ///< on the track
  Index steps_per_cycle = 600;  ///< at least; a cycle is the length of the track or two strokes
  Index cycles = 1;             ///< computed
  double cycles_each = 1;  ///< what each computed cycle stands for: wear is so many times as fast
};

/// One instant.
struct WearInstant {
  double time = 0;                  ///< [s], of all cycles that the computed ones stand for
  double distance = 0;              ///< slid [m]
  double mean_depth = 0;            ///< [m] over the track
  double max_depth = 0;             ///< [m]
  double sliding_speed = 0;         ///< [m/s], negative on the way back
  double min_film = 0;              ///< [m]
  double max_pressure = 0;          ///< [Pa]
  double friction_coefficient = 0;  ///< with the sign of the speed
};

/// The worn track, and how it came to that.
struct WearResult {
  std::vector<WearInstant> history;  ///< the first before any wear; empty if stopped before
  Eigen::ArrayXd track;              ///< [m] place along the track
  Eigen::ArrayXd depth;              ///< worn [m] at the end
  double time_step = 0;              ///< [s] of the film
  double worn_area = 0;              ///< [m^2], volume per width
  Convergence convergence;           ///< of all steps; certificate: of the last one
  Warnings warnings;
};

/// Follows the film by implicit Euler steps. The nodes of the track move with it from node to node
/// of the film, so that no interpolation smooths the wear; with a stroke, a step moves the track to
/// the node next to where it is. A domain without a given outlet is made symmetric for a stroke.
/// Throws InputError for invalid input, as solve_line(); a step that does not converge
/// ends it, and so does being stopped.
WearResult solve_wear(const WearProblem& given, const Observer& observer = {});

}  // namespace tabor::ehl
