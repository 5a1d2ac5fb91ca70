#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/analysis/fields_file.hpp"
#include "tabor/analysis/states.hpp"
#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/columns.hpp"

// The options of contact, film and friction: they are declared into the settings of analysis, which
// checks them, and are shown with the results.
namespace tabor::cli {

/// Pressures and what the contact of each needs.
void declare_contact(OptionSet& set, analysis::CaseSettings& settings);
void declare_film(OptionSet& set, analysis::FilmSettings& settings);
void declare_fluid(OptionSet& set, analysis::FluidSettings& settings);
void declare_friction(OptionSet& set, analysis::FrictionSettings& settings);

/// What is asked of a file of maps.
struct FieldsRequest {
  std::optional<std::string> output;  ///< its name; none is written without
  analysis::FieldsOptions options;
  CsvRequest csv;
};
/// Declares -o, --fields, --double and --csv.
void declare_fields(OptionSet& set, FieldsRequest& request);
/// The file that is asked for, with the settings in force and what to cite; nothing without -o.
std::optional<analysis::FieldsFile> fields_file(const FieldsRequest& request,
                                                const Context& context, const Scan& scan,
                                                const io::Json& settings,
                                                const std::vector<std::string>& methods);

/// The option of what analysis calls by this name.
std::string flag_of(std::string_view setting);
/// Throws what analysis objects to, before a scan is read.
void check(const std::optional<analysis::Objection>& objection);
void check_contact(const analysis::CaseSettings& settings);

void describe(const analysis::ContactSettings& settings, Facts& facts);
void describe(const analysis::FilmSettings& settings, Facts& facts);
void describe(const analysis::FluidSettings& settings, Facts& facts);

/// Runs what makes one state after the other; Ctrl-C keeps the finished ones. Returns the exit
/// code: done or interrupted.
int until_interrupted(Context& context, const std::function<void()>& make_states,
                      const std::string& what = "states");

/// The same numbers as CSV.
template <typename Record>
std::string states_csv(const Columns<Record>& columns, const std::vector<Record>& records) {
  return io::csv_of(columns, records, analysis::media::kObject);
}

/// The JSON objects of many records.
template <typename Record>
io::Json states_json(const Columns<Record>& columns, const std::vector<Record>& records) {
  io::Json states = io::Json::array();
  for (const Record& record : records) {
    states.push_back(io::json_of(columns, record, analysis::media::kObject));
  }
  return states;
}

}  // namespace tabor::cli
