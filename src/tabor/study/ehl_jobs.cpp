#include "tabor/study/ehl_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "tabor/core/advice.hpp"
#include "tabor/core/error.hpp"
#include "tabor/engine/checkpoint.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

ehl::CaseResult solve_or_reject(const ehl::Program& program, const ehl::CaseSolver& solve,
                                const EhlCase& one, const ehl::CaseSetting& setting) {
  try {
    check_memory_of_case(program, one.config);
    ehl::CaseResult result = solve(one.config, setting);
    // Maps of many cases would fill the memory.
    result.facts.clear();
    result.write = {};
    return result;
  } catch (const InputError& error) {
    const std::string why = without_advice(error.what());  // of files that no key of a case reads
    return {.status = ehl::CaseStatus::rejected, .error = why, .warnings = {{"rejected", why}}};
  }
}

engine::Quality quality_of(const ehl::CaseResult& result) {
  if (result.rejected()) return engine::Quality::failed;
  return result.converged() ? engine::Quality::converged : engine::Quality::not_converged;
}

io::Json json_of(const ehl::CaseResult& result) {
  io::Json warnings = io::Json::array();
  for (const Warning& warning : result.warnings) {
    warnings.push_back(
        {{"code", warning.code}, {"text", warning.text}, {"weight", io::number(warning.weight)}});
  }
  return {{"numbers", io::json_of(result.numbers)},
          {"status", ehl::kCaseStatus.of(result.status)},
          {"error", result.error},
          {"warnings", warnings}};
}

/// What the jobs of one chain share: the solver, and behind which case it stands.
struct Chain {
  ehl::CaseChain solver;
  std::optional<std::size_t> behind = {};
  /// Lets the solver serve one job at a time: where a stored case of a chain was damaged, two are
  /// ready at once.
  std::mutex mutex = {};

  bool keeps_starts() const { return solver.write_start != nullptr; }
};

std::shared_ptr<Chain> chain_of(const ehl::Program& program) {
  auto chain = std::make_shared<Chain>();
  chain->solver =
      program.make_chain ? program.make_chain() : ehl::CaseChain{.solve = program.solve};
  return chain;
}

/// What all jobs of a series share.
struct SeriesOfJobs {
  const EhlSeries& series;
  const engine::Store* store;
  EhlResults& results;
  std::vector<std::string>& damaged;
  std::mutex mutex = {};  // of `damaged`

  fs::path start_of(std::size_t i) const { return store->folder() / series.cases[i].start_file; }
};
using Shared = std::shared_ptr<SeriesOfJobs>;

/// True if the start that a case has left is there, to the last byte; only then is it opened. A
/// damaged one is named and removed.
bool has_start(SeriesOfJobs& shared, std::size_t i) {
  const fs::path file = shared.start_of(i);
  if (!fs::exists(file)) return false;  // the next case has been solved from there
  const io::Json kept = engine::read_checkpoint(*shared.store, shared.series.cases[i].task);
  if (kept.value("start_sha256", std::string()) == io::sha256_of_file(file)) return true;
  const std::lock_guard lock(shared.mutex);
  shared.damaged.push_back(file.string() + ": damaged");
  fs::remove(file);
  return false;
}

/// Puts the solver behind the case before this one.
void stand_before(SeriesOfJobs& shared, Chain& chain, std::size_t i) {
  if (shared.series.cases[i].starts_anew || !chain.keeps_starts()) return;
  if (chain.behind == i - 1) return;
  const fs::path file = shared.start_of(i - 1);
  if (!fs::exists(file)) {
    throw Error(
        file.string() +
        ": gone while this command ran; only one process may work on a shard: run it again");
  }
  try {
    chain.solver.read_start(io::Hdf5Reader(file));  // without a guard: has_start() knows its bytes
  } catch (const InputError& error) {  // of a file of this store, which is no fault of the case
    throw Error(error.what());
  }
}

/// The start before the case, so that the case is never there without it; the start of the case
/// before only goes when this one is there.
void keep(const SeriesOfJobs& shared, const Chain& chain, std::size_t i,
          const ehl::CaseResult& result) {
  io::Json json = json_of(result);
  if (chain.keeps_starts()) {
    io::Hdf5Writer writer(shared.start_of(i));
    chain.solver.write_start(writer);
    writer.commit();
    json["start_sha256"] = io::sha256_of_file(shared.start_of(i));
  }
  const EhlCase& one = shared.series.cases[i];
  engine::write_checkpoint(*shared.store, one.task, json);
  std::error_code ignored;
  if (!one.starts_anew) fs::remove(shared.start_of(i - 1), ignored);
}

void compute(SeriesOfJobs& shared, Chain& chain, std::size_t i, const engine::Monitor& monitor) {
  const EhlCase& one = shared.series.cases[i];
  const std::lock_guard lock(chain.mutex);
  if (shared.store) stand_before(shared, chain, i);
  ehl::CaseResult result = solve_or_reject(shared.series.program, chain.solver.solve, one,
                                           shared.series.setting(monitor.own));
  chain.behind = i;
  if (shared.store) keep(shared, chain, i, result);
  shared.results[one.place] = std::move(result);
}

std::string defect_of(const SeriesOfJobs& shared, const engine::Task& task) {
  try {
    read_ehl_case(*shared.store, task, shared.series.program.columns);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

engine::Job job_of(const Shared& shared, const std::shared_ptr<Chain>& chain, std::size_t i) {
  const EhlSeries& series = shared->series;
  const EhlCase& one = series.cases[i];
  engine::Job job;
  job.task = shared->store ? one.task : engine::Task{};
  job.kind = "case";
  job.stage = fmt::format("{} {}", series.program.name, one.name);
  job.part = one.chain;
  job.restarts = true;
  if (!one.starts_anew) job.needs = {i - 1};
  job.compute = [shared, chain, i](const engine::Monitor& monitor) {
    compute(*shared, *chain, i, monitor);
  };
  if (series.program.memory) {
    job.memory = [shared, i](const engine::Monitor&) {
      const ehl::Program& program = shared->series.program;
      constexpr double most = 1e18;  // that the type holds
      return static_cast<std::size_t>(
          std::min(most, program.memory(shared->series.cases[i].config)));
    };
  }
  if (!shared->store) return job;
  job.defect = [shared, task = one.task] { return defect_of(*shared, task); };
  job.quality = [shared, task = one.task] {
    return quality_of(read_ehl_case(*shared->store, task, shared->series.program.columns));
  };
  if (chain->keeps_starts()) job.can_serve = [shared, i] { return has_start(*shared, i); };
  return job;
}

}  // namespace

EhlStore::EhlStore(const fs::path& folder, engine::Store::Use use)
    : store_(folder, use,
             folder.string() +
                 ": another sweep keeps its cases there; wait for it to end, give another -o, or "
                 "split one sweep with <shard=i/n>") {}

EhlStore::~EhlStore() {
  if (store_.is_shared()) return;
  store_.discard(is_finished_ ? std::vector<std::string>{"case", "start"}
                              : std::vector<std::string>{});
}

std::size_t EhlStore::n_unused(const EhlSeries& series) const {
  std::set<std::string> used;
  for (const EhlCase& one : series.cases) used.insert(one.task.file);
  std::size_t n = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder(), ignored)) {
    const fs::path name = entry.path().filename();
    const bool is_case = name.extension() == ".json" && name.string().starts_with("case-");
    n += is_case && !used.contains(name.string()) ? 1 : 0;
  }
  return n;
}

namespace {

NamedCells cells_in(const io::Json& numbers, const ehl::CaseColumns& columns) {
  NamedCells cells;
  for (const ColumnHead& head : columns) {
    if (io::has_cell(numbers, head.key)) cells.push_back({head, io::cell_in(numbers, head.key)});
  }
  return cells;
}

/// A case of an earlier version: warnings have no codes.
ehl::CaseResult earlier_result(const io::Json& json, const ehl::CaseColumns& columns) {
  ehl::CaseResult result{.numbers = cells_in(json.at("scalars"), columns)};
  if (json.at("converged").get<bool>()) result.status = ehl::CaseStatus::converged;
  for (const io::Json& text : json.at("warnings")) {
    result.warnings.push_back({"", text.get<std::string>()});
  }
  return result;
}

ehl::CaseResult result_of(const io::Json& json, const ehl::CaseColumns& columns) {
  if (json.contains("scalars")) return earlier_result(json, columns);
  ehl::CaseResult result{.numbers = cells_in(json.at("numbers"), columns)};
  result.status =
      ehl::kCaseStatus.parse(json.at("status").get<std::string>(), "status of a stored case");
  result.error = json.at("error").get<std::string>();
  for (const io::Json& warning : json.at("warnings")) {
    const io::Json& weight = warning.at("weight");
    result.warnings.push_back({warning.at("code").get<std::string>(),
                               warning.at("text").get<std::string>(),
                               weight.is_null() ? 0 : weight.get<double>()});
  }
  return result;
}

}  // namespace

ehl::CaseResult read_ehl_case(const engine::Store& store, const engine::Task& task,
                              const ehl::CaseColumns& columns) {
  const io::Json json = engine::read_checkpoint(store, task);
  try {
    ehl::CaseResult result = result_of(json, columns);
    if (result.rejected() || !result.numbers.empty()) return result;
  } catch (const io::Json::exception&) {  // as below
  }
  throw InputError(store.path(task).string() + ": not a whole case");
}

std::vector<engine::Job> ehl_jobs(const EhlSeries& series, const engine::Store* store,
                                  EhlResults& results, std::vector<std::string>& damaged) {
  results.resize(series.cases.size());
  const Shared shared(new SeriesOfJobs{series, store, results, damaged});
  std::vector<engine::Job> jobs;
  std::shared_ptr<Chain> chain;
  for (std::size_t i = 0; i < series.cases.size(); ++i) {
    if (series.cases[i].starts_anew) chain = chain_of(series.program);
    jobs.push_back(job_of(shared, chain, i));
  }
  return jobs;
}

}  // namespace tabor::study
