#pragma once

#include <memory>

#include "tabor/elastic/operator.hpp"

// Makes the elastic operators of maps: half-space under a pressure that repeats or that mirror
// images continue, and half-space loaded on the map only.
namespace tabor::elastic {

/// Makes a half-space under a pressure that repeats with the grid: S(q) = 2 / (E* |q|), the mean
/// mode dropped (Johnson 1985, eq. 13.7; Stanley & Kato 1997, doi:10.1115/1.2833523).
/// effective_modulus E* [Pa] > 0, else InputError.
std::unique_ptr<ElasticOperator> make_periodic(const Grid& grid, double effective_modulus);

/// Makes the same for one of 2 x 2 mirror images, of which the cell that repeats consists: for maps
/// that are even about all of their borders, in a quarter of the time and memory. `grid` is that of
/// one image.
std::unique_ptr<ElasticOperator> make_mirrored(const Grid& grid, double effective_modulus);

/// Makes a half-space loaded on this grid only: uniform pressure on each pixel's rectangle (Love
/// 1929, doi:10.1098/rsta.1929.0009), summed by zero-padded convolution. The displacement is
/// measured from infinity.
std::unique_ptr<ElasticOperator> make_free(const Grid& grid, double effective_modulus);

/// Returns Love's coefficient [m/Pa]: displacement at (x, y) [m] of a unit pressure on the
/// rectangle dx * dy [m] around the origin.
double love_coefficient(double x, double y, double dx, double dy, double effective_modulus);

}  // namespace tabor::elastic
