#include "tabor/cli/ehl_kept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/cli/ehl_case.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/digest.hpp"
#include "tabor/io/hdf5_guard.hpp"
#include "tabor/io/sealed_file.hpp"

namespace tabor::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCasePrefix = "case-";
constexpr std::string_view kStartPrefix = "start-";
constexpr const char* kLockName = "lock";

/// Length first, so that no text can look like the lines around it.
std::string line(std::string_view name, std::string_view value) {
  return fmt::format("{} = {}:{}\n", name, value.size(), value);
}

/// Empty for what is no file: reading it is rejected where it is used.
std::string digest_of(const fs::path& file, const Observer& observer = {}) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return "";
  try {
    return io::sha256_of_file(file, [&] { report_progress(observer, "hash", std::nan("")); });
  } catch (const InputError&) {
    return "";
  }
}

std::string key_of(const std::string& text) { return io::sha256(text).substr(0, 16); }

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) files.push_back(entry.path());
  return files;
}

bool is_case_file(const fs::path& file) {
  return file.extension() == ".json" && file.filename().string().starts_with(kCasePrefix);
}

bool is_ours(const fs::path& file) {
  return is_case_file(file) || file.filename().string().starts_with(kStartPrefix) ||
         io::is_temporary_name(file);
}

io::Json to_json(const KeptCase& kept) {
  return {{"scalars", kept.answer.scalars},
          {"converged", kept.answer.converged},
          {"warnings", kept.answer.warnings},
          {"notices", kept.notices}};
}

KeptCase from_json(const io::Json& json) {
  KeptCase kept;
  kept.answer.scalars = json.at("scalars");
  if (!kept.answer.scalars.is_object()) throw InputError("scalars: no object");
  kept.answer.converged = json.at("converged").get<bool>();
  kept.answer.warnings = json.at("warnings").get<std::vector<std::string>>();
  kept.notices = json.at("notices").get<std::vector<std::string>>();
  return kept;
}

}  // namespace

std::string canonical_text(const EhlProgram& program, const io::Config& config,
                           const Context& context, const std::string& before) {
  std::string text = fmt::format("tabor ehl {} {}\n", program.name, kEhlAlgorithms);
  text += line("version", kVersion);
  text += line("seed", std::to_string(context.seed_or_default()));
  // Messages begin with the name of the case and a line number in it.
  text += line("case", config.name());
  text += line("case_sha256", digest_of(config.name(), context.observer()));
  text += line("config", config.to_text());
  for (const std::string& key : program.files) {
    if (!config.has(key)) continue;
    text += line(key, digest_of(named_file(config, key), context.observer()));
  }
  if (!before.empty()) text += line("after", key_of(before));
  return text;
}

void note_digests(const EhlProgram& program, const io::Config& config, Context& context) {
  for (const std::string& key : program.files) {
    if (!config.has(key)) continue;
    const fs::path file = named_file(config, key);
    if (!context.files.sha256_of(file).empty()) continue;
    const std::string digest = digest_of(file);
    if (!digest.empty()) context.files.holds(file, digest);
  }
}

KeptCases::KeptCases(fs::path folder, std::vector<std::string> texts)
    : folder_(std::move(folder)),
      lock_(io::FileLock::take_or_reject(
          folder_ / kLockName, io::FileLock::Kind::alone,
          folder_.string() +
              ": another sweep keeps its cases there; wait for it to end or give another -o")),
      texts_(std::move(texts)),
      keys_(texts_.size()) {
  std::transform(texts_.begin(), texts_.end(), keys_.begin(), key_of);
}

KeptCases::~KeptCases() {
  std::error_code ignored;
  fs::remove(folder_ / kLockName, ignored);
  fs::remove(folder_, ignored);  // stays if there is anything else in it
}

fs::path KeptCases::case_file(std::size_t place) const {
  return folder_ / fmt::format("{}{}.json", kCasePrefix, keys_[place]);
}

fs::path KeptCases::start_file(std::size_t place) const {
  return folder_ / fmt::format("{}{}.h5", kStartPrefix, keys_[place]);
}

std::optional<KeptCase> KeptCases::read(std::size_t place) {
  const fs::path file = case_file(place);
  if (!fs::exists(file)) return std::nullopt;
  try {
    const io::Json json = io::read_json(file);
    const bool is_ours = json.at("canonical_text") == texts_[place];
    if (is_ours && io::is_sealed(json)) return from_json(json);
    complaints_.push_back(file.string() + (is_ours ? ": damaged" : ": of another case"));
  } catch (const InputError&) {
    complaints_.push_back(file.string() + ": damaged");
  } catch (const io::Json::exception&) {
    complaints_.push_back(file.string() + ": not a whole case");
  }
  return std::nullopt;
}

bool KeptCases::read_start(std::size_t place, const EhlChain& chain) {
  const fs::path file = start_file(place);
  if (!fs::exists(file)) return false;  // a sweep that begins like this one went on from there
  try {
    // Only a file that is to the last byte what was written is opened at all.
    const io::Json json = io::read_json(case_file(place));
    if (json.at("start_sha256") == digest_of(file)) {
      const auto read = [&] { chain.read_start(io::Hdf5Reader(file)); };
      io::require_hdf5_survives(file, read);
      read();
      return true;
    }
  } catch (const InputError&) {
  } catch (const io::Json::exception&) {
  }
  complaints_.push_back(file.string() + ": damaged");
  return false;
}

std::vector<std::optional<KeptCase>> KeptCases::take(const EhlChain& chain) {
  std::vector<std::optional<KeptCase>> found(texts_.size());
  const bool is_chain = chain.read_start != nullptr;
  std::size_t n_read = 0;
  for (; n_read < found.size(); ++n_read) {
    found[n_read] = read(n_read);
    if (is_chain && !found[n_read]) break;
  }
  const bool goes_on = n_read > 0 && n_read < found.size();
  if (is_chain && goes_on && !read_start(n_read - 1, chain)) {
    std::fill(found.begin(), found.end(), std::nullopt);
  }
  const auto count = [](const auto& all, const auto& is_one) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_one));
  };
  n_kept_ = count(found, [](const auto& kept) { return kept.has_value(); });
  n_unused_ = count(files_in(folder_), is_case_file) - n_kept_;
  return found;
}

void KeptCases::keep(std::size_t place, const KeptCase& kept, const EhlChain& chain) {
  io::Json json = {{"canonical_text", texts_[place]}};
  json.update(to_json(kept));
  if (chain.write_start) {
    io::Hdf5Writer writer(start_file(place));
    chain.write_start(writer);
    writer.commit();
    json["start_sha256"] = digest_of(start_file(place));
  }
  io::write_file(case_file(place), io::to_text(io::sealed(std::move(json))) + "\n");
  ++n_kept_;
  // Only now: until the case is there, the next run needs the film before it.
  std::error_code ignored;
  if (place > 0) fs::remove(start_file(place - 1), ignored);
}

void KeptCases::remove() const {
  std::error_code ignored;
  for (const fs::path& file : files_in(folder_)) {
    if (is_ours(file)) fs::remove(file, ignored);
  }
}

}  // namespace tabor::cli
