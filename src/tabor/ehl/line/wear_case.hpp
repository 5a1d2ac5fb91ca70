#pragma once

#include <string>

#include "tabor/ehl/line/wear.hpp"
#include "tabor/ehl/program.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"
#include "tabor/io/toml.hpp"

/// The worn track of `tabor ehl line`.
namespace tabor::ehl {

/// [wear]
CaseKeys wear_keys();

/// [wear]: a track that runs under the cylinder, round and round or to and fro. Throws InputError
/// beside a roughness that stands still.
WearProblem read_wear(const io::Config& config, const LineProblem& contact);

/// With the worn mass where [wear] has `density` and `width`.
io::Json wear_json(const io::Config& config, const WearResult& wear);
Facts wear_facts(const WearResult& wear);

/// The group /wear: histories and the track at the end.
void write_wear(io::Hdf5Writer& writer, const WearResult& wear);

}  // namespace tabor::ehl
