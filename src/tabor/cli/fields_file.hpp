#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/result.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/names.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/hdf5.hpp"

namespace tabor::cli {

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

/// What is asked of a result file.
struct FieldsRequest {
  std::optional<std::string> output;  ///< its name; none is written without
  Fields fields = Fields::all;
  bool doubles = false;  ///< maps are float64 and not float32
};

/// Declares -o, --fields and --double.
void declare_fields(OptionSet& set, FieldsRequest& request);

/// The `-o` file of contact, lubricate and friction (docs/results.md). Nothing appears under its
/// name before commit().
class FieldsFile {
 public:
  /// `settings` is a flat object, stored as TOML text; `methods` are keys of references.bib.
  FieldsFile(const FieldsRequest& request, const Context& context, const Scan& scan,
             const io::Json& settings, const std::vector<std::string>& methods);

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
  /// With all warnings so far. A file without a state would look finished: none is made.
  void commit(const Context& context);

 private:
  void write_root(const Context& context, const Scan& scan, const io::Json& settings,
                  const std::vector<std::string>& methods);
  void write_axes(const std::string& group);
  void write_map(const std::string& group, const StateField& field);

  io::Hdf5Writer writer_;
  Grid grid_;
  Fields fields_;
  io::Precision precision_;
  std::map<std::string, std::string> stored_;  ///< path of what stands in the file, by its owner
  std::size_t n_states_ = 0;
};

/// The attributes every result file begins with; `methods` are keys of references.bib.
void write_result_head(io::Hdf5Writer& writer, const Context& context,
                       const std::string& config_toml, const std::vector<std::string>& methods);

/// The attribute every result file ends with: what --json says under the same key.
void write_warnings(io::Hdf5Writer& writer, const Context& context);

/// A flat JSON object as TOML lines; nulls are left out.
std::string toml_of(const io::Json& settings);

}  // namespace tabor::cli
