#include "tabor/cases/ehl/program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"

namespace tabor::ehl {

namespace {

std::vector<std::string> names_of(const std::vector<ParameterHead>& keys) {
  std::vector<std::string> names(keys.size());
  std::transform(keys.begin(), keys.end(), names.begin(),
                 [](const ParameterHead& key) { return key.file_key(); });
  return names;
}

/// Keys of a case that a program does not know.
std::vector<std::string> unknown_keys(const Program& program, const io::Config& config) {
  const std::vector<std::string> known = names_of(program.keys);
  std::vector<std::string> unknown = config.keys();
  std::erase_if(unknown, [&](const std::string& key) {
    return std::find(known.begin(), known.end(), key) != known.end();
  });
  return unknown;
}

/// The program that knows most of the keys, if it is another one and knows at least twice as well.
const Program* other_program(const Program& program, const io::Config& config) {
  const auto n_unknown = [&](const Program& of) { return unknown_keys(of, config).size(); };
  const auto best = std::min_element(
      programs().begin(), programs().end(),
      [&](const Program& a, const Program& b) { return n_unknown(a) < n_unknown(b); });
  return 2 * n_unknown(*best) <= n_unknown(program) ? &*best : nullptr;
}

}  // namespace

Cell CaseResult::cell(std::string_view key) const {
  const auto found = std::find_if(numbers.begin(), numbers.end(),
                                  [&](const NamedCell& one) { return one.head.key == key; });
  return found == numbers.end() ? Cell() : found->cell;
}

CaseStatus status_of(const Convergence& convergence) {
  return convergence.converged() ? CaseStatus::converged : CaseStatus::not_converged;
}

const std::vector<Program>& programs() {
  static const std::vector<Program> all = {impact_program(), squeeze_program(), line_program(),
                                           point_program()};
  return all;
}

void reject_unknown_keys(const Program& program, const io::Config& config) {
  const std::vector<std::string> unknown = unknown_keys(program, config);
  if (unknown.empty()) return;
  if (const Program* other = other_program(program, config)) {
    throw InputError(config.name(),
                     fmt::format("a case of 'tabor ehl {}' ({})", other->name, unknown.front()),
                     fmt::format("one of 'tabor ehl {}'", program.name),
                     fmt::format("run tabor ehl {} {}", other->name, config.name()));
  }
  config.reject_unknown(names_of(program.keys));
}

void check_case(const Program& program, const io::Config& config) {
  reject_unknown_keys(program, config);
  program.check(config);
}

void check_memory_of_case(const Program& program, const io::Config& config) {
  if (!program.memory) return;
  check_memory(config.place("grid.nodes"), "so many nodes", program.memory(config),
               "take fewer nodes");
}

CaseResult solve_case(const Program& program, const io::Config& config,
                      const CaseSetting& setting) {
  reject_unknown_keys(program, config);
  check_memory_of_case(program, config);
  return program.solve(config, setting);
}

}  // namespace tabor::ehl
