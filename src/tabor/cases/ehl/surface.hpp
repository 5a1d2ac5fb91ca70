#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/core/warning.hpp"

// Rough surfaces that a case asks for. This module knows neither scan files nor generators: whoever
// solves a case hands in what makes them (cases/ehl_surfaces.hpp).
namespace tabor::ehl {

/// A scan file that a case names.
struct NamedScan {
  std::filesystem::path file;
  std::optional<std::string> channel =
      {};  ///< its height channel; the default one if there is none
  std::vector<std::string> treatment = {};  ///< steps as in a study, "level=plane"
  /// Where the case names it, to begin a complaint about holes with; "" where holes may be.
  std::string rejects_holes_at = {};
};

/// A finish that no instrument has seen.
struct GeneratedSurface {
  Grid grid;
  double rms_height = 0;           ///< [m], exact
  double hurst = 0.8;              ///< of its self-affine spectrum
  double roll_off_wavelength = 0;  ///< [m]; of grooves across them
  double groove_length = 0;        ///< [m], along x; 0: no grooves, Gaussian heights of all waves
  std::uint64_t seed = 1;          ///< of its random numbers
};

/// Heights that were read or generated.
struct Surface {
  Grid grid;
  Field height;             ///< [m], asperities up, shape (ny, nx)
  std::string sha256 = {};  ///< of the bytes of the file
  Warnings warnings = {};   ///< about the scan
};

/// What makes surfaces. Both throw InputError, naming the file or the invalid number.
struct SurfaceSource {
  std::function<Surface(const NamedScan&, const Observer&)> read;
  std::function<Surface(const GeneratedSurface&)> generate;
};

}  // namespace tabor::ehl
