#pragma once

#include <string>

#include "tabor/cases/ehl/line_record.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/toml.hpp"

/// The worn track of `tabor ehl line`.
namespace tabor::ehl {

/// With the worn mass where [wear] has `density` and `width`.
WearRecord wear_record(const io::Config& config, const WearResult& wear);

/// The group /wear: histories and the track at the end.
void write_wear(io::Hdf5Writer& writer, const WearResult& wear);

}  // namespace tabor::ehl
