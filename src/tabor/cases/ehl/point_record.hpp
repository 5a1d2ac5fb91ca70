#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/ehl/point/measures.hpp"
#include "tabor/ehl/point/point.hpp"
#include "tabor/ehl/point/transient.hpp"

// Makes the record of a point contact: the numbers of `tabor ehl point`.
namespace tabor::ehl {

/// Films of formulas for smooth bodies; NaN where a formula does not hold.
struct PointFormulas {
  double nijenbanning = 0;            ///< [m], in the centre, over the density at Hertz' pressure
  double hamrock_dowson_central = 0;  ///< [m]
  double hamrock_dowson_min = 0;      ///< [m]
};

/// The scan that a case took.
struct PointScan {
  std::string path;
  std::string sha256;  ///< of its bytes
};

/// The rough bodies without liquid.
struct DryPointContact {
  PointMeasures measures;
  Convergence convergence;
};

/// What a film under a moving roughness went through.
struct PointHistory {
  std::size_t n_steps = 0;
  double end = 0;              ///< [s]
  double roughness_speed = 0;  ///< [m/s]
  PointMoment thinnest;        ///< when the film was smallest
  PointMoment hardest;         ///< when the pressure was largest
};

/// What a user is told of a point contact.
struct PointRecord {
  PointMeasures measures;
  reference::PointContactFilm groups;
  PointFormulas formulas;
  double moes_length = 0;   ///< [m] of a film of 1 in Moes' units, Rx sqrt(2 U)
  double hertz_length = 0;  ///< [m] of a film of 1 in units of a^2/Rx, as numerical papers scale it
  double load = 0;          ///< [N]
  double entrainment_speed = 0;  ///< [m/s]
  double sliding_speed = 0;      ///< [m/s]
  double roughness_rms = 0;      ///< [m], over the area of the dry contact; 0 for smooth bodies
  double lambda_ratio = 0;       ///< mean central film over roughness_rms; NaN for smooth bodies
  Index nodes_x = 0;
  Index nodes_y = 0;
  double spacing = 0;  ///< [m] of the nodes along the flow
  double load_error = 0;
  double mass_error = 0;
  Convergence convergence;
  std::optional<PointScan> scan = {};
  std::optional<DryPointContact> dry = {};
  std::optional<PointHistory> history = {};
};
const Columns<PointRecord>& point_columns();

/// The record of a film; `measures` of it, in which friction that nobody can know is NaN.
PointRecord point_record(const PointProblem& problem, const PointResult& result,
                         const PointMeasures& measures);

/// The same for a person, in groups.
std::vector<Facts> facts_of(const PointProblem& problem, const PointRecord& record);

}  // namespace tabor::ehl
