#include "tabor/cli/ehl_point_series.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "tabor/cli/ehl_point_answer.hpp"
#include "tabor/cli/ehl_point_case.hpp"
#include "tabor/cli/ehl_point_passage.hpp"

namespace tabor::cli {

namespace {

using ehl::PointProblem;
using ehl::PointResult;

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

}  // namespace

EhlChain make_point_chain() {
  // Empty where the case before has no film to start from.
  const auto previous = std::make_shared<std::optional<Previous>>();
  EhlChain chain;
  chain.solve = [previous](const io::Config& config, Context& context) {
    if (has_passage(config)) return passage_answer(config, context);
    PointProblem problem = read_rough_point(config, context);
    const bool has_start = previous->has_value() && are_neighbours((*previous)->problem, problem);
    PointResult result =
        solve_point(problem, has_start ? &(*previous)->result : nullptr, context.observer());
    throw_if_stopped(result.convergence);
    EhlAnswer answer = point_answer(config, problem, result, context);
    previous->reset();
    if (result.convergence.converged()) *previous = Previous{std::move(problem), std::move(result)};
    return answer;
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

}  // namespace tabor::cli
