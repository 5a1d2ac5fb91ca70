#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {

/// The order matters only where identify() answers maybe: a ZIP archive is asked whether it is X3P
/// or PLUX, an HDF5 file whether it is tabor's or Zygo's, before it goes to the converter, which
/// takes whatever is left.
const std::vector<Format>& table() {
  static const std::vector<Format> formats{
      {"h5", "tabor's HDF5 (docs/results.md)", {".h5", ".hdf5"}, identify_h5, open_h5, write_h5},
      {"x3p", "ISO 25178-72 / ISO 5436-2 XML", {".x3p"}, identify_x3p, open_x3p, write_x3p},
      {"datx", "Zygo Mx", {".datx"}, identify_datx, open_datx},
      {"plux", "Sensofar, newer", {".plux"}, identify_plux, open_plux},
      {"gwy", "Gwyddion native", {".gwy"}, identify_gwy, open_gwy, write_gwy},
      {"gsf", "Gwyddion Simple Field (float32)", {".gsf"}, identify_gsf, open_gsf, write_gsf},
      {"sdf", "ISO 25178-71, binary", {".sdf"}, identify_sdf, open_sdf, write_sdf},
      {"sdf-ascii",
       "ISO 25178-71, text",
       {".asdf"},
       identify_sdf_ascii,
       open_sdf_ascii,
       write_sdf_ascii},
      {"npy", "NumPy array; needs --pixel and --unit", {".npy"}, identify_npy, open_npy, write_npy},
      {"sur", "Digital Surf", {".sur"}, identify_sur, open_sur},
      {"al3d", "Alicona Imaging", {".al3d"}, identify_al3d, open_al3d},
      {"opd", "Wyko / Veeco", {".opd"}, identify_opd, open_opd},
      {"metropro", "Zygo MetroPro", {".dat"}, identify_metropro, open_metropro},
      {"vk", "Keyence VK", {".vk3", ".vk4", ".vk6", ".vk7"}, identify_vk, open_vk},
      {"bcr", "Image Metrology SPIP", {".bcr", ".bcrf"}, identify_bcr, open_bcr},
      {"tmd", "TrueMap", {".tmd"}, identify_tmd, open_tmd},
      {"png", "grey image; needs --pixel and --z-scale", {".png"}, identify_png, open_png},
      {"tiff",
       "grey image; needs --pixel and --z-scale",
       {".tif", ".tiff"},
       identify_tiff,
       open_tiff},
      {"pgm", "grey image; needs --pixel and --z-scale", {".pgm", ".pnm"}, identify_pnm, open_pnm},
      {"matrix",
       "text, one row of heights per line",
       {".txt", ".asc", ".csv"},
       identify_text,
       open_text,
       write_matrix},
      {"xyz", "text, x y z of a regular grid", {".xyz"}, identify_text, open_text, write_xyz},
      {"nms", "NanoFocus usurf", {".nms"}, identify_nms, open_nms},
      {"plu", "Sensofar", {".plu"}, identify_plu, open_plu},
      {"vti", "VTK ImageData for ParaView", {".vti"}, nullptr, nullptr, write_vti},
      {"gwyddion",
       "about 150 others, if Gwyddion is installed",
       {".lext", ".oir", ".poir", ".frt", ".opdx", ".ibw", ".nid", ".di", ".spm", ".jpk", ".mi",
        ".stp", ".top", ".mdt"},
       identify_gwyddion,
       open_gwyddion,
       nullptr,
       true},
  };
  return formats;
}

}  // namespace tabor::scan::format
