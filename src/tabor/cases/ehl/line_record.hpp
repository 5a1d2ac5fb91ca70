#pragma once

#include <optional>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/ehl/line/line.hpp"
#include "tabor/ehl/line/wear.hpp"

// Makes the record of a line contact: the numbers of `tabor ehl line`.
namespace tabor::ehl {

/// What asperities carry, where solids can touch.
struct LineAsperities {
  double boundary_film = 0;           ///< [m]
  double max_pressure = 0;            ///< [Pa] of the asperities
  double max_fluid_pressure = 0;      ///< [Pa] of the liquid
  double solid_contact_fraction = 0;  ///< of the width of the dry contact
};

/// What a user is told of a worn track.
struct WearRecord {
  WearInstant last;
  double thinnest_film = 0;    ///< [m], in all the time
  double worn_area = 0;        ///< [m^2], volume per width
  std::optional<double> mass;  ///< [kg]; nothing without a density and a width
  double time_step = 0;        ///< [s]
  std::size_t n_steps = 0;
  Convergence convergence;
};

/// What a user is told of a line contact.
struct LineRecord {
  LineMeasures measures;
  reference::HertzLineContact hertz;
  reference::LineContactFilm groups;
  Index nodes = 0;
  double inlet = 0;   ///< [m] before the centre
  double outlet = 0;  ///< [m] behind it
  std::optional<LineAsperities> asperities = {};
  std::optional<AsperityEffect> single_asperity = {};
  std::optional<WearRecord> wear = {};

  /// The convergence of the film, or of its wear where the film converged and there is wear.
  const Convergence& convergence() const;
};
const Columns<LineRecord>& line_columns();

/// The record of a solved film, without its wear.
LineRecord line_record(const LineProblem& problem, const LineResult& result);

/// The same for a person, in groups.
std::vector<Facts> facts_of(const LineProblem& problem, const LineResult& result,
                            const LineRecord& record);

}  // namespace tabor::ehl
