#pragma once

#include <string>
#include <vector>

// Lists the generated finishes that a case can name.
namespace tabor::ehl {

/// A finish that is generated: Gaussian heights with a self-affine spectrum that is flat beyond the
/// roll-off.
struct Finish {
  std::string name;
  double rms_height;           ///< [m]
  double roll_off_wavelength;  ///< [m]
  double hurst = 0.8;          ///< exponent of the spectrum
};

/// "lapped-like" and "polished-like". Their heights are those that Redlich, Bartel & Deters (2003,
/// doi:10.1016/S0167-8922(03)80083-8) print for their surfaces; with the roll-off the dry contact
/// of their ball touches and flows on about the shares they print, 45 and 37 % lapped, 80 and 6 %
/// polished (docs/ehl_point.md).
const std::vector<Finish>& finishes();

}  // namespace tabor::ehl
