#pragma once

// Computes complete elliptic integrals without cancellation.
namespace tabor::reference {

/// Complete elliptic integrals K and E of modulus k, and their differences, which stay exact where
/// k is small.
struct EllipticIntegrals {
  double first;   ///< K
  double second;  ///< E
  double wide;    ///< (K - E) / k^2, pi/4 at k = 0
  double narrow;  ///< (E - (1 - k^2) K) / k^2, pi/4 at k = 0
};

/// Computes them by the arithmetic-geometric mean (Abramowitz & Stegun 17.6), to some ulp, without
/// the cancellation of K - E near k = 0 and the four digits that libstdc++ loses near k = 1.
/// `complement` is sqrt(1 - k^2) > 0, which cannot be computed from k where it is close to 1.
EllipticIntegrals elliptic_integrals(double modulus, double complement);

}  // namespace tabor::reference
