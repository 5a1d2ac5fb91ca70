// Takes the place of io/hdf5_guard.cpp in the fuzzer: a child process would hide the sanitizers'
// findings in our own code, and what HDF5 itself does with broken files shall be counted.
#include "tabor/io/hdf5.hpp"

namespace tabor::io {

bool hdf5_survives(const std::filesystem::path&, const std::function<void()>&) { return true; }

std::optional<Field> hdf5_map_from_copy(const std::filesystem::path&, std::array<Index, 2> shape,
                                        const SendRows& send_rows,
                                        const std::function<void(double)>&) {
  return hdf5_map_directly(shape, send_rows);
}

}  // namespace tabor::io
