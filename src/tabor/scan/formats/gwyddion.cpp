// Every other format: Gwyddion, if installed, converts the file in a process of its own. The
// program is gwyddion of version 2, or gwyconvert (PyPI: gwyddionpy-converter), which is built from
// its file modules.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::chrono::seconds kTimeLimit{120};

/// Some readers of Gwyddion believe a damaged file that claims gigabytes. The program itself takes
/// some hundred MiB of addresses; a sound file of packed 8 bit counts becomes several maps of
/// doubles, and a copy of each.
io::ProgramLimits limits_for(std::size_t file_bytes) {
  constexpr std::uint64_t kProgram = std::uint64_t{1536} << 20;
  constexpr std::uint64_t kPerByte = 64;
  const std::uint64_t maps = kPerByte * file_bytes;
  return {.address_space = kProgram + 2 * maps,
          .processor = static_cast<std::uint64_t>(kTimeLimit.count()),
          .file = (std::uint64_t{64} << 20) + maps};
}

/// What to tell the program; gwyconvert has no options.
std::vector<std::string> arguments_of(const std::filesystem::path& program,
                                      const std::filesystem::path& input,
                                      const std::filesystem::path& output) {
  if (program.filename() == kGwyddionPrograms[1]) return {input.string(), output.string()};
  return {"--convert-to-gwy=" + output.string(), input.string()};
}

/// The converted file, or "" if Gwyddion made none. A temporary home, because Gwyddion writes its
/// settings and a log there; one file per call, because with several it reports success when only
/// some could be read.
std::string convert(const Contents& contents, const std::filesystem::path& program) {
  const io::TemporaryFolder folder;
  const std::filesystem::path output = folder.path() / "converted.gwy";
  const io::Completed run = io::run_program(
      program, arguments_of(program, std::filesystem::absolute(contents.file), output),
      {{"HOME", folder.path().string()}, {"LC_ALL", "C.UTF-8"}, {"LANGUAGE", ""}}, kTimeLimit,
      [&contents] {
        constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
        if (contents.observer) report_progress(*contents.observer, "Gwyddion converts", kUnknown);
      },
      limits_for(contents.bytes.size()), folder.path());
  if (run.timed_out) {
    reject(contents, fmt::format("no answer from Gwyddion in {} s", kTimeLimit.count()),
           "a converted file", "convert it with Gwyddion yourself and read the .gwy file");
  }
  std::ifstream stream(output, std::ios::binary);
  const bool is_whole = run.exit_code < 128;  // no signal, such as that of a limit, ended it
  return is_whole ? std::string{std::istreambuf_iterator<char>(stream), {}} : "";
}

/// The file as the first program converts it that can; "" if none can.
std::string converted(const Contents& contents) {
  for (const char* const name : kGwyddionPrograms) {
    const auto program = io::find_program(name);
    std::string bytes = program ? convert(contents, *program) : "";
    if (!bytes.empty()) return bytes;
  }
  return "";
}

/// Gwyddion takes 0 for a size that it does not find; what it finds is no less.
void forget_no_size(Layer& layer) {
  if (layer.pixel_x && !(*layer.pixel_x > 0)) layer.pixel_x.reset();
  if (layer.pixel_y && !(*layer.pixel_y > 0)) layer.pixel_y.reset();
}

/// What Gwyddion makes of pictures: the grey values of 8 bits become shares of 255, those of more
/// bits stay. The counts of the file come back.
Field counts_of(Field shares) {
  constexpr double kMostGrey = 255, kRounding = 1e-6;
  for (Index i = 0; i < shares.size(); ++i) {
    const double count = kMostGrey * shares.data()[i];
    const bool is_share = count >= 0 && count <= kMostGrey + kRounding &&
                          std::abs(count - std::round(count)) < kRounding;
    if (!is_share && !std::isnan(count)) return shares;
  }
  return (kMostGrey * shares).round();
}

/// A picture has neither a size nor a unit; Gwyddion calls its channel by its colours.
void restore_counts(Layer& layer) {
  if (!layer.unit.empty() || layer.pixel_x || layer.pixel_y) return;
  static constexpr std::string_view colours[]{"Value (max)", "Red", "Green", "Blue", "Alpha"};
  layer.is_picture =
      std::find(std::begin(colours), std::end(colours), layer.name) != std::end(colours);
  layer.is_count = layer.is_picture || layer.name == "Gray";
  if (!layer.is_count) return;
  layer.load = [load = layer.load] { return counts_of(load()); };
}

}  // namespace

Match identify_gwyddion(std::string_view) { return Match::maybe; }

Document open_gwyddion(const Contents& contents) {
  if (is_stl(contents.bytes)) {
    throw Unrecognised(contents, "a mesh of triangles (STL)",
                       "read the scan that the mesh was made of: tabor writes STL only");
  }
  if (!gwyddion_program()) {
    throw Unrecognised(contents, "content of no format tabor reads itself",
                       "for about 150 instrument formats install Gwyddion 2: "
                       "sudo apt install gwyddion");
  }
  const auto bytes = std::make_shared<const std::string>(converted(contents));
  if (bytes->empty()) {
    throw Unrecognised(contents, "content neither tabor nor Gwyddion recognises",
                       "'tabor formats' lists what can be read, with Gwyddion 2");
  }
  Document document = open_gwy(contents.part(*bytes));
  document.format = "gwyddion";
  for (Layer& layer : document.layers) {
    restore_counts(layer);
    forget_no_size(layer);
    layer.load = [load = layer.load, bytes] { return load(); };  // the bytes live as long
  }
  return document;
}

}  // namespace tabor::scan::format
