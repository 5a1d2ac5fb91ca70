#pragma once

// Computes the effective modulus E* of elastic solids in contact.
namespace tabor::material {

/// An isotropic linear elastic half-space.
struct Solid {
  double youngs_modulus = 0;  ///< E [Pa], > 0; infinity is a rigid body
  double poissons_ratio = 0;  ///< nu, -1 < nu <= 0.5
};

/// Returns E* [Pa] of a solid under a rigid counter body: E / (1 - nu^2) (Johnson 1985, section
/// 4.2). Throws InputError for a modulus or ratio out of range, or a rigid solid.
double effective_modulus(const Solid& solid);

/// Returns E* [Pa] of two solids in contact: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. A rigid
/// counter body (E2 = infinity) gives the one-solid value. Throws InputError as above, or if both
/// are rigid.
double effective_modulus(const Solid& solid, const Solid& counter);

}  // namespace tabor::material
