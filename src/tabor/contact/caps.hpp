#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "tabor/core/types.hpp"

// Holds the upper bounds on pressures: one for all pixels, or one for each.
namespace tabor::contact {

inline constexpr double kNoSaturation = std::numeric_limits<double>::infinity();

/// Saturation pressures of a map, or of a list of its pixels, that it does not own. One for all
/// costs no memory and no look.
class Caps {
 public:
  /// One for all [Pa], which is what most callers have.
  Caps(double for_all) : for_all_(for_all) {}  // NOLINT(google-explicit-constructor)
  /// One for each pixel [Pa]; must outlive the object.
  explicit Caps(const double* each) : for_all_(kNoSaturation), each_(each) {}

  /// Returns the cap of pixel i [Pa].
  template <std::integral Count>
  double operator()(Count i) const {
    return each_ != nullptr ? each_[i] : for_all_;
  }
  bool are_one() const { return each_ == nullptr; }  ///< true where one holds for all pixels
  double for_all() const { return for_all_; }        ///< [Pa], where they are one
  /// Returns false where no pressure is bounded.
  bool bound() const { return each_ != nullptr || std::isfinite(for_all_); }

  double highest(Index n) const;  ///< of the first n [Pa]
  double lowest(Index n) const;   ///< of the first n [Pa]
  double sum(Index n) const;      ///< of the first n [Pa]
  /// Returns the mean of the first n [Pa].
  double mean(Index n) const { return are_one() ? for_all_ : sum(n) / static_cast<double>(n); }

 private:
  double for_all_;
  const double* each_ = nullptr;
};

}  // namespace tabor::contact
