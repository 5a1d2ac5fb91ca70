#include "tabor/topography/formats/readers.hpp"

namespace tabor::topography::format {

/// The order matters only where identify() answers maybe: a ZIP archive is asked whether it is X3P
/// before it goes to the converter, which takes whatever is left.
const std::vector<Format>& table() {
  static const std::vector<Format> formats{
      {"h5", "tabor's HDF5 (docs/results.md)", {".h5", ".hdf5"}, identify_h5, open_h5, write_h5},
      {"x3p", "ISO 25178-72 / ISO 5436-2 XML", {".x3p"}, identify_x3p, open_x3p, write_x3p},
      {"npy", "NumPy array; needs --pixel, --unit", {".npy"}, identify_npy, open_npy, write_npy},
      {"matrix",
       "text, one row of heights per line",
       {".txt", ".asc", ".csv"},
       identify_text,
       open_text,
       write_matrix},
      {"xyz", "text, x y z of a regular grid", {".xyz"}, identify_text, open_text, write_xyz},
  };
  return formats;
}

}  // namespace tabor::topography::format
