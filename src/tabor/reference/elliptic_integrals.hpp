#pragma once

namespace tabor::reference {

/// Complete elliptic integrals K and E of modulus k, and what is left of K - E where k is small.
struct EllipticIntegrals {
  double first;   ///< K
  double second;  ///< E
  double wide;    ///< (K - E) / k^2, pi/4 at k = 0
  double narrow;  ///< (E - (1 - k^2) K) / k^2, pi/4 at k = 0
};

/// By the arithmetic-geometric mean (Abramowitz & Stegun 17.6), to some ulp, without the
/// cancellation of K - E near k = 0 and the four digits that libstdc++ loses near k = 1.
/// `complement` is sqrt(1 - k^2) > 0, which k itself does not say where it is close to 1.
EllipticIntegrals elliptic_integrals(double modulus, double complement);

}  // namespace tabor::reference
