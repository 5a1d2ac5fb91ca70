#include "tabor/reference/elliptic_integrals.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace tabor::reference {

EllipticIntegrals elliptic_integrals(double modulus, double complement) {
  assert(modulus >= 0 && modulus <= 1 && complement > 0);
  double a = 1;
  double g = complement;
  double c = modulus;
  double weight = 0.5;              // 2^(n - 1)
  double tail = 0;                  // sum of 2^(n - 1) c_n^2 from n = 1 on
  while (std::abs(c) > 1e-9 * a) {  // converges quadratically: c^2 is below rounding
    c = 0.5 * (a - g);
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
    weight *= 2;
    tail += weight * c * c;
  }
  const double first = 0.5 * std::numbers::pi / a;
  const double square = modulus * modulus;
  const double share = square > 0 ? tail / square : 0;
  return {.first = first,
          .second = first * (1 - 0.5 * square - tail),
          .wide = first * (0.5 + share),
          .narrow = first * (0.5 - share)};
}

}  // namespace tabor::reference
