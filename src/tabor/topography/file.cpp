#include "tabor/topography/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/digest.hpp"
#include "tabor/topography/doubts.hpp"
#include "tabor/topography/formats/format.hpp"
#include "tabor/topography/formats/resolve.hpp"

namespace tabor::topography {
namespace {

namespace fs = std::filesystem;
using format::Contents;
using format::Document;
using format::Format;
using format::Layer;

std::string bytes_of(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(file.string() + ": no such file");
  if (!fs::is_regular_file(status)) {
    throw InputError(file.string(), "a folder or device", "a scan file", "");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(fs::file_size(file), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw InputError(file.string() + ": cannot be read: check its permissions");
  }
  if (bytes.empty()) throw InputError(file.string(), "an empty file", "a scan", "copy it again");
  return bytes;
}

/// The first format that recognises the content opens it.
Document open(const Contents& contents) {
  const std::string_view head = contents.bytes.substr(0, format::kHeadSize);
  std::string found;
  std::string remedy;
  for (const Format& row : format::table()) {
    if (row.identify == nullptr || row.identify(head) == format::Match::no) continue;
    try {
      return row.open(contents);
    } catch (const format::Unrecognised& refusal) {
      found += (found.empty() ? "" : "; ") + refusal.got();
      remedy = refusal.remedy();
    }
  }
  throw InputError(contents.file.string(), found, "a scan file", remedy);
}

/// Heights in metres. What is not finite after scaling is a hole.
Field heights_of(const Layer& layer, double factor) {
  Field height = layer.load();
  parallel_for(height.size(), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      double& z = height.data()[i];
      z *= factor;
      if (!std::isfinite(z)) z = format::kHole;
    }
  });
  return height;
}

void require_heights(const Contents& contents, const Topography& topography) {
  if (count_holes(topography) == topography.grid.size()) {
    format::refuse(contents, "no valid height at any pixel", "a scan with heights");
  }
}

const Format* writer_for(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  for (const Format& row : format::table()) {
    const auto& known = row.extensions;
    if (row.write && std::find(known.begin(), known.end(), extension) != known.end()) {
      return &row;
    }
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

FileInfo inspect(const fs::path& file, const ReadOptions&) {
  const std::string bytes = bytes_of(file);
  const Document document = open({file, bytes});
  return {.format = document.format,
          .instrument = document.instrument,
          .channels = format::channels_of(document)};
}

Topography read(const fs::path& file, const ReadOptions& options, const Observer& observer) {
  report_progress(observer, "read", 0);
  const std::string bytes = bytes_of(file);
  const Contents contents{file, bytes};
  Document document = open(contents);
  const Layer& layer = format::choose_layer(contents, document, options);
  Topography topography;
  topography.doubts = document.doubts;
  topography.grid = format::resolve_grid(contents, layer, options, topography.doubts);
  const double factor = format::resolve_height_factor(contents, layer, options, topography.doubts);
  topography.height = heights_of(layer, factor);
  require_heights(contents, topography);
  topography.periodic = document.periodic;
  topography.source = file.string();
  topography.format = document.format;
  topography.instrument = document.instrument;
  topography.channel = layer.name;
  topography.metadata = std::move(document.metadata);
  topography.history = std::move(document.history);
  for (std::string& doubt : doubts(topography)) topography.doubts.push_back(std::move(doubt));
  report_progress(observer, "read", 1);
  return topography;
}

void write(const Topography& topography, const fs::path& file) {
  const Format* row = writer_for(file);
  if (row == nullptr) {
    throw InputError(file.string(), "extension '" + file.extension().string() + "'",
                     "one of " + writable_extensions(), "the extension chooses the format");
  }
  row->write(topography, file);
}

std::string sha256(const fs::path& file) { return io::sha256_of_file(file); }

}  // namespace tabor::topography
