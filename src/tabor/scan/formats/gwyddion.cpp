// Every other format: Gwyddion, if installed, converts the file in a process of its own.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/io/subprocess.hpp"
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

/// The converted file, or "" if Gwyddion made none. A temporary home, because Gwyddion writes its
/// settings and a log there; one file per call, because with several it reports success when only
/// some could be read.
std::string convert(const Contents& contents, const std::filesystem::path& program) {
  const io::TemporaryFolder folder;
  const std::filesystem::path output = folder.path() / "converted.gwy";
  const io::Completed run = io::run_program(
      program,
      {"--convert-to-gwy=" + output.string(), std::filesystem::absolute(contents.file).string()},
      {{"HOME", folder.path().string()}}, kTimeLimit,
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

}  // namespace

Match identify_gwyddion(std::string_view) { return Match::maybe; }

Document open_gwyddion(const Contents& contents) {
  const auto program = gwyddion_program();
  if (!program) {
    throw Unrecognised(contents, "content of no format tabor reads itself",
                       "for about 150 instrument formats install Gwyddion: "
                       "sudo apt install gwyddion");
  }
  const auto bytes = std::make_shared<const std::string>(convert(contents, *program));
  if (bytes->empty()) {
    throw Unrecognised(contents, "content neither tabor nor Gwyddion recognises",
                       "'tabor formats' lists what can be read");
  }
  Document document = open_gwy(contents.part(*bytes));
  document.format = "gwyddion";
  for (Layer& layer : document.layers) {
    layer.load = [load = layer.load, bytes] { return load(); };  // the bytes live as long
  }
  return document;
}

}  // namespace tabor::scan::format
