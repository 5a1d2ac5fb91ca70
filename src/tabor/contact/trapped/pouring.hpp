#pragma once

#include <optional>
#include <vector>

#include "tabor/contact/trapped/pockets.hpp"

// Projects pressures on those that carry a load and stand no lower in a pocket than its liquid.
namespace tabor::contact {

/// A step to be projected: pressures wanted [Pa], of pixels that may move, those outside pockets
/// apart from those of pockets (in the order of Pockets::pixels).
struct Wanted {
  std::vector<double> outside;
  std::vector<double> inside;
  double step = 1;  ///< t of the pixels outside [Pa/m]
};

/// The proximal step of the energy of trapped liquid. In the landscape of the wanted pressures
/// liquid stands in each pocket k at the level pi_k [Pa] that holds the volume t_k V_k (1 -
/// pi_k/K):
///
///     p = clip(max(q + t_k/t shift, pi_k), 0, p_sat),   0 <= pi_k <= seal_k
///
/// with the shift for which the pressures carry the load. t_k [Pa/m] is the step of a pocket, t
/// that of pixels outside, whose shift is the shift itself.
class Pouring {
 public:
  /// `bulk_modulus` K [Pa], `cap` p_sat [Pa]; either may be infinite. Pockets must outlive it.
  Pouring(const Pockets& pockets, double bulk_modulus, double cap);

  /// Replaces wanted pressures by those that carry the load [Pa, sum over these pixels]; `level`:
  /// pressure of each pocket's liquid [Pa], as a first guess and as found. `steps`: t_k. `most`:
  /// bound on each level, its seal [Pa]. Returns the shift; nothing where none carries the load.
  std::optional<double> project(const std::vector<double>& steps, const std::vector<double>& most,
                                double load, Wanted& wanted, std::vector<double>& level);

 private:
  struct Carried {
    double load = 0;   ///< sum of pressures [Pa]
    double slope = 0;  ///< its derivative by the shift
  };
  struct Poured {
    double level = 0;
    double level_slope = 0;  ///< derivative of the level by the shift
  };

  template <typename Sum>
  Poured pour(std::size_t pocket, double step, double most, double shift, double guess,
              const double* q, const Sum& sum) const;
  Carried carried_by(std::size_t pocket, const Poured& poured, double shift, const double* q) const;
  Carried carried(const std::vector<double>& steps, const std::vector<double>& most, double shift,
                  const Wanted& wanted, std::vector<double>& level);
  double find_shift(const std::vector<double>& steps, const std::vector<double>& most, double load,
                    const Wanted& wanted, std::vector<double>& level);

  const Pockets& pockets_;
  double bulk_modulus_;
  double cap_;
  std::vector<std::uint32_t> small_, large_;  // pockets, by what a loop over one of them costs
  std::vector<Carried> by_pocket_;
};

}  // namespace tabor::contact
