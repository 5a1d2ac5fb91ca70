#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tabor/analysis/findings.hpp"
#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/names.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"
#include "tabor/topography/topography.hpp"

// The result files of contacts, films and their friction.
namespace tabor::analysis {

/// What every result file begins with.
struct ResultHead {
  std::string command;               ///< that made it
  std::string config_toml;           ///< every setting in force
  std::vector<std::string> methods;  ///< keys of references.bib
};
void write_result_head(io::Hdf5Writer& writer, const ResultHead& head);

/// The attribute every result file ends with: what --json says under the same key.
void write_warnings(io::Hdf5Writer& writer, const std::vector<Finding>& warnings);

/// Settings in force, for the JSON head and result files: flat objects.
io::Json settings_json(const ContactSettings& settings);
io::Json settings_json(const FilmSettings& settings);
io::Json settings_json(const FluidSettings& settings);
/// All of them, and those of friction.
io::Json settings_json(const CaseSettings& settings);

/// A flat JSON object as TOML lines; nulls are left out.
std::string toml_of(const io::Json& settings);

/// One map of a state.
struct StateField {
  std::string name;  ///< "pressure"
  std::string unit;  ///< "Pa"
  std::string long_name;
  const Field& map;
  std::string owner = {};  ///< maps of one name and owner are the same one, stored once; "": none
};

/// Which maps a result file keeps.
enum class Fields {
  none,     ///< numbers alone
  contact,  ///< heights, contact pressure and film thickness
  all
};
inline constexpr auto kFields = names<Fields>("none", "contact", "all");

/// How maps are kept.
struct FieldsOptions {
  Fields fields = Fields::all;
  bool doubles = false;  ///< maps are float64 and not float32
};

/// The scan file that a surface comes from.
struct ScanOrigin {
  std::string path;
  std::string sha256;  ///< of its bytes; "" if it is of no file
};

/// The maps of each record.
std::vector<StateField> fields_of(const ContactRecord& record);
std::vector<StateField> fields_of(const FilmRecord& record);
std::vector<StateField> fields_of(const FluidRecord& record);
/// Those of a friction; `fluid` is null where the oil does not flow. A contact is the same under
/// all films, and a film on all contacts.
std::vector<StateField> fields_of(const ContactRecord& contact, const FilmRecord& film,
                                  const FluidRecord* fluid);

/// "0.9 g/m^2"
std::string density_text(double density);

/// What a warning of the record is said to be about.
Case case_of(const ContactRecord& record);
Case case_of(const FilmRecord& record);
Case case_of(const FrictionRecord& record);

/// The `-o` file of contact, lubricate and friction (docs/results.md): HDF5, or by the extension
/// .vti the maps alone, for ParaView. Nothing appears under its name before commit().
class FieldsFile {
 public:
  /// Throws InputError for a .vti without maps.
  FieldsFile(const std::filesystem::path& file, const FieldsOptions& options,
             const ResultHead& head, const topography::Topography& surface,
             const ScanOrigin& origin);

  /// Adds /states/NNNN: scalars as attributes, the first field as what viewers plot.
  void add_state(std::size_t number, const NamedCells& scalars,
                 const std::vector<StateField>& fields);
  /// Adds columns of one length under `group`, of all states together.
  template <typename Record>
  void add_table(const std::string& group, const Columns<Record>& columns,
                 const std::vector<Record>& records) {
    io::write_datasets(writer_, group, columns, records);
  }
  /// What the numbers say, in sentences.
  void add_answers(const std::vector<std::string>& sentences) {
    writer_.attribute("/", "answers", sentences);
  }
  /// With its warnings. A file without a state would look finished: none is made.
  void commit(const std::vector<Finding>& warnings);

 private:
  io::Precision precision() const;
  void write_axes(const std::string& group);
  void write_map(const std::string& group, const StateField& field);

  std::filesystem::path file_;
  io::Hdf5Writer writer_;
  Grid grid_;
  FieldsOptions options_;
  std::map<std::string, std::string> stored_;  ///< path of what stands in the file, by its owner
  std::size_t n_states_ = 0;
};

}  // namespace tabor::analysis
