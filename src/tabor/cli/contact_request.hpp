#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/cases/states.hpp"
#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/results/fields_file.hpp"

// Declares the options of contact, film and friction into the settings of analysis, which checks
// them, and shows them with the results.
namespace tabor::cli {

/// What contacts may be asked for under.
enum class Controls {
  pressures,  ///< one must be given
  sliding,    ///< the same, under a tool at one place
  all         ///< pressures, separations or forces: objection_to_controls() tells if none is given
};
/// Declares what contacts are solved under and their settings.
void declare_contact(OptionSet& set, cases::CaseSettings& settings,
                     Controls controls = Controls::pressures);
void declare_film(OptionSet& set, cases::FilmSettings& settings, bool is_needed = true);
void declare_dry_below(OptionSet& set, cases::FrictionSettings& settings);
void declare_trapped(OptionSet& set, cases::CaseSettings& settings);
void declare_fluid(OptionSet& set, cases::FluidSettings& settings);
void declare_friction(OptionSet& set, cases::FrictionSettings& settings);

/// Options of the output file of maps.
struct FieldsRequest {
  std::optional<std::string> output;  ///< its name; none is written without
  results::FieldsOptions options;
  CsvRequest csv;
};
/// Declares -o, --fields, --double and --csv.
void declare_fields(OptionSet& set, FieldsRequest& request);
/// Opens the output file of results under these settings; nothing without -o.
template <typename... Settings>
std::optional<results::FieldsFile> fields_file(const FieldsRequest& request, const Context& context,
                                               const Scan& scan, const Settings&... settings) {
  if (!request.output) return std::nullopt;
  return results::FieldsFile(
      {*request.output, request.options, context.command_line, {scan.path, scan.sha256}},
      scan.surface, settings...);
}

/// Returns the option of a setting: "--pressure" for "mean_pressure".
std::string flag_of(std::string_view setting);
/// Throws the objection, if there is one. To be called before a scan is read.
void check(const std::optional<cases::Objection>& objection);
void check_contact(const cases::CaseSettings& settings);
/// Looks for the tool where it is a file, which no output may replace.
void find_tool(cases::ContactSettings& settings, Context& context);
/// Takes the boundary from --edges. Throws UsageError where options contradict each other.
void take_edges(const ScanRequest& scan, cases::ContactSettings& settings);

void describe(const cases::ContactSettings& settings, Facts& facts);
void describe(const cases::ToolSettings& settings, Facts& facts);
void describe(const cases::FilmSettings& settings, Facts& facts);
void describe(const cases::TrappedSettings& settings, Facts& facts);
void describe(const cases::FluidSettings& settings, Facts& facts);

/// Runs `make_states`; after Ctrl-C the finished states remain. Returns the exit code: done or
/// interrupted.
int until_interrupted(Context& context, const std::function<void()>& make_states,
                      const std::string& what = "states");

/// Returns many records as CSV.
template <typename Record>
std::string states_csv(const Columns<Record>& columns, const std::vector<Record>& records) {
  return io::csv_of(columns, records, cases::media::kObject);
}

/// Returns many records as a JSON array.
template <typename Record>
io::Json states_json(const Columns<Record>& columns, const std::vector<Record>& records) {
  io::Json states = io::Json::array();
  for (const Record& record : records) {
    states.push_back(io::json_of(columns, record, cases::media::kObject));
  }
  return states;
}

}  // namespace tabor::cli
