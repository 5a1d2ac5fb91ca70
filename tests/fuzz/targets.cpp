#include "fuzz/targets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "fuzz/archive.hpp"
#include "fuzz/memory_file.hpp"
#include "fuzz/png.hpp"
#include "support/folder.hpp"
#include "support/sample_map.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/scan/formats/format.hpp"
#include "tabor/study/experiment.hpp"
#include "tabor/study/study.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::fuzz {
namespace {

using scan::ReadOptions;

/// A rejection says which file or option is meant.
void check_message(const std::string& message, const std::string& place) {
  if (message.find(place) == std::string::npos) {
    throw std::logic_error("a message without its place: " + message);
  }
}

/// Runs the action; true if it was not rejected.
bool accepted(const std::function<void()>& action, const std::string& place = "") {
  try {
    action();
    return true;
  } catch (const InputError& error) {
    check_message(error.what(), place);
    return false;
  }
}

/// Completes what any file may leave open, so that every reader gets as far as its heights.
ReadOptions complete() {
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.unit = "um";
  options.override_unit = true;
  return options;
}

/// What was read is a map with a size; heights are numbers or holes.
void check_map(const topography::Topography& map) {
  const Grid& grid = map.grid;
  const bool has_size = grid.nx == map.height.cols() && grid.ny == map.height.rows() &&
                        grid.lx > 0 && grid.ly > 0 && std::isfinite(grid.lx) &&
                        std::isfinite(grid.ly);
  if (!has_size) throw std::logic_error("a map without a size");
  if (map.height.isInf().any()) throw std::logic_error("an infinite height");
}

void read_every_channel(const std::filesystem::path& file) {
  constexpr std::size_t kEnough = 4;
  std::optional<scan::ScanFile> scan;
  if (!accepted([&] { scan.emplace(file); }, file.string())) return;
  const scan::FileInfo info = scan->info();
  accepted([&] { check_map(scan->read()); }, file.string());
  for (std::size_t i = 0; i < std::min(kEnough, info.channels.size()); ++i) {
    ReadOptions options = complete();
    options.channel = std::to_string(info.channels[i].index);
    accepted([&] { check_map(scan->read(options)); }, file.string());
    options.unit.reset();
    options.z_scale = -1e-9;
    accepted([&] { check_map(scan->read(options)); }, file.string());
  }
}

/// Only bytes that this reader takes for its own: what others do with them is their target's work.
void run_reader(const scan::format::Format& format, std::string_view bytes) {
  using namespace scan::format;
  if (format.identify(bytes.substr(0, kHeadSize)) == Match::no) return;
  const MemoryFile file(format.name == "png" ? repaired_png(bytes) : std::string(bytes));
  read_every_channel(file.path());
}

/// A ZIP archive made of what the input lists: its checksums are right, which no mutation of packed
/// bytes would achieve.
void run_archive(std::string_view bytes) {
  std::string packed;
  try {
    packed = packed_archive(bytes);
  } catch (const OutputError&) {
    return;  // names that no archive may hold
  }
  if (packed.empty()) return;
  const MemoryFile file(packed);
  read_every_channel(file.path());
}

void run_units(std::string_view bytes) {
  const std::string text(bytes);
  accepted([&] { parse_quantity(text); });
  accepted([&] { parse_si(text, dimension::pressure, "--pressure"); }, "--pressure");
  accepted([&] { parse_si_list(text, dimension::length, "--pixel"); }, "--pixel");
  unit_factor(text, dimension::length);
}

/// One step per line, applied to a small map with holes.
void run_treatment(std::string_view bytes) {
  constexpr std::size_t kEnough = 6;
  topography::Treatment steps = split(bytes, '\n');
  if (steps.size() > kEnough) steps.resize(kEnough);
  if (!accepted([&] { topography::check(steps); })) return;
  accepted([&] { topography::apply(steps, test::small_map()); });
}

/// A study file beside one scan; what is read is written out and read again.
void run_study(std::string_view bytes) {
  static const test::Folder folder;
  static const bool has_scan = [] {
    scan::write(test::small_map(), folder / "scan_1.h5");
    return true;
  }();
  (void)has_scan;
  const std::filesystem::path file = folder / "study.toml";
  test::put_bytes(file, std::string(bytes));
  study::Study study;
  if (!accepted([&] { study = study::read_study(file); }, "study.toml")) return;
  test::put_bytes(file, study::to_toml(study));
  study::read_study(file);
}

void run_file(std::string_view bytes, void (*read)(const std::filesystem::path&)) {
  const MemoryFile file(bytes);
  accepted([&] { read(file.path()); }, file.path().string());
}

void run_experiment(std::string_view bytes) {
  run_file(bytes, [](const auto& file) { study::read_experiment(file); });
}

void run_csv(std::string_view bytes) {
  run_file(bytes, [](const auto& file) { io::read_csv(file); });
}

void run_json(std::string_view bytes) {
  run_file(bytes, [](const auto& file) { io::read_json(file); });
}

/// Formats whose files hold compressed parts.
bool is_packed(const std::string& format) {
  static constexpr std::string_view names[]{"h5",   "x3p",  "sur", "png",      "plux", "vk",
                                            "datx", "tiff", "ce",  "mitutoyo", "nc"};
  return std::find(std::begin(names), std::end(names), format) != std::end(names);
}

/// Formats that HDF5 reads. tools/fuzz lets no single block of theirs be larger than 320 MiB.
std::size_t library_bytes(const std::string& format) {
  return format == "h5" || format == "datx" || format == "nc" ? std::size_t{768} << 20 : 0;
}

std::vector<Target> make_targets() {
  ::setenv("PATH", "/nonexistent", 1);  // no converter: what no reader knows is rejected at once
  std::vector<Target> all;
  for (const auto& format : scan::format::table()) {
    if (format.open == nullptr || format.via_gwyddion) continue;
    all.push_back({format.name, [&format](std::string_view bytes) { run_reader(format, bytes); },
                   is_packed(format.name), library_bytes(format.name)});
  }
  all.push_back({"archive", run_archive, true});
  all.push_back({"units", run_units});
  all.push_back({"treatment", run_treatment});
  all.push_back({"study", run_study});
  all.push_back({"experiment", run_experiment});
  all.push_back({"csv", run_csv});
  all.push_back({"json", run_json});
  return all;
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = make_targets();
  return all;
}

const Target& target(const std::string& name) {
  for (const Target& candidate : targets()) {
    if (candidate.name == name) return candidate;
  }
  throw std::logic_error("no fuzz target '" + name + "'");
}

}  // namespace tabor::fuzz
