#pragma once

#include <string>

#include "tabor/cli/ehl_keys.hpp"
#include "tabor/ehl/line/wear.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"
#include "tabor/io/toml.hpp"

/// The worn track of `tabor ehl line`.
namespace tabor::cli {

/// [wear]
EhlKeys wear_keys();

/// [wear]: a track that runs under the cylinder, round and round or to and fro. Throws InputError
/// beside a roughness that stands still.
ehl::WearProblem read_wear(const io::Config& config, const ehl::LineProblem& contact);

/// With the worn mass where [wear] has `density` and `width`.
io::Json wear_json(const io::Config& config, const ehl::WearResult& wear);
std::string wear_text(const ehl::WearResult& wear);
/// The group /wear: histories and the track at the end.
void write_wear(io::Hdf5Writer& writer, const ehl::WearResult& wear);

}  // namespace tabor::cli
