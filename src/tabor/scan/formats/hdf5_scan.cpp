// What scans in HDF5 files share: the library does not survive every damaged file, tabor does.
#include "tabor/scan/formats/hdf5_scan.hpp"

namespace tabor::scan::format {

void require_survival(const Contents& contents, const std::function<void()>& describe) {
  if (!io::hdf5_survives(contents.file, describe)) {
    reject(contents, "an HDF5 file whose tables are damaged", "a scan", kDamaged);
  }
}

Field guarded_heights(const Contents& contents, std::array<Index, 2> shape,
                      const io::SendRows& send) {
  auto heights = io::guarded_hdf5_map(contents.file, shape, send,
                                      [&contents](double share) { contents.finished({}, share); });
  if (!heights) reject(contents, "heights in damaged HDF5 blocks", "a scan", kDamaged);
  return std::move(*heights);
}

}  // namespace tabor::scan::format
