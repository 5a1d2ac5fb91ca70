#include "tabor/core/error.hpp"
#include "tabor/io/hdf5.hpp"

namespace tabor::io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw InputError(file.string() + ": damaged HDF5 file");
}

}  // namespace

void require_hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action) {
  if (!hdf5_survives(file, action)) refuse(file);
}

Field read_guarded_map(const std::filesystem::path& file, const std::string& path) {
  const std::array<Index, 2> shape =
      read_guarded(file, [&](const Hdf5Reader& reader) { return reader.map_shape(path); });
  const SendRows send_rows = [&](const std::function<void(const Field&)>& accept) {
    Hdf5Reader(file).for_rows(path, [&](Index, const Field& rows) { accept(rows); });
  };
  std::optional<Field> map = hdf5_map_from_copy(file, shape, send_rows, {});
  if (!map) refuse(file);
  return std::move(*map);
}

}  // namespace tabor::io
