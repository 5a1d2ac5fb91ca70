#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <ostream>

#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/each_scan.hpp"
#include "tabor/cli/params_text.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/scan_groups.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/results/parameter_tables.hpp"

namespace tabor::cli {

namespace {

using metrology::ParameterSet;

struct Request {
  ScanRequest scan;  ///< how each of the files is read and treated
  std::vector<std::string> files;
  std::vector<ScanGroup> groups;
  metrology::ParameterOptions options;
  std::optional<std::vector<ParameterSet>> sets;
  std::string stencil = "forward";
  std::string triangles = "two";
  std::string profile_standard = "iso21920";
  std::string profile_kind = "roughness";
  std::string profile_ends = "regression";
  std::optional<std::uint64_t> profile_sections;
  CsvRequest csv;
  std::optional<std::string> output;
};

/// One scan read, treated and measured, ready for every kind of output.
struct Measured {  // NOLINT(bugprone-exception-escape): moving JSON checks an assertion
  cases::ParametersRecord row;
  io::Json object;
  std::string facts;
  results::Case doubts;
};

/// Sets in a table for people; files and JSON objects have all of them.
constexpr std::array kShown{ParameterSet::height, ParameterSet::hybrid, ParameterSet::function};

std::vector<ParameterSet> sets_from(const std::string& text) {
  if (text == "all") return {metrology::kParameterSets.begin(), metrology::kParameterSets.end()};
  std::vector<std::string> words;
  words.reserve(metrology::kParameterSets.size() + 1);
  for (const ParameterSet set : metrology::kParameterSets) words.emplace_back(name_of(set));
  words.emplace_back("all");
  std::vector<ParameterSet> sets;
  for (const std::string& word : io::parse_csv(text + "\n", "--set").columns) {
    const auto set = metrology::parameter_set_from(word);
    if (!set) {
      throw UsageError(fmt::format("--set: got '{}'; expected {}{}", word, fmt::join(words, ", "),
                                   suggestion(word, words)));
    }
    if (std::find(sets.begin(), sets.end(), *set) == sets.end()) sets.push_back(*set);
  }
  return sets;
}

metrology::ProfileOptions profile_options_of(const Request& request) {
  using metrology::ProfileKind;
  metrology::ProfileOptions options = request.options.profile;
  if (request.profile_standard == "iso4287") options.standard = metrology::ProfileStandard::iso4287;
  if (request.profile_kind == "primary") options.kind = ProfileKind::primary;
  if (request.profile_kind == "waviness") options.kind = ProfileKind::waviness;
  if (request.profile_ends == "trim") options.ends = metrology::ProfileEnds::trim;
  if (request.profile_sections) {
    options.sections =
        static_cast<int>(std::min<std::uint64_t>(*request.profile_sections, 1000000));
  }
  return options;
}

/// True if the result is a table for people that nobody chose the sets of.
bool is_short(const Request& request, const Context& context) {
  return !request.sets && !request.csv.is_asked() && !request.output && !context.json;
}

metrology::ParameterOptions options_of(const Request& request, const Context& context) {
  metrology::ParameterOptions options = request.options;
  if (request.sets) options.sets = *request.sets;
  if (is_short(request, context)) options.sets = {kShown.begin(), kShown.end()};
  options.profile = profile_options_of(request);
  if (request.stencil == "seven-point") options.stencil = metrology::SlopeStencil::seven_point;
  if (request.triangles == "four") options.triangles = metrology::AreaTriangles::four;
  return options;
}

std::string chain_of(const Scan& scan) {
  return scan.treatment.empty() ? "none" : fmt::format("{}", fmt::join(scan.treatment, ", "));
}

std::string facts_of(const Scan& scan, Index valid_points) {
  Facts facts;
  describe(scan, facts);
  facts.fact("valid points",
             fmt::format("{} of {} pixels", valid_points, scan.surface.grid.size()));
  return facts.text();
}

Measured measure(const Request& request, const std::string& file, const Context& context,
                 const Observer& observer) {
  ScanRequest one = request.scan;
  one.file = file;
  const Scan scan = read_scan(one, context, observer);
  Measured measured{
      .row = cases::parameters_of(scan.surface, options_of(request, context), observer),
      .object = json_head(context, scan),
      .facts = {},
      .doubts = doubts_of(scan)};
  measured.row.path = file;
  measured.row.treatment = chain_of(scan);
  measured.facts = facts_of(scan, measured.row.valid_points);
  measured.object["valid_points"] = measured.row.valid_points;
  measured.object["parameters"] = results::json_of(measured.row.parameters);
  return measured;
}

/// The same for one of many: what cannot be read is told and does not end the others.
Measured try_measure(const Request& request, const std::string& file, const Context& context,
                     const Observer& observer) {
  try {
    return measure(request, file, context, observer);
  } catch (const InputError& error) {
    Measured failed;
    failed.row.path = file;
    failed.row.failure = context.spelled(error.what());
    failed.object = {{"scan", {{"path", file}, {"sha256", nullptr}}},
                     {"failure", failed.row.failure}};
    return failed;
  }
}

std::vector<Measured> measure_all(const Request& request, const Context& context) {
  return measure_each<Measured>(
      request.files, "params",
      [&](const std::string& file, const Observer& observer) {
        return try_measure(request, file, context, observer);
      },
      context);
}

/// What a short table leaves out.
std::string other_sets(const Request& request, const Context& context) {
  if (!is_short(request, context)) return "";
  std::vector<std::string_view> others;
  others.reserve(metrology::kParameterSets.size());
  for (const ParameterSet set : metrology::kParameterSets) {
    if (std::find(kShown.begin(), kShown.end(), set) == kShown.end()) {
      others.push_back(name_of(set));
    }
  }
  return fmt::format("\nother sets: {} (--set all)\n", fmt::join(others, ", "));
}

/// Adds one warning for all scans that have it.
void warn_of(const std::vector<Measured>& all, Context& context) {
  std::vector<results::Case> cases;
  cases.reserve(all.size());
  for (const Measured& measured : all) {
    if (measured.row.failure.empty()) cases.push_back(measured.doubts);
  }
  results::shorten_paths(cases);
  context.warn(results::findings_of(cases));
}

int show_one(const Request& request, Context& context) {
  const Measured measured = measure(request, request.files.front(), context, context.observer());
  warn_of({measured}, context);
  if (request.output) io::write_file(*request.output, results::csv_of({measured.row}));
  const std::string text =
      measured.facts + '\n' + grouped_table(measured.row.parameters) + other_sets(request, context);
  return finish(context, measured.object,
                write_csv(request.csv, results::csv_of({measured.row}), text));
}

io::Json json_of(const std::vector<Measured>& all, const Context& context) {
  io::Json object = json_head(context);
  object["scans"] = io::Json::array();
  for (const Measured& measured : all) {
    io::Json scan = measured.object;
    scan.erase("tabor_version");
    scan.erase("command");
    object["scans"].push_back(scan);
  }
  return object;
}

std::string text_of(const std::vector<Measured>& all,
                    const std::vector<cases::ParametersRecord>& rows) {
  std::string text;
  for (const Measured& measured : all) {
    if (!measured.facts.empty()) text += measured.facts + '\n';
  }
  return text + comparison_table(rows);
}

std::vector<cases::GroupParameters> means_of(const std::vector<GroupMembers>& groups,
                                             const std::vector<cases::ParametersRecord>& rows) {
  std::vector<cases::GroupParameters> means;
  for (const GroupMembers& group : groups) {
    std::vector<const cases::ParametersRecord*> members;
    for (const std::size_t place : group.places) members.push_back(&rows[place]);
    means.push_back(cases::mean_of(group.name, members));
  }
  return means;
}

int show_many(const Request& request, Context& context) {
  const std::vector<GroupMembers> members = members_of(request.groups, request.files);
  const std::vector<Measured> all = measure_all(request, context);
  warn_of(all, context);
  std::vector<cases::ParametersRecord> rows;
  rows.reserve(all.size());
  for (const Measured& measured : all) rows.push_back(measured.row);
  const std::vector<cases::GroupParameters> groups = means_of(members, rows);
  if (request.output) io::write_file(*request.output, results::csv_of(groups, rows));
  int code = kDone;
  for (const cases::ParametersRecord& row : rows) {
    if (row.failure.empty()) continue;
    code = kInput;
    if (!context.json) context.warn("not measured: " + row.failure);
  }
  std::string text = text_of(all, rows);
  io::Json object = json_of(all, context);
  for (const cases::GroupParameters& group : groups) {
    text += '\n' + group_table(group);
    object["groups"].push_back(results::json_of(group));
  }
  text += other_sets(request, context);
  return finish(context, object, write_csv(request.csv, results::csv_of(groups, rows), text), code);
}

int show(const Request& request, Context& context) {
  const bool is_one = request.files.size() == 1 && request.groups.empty();
  return is_one ? show_one(request, context) : show_many(request, context);
}

void assign_ratios(metrology::ParameterOptions& options, const std::string& text) {
  const std::vector<double> ratios = parse_si_list(text, dimension::none, "--material-ratios");
  if (ratios.size() != 2) throw UsageError("--material-ratios: expected two per cents, e.g. 10,80");
  options.peak_ratio = ratios.front();
  options.valley_ratio = ratios.back();
}

void declare_parameters(OptionSet& set, Request& request) {
  metrology::ParameterOptions& options = request.options;
  set.group("Parameters");
  set.add({.flag = "--set",
           .placeholder = "SET[,SET...]",
           .help = "height, hybrid, function, volume, spatial, feature, spectral, profile, all "
                   "[height,hybrid,function in a table; all in --json, --csv and -o]",
           .assign = [&request](const std::string& text) { request.sets = sets_from(text); }});
  set.choice("--stencil", {"forward", "seven-point"}, "finite differences for Sdq [forward]",
             request.stencil);
  set.choice("--triangles", {"two", "four"}, "triangles per cell for Sdr [two, in both ways]",
             request.triangles);
  set.add({.flag = "--material-ratios",
           .placeholder = "P,Q",
           .help = "material ratios of Sdc, Smc and the volumes, in per cent [10,80]",
           .assign = [&options](const std::string& text) { assign_ratios(options, text); }});
  set.quantity("--smr-height", "C", "height of Smr(c) above the mean [0um]", dimension::length,
               options.smr_height);
  set.number("--acf-threshold", "S",
             "value at which the autocorrelation counts as decayed, for "
             "Sal and Str [0.2]",
             options.acf_threshold);
  set.number("--pruning", "SHARE", "Wolf pruning of hills and dales, share of Sz [0.05]",
             options.pruning);
}

void declare_profiles(OptionSet& set, Request& request) {
  set.group("Profiles along x and y");
  set.choice("--profile-standard", {"iso21920", "iso4287"},
             "parameters over the evaluation length (ISO 21920) or means of sampling lengths (ISO "
             "4287) [iso21920]",
             request.profile_standard);
  set.choice("--profile-kind", {"roughness", "primary", "waviness"},
             "R, P or W parameters [roughness]", request.profile_kind);
  set.choice("--profile-ends", {"regression", "trim"},
             "filter up to the ends, or cut lc/2 off at both ends [regression]",
             request.profile_ends);
  set.quantity("--profile-cutoff", "LC", "cut-off lc of the filter [setting class of ISO 21920-3]",
               dimension::length, request.options.profile.cutoff);
  set.quantity("--profile-short-cutoff", "LS", "cut-off ls against noise, 0um for none [with lc]",
               dimension::length, request.options.profile.short_cutoff);
  set.quantity("--rmr-height", "C", "height of Rmr(c) above the mean line [that of --smr-height]",
               dimension::length, request.options.profile.ratio_height);
  set.count("--profile-sections", "sampling lengths of lc, 0 for as many as fit [5]",
            request.profile_sections);
}

void declare_output(OptionSet& set, Request& request) {
  set.group("Output");
  declare_csv(set, "one row per scan", request.csv);
  set.output("OUT.csv", "write the same CSV to a file", {".csv"}, request.output);
}

}  // namespace

Verb params_verb() {
  return {
      .name = "params",
      .arguments = "SCAN [SCAN...] [options]",
      .summary = "compute roughness parameters (ISO 25178-2, ISO 21920-2) with definitions",
      .details =
          "Several scans stand side by side, treated in the same way. If a scan cannot be read, "
          "tabor names it, measures the others and ends with exit code 3. With --group the CSV "
          "has a row per group and parameter, with its mean and then the scans.",
      .examples = {"tabor params surfaces/edt_before.x3p --level plane",
                   "tabor params surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                   "--set height,function --json",
                   "tabor params surfaces/edt_before.x3p surfaces/edt_after.x3p --level plane "
                   "--set height --csv",
                   "tabor params surfaces/edt_before.x3p surfaces/edt_after.x3p --level plane "
                   "--set height --group 'edt=edt_*'"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scans(set, request->scan, request->files);
        declare_groups(set, request->groups);
        declare_parameters(set, *request);
        declare_profiles(set, *request);
        declare_output(set, *request);
        return [request](Context& context) { return show(*request, context); };
      }};
}

}  // namespace tabor::cli
