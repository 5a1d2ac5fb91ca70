#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/cases/surface_summary.hpp"
#include "tabor/cli/each_scan.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/results/parameter_tables.hpp"

namespace tabor::cli {

namespace {

using cases::SurfaceRecord;
using scan::FileInfo;

struct Request {
  ScanRequest scan;  ///< how each of the files is read
  std::vector<std::string> files;
};

/// What one file holds, ready for every kind of output.
struct Contents {  // NOLINT(bugprone-exception-escape): moving JSON checks an assertion
  std::string path;
  std::optional<SurfaceRecord> record;  ///< none of a file that could not be read
  std::string problem = {};             ///< why not
  bool is_incomplete = false;           ///< a sound file that needs a word from the user
  io::Json object = {};
  std::string text = {};
  Warnings warnings = {};
};

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

/// `is_read`: its heights have been read, with the unit that was given.
void describe(const FileInfo& file, const std::string& path, const std::string& instrument,
              bool is_read, Facts& facts) {
  facts.fact("file", path);
  facts.fact("format", file.format);
  facts.fact("instrument", instrument);
  for (const scan::Channel& channel : file.channels) {
    const bool is_unknown = channel.unit.empty();
    const bool is_given = is_read && is_unknown && file.channels.size() == 1;
    const std::string remark = channel.is_height ? ""
                               : is_given        ? ", unit as given"
                               : is_unknown      ? ", a height with --unit or --z-scale only"
                                                 : ", not a height";
    facts.fact(fmt::format("channel {}", channel.index),
               fmt::format("{} [{}]{}", channel.name, is_unknown ? "?" : channel.unit, remark));
  }
}

/// Returns the warnings, then information, with settings spelled as options of the verbs that treat
/// a scan.
std::vector<std::string> warnings_about(const Scan& scan) {
  std::vector<results::Finding> findings;
  for (const Warning& warning : scan.surface.warnings) {
    findings.emplace_back();
    findings.back().code = warning.code;
    findings.back().text = warning.text;
  }
  results::put_doubts_first(findings);
  results::spell(as_option, findings);
  std::vector<std::string> texts;
  texts.reserve(findings.size());
  for (const results::Finding& finding : findings) texts.push_back(finding.text);
  return texts;
}

io::Json json_of(const Scan& scan, const FileInfo& file, const SurfaceRecord& record) {
  io::Json object;
  object["scan"] = {{"path", scan.path}, {"sha256", scan.sha256}};
  object.update({{"file", scan.path},
                 {"format", file.format},
                 {"instrument", scan.surface.instrument},
                 {"channels", channels_of(file)}});
  object.update(io::json_of(cases::surface_columns(), record));
  object.update({{"metadata", scan.surface.metadata}, {"doubts", warnings_about(scan)}});
  return object;
}

/// The rise of the plane; none where it is what rounding leaves of a levelled surface.
std::string tilt_text(const SurfaceRecord& record) {
  constexpr double rounding = 1e-9;  // of the rms height
  return std::abs(record.tilt) <= rounding * record.rms ? "0 m" : si(record.tilt, "m");
}

std::string text_of(const Scan& scan, const FileInfo& file, const SurfaceRecord& record) {
  const Grid& grid = record.grid;
  Facts facts;
  describe(file, scan.path, scan.surface.instrument, true, facts);
  facts.fact("pixels", fmt::format("{} x {}", grid.nx, grid.ny));
  facts.fact("pixel", si(grid.dx(), "m") + " x " + si(grid.dy(), "m"));
  facts.fact("size", si(grid.lx, "m") + " x " + si(grid.ly, "m"));
  facts.fact("periodic", record.periodic ? "yes" : "no");
  facts.fact("missing", record.missing_pixels == 0
                            ? "none"
                            : fmt::format("{} pixel{} ({})", record.missing_pixels,
                                          record.missing_pixels == 1 ? "" : "s",
                                          percent(record.missing_fraction())));
  facts.fact("heights", si(record.min, "m") + " to " + si(record.max, "m"));
  facts.fact("rms height", si(record.rms, "m") + " about the mean");
  if (!std::isnan(record.tilt)) facts.fact("tilt", tilt_text(record) + " over both sides");
  if (!std::isnan(record.quantum)) facts.fact("height step", si(record.quantum, "m"));
  for (const std::string& text : warnings_about(scan)) facts.fact("warning", text);
  return facts.text();
}

/// True if all channels have as many pixels, so that their number is known whichever is meant.
bool have_one_size(const std::vector<scan::Channel>& channels) {
  return !channels.empty() &&
         std::all_of(channels.begin(), channels.end(), [&](const scan::Channel& channel) {
           return channel.nx == channels.front().nx && channel.ny == channels.front().ny;
         });
}

/// What is known of a file that needs a word from the user, and what to say.
Contents incomplete(const scan::ScanFile& scan_file, const std::string& path,
                    const std::string& problem, const Observer& observer) {
  const FileInfo file = scan_file.info();
  Contents contents{.path = path, .record = {}, .problem = problem, .is_incomplete = true};
  io::Json& object = contents.object;
  const auto may_stop = [&observer] { report_progress(observer, "hash", std::nan("")); };
  object["scan"] = {{"path", path}, {"sha256", scan_file.sha256(may_stop)}};
  object.update({{"file", path},
                 {"format", file.format},
                 {"instrument", file.instrument},
                 {"channels", channels_of(file)}});
  for (const auto& column : cases::surface_columns()) {
    if (!std::holds_alternative<bool>(column.kind)) object[column.key] = nullptr;
  }
  object["doubts"] = {problem};
  Facts facts;
  describe(file, path, file.instrument, false, facts);
  if (have_one_size(file.channels)) {
    object["nx"] = file.channels.front().nx;
    object["ny"] = file.channels.front().ny;
    facts.fact("pixels",
               fmt::format("{} x {}", file.channels.front().nx, file.channels.front().ny));
  }
  facts.fact("needs", problem);
  contents.text = facts.text();
  return contents;
}

Contents contents_of(const Request& request, const std::string& path, const Context& context,
                     const Observer& observer) {
  ScanRequest one = request.scan;
  one.file = path;
  const scan::ScanFile scan_file(path, observer);
  try {
    const FileInfo file = scan_file.info();
    const Scan scan = read_scan(scan_file, one, context, observer);
    Contents contents{.path = path, .record = cases::summary_of(scan.surface)};
    contents.object = json_of(scan, file, *contents.record);
    contents.text = text_of(scan, file, *contents.record);
    contents.warnings = scan.surface.warnings;
    return contents;
  } catch (const IncompleteError& error) {
    return incomplete(scan_file, path, context.spelled(error.what()), observer);
  }
}

/// The same for one of many: what cannot be read is told and does not end the others.
Contents try_contents_of(const Request& request, const std::string& path, const Context& context,
                         const Observer& observer) {
  try {
    return contents_of(request, path, context, observer);
  } catch (const InputError& error) {
    const std::string problem = context.spelled(error.what());
    Contents failed{.path = path, .record = {}, .problem = problem};
    failed.object = {{"scan", {{"path", path}, {"sha256", nullptr}}}, {"failure", problem}};
    return failed;
  }
}

int show_one(const Request& request, Context& context) {
  const Contents contents =
      contents_of(request, request.files.front(), context, context.observer());
  io::Json object = json_head(context);
  object.update(contents.object);
  return finish(context, object, contents.text);
}

std::string table_of(const std::vector<Contents>& all, const std::vector<std::string>& names) {
  Table table({"scan", "pixels", "pixel", "Sq", "missing", "tilt", "warnings"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].record) {
      table.row(
          {names[i], "-", "-", "-", "-", "-", all[i].is_incomplete ? "incomplete" : "failed"});
      continue;
    }
    const SurfaceRecord& record = *all[i].record;
    const Grid& grid = record.grid;
    const bool is_square = grid.dx() == grid.dy();
    table.row({names[i], fmt::format("{} x {}", grid.nx, grid.ny),
               si(grid.dx(), "m") + (is_square ? "" : " x " + si(grid.dy(), "m")),
               si(record.rms, "m"),
               record.missing_pixels == 0 ? "none" : percent(record.missing_fraction()),
               tilt_text(record), results::codes_text(all[i].warnings)});
  }
  return table.text() + "Sq is taken about the mean. Tilt is the rise of the fitted plane.\n";
}

int show_many(const Request& request, Context& context) {
  const std::vector<Contents> all = measure_each<Contents>(
      request.files, "info",
      [&](const std::string& path, const Observer& observer) {
        return try_contents_of(request, path, context, observer);
      },
      context);
  io::Json object = json_head(context);
  std::vector<results::Case> cases;
  int code = kDone;
  for (const Contents& one : all) {
    object["scans"].push_back(one.object);
    if (one.record) cases.push_back({.surface = one.path, .warnings = one.warnings});
    if (one.problem.empty()) continue;
    if (!one.is_incomplete) code = kInput;
    context.warn((one.is_incomplete ? "incomplete: " : "not read: ") + one.problem);
  }
  results::shorten_paths(cases);
  context.warn(results::findings_of(cases));
  return finish(context, object, table_of(all, results::headings(request.files)), code);
}

int show(const Request& request, Context& context) {
  return request.files.size() == 1 ? show_one(request, context) : show_many(request, context);
}

}  // namespace

Verb info_verb() {
  return {.name = "info",
          .arguments = "SCAN [SCAN...] [options]",
          .summary = "show what a scan file holds: format, size, holes, heights and warnings",
          .details = "Several scans make a table with one row each.",
          .examples = {"tabor info surfaces/edt_before.x3p",
                       "tabor info surfaces/edt_before.x3p surfaces/edt_after.x3p",
                       "tabor info surfaces/edt_before.x3p --json"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scans(set, request->scan, request->files, false);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
