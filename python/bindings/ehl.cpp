#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>

#include "tabor/analysis/ehl_file.hpp"
#include "tabor/analysis/ehl_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using ehl::Program;

const Program& program_of(const std::string& name) {
  for (const Program& program : ehl::programs()) {
    if (program.name == name) return program;
  }
  throw InputError("program", "'" + name + "'", "impact, squeeze, line or point", "");
}

/// A case and the program that it is of.
struct FilmCase {
  const Program& program;
  io::Config config;
};

using Settings = std::vector<std::pair<std::string, std::string>>;

FilmCase case_of(const std::string& program, io::Config config, const Settings& settings) {
  for (const auto& [key, value] : settings) config = config.with(key, value);
  FilmCase one{program_of(program), std::move(config)};
  ehl::reject_unknown_keys(one.program, one.config);
  return one;
}

struct Solved {
  FilmCase of;
  ehl::CaseResult result;
};

Solved solve(const FilmCase& one, std::uint64_t seed, const nb::object& progress) {
  return watched(progress, [&](const Observer& observer) {
    return Solved{one,
                  ehl::solve_case(
                      one.program, one.config,
                      {.observer = observer, .seed = seed, .surfaces = analysis::ehl_surfaces()})};
  });
}

void save(const Solved& solved, const std::filesystem::path& file) {
  std::vector<analysis::Finding> warnings(solved.result.warnings.size());
  for (std::size_t i = 0; i < warnings.size(); ++i) warnings[i].text = solved.result.warnings[i];
  analysis::write_case(file, "tabor.save", solved.of.program, solved.of.config, solved.result,
                       warnings);
}

/// (key, unit, usual value, meaning)
using KeyRow = std::tuple<std::string, std::string, std::string, std::string>;
std::vector<KeyRow> keys_of(const std::string& program) {
  std::vector<KeyRow> rows;
  for (const ehl::CaseKey& key : program_of(program).keys) {
    rows.emplace_back(key.name, key.unit, key.usual, key.meaning);
  }
  return rows;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Solved& solved) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const ehl::Facts& group : solved.result.facts) {
    for (const ehl::Fact& fact : group) all.emplace_back(fact.label, fact.value);
  }
  return all;
}

}  // namespace

void bind_ehl(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<FilmCase>(module, "FilmCase").def_prop_ro("toml", [](const FilmCase& self) {
    return self.config.to_text();
  });
  nb::class_<Solved>(module, "SolvedCase")
      .def_prop_ro("json", [](const Solved& self) { return io::to_text(self.result.scalars); })
      .def_prop_ro("facts", &facts_of)
      .def_prop_ro("converged", [](const Solved& self) { return self.result.converged; })
      .def_prop_ro("warnings", [](const Solved& self) { return self.result.warnings; })
      .def_prop_ro("references", [](const Solved& self) { return self.of.program.methods; })
      .def("save", &save, "file"_a);
  module.def(
      "read_case",
      [](const std::string& program, const std::filesystem::path& file, const Settings& settings) {
        return case_of(program, io::Config::read(file), settings);
      },
      "program"_a, "file"_a, "settings"_a);
  module.def(
      "parse_case",
      [](const std::string& program, const std::string& text, const std::string& name,
         const Settings& settings) {
        return case_of(program, io::Config::parse(text, name), settings);
      },
      "program"_a, "text"_a, "name"_a, "settings"_a);
  module.def("case_template",
             [](const std::string& program) { return ehl::case_template(program_of(program)); });
  module.def("case_keys", &keys_of);
  module.def("solve_case", &solve, "case"_a, "seed"_a, "progress"_a.none());
}

}  // namespace tabor::python
