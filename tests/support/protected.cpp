// Linked into programs of tests that give broken files to the readers: they are protected as the
// command line program is.
#include "tabor/io/files/protection.hpp"

namespace {

struct Protection {
  Protection() {
    tabor::io::isolate_hdf5_reading(true);
    tabor::io::trap_lost_pages(true);
  }
};

const Protection protection;

}  // namespace
