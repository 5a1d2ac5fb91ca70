#pragma once

// Gives Hertz's closed form of an elliptic contact.
namespace tabor::reference {

/// Paraboloid of principal radii Rx and Ry, its axes along x and y, pressed on an elastic
/// half-space: contact in an ellipse. Hertz 1882; Johnson 1985, section 4.2(c), eqs. 4.26 and 4.28.
struct HertzEllipse {
  double radius_x = 0;           ///< Rx [m]
  double radius_y = 0;           ///< Ry [m]
  double effective_modulus = 0;  ///< E* [Pa]
  double load = 0;               ///< F [N]
  double half_axis_x = 0;        ///< a [m], along x
  double half_axis_y = 0;        ///< b [m], along y
  double approach = 0;           ///< delta [m], of distant points
  double max_pressure = 0;       ///< p0 [Pa], 3 F / (2 pi a b)
};

/// Returns the contact at a load. Precondition: radii and modulus > 0, load >= 0.
HertzEllipse hertz_ellipse_at_load(double radius_x, double radius_y, double effective_modulus,
                                   double load);

/// Returns p(x, y) [Pa] = p0 sqrt(1 - x^2/a^2 - y^2/b^2), 0 outside.
double hertz_pressure(const HertzEllipse& contact, double x, double y);

}  // namespace tabor::reference
