#pragma once

#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/contact/load_problem.hpp"
#include "tabor/contact/trapped/pockets.hpp"

// Holds the pressures of a contact with liquid while they are improved, and tests them.
namespace tabor::contact {

/// True where a pressure is that of the liquid of its pocket [Pa], but for rounding.
inline bool at_level(double pressure, double level) {
  constexpr double rounding = 1e-12;
  return pressure <= (1 + rounding) * level;
}

/// Pockets of liquid in a contact, and what bounds their pressures.
struct SealedPockets {
  const Pockets& pockets;
  double bulk_modulus;               ///< K [Pa], may be infinite
  const std::vector<double>& seals;  ///< largest pressure of each pocket [Pa]
};

/// Pressures of solids and liquid that carry the load, and the residual that belongs to them.
struct Iterate {
  Field pressure;              ///< p [Pa]
  Field v;                     ///< S p - h [m]
  std::vector<double> levels;  ///< pi_k [Pa]
  double lambda = 0;           ///< multiplier of the load [m]: gap = v - lambda
};

/// Conditions of a solution with liquid beside its duality gap, as conditions.hpp has them without.
class IterateConditions {
 public:
  IterateConditions(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                    const SealedPockets& liquid);

  double gap_limit() const { return gap_limit_; }  ///< largest gap_error() that counts as converged

  /// Returns the level of liquid on a pixel [Pa], 0 outside pockets.
  double level_under(const Iterate& now, std::size_t pixel) const {
    const std::int32_t pocket = liquid_.pockets.of[pixel];
    return pocket == kNoPocket ? 0 : now.levels[static_cast<std::size_t>(pocket)];
  }
  /// True where solids touch.
  bool is_solid(const Iterate& now, std::size_t pixel) const {
    const double p = now.pressure.data()[pixel];
    return touches(p) && !at_level(p, level_under(now, pixel));
  }

  /// Returns the multiplier that the pressures ask for: the mean of v over solid contact inside its
  /// bounds, each pixel weighted by its distance from them. Without such contact, the mean of what
  /// the squeezed pockets say by their volume, else the last solid contact to open; -infinity
  /// without any.
  /// `outside`: all pixels outside pockets with pressure, and any others.
  double multiplier(const Iterate& now, const PixelList& outside) const;

  /// Returns the largest violation [m] of: gap = 0 for solids inside their bounds, gap >= 0 over
  /// liquid and without pressure.
  double gap_error(const Iterate& now) const;

  /// Moves pixels to the bound that their pressure hardly differs from; the other solids share
  /// the load. Returns the load that moved, as a share of all; moves nothing where that is more
  /// than kMostSettled.
  double settle(Iterate& now) const;

  /// Lowers liquid that stands above its seal; the contact outside pockets takes the load. Returns
  /// false, and changes nothing, where no liquid does or that contact cannot bear it.
  bool let_down(const std::vector<double>& levels, Field& pressure) const;

 private:
  const SealedPockets& liquid_;
  double cap_;               // [Pa]
  double load_;              // sum of pressures [Pa]
  double pixel_compliance_;  // [m/Pa]
  double gap_limit_;         // [m]
};

}  // namespace tabor::contact
