#pragma once

#include <optional>

#include "tabor/contact/contact.hpp"
#include "tabor/contact/trapped_liquid.hpp"
#include "tabor/sliding/displaced.hpp"

// Slides a rough tool over a sheet that yields, and finds the force that ploughing takes.
namespace tabor::sliding {

/// Oil on the sheet whose closed pockets carry load.
struct TrappedOil {
  Field film;               ///< [m], stays on the pixels of the sheet
  double bulk_modulus = 0;  ///< K [Pa]
  bool periodic = true;     ///< opposite borders of the map are neighbours
};

/// A sheet, a tool and the load on it. Both are on the same pixels.
struct Problem {
  Field sheet;               ///< heights [m], shape (ny, nx)
  Field tool;                ///< heights towards the sheet [m], shape (ny, nx_T), repeats along x
  Index place = 0;           ///< of the tool along x [pixels]
  double mean_pressure = 0;  ///< P [Pa]
  double saturation_pressure = 0;  ///< p_sat [Pa]; infinite: the sheet is elastic, and only worn
  double hardening = 0;  ///< H [Pa/m]: where the sheet has yielded w deep, p_sat is H w higher
  Displaced displaced = Displaced::near;
  double reach = 2e-6;          ///< [m], of Displaced::near
  double wear_coefficient = 0;  ///< k [1/Pa]: a solid pressure p wears k p deep over each length
  std::optional<TrappedOil> oil = {};
  double tolerance = 1e-6;  ///< on the certificate of each contact
};

/// Work and material of sliding from one place of the tool to the next, over the nominal area.
struct Ploughing {
  double distance = 0;       ///< [m]
  double work = 0;           ///< [J/m^2]
  double lower = 0;          ///< bound on the work [J/m^2]
  double upper = 0;          ///< the same from above
  double moved = 0;          ///< volume of displaced material [m]
  double lost = 0;           ///< of it, that left the sheet [m]
  double without_space = 0;  ///< of it, that found no space in the gap [m]
  double worn = 0;           ///< volume that wear took off, beside what was displaced [m]

  Ploughing& operator+=(const Ploughing& more);
  /// Returns the coefficient of friction of a work under a mean pressure [Pa]; NaN before sliding.
  double friction(double of_work, double mean_pressure) const;
  /// Returns the step certificate: bounds apart, over the work, at least 1e-3 of load and distance.
  double certificate(double mean_pressure) const;
};

/// Presses the tool on the sheet and slides it along +x, step by step. Each contact displaces
/// material of the saturated pixels, w = max(-gap, 0); it is taken off the sheet and rises
/// elsewhere (displaced.hpp). With V' = 1/2 <p, S p> + P N sep after that, the force of ploughing
/// follows from the energy of two places,
///
///   work = V'(2) + p_sat sum w(2) - V'(1),   <p(1), T(2) - T(1)> <= work <= <p(2), T(2) - T(1)>,
///
/// since V(h) = min { 1/2 <u, S^-1 u> + p_sat sum w + P N sep : sep + u + w >= h, w >= 0 } is
/// convex with the gradient p, and V(h - w) = V(h) - p_sat sum w with the same p (docs/sliding.md).
/// With hardening p_sat is a map, that of the contact 2: it is no lower than that of the contact 1,
/// so that V'(1) and p(1) are the same under both.
/// Wear takes k p s off the sheet with each step s (Archard 1953), and <p, k p s> off V', to first
/// order. With trapped oil the pockets change between two places, and V' with them: the work is
/// then the mean of both products, which are no bounds.
class Slider {
 public:
  /// Throws InputError for shapes, loads and tools that do not fit.
  Slider(elastic::ElasticOperator& elasticity, Problem problem);

  /// Presses without sliding: the first state. Throws Interrupted where the observer stops it.
  Ploughing press(const Observer& observer = {});
  /// Moves the tool by so many pixels and presses again.
  Ploughing advance(Index pixels, const Observer& observer = {});

  /// What the next step depends on.
  struct Reached {
    Field sheet;        ///< [m]
    Field pressure;     ///< of the last contact without oil [Pa]
    Field with_oil;     ///< of the last contact with trapped oil [Pa]; or empty
    Field caps;         ///< saturation pressures of the next contact [Pa]; empty: p_sat
    double energy = 0;  ///< V' over the nominal area [J/m^2]
    Index place = 0;    ///< of the tool [pixels]
  };
  Reached reached() const;
  /// Goes on from what a slider of the same problem has reached, with the same bits. Until the next
  /// step there is no contact.
  void go_on_from(Reached reached);

  const Field& sheet() const { return problem_.sheet; }   ///< as the last contact left it [m]
  const contact::State& state() const { return state_; }  ///< the last contact without oil
  contact::Summary summary() const;                       ///< its numbers
  /// The contact with its trapped oil; null where there is none.
  const contact::TrappedState* trapped() const { return trapped_ ? &*trapped_ : nullptr; }
  contact::Summary summary_of_solids();  ///< of the contact with trapped oil
  /// The contact that displaces material: with trapped oil, where there is some.
  const contact::State& displacing() const { return trapped_ ? trapped_->contact : state_; }
  Mask touching() const;  ///< pixels of its solid contact
  /// Returns the saturation pressures of the last contact [Pa].
  contact::Caps caps() const;
  double highest_cap() const { return caps().highest(problem_.sheet.size()); }  ///< of a pixel [Pa]
  const Field& caps_map() const { return caps_; }  ///< the same; empty without hardening
  /// Replaces the oil of a problem that has some [m].
  void lay_oil(const Field& film) { problem_.oil->film = film; }
  Index place() const { return problem_.place; }

 private:
  Field pressed_height(Index pixels) const;
  contact::Problem pressing(Field height) const;
  const Field& last_pressure() const { return displacing().pressure; }
  Ploughing press(Index pixels, const Observer& observer);
  Ploughing settle();
  Field next_caps() const;
  double yielded(const contact::State& pressed, Index i) const;
  double wear(double distance);

  elastic::ElasticOperator& elasticity_;
  Problem problem_;
  contact::State state_;
  std::optional<contact::TrappedState> trapped_;
  Field caps_;           // saturation pressures of the last contact [Pa]; empty: p_sat
  double energy_ = 0;    // V' over the nominal area [J/m^2]
  double yielding_ = 0;  // mean of p_sat w of the last contact [J/m^2]
};

/// Returns the heights of a tool at a place over a sheet of so many columns [m].
Field tool_at(const Field& tool, Index place, Index n_columns);

}  // namespace tabor::sliding
