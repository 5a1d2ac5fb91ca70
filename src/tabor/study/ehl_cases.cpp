#include "tabor/study/ehl_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/cases/ehl_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/files/digest.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

/// With every link on the way resolved, as far as it exists.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path known = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file.lexically_normal() : known;
}

std::string digest_of(const fs::path& file, const Observer& observer) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return "";
  try {
    return io::sha256_of_file(file, [&] { report_progress(observer, "hash", std::nan("")); });
  } catch (const InputError&) {
    return "";
  }
}

/// The case with one combination of the swept values.
io::Config case_at(const io::Config& config, const std::vector<SweepAxis>& axes,
                   const Places& places) {
  io::Config changed = config;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    changed = changed.with(axes[i].key, axes[i].values[places[i]]);
  }
  return changed;
}

bool begins_like_one_of(const std::string& key, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& beginning) { return key.starts_with(beginning); });
}

/// True if the second of two cases cannot start from the first.
bool ends_chain(const ehl::Program& program, const std::vector<SweepAxis>& axes, const Places& a,
                const Places& b) {
  if (!program.make_chain) return true;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool changes = axes[i].values[a[i]] != axes[i].values[b[i]];
    if (changes && begins_like_one_of(axes[i].key, program.chain_ends)) return true;
  }
  return false;
}

EhlSeries series_of(const ehl::Program& program, std::uint64_t seed) {
  return {.program = program, .cases = {}, .seed = seed, .surfaces = cases::ehl_surfaces()};
}

std::string text_of(const EhlSeries& series, const EhlCase& one, const std::string& key_before,
                    const Observer& observer) {
  const ehl::Program& program = series.program;
  std::string text = fmt::format("tabor ehl {} {}\n", program.name, kEhlAlgorithms);
  text += engine::text_line("version", std::string_view(kVersion));
  text += engine::text_line("seed", std::to_string(series.seed));
  // Messages begin with the name of the case and a line number in it.
  text += engine::text_line("case", one.config.name());
  text += engine::text_line("case_sha256", series.digests->of(one.config.name(), observer));
  text += engine::text_line("config", one.config.to_text());
  for (const std::string& key : program.files) {
    if (!one.config.has(key)) continue;
    text += engine::text_line(key, series.digests->of(ehl::named_file(one.config, key), observer));
  }
  if (!key_before.empty()) text += engine::text_line("after", key_before);
  return text;
}

}  // namespace

std::string FileDigests::of(const fs::path& file, const Observer& observer) {
  const std::lock_guard lock(mutex_);
  const auto known = digests_.find(resolved(file));
  if (known != digests_.end()) return known->second;
  std::string digest = digest_of(file, observer);
  if (!digest.empty()) digests_.emplace(resolved(file), digest);
  return digest;
}

void FileDigests::hold(const fs::path& file, const std::string& sha256) {
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = digests_.try_emplace(resolved(file), sha256);
  if (is_new || known->second == sha256) return;
  throw Error(fmt::format("{}: replaced or changed since this command first read it; run it again",
                          file.string()));
}

ehl::CaseSetting EhlSeries::setting(const Observer& observer) const {
  ehl::SurfaceSource source = surfaces;
  source.read = [read = surfaces.read, held = digests](const ehl::NamedScan& scan,
                                                       const Observer& watching) {
    ehl::Surface surface = read(scan, watching);
    held->hold(scan.file, surface.sha256);
    return surface;
  };
  return {.observer = observer, .seed = seed, .surfaces = std::move(source)};
}

EhlSeries ehl_sweep(const ehl::Program& program, const io::Config& config,
                    const std::vector<SweepAxis>& axes, std::uint64_t seed) {
  EhlSeries series = series_of(program, seed);
  const std::vector<Places> all = combinations(axes);
  const std::vector<std::string> names = names_of(axes, all);
  const Places* before = nullptr;
  std::size_t n_chains = 0;
  for (const std::size_t place : solving_order(axes, all, program.downwards)) {
    const bool starts_anew = !before || ends_chain(program, axes, *before, all[place]);
    n_chains += starts_anew ? 1 : 0;
    series.cases.push_back({.config = case_at(config, axes, all[place]),
                            .name = names[place],
                            .place = place,
                            .chain = n_chains - 1,
                            .starts_anew = starts_anew});
    before = &all[place];
  }
  // In the order of the command line, as the first that is wrong is named.
  std::vector<const EhlCase*> asked(series.cases.size());
  for (const EhlCase& one : series.cases) asked[one.place] = &one;
  for (const EhlCase* one : asked) reject_unknown_keys(program, one->config);
  return series;
}

EhlSeries ehl_variants(const ehl::Program& program, const io::Config& config,
                       const std::string& key, const std::vector<std::string>& values,
                       std::uint64_t seed) {
  EhlSeries series = series_of(program, seed);
  series.program.make_chain = {};
  for (const std::string& value : values) {
    const std::size_t place = series.cases.size();
    series.cases.push_back(
        {.config = config.with(key, value), .name = value, .place = place, .chain = place});
  }
  return series;
}

void give_tasks(EhlSeries& series, const Observer& observer) {
  std::string before;
  for (EhlCase& one : series.cases) {
    if (one.starts_anew) before.clear();
    one.task = engine::make_task("case", "json", text_of(series, one, before, observer));
    one.start_file = "start-" + one.task.key + ".h5";
    before = one.task.key;
  }
}

std::vector<fs::path> files_of(const EhlSeries& series) {
  std::set<fs::path> files;
  for (const EhlCase& one : series.cases) {
    for (const std::string& key : series.program.files) {
      if (one.config.has(key)) files.insert(ehl::named_file(one.config, key));
    }
  }
  return {files.begin(), files.end()};
}

std::vector<std::string> names_of(const std::vector<SweepAxis>& axes,
                                  const std::vector<Places>& all) {
  std::vector<std::string> names(all.size());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::string before = a > 0 ? " / " : "";
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string& value = axes[a].values[all[i][a]];
      names[i] += before;
      if (parse_number(value)) names[i] += axes[a].key + "=";
      names[i] += value;
    }
  }
  return names;
}

}  // namespace tabor::study
