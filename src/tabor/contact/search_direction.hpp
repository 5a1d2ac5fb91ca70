#pragma once

#include <algorithm>
#include <vector>

#include "tabor/contact/caps.hpp"
#include "tabor/contact/long_waves.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/elastic/operator.hpp"

// Finds the direction of a projected step on a set of pixels, for the solvers with and without
// trapped liquid.
namespace tabor::contact {

// Both solvers refine and give up alike.
inline constexpr double kFirstRefresh = 1e-6;  ///< certificate below which v is computed afresh in
                                               ///< double
inline constexpr double kNextRefresh = 1e-4;   ///< and again each time it fell by this factor
inline constexpr int kPatience = 300;          ///< iterations without a better certificate

/// The direction M r [Pa] of residuals r on a set of pixels: that of the compact Preconditioner,
/// corrected for long waves (LongWaves). Pixels that a bound holds depend on the correction and the
/// correction on them: a semi-smooth Newton iteration, each round of which holds what the direction
/// of the round before presses against a bound.
class SearchDirection {
 public:
  explicit SearchDirection(const elastic::ElasticOperator& elasticity)
      : preconditioner_(elasticity.grid(), elasticity.effective_modulus(), elasticity.border()),
        long_waves_(elasticity.grid(), elasticity.effective_modulus(), preconditioner_.plateau(),
                    elasticity.border()) {}

  /// Stiffness of a lone pixel [Pa/m].
  double diagonal() const { return preconditioner_.diagonal(); }

  /// Finds the direction on a set for steps of this length; pressure(k) and lowest(k) [Pa] at its
  /// pixel k, which lies between lowest(k) and caps(k). `residual` [m] is a map, zero off the set.
  template <typename Pressure, typename Lowest>
  void find(const PixelList& set, const FieldF& residual, double step, const Caps& caps,
            const Pressure& pressure, const Lowest& lowest) {
    preconditioner_.apply(set, residual, compact_, stiffness_);
    whole_ = compact_;
    moved_ = compact_;
    long_waves_.start_anew();
    for (int round = 0; round < kMostRounds && long_waves_.useful(); ++round) {
      const double n_changed = hold_at_bounds(set.size(), step, caps, pressure, lowest);
      if (round > 1 && n_changed <= kSettledShare * static_cast<double>(set.size())) break;
      const auto accuracy = round == 0 ? LongWaves::Accuracy::rough : LongWaves::Accuracy::full;
      long_waves_.correct(set, stiffness_, moved_, compact_, accuracy, whole_);
    }
  }

  /// Takes the residual times the diagonal, pixel by pixel.
  void find_alone(const PixelList& set, const FieldF& residual) {
    const auto diagonal = static_cast<float>(preconditioner_.diagonal());
    whole_.resize(set.size());
    for_each(set.size(), [&](std::size_t k) { whole_[k] = diagonal * residual.data()[set[k]]; });
    compact_ = whole_;
  }

  const std::vector<float>& whole() const { return whole_; }
  const std::vector<float>& compact() const { return compact_; }  ///< without long waves

  /// Leaves the correction for long waves out.
  void drop_long_waves() { whole_ = compact_; }
  /// Counts as no direction, so that the next step is not measured by it.
  void clear() { std::fill(whole_.begin(), whole_.end(), 0.0F); }
  /// Frees all but whole().
  void free_memory() {
    for (std::vector<float>* values : {&compact_, &stiffness_, &moved_}) release(*values);
  }

  /// Returns <S dp, M S dp> of the step before, M S dp being the change of the direction since:
  /// previous(k) is the direction then, response(k) S dp [m] of that step.
  template <typename Response, typename Previous>
  double curvature_of_change(const Response& response, const Previous& previous) const {
    const double mean = sum_over(whole_.size(), response) / static_cast<double>(whole_.size());
    return sum_over(whole_.size(), [&](std::size_t k) {
      return (static_cast<double>(whole_[k]) - previous(k)) * (response(k) - mean);
    });
  }

 private:
  static constexpr int kMostRounds = 3;
  static constexpr double kSettledShare = 1e-4;  // of the pixels changing between free and held

  /// moved_ := the compact direction, or as much as the bounds allow where the direction leads
  /// beyond them. Returns the number of pixels that changed between the two.
  template <typename Pressure, typename Lowest>
  double hold_at_bounds(std::size_t n, double step, const Caps& caps, const Pressure& pressure,
                        const Lowest& lowest) {
    return sum_over(n, [&](std::size_t k) {
      const double p = pressure(k);
      const double wanted = p - step * static_cast<double>(whole_[k]);
      const double allowed = std::clamp(wanted, lowest(k), caps(k));
      const bool was_free = moved_[k] == compact_[k];
      moved_[k] = wanted == allowed ? compact_[k] : static_cast<float>((p - allowed) / step);
      return was_free == (wanted == allowed) ? 0.0 : 1.0;
    });
  }

  Preconditioner preconditioner_;
  LongWaves long_waves_;
  std::vector<float> whole_;
  std::vector<float> compact_;
  std::vector<float> stiffness_;  // row sums of the compact kernel [Pa/m]
  std::vector<float> moved_;      // compact direction as far as the bounds let it through
};

}  // namespace tabor::contact
