#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "parameters.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/synthesis/recipes.hpp"

// The tables of parameters as Python reads them: its functions take their arguments, types, units
// and documentation from there (python/tabor/_settings.py).
namespace tabor::python {
namespace {

/// The argument as the command line spells it, where that differs: "poisson_ratio".
std::string other_argument(const ParameterHead& head) {
  std::string other = head.option().substr(2);
  std::replace(other.begin(), other.end(), '-', '_');
  return other == head.python_argument() ? "" : other;
}

nb::dict row_of(const char* table, const ParameterHead& head) {
  nb::dict row;
  row["table"] = table;
  row["name"] = head.name;
  row["argument"] = head.python_argument();
  row["other"] = other_argument(head);
  row["option"] = head.option();
  row["kind"] = std::string(kValueKinds.of(head.kind));
  row["dimension"] = name_of(head.dimension);
  row["unit"] = si_unit(head.dimension);
  row["words"] = head.words;
  row["help"] = head.help;
  row["example"] = head.example;
  row["absent"] = head.absent;
  row["none"] = head.none;
  row["study_key"] = head.study_key;
  row["is_of_material"] = head.is_of_material;
  row["default"] = nb::none();
  return row;
}

template <typename Settings>
void add_rows(const char* table, const Parameters<Settings>& parameters, nb::list& rows) {
  const Settings defaults{};
  for (const Parameter<Settings>& one : parameters) {
    nb::dict row = row_of(table, one);
    if (one.kind == ValueKind::numbers) {
      if (one.has_default()) row["default"] = nb::cast(one.numbers(defaults));
    } else if (one.has_default() || one.kind == ValueKind::flag) {
      row["default"] = given_value(one.value(defaults));
    }
    rows.append(row);
  }
}

/// Settings of several kinds have several defaults, which the example names.
nb::dict row_of(const synthesis::RecipeSetting& setting) {
  nb::dict row = row_of("recipe", setting);
  if (setting.kinds.size() == 1) {
    const bool has_default = !setting.defaults.empty() || setting.kind == ValueKind::flag;
    if (has_default) row["default"] = given_value(setting.default_value);
    return row;
  }
  std::vector<std::string> texts;
  for (const auto& [kind, text] : setting.defaults) texts.push_back(kind + " " + text);
  row["example"] = "";
  row["absent"] = fmt::format("{}", fmt::join(texts, ", "));
  return row;
}

nb::list settings() {
  nb::list rows;
  add_rows("contact", cases::contact_parameters(), rows);
  add_rows("film", cases::film_parameters(), rows);
  add_rows("trapped", cases::trapped_parameters(), rows);
  add_rows("fluid", cases::fluid_parameters(), rows);
  add_rows("friction", cases::friction_parameters(), rows);
  add_rows("slide", cases::slide_parameters(), rows);
  add_rows("read", scan::read_parameters(), rows);
  add_rows("pixels", synthesis::pixel_parameters(), rows);
  for (const auto& one : synthesis::recipe_settings()) rows.append(row_of(one));
  return rows;
}

}  // namespace

void bind_setting_tables(nb::module_& module) { module.def("settings", &settings); }

}  // namespace tabor::python
