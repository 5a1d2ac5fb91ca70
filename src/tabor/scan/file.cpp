#include "tabor/scan/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/scan/formats/format.hpp"
#include "tabor/scan/formats/resolve.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::scan {
namespace {

namespace fs = std::filesystem;
using format::Contents;
using format::Document;
using format::Format;
using format::Layer;

/// Heights in metres. What is not finite after scaling is a hole; so is what no surface can have,
/// such as a mark of missing points that the format does not know.
Field heights_of(const Layer& layer, double factor, std::vector<std::string>& warnings) {
  constexpr double kTallest = 1e6;  // [m]; squares of more leave the range of numbers at last
  Field height = layer.load();
  std::atomic<Index> n_absurd{0};
  parallel_for(height.size(), kBlock, [&](Index begin, Index end) {
    Index absurd = 0;
    for (Index i = begin; i < end; ++i) {
      double& z = height.data()[i];
      z *= factor;
      if (std::abs(z) <= kTallest) continue;
      absurd += std::isfinite(z) ? 1 : 0;
      z = format::kHole;
    }
    n_absurd += absurd;
  });
  if (n_absurd > 0) {
    warnings.push_back(fmt::format("{} heights beyond 1000 km count as missing", n_absurd.load()));
  }
  return height;
}

void require_heights(const Contents& contents, const topography::Topography& topography) {
  if (topography::count_holes(topography) == topography.grid.size()) {
    format::reject(contents, "no valid height at any pixel", "a scan with heights");
  }
}

const Format* writer_for(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  for (const Format& row : format::table()) {
    const auto& known = row.extensions;
    if (row.write && std::find(known.begin(), known.end(), extension) != known.end()) return &row;
  }
  return nullptr;
}

std::string writable_extensions() {
  std::string text;
  for (const Format& row : format::table()) {
    if (row.write) text += (text.empty() ? "" : " ") + row.extensions.front();
  }
  return text;
}

}  // namespace

std::vector<FormatRow> formats() {
  std::vector<FormatRow> rows;
  for (const Format& row : format::table()) {
    rows.push_back({.name = row.name,
                    .description = row.description,
                    .extensions = row.extensions,
                    .reads = row.open != nullptr,
                    .writes = row.write != nullptr,
                    .via_gwyddion = row.via_gwyddion});
  }
  return rows;
}

std::optional<fs::path> gwyddion_program() {
  for (const char* const name : kGwyddionPrograms) {
    if (auto program = io::find_program(name)) return program;
  }
  return std::nullopt;
}

struct ScanFile::Opened {
  Opened(const fs::path& file, const Observer& watching)
      : observer(watching), mapped(file), contents{file, mapped.bytes(), &mapped, &observer} {
    const Watch watch(observer, "read");
    document = format::open_document(contents);
  }

  Observer observer;
  io::MappedFile mapped;
  Contents contents;
  Document document;
};

ScanFile::ScanFile(const fs::path& file, const Observer& observer)
    : opened_(std::make_unique<Opened>(file, observer)) {}

ScanFile::~ScanFile() = default;
ScanFile::ScanFile(ScanFile&&) noexcept = default;

FileInfo ScanFile::info() const {
  const Document& document = opened_->document;
  return {.format = document.format,
          .instrument = document.instrument,
          .channels = format::channels_of(document)};
}

std::string ScanFile::sha256(const std::function<void()>& between) const {
  constexpr std::size_t kPiece = std::size_t{1} << 22;
  io::RunningDigest digest(io::DigestKind::sha256);
  for (std::string_view rest = opened_->mapped.bytes(); !rest.empty();) {
    const std::string_view piece = rest.substr(0, kPiece);
    digest.add(piece);
    opened_->mapped.release(piece);
    rest.remove_prefix(piece.size());
    if (between) between();
  }
  opened_->mapped.check();
  return digest.hexadecimal();
}

topography::Topography ScanFile::read(const ReadOptions& options) const {
  const Watch watch(opened_->observer, "read");
  const Contents& contents = opened_->contents;
  const Document& document = opened_->document;
  const Layer& layer = format::choose_layer(contents, document, options);
  topography::Topography topography;
  std::vector<std::string> found = document.warnings;
  std::vector<std::string> overrides;  // as the user asked
  topography.grid = format::resolve_grid(contents, layer, options, overrides);
  const double factor = format::resolve_height_factor(contents, layer, options, overrides);
  topography.height = heights_of(layer, factor, found);
  go_on_or_throw();
  // Some formats are read by other libraries and programs, which open the file by its name.
  opened_->mapped.check_name();
  if (layer.late_warnings) {
    const std::vector<std::string>& late = *layer.late_warnings;
    found.insert(found.end(), late.begin(), late.end());
  }
  require_heights(contents, topography);
  go_on_or_throw();
  topography.periodic = document.periodic;
  topography.tiles = document.tiles;
  topography.edges = document.edges;
  topography.source = contents.file.string();
  topography.format = document.format;
  topography.instrument = document.instrument;
  topography.channel = layer.name;
  topography.metadata = document.metadata;
  topography.history = document.history;
  for (std::string& warning : found) {
    topography.warnings.push_back({.code = "file", .text = std::move(warning)});
  }
  for (std::string& text : overrides) {
    topography.warnings.push_back({.code = "override", .text = std::move(text)});
  }
  for (const Warning& warning : document.lasting) topography.warnings.push_back(warning);
  topography::look_at(topography);
  contents.finished({}, 1);
  return topography;
}

FileInfo inspect(const fs::path& file) { return ScanFile(file).info(); }

topography::Topography read(const fs::path& file, const ReadOptions& options,
                            const Observer& observer) {
  return ScanFile(file, observer).read(options);
}

void require_writer(const fs::path& file) {
  if (writer_for(file) == nullptr) {
    throw InputError(file.string(), "extension '" + file.extension().string() + "'",
                     "one of " + writable_extensions(), "the extension chooses the format");
  }
}

void write(const topography::Topography& topography, const fs::path& file) {
  require_writer(file);
  writer_for(file)->write(topography, file);
}

std::string note_of(const topography::Topography& topography, const fs::path& file) {
  const Format* row = writer_for(file);
  return row == nullptr || row->note == nullptr ? "" : row->note(topography);
}

std::string sha256(const fs::path& file) { return io::sha256_of_file(file); }

}  // namespace tabor::scan
