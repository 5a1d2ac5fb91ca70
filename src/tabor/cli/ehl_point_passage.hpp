#pragma once

#include "tabor/cli/ehl.hpp"
#include "tabor/ehl/point_transient.hpp"

/// Cases of `tabor ehl point` whose rough surface moves: motion.duration says for how long.
namespace tabor::cli {

/// The film under a rough surface that moves with its body, at u_m - u_s/2.
struct PointPassage {
  ehl::PointProblem at_end;  ///< with the roughness where it was last
  double speed = 0;          ///< of the roughness [m/s]
  ehl::TransientPointResult film;
};

bool has_passage(const io::Config& config);

/// Throws InputError, naming the key, for a case that cannot move.
PointPassage solve_passage(const io::Config& config, Context& context);

/// What happened on the way: scalars under "history", lines of text, curves in /history.
void add_history(const PointPassage& passage, EhlAnswer& answer);

}  // namespace tabor::cli
