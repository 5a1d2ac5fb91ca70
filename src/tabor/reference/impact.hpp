#pragma once

// Gives the closed form of a dry elastic impact of a ball on a flat.
namespace tabor::reference {

/// Impact of a ball that strikes a flat without lubricant and leaves at the same speed: Hertz' law
/// as a spring, no waves, no losses (Johnson 1985, section 11.4). Valid while the contact lasts
/// much longer than waves take across the ball: speed << speed of sound.
struct DryImpact {
  double sphere_radius = 0;      ///< R [m]
  double effective_modulus = 0;  ///< E* [Pa]
  double mass = 0;               ///< m [kg]
  double speed = 0;              ///< v [m/s], of the approach

  double max_approach = 0;  ///< [m] (15 m v^2 / (16 sqrt(R) E*))^(2/5)
  double max_force = 0;     ///< [N] (4/3) E* sqrt(R) max_approach^(3/2)
  double max_radius = 0;    ///< [m] of the contact
  double max_pressure = 0;  ///< [Pa] in the centre at the turning point
  double contact_time = 0;  ///< [s] 2.9433 max_approach / v

  /// Returns delta(t) ~ max_approach sin(pi t / contact_time) [m], 0 outside the contact: within
  /// 2.2 % of max_approach of the exact motion.
  double approach_at(double time) const;
  double force_at(double time) const;  ///< [N], of that approach
};

/// Returns the impact. Precondition: all arguments > 0.
DryImpact hertz_impact(double sphere_radius, double effective_modulus, double mass, double speed);

}  // namespace tabor::reference
