#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/names.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/topography/topography.hpp"

// Writes the result files of contacts, films and their friction.
namespace tabor::results {

/// Attributes that every result file begins with.
struct ResultHead {
  std::string command;               ///< that made it
  std::string config_toml;           ///< every setting in force
  std::vector<std::string> methods;  ///< keys of references.bib
};
void write_result_head(io::Hdf5Writer& writer, const ResultHead& head);

/// Writes the attributes that every result file ends with: the lines of warnings, and the class of
/// each.
void write_warnings(io::Hdf5Writer& writer, const std::vector<Finding>& warnings);

/// Returns settings in force as flat objects, for the JSON head and result files.
io::Json settings_json(const cases::ContactSettings& settings);
io::Json settings_json(const cases::FilmSettings& settings);
io::Json settings_json(const cases::FluidSettings& settings);
/// Returns all settings of a case, those of friction included.
io::Json settings_json(const cases::CaseSettings& settings);
/// Returns the settings of sliding with those of the case; without oil those of none.
io::Json settings_json(const cases::CaseSettings& settings, const cases::SlideSettings& sliding);

/// Returns a flat JSON object as TOML lines; nulls are left out.
std::string toml_of(const io::Json& settings);

/// One map of a state.
struct StateField {
  std::string name;  ///< "pressure"
  std::string unit;  ///< "Pa"
  std::string long_name;
  const Field& map;
  std::string owner = {};  ///< maps of one name and owner are the same one, stored once; "": none
};

/// Returns the group of a state: "/states/0000".
std::string state_group(std::size_t number);

/// Maps that a result file stores.
enum class Fields {
  none,     ///< numbers alone
  contact,  ///< heights, contact pressure and film thickness
  all
};
inline constexpr auto kFields = names<Fields>("none", "contact", "all");

/// Selection and precision of the stored maps.
struct FieldsOptions {
  Fields fields = Fields::all;
  bool doubles = false;  ///< maps are float64 and not float32
};

/// The scan file that a surface comes from.
struct ScanOrigin {
  std::string path;
  std::string sha256;  ///< of its bytes; "" if it is of no file
};

/// Returns the maps of a record.
std::vector<StateField> fields_of(const cases::ContactRecord& record);
std::vector<StateField> fields_of(const cases::FilmRecord& record);
std::vector<StateField> fields_of(const cases::TrappedRecord& record);
std::vector<StateField> fields_of(const cases::FluidRecord& record);
/// Returns the maps of a friction. A contact is the same under all films, and a film on all
/// contacts.
std::vector<StateField> fields_of(const cases::ContactRecord& contact, const cases::Oil& oil);

/// Returns a density as text: "0.9 g/m^2".
std::string density_text(double density);

/// Returns the case that a warning of the record names.
Case case_of(const cases::ContactRecord& record);
Case case_of(const cases::FilmRecord& record);
Case case_of(const cases::FrictionRecord& record);

/// Returns the map that a file has of each contact: 0 no contact, 1 contact below saturation, 2
/// saturated.
inline constexpr const char* kContactMap = "0 no contact, 1 contact below saturation, 2 saturated";
io::ByteMap contact_map(const contact::State& state, double saturation_pressure);

/// File of results to be written, and what they are of.
struct FieldsTarget {
  std::filesystem::path file;
  FieldsOptions options;
  std::string command;  ///< that makes it
  ScanOrigin origin;
};

/// The `-o` file of contact, lubricate and friction, and that of tabor.save (docs/results.md):
/// HDF5, or by the extension .vti the maps alone, for ParaView. Nothing appears under its name
/// before commit().
class FieldsFile {
 public:
  /// Open the file of contacts, of films or of frictions under these settings. Throw InputError for
  /// a .vti without maps.
  FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
             const cases::ContactSettings& settings);
  FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
             const cases::FilmSettings& settings);
  FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
             const cases::CaseSettings& settings);
  /// Opens the file of a slide.
  FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
             const cases::CaseSettings& settings, const cases::SlideSettings& sliding);
  /// Opens a file of any numbers and maps.
  FieldsFile(const std::filesystem::path& file, const FieldsOptions& options,
             const ResultHead& head, const topography::Topography& surface,
             const ScanOrigin& origin);

  /// Add the state NNNN of a contact, of a film or of a friction.
  void add(std::size_t number, const cases::ContactRecord& record);
  void add(std::size_t number, const cases::FilmRecord& record);
  void add(std::size_t number, const cases::FrictionRecord& record,
           const cases::ContactRecord& contact, const cases::Oil& oil);

  /// Adds the state NNNN of a slide, with the maps that are stored of it and its spectra.
  void add(std::size_t number, const cases::SlideState& state, const cases::SlideParts& parts);
  /// Adds what a slide says beside its states: spectra of the sheet before, number and length of
  /// the steps, whether sliding became steady.
  void add_run(const cases::SlideResult& result);

  /// Adds /states/NNNN: scalars as attributes, the first field as what viewers plot.
  void add_state(std::size_t number, const NamedCells& scalars,
                 const std::vector<StateField>& fields);
  /// Adds columns of one length under `group`, of all states together.
  template <typename Record>
  void add_table(const std::string& group, const Columns<Record>& columns,
                 const std::vector<Record>& records) {
    io::write_datasets(writer_, group, columns, records);
  }
  /// Adds the answers that the numbers give, in sentences.
  void add_answers(const std::vector<std::string>& sentences) {
    writer_.attribute("/", "answers", sentences);
  }
  /// Completes the file with its warnings. Makes no file where no state was added.
  void commit(const std::vector<Finding>& warnings);

 private:
  io::Precision precision() const;
  void write_axes(const std::string& group);
  void write_map(const std::string& group, const StateField& field);
  void write_contact(std::size_t number, const contact::State& state, const std::string& owner);
  void write_spectra(const std::string& group, const cases::SheetSpectra& spectra);
  bool is_first(const std::string& name, const std::string& owner, const std::string& path);

  std::filesystem::path file_;
  io::Hdf5Writer writer_;
  Grid grid_;
  FieldsOptions options_;
  double cap_ = std::numeric_limits<double>::infinity();  ///< saturation pressure [Pa]
  std::vector<ColumnHead> heads_;                         ///< of the numbers of all states
  std::map<std::string, std::string> stored_;             ///< path of each stored map, by its owner
  std::size_t n_states_ = 0;
};

}  // namespace tabor::results
