#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <exception>
#include <memory>
#include <mutex>
#include <optional>

#include "tabor/cases/ehl_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/results/ehl_file.hpp"
#include "tabor/study/ehl_sweep.hpp"
#include "tabor/study/ehl_tables.hpp"
#include "values.hpp"
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
  ehl::check_case(one.program, one.config);
  return one;
}

/// The observer that a result keeps, for it may compute more when it is written. It outlives the
/// call that solved it, so it asks whoever watches at the time.
class Relay {
 public:
  Observer observer() const {
    return [watching = watching_](const Progress& progress) {
      return !watching->observer || watching->observer(progress);
    };
  }
  /// What `work` returns, watched by this observer; one call at a time.
  template <typename Work>
  auto watch(const Observer& observer, Work&& work) const {
    const std::lock_guard lock(watching_->mutex);
    const Watching::For watched(*watching_, observer);
    return work();
  }

 private:
  struct Watching {
    struct For {
      For(Watching& of, const Observer& observer) : watching(of) { watching.observer = observer; }
      ~For() { watching.observer = {}; }
      For(const For&) = delete;
      For& operator=(const For&) = delete;
      Watching& watching;
    };
    std::mutex mutex = {};
    Observer observer = {};
  };
  std::shared_ptr<Watching> watching_ = std::make_shared<Watching>();
};

struct Solved {
  FilmCase of;
  Relay relay;
  ehl::CaseResult result;
};

Solved solve(const FilmCase& one, std::uint64_t seed, const nb::object& progress) {
  return watched(progress, [&](const Observer& observer) {
    const Relay relay;
    const ehl::CaseSetting setting{
        .observer = relay.observer(), .seed = seed, .surfaces = cases::ehl_surfaces()};
    return relay.watch(observer, [&] {
      return Solved{one, relay, ehl::solve_case(one.program, one.config, setting)};
    });
  });
}

void save(const Solved& solved, const std::filesystem::path& file) {
  watch(nb::none(), [&](const Observer& observer) {
    solved.relay.watch(observer, [&] {
      results::write_case(file, "tabor.save", solved.of.program, solved.of.config, solved.result,
                          results::findings_of({{.warnings = solved.result.warnings}}));
    });
  });
}

/// A sweep, and the case that was varied.
struct Swept {
  FilmCase of;
  study::EhlSweep sweep;
  std::size_t n_computed = 0;  ///< other cases were in the folder
};

/// As a table, or with axes and warnings.
void save_sweep(const Swept& swept, const std::filesystem::path& file) {
  watch(nb::none(), [&](const Observer&) {
    if (file.extension() == ".csv") {
      io::write_file(file, study::csv_of(swept.sweep));
      return;
    }
    study::write_sweep(file, {"tabor.save", swept.of.config.to_text(), swept.of.program.methods},
                       swept.sweep, swept.sweep.warnings);
  });
}

using Axes = std::vector<std::pair<std::string, std::vector<std::string>>>;

std::vector<study::SweepAxis> axes_of(const Axes& given) {
  std::vector<study::SweepAxis> axes;
  axes.reserve(given.size());
  for (const auto& [key, values] : given) axes.push_back({key, values, true});
  return axes;
}

study::EhlOutcome run_sweep(study::EhlSeries& series,
                            const std::optional<std::filesystem::path>& folder,
                            const engine::RunOptions& options) {
  std::optional<study::EhlStore> store;
  if (folder) {
    study::give_tasks(series, options.observer);
    store.emplace(*folder, engine::Store::Use::alone);
  }
  study::EhlOutcome outcome = study::run_ehl(series, store ? &*store : nullptr, options);
  if (outcome.ended_by) std::rethrow_exception(outcome.ended_by);
  return outcome;
}

/// Each film starts from the one before; in a folder, if there is one, finished cases are stored.
Swept sweep(const FilmCase& one, const Axes& given, std::uint64_t seed,
            const std::optional<std::filesystem::path>& folder, int jobs, bool retry,
            const nb::object& progress) {
  return watched_beside(progress, [&](const Observer& observer) {
    std::vector<study::SweepAxis> axes = axes_of(given);
    study::EhlSeries series = study::ehl_sweep(one.program, one.config, axes, seed);
    engine::RunOptions options;
    options.jobs = jobs;
    options.retry = retry;
    options.observer = observer;
    const study::EhlOutcome outcome = run_sweep(series, folder, options);
    return Swept{one, study::sweep_of(one.program, std::move(axes), outcome.all()),
                 outcome.n_computed};
  });
}

/// One key varied around the value in force.
Swept vary(const FilmCase& one, const std::string& name, std::uint64_t seed, int jobs,
           const nb::object& progress) {
  return watched_beside(progress, [&](const Observer& observer) {
    engine::RunOptions options;
    options.jobs = jobs;
    options.observer = observer;
    const ehl::CaseStudy& study = study::find_study(one.program, name);
    study::EhlStudyOutcome outcome =
        study::run_ehl_study(one.program, one.config, study, seed, options);
    const std::size_t n_computed = outcome.results.size();
    return Swept{
        one, study::sweep_of(one.program, {std::move(outcome.axis)}, std::move(outcome.results)),
        n_computed};
  });
}

/// (value, order) of each column.
std::vector<std::pair<double, double>> limits_of(const Swept& swept) {
  std::vector<std::pair<double, double>> limits;
  limits.reserve(swept.sweep.limits.size());
  for (const numerics::GridLimit& limit : swept.sweep.limits) {
    limits.emplace_back(limit.value, limit.order);
  }
  return limits;
}

/// The values of each axis behind its key, SI; words are counted from 0.
std::vector<std::pair<std::string, std::vector<double>>> numbers_of(const Swept& swept) {
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
  numbers.reserve(swept.sweep.axes.size());
  for (const study::SweepAxis& axis : swept.sweep.axes) {
    numbers.emplace_back(axis.key, axis.numbers());
  }
  return numbers;
}

/// (key, heading, unit)
using ColumnRow = std::tuple<std::string, std::string, std::string>;
std::vector<ColumnRow> columns_of(const Swept& swept) {
  std::vector<ColumnRow> rows;
  rows.reserve(swept.sweep.columns.size());
  for (const ColumnHead& column : swept.sweep.columns) {
    rows.emplace_back(column.key, column.heading, column.unit);
  }
  return rows;
}

/// (numbers as JSON, status, why it was rejected, warnings)
using CaseRow = std::tuple<std::string, std::string, std::string, ShownWarnings>;
std::vector<CaseRow> cases_of(const Swept& swept) {
  std::vector<CaseRow> rows;
  rows.reserve(swept.sweep.results.size());
  for (const ehl::CaseResult& one : swept.sweep.results) {
    rows.emplace_back(io::to_text(io::json_of(one.numbers)),
                      std::string(ehl::kCaseStatus.of(one.status)), one.error, shown(one.warnings));
  }
  return rows;
}

/// Each kind of warning once: its code, the text of its line, its class.
ShownWarnings sweep_warnings(const Swept& swept) {
  ShownWarnings list;
  for (const results::Finding& one : swept.sweep.warnings) {
    list.emplace_back(one.code, statement_of(one), cases::name_of(one.kind()));
  }
  return list;
}

/// (key, unit, default, meaning)
using KeyRow = std::tuple<std::string, std::string, std::string, std::string>;
std::vector<KeyRow> keys_of(const std::string& program) {
  std::vector<KeyRow> rows;
  for (const ParameterHead& key : program_of(program).keys) {
    rows.emplace_back(key.name, key.shown_unit(), key.when_absent(), key.meaning());
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
      .def_prop_ro("json",
                   [](const Solved& self) { return io::to_text(io::json_of(self.result.numbers)); })
      .def_prop_ro("facts", &facts_of)
      .def_prop_ro("converged", [](const Solved& self) { return self.result.converged(); })
      .def_prop_ro("warnings", [](const Solved& self) { return shown(self.result.warnings); })
      .def_prop_ro("references", [](const Solved& self) { return self.of.program.methods; })
      .def("save", &save, "file"_a);
  nb::class_<Swept>(module, "SweptCases")
      .def_prop_ro("cases", &cases_of)
      .def_prop_ro("columns", &columns_of)
      .def_prop_ro("axes", &numbers_of)
      .def_prop_ro("warnings", &sweep_warnings)
      .def_prop_ro("limits", &limits_of)
      .def_ro("n_computed", &Swept::n_computed)
      .def("save", &save_sweep, "file"_a);
  module.def("sweep_case", &sweep, "case"_a, "axes"_a, "seed"_a, "folder"_a.none(), "jobs"_a,
             "retry"_a, "progress"_a.none());
  module.def("vary_case", &vary, "case"_a, "study"_a, "seed"_a, "jobs"_a, "progress"_a.none());
  module.def(
      "case_references", [](const FilmCase& one) { return one.program.methods; }, "case"_a);
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
