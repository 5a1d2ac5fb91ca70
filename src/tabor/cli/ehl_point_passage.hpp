#pragma once

#include "tabor/cli/ehl.hpp"

/// Cases of `tabor ehl point` whose rough surface moves: motion.duration says for how long.
namespace tabor::cli {

bool has_passage(const io::Config& config);

/// The film at the last instant, and what happened on the way. Throws InputError, naming the key,
/// for a case that cannot move.
EhlAnswer passage_answer(const io::Config& config, Context& context);

}  // namespace tabor::cli
