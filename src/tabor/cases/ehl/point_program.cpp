#include "tabor/cases/ehl/point_case.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "tabor/cases/ehl/point_parameters.hpp"

namespace tabor::ehl {

namespace {

/// By how much the peak of `tabor ehl point` grows with the nodes: 1100 smooth, 1600 rough, and a
/// little.
constexpr double kBytesPerNode = 2000;

/// A number of a problem or a result, as a file names it.
template <typename Owner>
struct Named {
  const char* name;
  double Owner::*value;
};

/// What neighbours have in common beside nodes and roughness.
constexpr Named<PointProblem> kCommon[] = {{"inlet", &PointProblem::inlet},
                                           {"outlet", &PointProblem::outlet},
                                           {"half_width", &PointProblem::half_width},
                                           {"radius_x", &PointProblem::radius_x},
                                           {"radius_y", &PointProblem::radius_y},
                                           {"effective_modulus", &PointProblem::effective_modulus},
                                           {"plastic_pressure", &PointProblem::plastic_pressure}};

constexpr Named<PointResult> kNumbers[] = {{"separation", &PointResult::separation},
                                           {"entrainment_speed", &PointResult::entrainment_speed}};

/// A map of a result; the file leaves out empty ones.
struct NamedMap {
  const char* name;
  Field PointResult::*map;
};

constexpr NamedMap kMaps[] = {{"pressure", &PointResult::pressure},
                              {"contact_pressure", &PointResult::contact_pressure},
                              {"film", &PointResult::film},
                              {"plastic_depth", &PointResult::plastic_depth}};

/// A film that was found, and whose it is: of the problem, nodes, roughness and what is kCommon.
struct Previous {
  PointProblem problem;
  PointResult result;
};

const std::string kGroup = "/start";
const std::string kRoughness = kGroup + "/roughness";

bool are_equal(const Field& a, const Field& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a == b).all();
}

/// Cases that differ in speed or load alone.
bool are_neighbours(const PointProblem& a, const PointProblem& b) {
  return a.nodes_x == b.nodes_x && a.nodes_y == b.nodes_y && are_equal(a.roughness, b.roughness) &&
         std::all_of(std::begin(kCommon), std::end(kCommon),
                     [&](const auto& common) { return a.*common.value == b.*common.value; });
}

void write_previous(io::Hdf5Writer& writer, const Previous& previous) {
  const auto& [problem, result] = previous;
  for (const auto& common : kCommon) writer.attribute(kGroup, common.name, problem.*common.value);
  for (const auto& number : kNumbers) writer.attribute(kGroup, number.name, result.*number.value);
  writer.attribute(kGroup, "size_x", result.grid.lx);
  writer.attribute(kGroup, "size_y", result.grid.ly);
  for (const NamedMap& map : kMaps) {
    const Field& values = result.*map.map;
    if (values.size() > 0) writer.write(kGroup + "/" + map.name, values);
  }
  if (problem.roughness.size() > 0) writer.write(kRoughness, problem.roughness);
}

Previous read_previous(const io::Hdf5Reader& reader) {
  Previous previous;
  auto& [problem, result] = previous;
  for (const auto& common : kCommon) problem.*common.value = reader.number(kGroup, common.name);
  for (const auto& number : kNumbers) result.*number.value = reader.number(kGroup, number.name);
  for (const NamedMap& map : kMaps) {
    const std::string path = kGroup + "/" + map.name;
    if (reader.exists(path)) result.*map.map = reader.field(path);
  }
  if (reader.exists(kRoughness)) problem.roughness = reader.field(kRoughness);
  problem.nodes_x = result.pressure.cols();
  problem.nodes_y = result.pressure.rows();
  result.grid = {problem.nodes_x, problem.nodes_y, reader.number(kGroup, "size_x"),
                 reader.number(kGroup, "size_y")};
  result.convergence.status = Status::converged;
  return previous;
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  if (has_transient(config)) return result_of(transient_outcome(config, setting));
  const auto [problem, notes] = read_rough_point(config, setting);
  const PointResult film = solve_point(problem, nullptr, setting.observer);
  throw_if_stopped(film.convergence);
  PointOutcome outcome = outcome_of(config, problem, film, setting, notes);
  if (problem.roughness.size() > 0) add_dry_contact(setting.observer, outcome);
  return result_of(outcome);
}

double memory_of(const io::Config& config) {
  const PointProblem problem = read_point(config);
  return kBytesPerNode * static_cast<double>(problem.nodes_x * problem.nodes_y);
}

}  // namespace

CaseChain make_point_chain() {
  // Empty where the case before has no film to start from.
  const auto previous = std::make_shared<std::optional<Previous>>();
  CaseChain chain;
  chain.solve = [previous](const io::Config& config, const CaseSetting& setting) {
    if (has_transient(config)) return result_of(transient_outcome(config, setting));
    auto [problem, notes] = read_rough_point(config, setting);
    const bool has_start = previous->has_value() && are_neighbours((*previous)->problem, problem);
    PointResult film =
        solve_point(problem, has_start ? &(*previous)->result : nullptr, setting.observer);
    throw_if_stopped(film.convergence);
    CaseResult result = result_of(outcome_of(config, problem, film, setting, notes));
    previous->reset();
    if (film.convergence.converged()) *previous = Previous{std::move(problem), std::move(film)};
    return result;
  };
  chain.write_start = [previous](io::Hdf5Writer& writer) {
    writer.group(kGroup);
    writer.attribute(kGroup, "has_film", previous->has_value() ? 1 : 0);
    if (*previous) write_previous(writer, **previous);
  };
  chain.read_start = [previous](const io::Hdf5Reader& reader) {
    previous->reset();
    if (reader.integer(kGroup, "has_film") == 1) *previous = read_previous(reader);
  };
  return chain;
}

Program point_program() {
  return {.name = "point",
          .summary = "a film between a ball and a flat, smooth or rough, and the friction of both",
          .keys = heads_of(point_parameters()),
          .example = {{"ball.radius", "\"1.5 mm\""},
                      {"ball.load", "\"16.6 N\""},
                      {"motion.speed", "\"0.1 m/s\""},
                      {"solids.e_prime", "\"230.8 GPa\""},
                      {"lubricant.viscosity", "\"0.149 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"2.131e-8 1/Pa\""},
                      {"lubricant.eyring_stress", "\"6.8 MPa\""},
                      {"asperities.friction_coefficient", "0.12"},
                      {"grid.nodes_x", "97"},
                      {"grid.nodes_y", "85"}},
          .files = {"roughness.file"},
          .columns = heads_of(point_columns()),
          .studies = {{.name = "grid",
                       .key = "grid.nodes",
                       .number = "nodes_x",
                       .unit = "",
                       .factors = {1 / 2.25, 1 / 1.5, 1},
                       .end_nodes = 1,
                       .cells_by = 4},
                      {.name = "domain",
                       .key = "grid.domain",
                       .number = "domain",
                       .unit = "",
                       .factors = {1, 1.5, 2},
                       .has_limit = false,
                       .is_count = false}},
          .methods = {"nijenbanning1994", "hamrock1977", "redlich2003"},
          .solve = solve,
          .check = [](const io::Config& config) { read_point(config); },
          .make_chain = make_point_chain,
          .downwards = {"motion.speed", "motion.entrainment_speed"},
          .chain_ends = {"roughness.", "grid.", "solids.", "ball.radius"},
          .memory = memory_of};
}

}  // namespace tabor::ehl
