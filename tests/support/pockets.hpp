#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::test {

inline constexpr double kPocketMap = 100e-6;  ///< [m], side of the square plateau
inline constexpr double kPocketDepth = 1e-6;  ///< [m], of the deepest point below it

/// One pocket in a plateau at height 0 with area and volume in closed form. `depth` [m] counts
/// downwards from the plateau.
struct Pocket {
  std::string name;
  std::function<double(double x, double y)> height;  ///< [m], x and y from the map's corner
  std::function<double(double depth)> area_below;    ///< [m^2] of the map that lies deeper
  std::function<double(double depth)> volume_below;  ///< [m^3] between it and a level there
};

inline Pocket spherical_pit() {
  constexpr double edge = 30e-6;
  constexpr double radius = (edge * edge / kPocketDepth + kPocketDepth) / 2;
  return {"spherical pit",
          [=](double x, double y) {
            const double r = std::hypot(x - 48e-6, y - 53e-6);
            const double sphere = radius - std::sqrt(std::max(radius * radius - r * r, 0.0));
            return r < edge ? sphere - kPocketDepth : 0.0;
          },
          [=](double depth) {
            const double liquid = kPocketDepth - depth;
            return std::numbers::pi * (2 * radius - liquid) * liquid;
          },
          [=](double depth) {
            const double liquid = kPocketDepth - depth;
            return std::numbers::pi * liquid * liquid * (radius - liquid / 3);
          }};
}

inline Pocket v_groove() {
  constexpr double edge = 23e-6;
  constexpr double slope = kPocketDepth / edge;
  return {
      "V groove",
      [=](double x, double) { return std::min(0.0, slope * std::abs(x - 47e-6) - kPocketDepth); },
      [=](double depth) { return 2 * kPocketMap * (kPocketDepth - depth) / slope; },
      [=](double depth) {
        const double liquid = kPocketDepth - depth;
        return kPocketMap * liquid * liquid / slope;
      }};
}

inline Pocket cylindrical_groove() {
  constexpr double edge = 27e-6;
  constexpr double radius = (edge * edge / kPocketDepth + kPocketDepth) / 2;
  const auto half_chord = [=](double depth) {
    const double liquid = kPocketDepth - depth;
    return std::sqrt((2 * radius - liquid) * liquid);
  };
  return {"cylindrical groove",
          [=](double x, double) {
            const double r = std::abs(x - 51e-6);
            const double circle = radius - std::sqrt(std::max(radius * radius - r * r, 0.0));
            return r < edge ? circle - kPocketDepth : 0.0;
          },
          [=](double depth) { return 2 * kPocketMap * half_chord(depth); },
          [=](double depth) {
            const double chord = half_chord(depth);
            const double above = radius - kPocketDepth + depth;  // centre of the circle over level
            return kPocketMap * (radius * radius * std::atan2(chord, above) - above * chord);
          }};
}

/// Half a wave of a sinus, from plateau to plateau.
inline Pocket sinusoidal_pocket() {
  constexpr double wavevector = 2 * std::numbers::pi / 90e-6;
  const auto shore = [=](double depth) { return std::acos(depth / kPocketDepth) / wavevector; };
  return {"sinusoidal pocket",
          [=](double x, double) {
            const double phase = wavevector * (x - 49e-6);
            return std::abs(phase) < std::numbers::pi / 2 ? -kPocketDepth * std::cos(phase) : 0.0;
          },
          [=](double depth) { return 2 * kPocketMap * shore(depth); },
          [=](double depth) {
            const double x = shore(depth);
            return 2 * kPocketMap *
                   (kPocketDepth * std::sin(wavevector * x) / wavevector - depth * x);
          }};
}

/// A V groove whose bottom sinks from the plateau at x = 0 to its depth at the wall x = side.
inline Pocket tilted_groove() {
  constexpr double tilt = kPocketDepth / kPocketMap;
  constexpr double slope = kPocketDepth / 37e-6;
  return {"tilted groove",
          [=](double x, double y) { return std::min(0.0, slope * std::abs(y - 52e-6) - tilt * x); },
          [=](double depth) {
            const double liquid = kPocketDepth - depth;
            return liquid * liquid / (slope * tilt);
          },
          [=](double depth) {
            const double liquid = kPocketDepth - depth;
            return liquid * liquid * liquid / (3 * slope * tilt);
          }};
}

inline std::vector<Pocket> all_pockets() {
  return {spherical_pit(), v_groove(), cylindrical_groove(), sinusoidal_pocket(), tilted_groove()};
}

inline Grid pocket_grid(Index n) { return {n, n, kPocketMap, kPocketMap}; }

/// Heights [m] of n x n pixels, each that of its centre.
inline Field heights_of(const Pocket& pocket, Index n) {
  const double pixel = kPocketMap / static_cast<double>(n);
  const auto centre = [&](Index i) { return (static_cast<double>(i) + 0.5) * pixel; };
  return Field::NullaryExpr(
      n, n, [&](Index row, Index column) { return pocket.height(centre(column), centre(row)); });
}

}  // namespace tabor::test
