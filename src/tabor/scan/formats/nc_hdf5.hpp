#pragma once

#include <optional>
#include <string>

#include "tabor/scan/formats/format.hpp"

// What NetCDF files say about a surface, in both of their encodings.
namespace tabor::scan::format {

/// Description of the positions along one side.
struct NetcdfAxis {
  std::string unit = {};
  std::optional<double> length = {};  ///< of the whole side, in `unit`
  bool is_periodic = false;
};

/// Description of a surface but for its heights.
struct NetcdfSurface {
  NetcdfAxis x = {};
  std::optional<NetcdfAxis> y = {};  ///< nullopt for a line, whose pixels are taken as square
  std::string unit = {};             ///< of the heights
  std::string json = {};             ///< further remarks
};

/// Fills in unit, pixel and name of a layer whose size and heights are known, and the remarks of
/// its document.
void complete(const NetcdfSurface& surface, Layer& layer, Document& document);

/// Opens a NetCDF file that is based on HDF5 ("NetCDF-4"). Throws Unrecognised if it has no
/// dataset `heights`.
Document open_nc_hdf5(const Contents& contents);

}  // namespace tabor::scan::format
