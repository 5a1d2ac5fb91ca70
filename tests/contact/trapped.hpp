#pragma once

#include "contact/surfaces.hpp"
#include "tabor/contact/trapped/in_pockets.hpp"

// Contacts with trapped liquid on a periodic unit square with E* = 1.
namespace tabor::test {

inline constexpr double kUnitAmplitude = 0.01;

inline double area_of(const Mask& mask) {
  return static_cast<double>(mask.count()) / static_cast<double>(mask.size());
}

/// A contact, and the operator that it was solved with.
struct UnitContact {
  UnitContact(const Field& height, double mean_pressure, double cap, double tolerance = 1e-6,
              bool periodic = true)
      : grid{height.cols(), height.rows(), 1.0,
             static_cast<double>(height.rows()) / static_cast<double>(height.cols())},
        is_periodic(periodic),
        elasticity(periodic ? elastic::make_periodic(grid, 1.0) : elastic::make_free(grid, 1.0)),
        problem{.height = height,
                .control = contact::MeanPressure{mean_pressure},
                .bounds = {.upper = cap},
                .tolerance = tolerance},
        dry(contact::solve(*elasticity, problem)) {}

  contact::TrappedState with(const Field& film, double bulk_modulus) const {
    return contact::solve_trapped(*elasticity, problem, {film, bulk_modulus, is_periodic}, dry);
  }

  Grid grid;
  bool is_periodic;
  std::unique_ptr<elastic::ElasticOperator> elasticity;
  contact::Problem problem;
  contact::State dry;
};

/// One pocket that is the whole cell, with liquid of this mean height.
inline contact::TrappedState press_whole_cell(const Field& height, double mean_pressure, double cap,
                                              double liquid_height, double bulk_modulus,
                                              double tolerance = 1e-7) {
  const UnitContact contact(height, mean_pressure, cap, tolerance);
  const Field film = Field::Constant(height.rows(), height.cols(), liquid_height);
  const contact::Pockets pockets =
      contact::pockets_of(std::vector<std::int32_t>(static_cast<std::size_t>(height.size()), 0),
                          contact::contact_mask(contact.dry), film);
  return contact::solve_in_pockets(*contact.elasticity, contact.problem, pockets,
                                   {film, bulk_modulus, true}, contact.dry);
}

}  // namespace tabor::test
