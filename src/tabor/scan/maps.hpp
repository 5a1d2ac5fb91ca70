#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

// Writes maps of any quantity for other programs.
namespace tabor::scan {

/// Map of a set.
struct NamedMap {
  std::string name;             ///< "pressure"
  std::string unit;             ///< "Pa"; "1" for a plain number
  std::function<Field()> load;  ///< the values, NaN = hole; called when their turn comes
  io::Precision precision = io::Precision::float64;  ///< that the values have
};

/// Maps of one grid. Those of a large result are not in memory at once where the format allows it.
struct MapSet {
  Grid grid;
  std::vector<NamedMap> maps;
  std::map<std::string, std::string> metadata = {};  ///< GWY alone keeps it
  /// Origin of the grid [m], which .vti, .gwy, .csv and .xyz store.
  double left = 0, top = 0;
};

/// Returns the extensions of the files that write() makes: ".vti", ...
std::vector<std::string> map_extensions();

/// Writes by the file name's extension, to a temporary name that is then renamed: .vti, .gwy and
/// .csv hold any number of maps, .xyz, .npy and .txt one. Throws OutputError; InputError for
/// another extension and for several maps in a file of one.
void write(const MapSet& maps, const std::filesystem::path& file);

}  // namespace tabor::scan
