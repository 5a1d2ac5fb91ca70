#include "tabor/cli/ehl.hpp"
#include "tabor/cli/ehl_point_answer.hpp"
#include "tabor/cli/ehl_point_case.hpp"
#include "tabor/cli/ehl_point_passage.hpp"
#include "tabor/cli/ehl_point_series.hpp"

namespace tabor::cli {

namespace {

EhlAnswer solve(const io::Config& config, Context& context) {
  if (has_passage(config)) return passage_answer(config, context);
  const ehl::PointProblem problem = read_rough_point(config, context);
  const ehl::PointResult result = solve_point(problem, nullptr, context.observer());
  throw_if_stopped(result.convergence);
  EhlAnswer answer = point_answer(config, problem, result, context);
  if (problem.roughness.size() > 0) add_dry_contact(problem, context.observer(), answer);
  return answer;
}

}  // namespace

EhlProgram point_program() {
  return {.name = "point",
          .summary = "a film between a ball and a flat, smooth or rough, and the friction of both",
          .keys = point_keys(),
          .files = {"roughness.file"},
          .columns = {{"central_film_m", "central film", "m"},
                      {"min_film_m", "smallest film", "m"},
                      {"Hc", "Hc", ""},
                      {"Hm", "Hm", ""},
                      {"max_pressure_Pa", "largest pressure", "Pa"},
                      {"solid_contact_fraction", "solid contact", ""},
                      {"plastic_fraction", "plastic", ""},
                      {"friction_fluid", "fluid friction", ""},
                      {"friction_solid", "solid friction", ""},
                      {"friction_coefficient", "friction", ""},
                      {"newton_iterations", "iterations", "", false, false}},
          .studies = {{.name = "grid",
                       .key = "grid.nodes",
                       .scalar = "nodes_x",
                       .unit = "",
                       .factors = {1 / 2.25, 1 / 1.5, 1},
                       .end_nodes = 1,
                       .cells_by = 4},
                      {.name = "domain",
                       .key = "grid.domain",
                       .scalar = "domain",
                       .unit = "",
                       .factors = {1, 1.5, 2},
                       .has_limit = false,
                       .is_count = false}},
          .methods = {"nijenbanning1994", "hamrock1977", "redlich2003"},
          .solve = solve,
          .make_chain = make_point_chain,
          .downwards = {"motion.speed", "motion.entrainment_speed"}};
}

}  // namespace tabor::cli
