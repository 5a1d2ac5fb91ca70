#include "tabor/cli/ehl_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/cli/ehl.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

std::vector<std::string> names_of(const EhlKeys& keys) {
  std::vector<std::string> names(keys.size());
  std::transform(keys.begin(), keys.end(), names.begin(),
                 [](const EhlKey& key) { return key.name; });
  return names;
}

/// Keys of a case that a program does not know.
std::vector<std::string> unknown_keys(const EhlProgram& program, const io::Config& config) {
  const std::vector<std::string> known = names_of(program.keys);
  std::vector<std::string> unknown = config.keys();
  std::erase_if(unknown, [&](const std::string& key) {
    return std::find(known.begin(), known.end(), key) != known.end();
  });
  return unknown;
}

/// The program that knows most of the keys, if it is another one and knows at least twice as well.
const EhlProgram* other_program(const EhlProgram& program, const io::Config& config) {
  const auto n_unknown = [&](const EhlProgram& of) { return unknown_keys(of, config).size(); };
  const auto best = std::min_element(
      ehl_programs().begin(), ehl_programs().end(),
      [&](const EhlProgram& a, const EhlProgram& b) { return n_unknown(a) < n_unknown(b); });
  return 2 * n_unknown(*best) <= n_unknown(program) ? &*best : nullptr;
}

}  // namespace

const std::vector<EhlProgram>& ehl_programs() {
  static const std::vector<EhlProgram> all = {impact_program(), squeeze_program(), line_program(),
                                              point_program()};
  return all;
}

void reject_unknown_keys(const EhlProgram& program, const io::Config& config) {
  const std::vector<std::string> unknown = unknown_keys(program, config);
  if (unknown.empty()) return;
  if (const EhlProgram* other = other_program(program, config)) {
    throw InputError(config.name(),
                     fmt::format("a case of 'tabor ehl {}' ({})", other->name, unknown.front()),
                     fmt::format("one of 'tabor ehl {}'", program.name),
                     fmt::format("run tabor ehl {} {}", other->name, config.name()));
  }
  config.reject_unknown(names_of(program.keys));
}

std::vector<HelpTable> ehl_key_tables() {
  std::vector<HelpTable> tables;
  for (const EhlProgram& program : ehl_programs()) {
    HelpTable table{.word = program.name,
                    .title = fmt::format("Keys of a case of 'tabor ehl {}'", program.name),
                    .headings = {"key", "unit", "default", "meaning"},
                    .rows = {}};
    for (const EhlKey& key : program.keys) {
      table.rows.push_back({key.name, key.unit, key.usual, key.meaning});
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

EhlKeys joined(EhlKeys keys, const std::vector<EhlKeys>& more) {
  for (const EhlKeys& list : more) keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

}  // namespace tabor::cli
