#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/cases/surface_summary.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::cli {

namespace {

using cases::SurfaceRecord;
using scan::FileInfo;

io::Json channels_of(const FileInfo& file) {
  io::Json channels = io::Json::array();
  for (const scan::Channel& channel : file.channels) {
    channels.push_back({{"index", channel.index},
                        {"name", channel.name},
                        {"unit", channel.unit},
                        {"is_height", channel.is_height},
                        {"nx", channel.nx},
                        {"ny", channel.ny}});
  }
  return channels;
}

void describe(const FileInfo& file, const std::string& path, const std::string& instrument,
              Facts& facts) {
  facts.fact("file", path);
  facts.fact("format", file.format);
  facts.fact("instrument", instrument);
  for (const scan::Channel& channel : file.channels) {
    const bool is_unknown = channel.unit.empty();
    const std::string remark = channel.is_height ? ""
                               : is_unknown      ? ", a height with --unit or --z-scale only"
                                                 : ", not a height";
    facts.fact(fmt::format("channel {}", channel.index),
               fmt::format("{} [{}]{}", channel.name, is_unknown ? "?" : channel.unit, remark));
  }
}

/// Returns the warnings, then information, with settings spelled as options of the verb.
std::vector<std::string> warnings_about(const Scan& scan, const Context& context) {
  std::vector<results::Finding> findings;
  for (const Warning& warning : scan.surface.warnings) {
    findings.emplace_back();
    findings.back().code = warning.code;
    findings.back().text = warning.text;
  }
  results::put_doubts_first(findings);
  results::spell(context.spelling, findings);
  std::vector<std::string> texts;
  texts.reserve(findings.size());
  for (const results::Finding& finding : findings) texts.push_back(finding.text);
  return texts;
}

io::Json json_of(const Context& context, const Scan& scan, const FileInfo& file,
                 const SurfaceRecord& record) {
  io::Json object = json_head(context);
  object["scan"] = {{"path", scan.path}, {"sha256", scan.sha256}};
  object.update({{"file", scan.path},
                 {"format", file.format},
                 {"instrument", scan.surface.instrument},
                 {"channels", channels_of(file)}});
  object.update(io::json_of(cases::surface_columns(), record));
  object.update({{"metadata", scan.surface.metadata}, {"doubts", warnings_about(scan, context)}});
  return object;
}

std::string text_of(const Context& context, const Scan& scan, const FileInfo& file,
                    const SurfaceRecord& record) {
  const Grid& grid = record.grid;
  Facts facts;
  describe(file, scan.path, scan.surface.instrument, facts);
  facts.fact("pixels", fmt::format("{} x {}", grid.nx, grid.ny));
  facts.fact("pixel", si(grid.dx(), "m") + " x " + si(grid.dy(), "m"));
  facts.fact("size", si(grid.lx, "m") + " x " + si(grid.ly, "m"));
  facts.fact("periodic", record.periodic ? "yes" : "no");
  facts.fact("missing", record.missing_pixels == 0
                            ? "none"
                            : fmt::format("{} pixels ({})", record.missing_pixels,
                                          percent(record.missing_fraction())));
  facts.fact("heights", si(record.min, "m") + " to " + si(record.max, "m"));
  facts.fact("rms height", si(record.rms, "m") + " about the mean");
  if (!std::isnan(record.quantum)) facts.fact("height step", si(record.quantum, "m"));
  for (const std::string& text : warnings_about(scan, context)) facts.fact("warning", text);
  return facts.text();
}

/// True if all channels have as many pixels, so that their number is known whichever is meant.
bool have_one_size(const std::vector<scan::Channel>& channels) {
  return !channels.empty() &&
         std::all_of(channels.begin(), channels.end(), [&](const scan::Channel& channel) {
           return channel.nx == channels.front().nx && channel.ny == channels.front().ny;
         });
}

/// A sound file that needs a word from the user: what is in it, and what to say.
int show_incomplete(const ScanRequest& request, const scan::ScanFile& scan_file,
                    const std::string& warning, Context& context) {
  const FileInfo file = scan_file.info();
  io::Json object = json_head(context);
  const auto may_stop = [observer = context.observer()] {
    report_progress(observer, "hash", std::nan(""));
  };
  object["scan"] = {{"path", request.file}, {"sha256", scan_file.sha256(may_stop)}};
  object.update({{"file", request.file},
                 {"format", file.format},
                 {"instrument", file.instrument},
                 {"channels", channels_of(file)}});
  for (const auto& column : cases::surface_columns()) {
    if (!std::holds_alternative<bool>(column.kind)) object[column.key] = nullptr;
  }
  object["doubts"] = {warning};
  Facts facts;
  describe(file, request.file, file.instrument, facts);
  if (have_one_size(file.channels)) {
    object["nx"] = file.channels.front().nx;
    object["ny"] = file.channels.front().ny;
    facts.fact("pixels",
               fmt::format("{} x {}", file.channels.front().nx, file.channels.front().ny));
  }
  facts.fact("needs", warning);
  return finish(context, object, facts.text());
}

int show(const ScanRequest& request, Context& context) {
  const scan::ScanFile scan_file(request.file, context.observer());
  const FileInfo file = scan_file.info();
  try {
    const Scan scan = read_scan(scan_file, request, context, context.observer());
    const SurfaceRecord record = cases::summary_of(scan.surface);
    return finish(context, json_of(context, scan, file, record),
                  text_of(context, scan, file, record));
  } catch (const IncompleteError& error) {
    return show_incomplete(request, scan_file, error.what(), context);
  }
}

}  // namespace

Verb info_verb() {
  return {
      .name = "info",
      .arguments = "SCAN [options]",
      .summary = "what a scan file holds: format, channels, size, unit, holes, heights, warnings",
      .details = "",
      .examples = {"tabor info surfaces/edt_before.x3p",
                   "tabor info surfaces/edt_before.x3p --json"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<ScanRequest>();
        declare_scan(set, *request, false);
        return [request](Context& context) { return show(*request, context); };
      }};
}

}  // namespace tabor::cli
