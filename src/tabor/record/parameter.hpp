#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/units.hpp"

// A parameter says one setting once: its name, dimension, bounds, help and place. Options of the
// command line, keys of study and case files, templates of both, attributes of results, the text
// that names a stored result and the properties of Python's settings are all made from tables of
// parameters.
namespace tabor {

/// Where a number may lie.
struct Bounds {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_is_out = false;  ///< the number lies above `least`
  bool infinity_is_in = false;
  std::string text = {};  ///< "more than zero"; empty: every number is in

  /// True where a number lies there; NaN never does, infinity where it is said.
  bool contain(double value) const;
};
namespace bounds {
inline const Bounds above_zero{.least = 0, .least_is_out = true, .text = "more than zero"};
inline const Bounds zero_or_more{.least = 0, .text = "zero or more"};
}  // namespace bounds

/// When a setting must be given.
enum class Needed {
  no,              ///< its default holds, or nothing
  yes,             ///< always
  unless_material  ///< unless a material of the library is named
};

/// When the text that names a stored result has a line for a setting.
enum class Identity {
  no,             ///< the result does not depend on it, or another line says it
  yes,            ///< where the setting has a value
  unless_default  ///< where its value is not the default, so that older stores stay valid
};

/// What a setting holds.
enum class ValueKind { number, numbers, count, flag, word, text, texts };
inline constexpr auto kValueKinds =
    names<ValueKind>("number", "numbers", "count", "flag", "word", "text", "texts");

/// All of a parameter but its value.
struct ParameterHead {
  std::string name;          ///< "saturation_pressure": in files, JSON and Python; of a case file
                             ///< the key, "ball.radius"
  std::string help = {};     ///< one clause; neither example nor default, which are added; of a
                             ///< choice or a switch empty where its words say enough
  std::string example = {};  ///< "240 MPa"; the default where the setting has one
  Dimension dimension = {};
  std::string unit = {};  ///< shown in place of the dimension's, "N/m^2" of a spring per width
  Bounds bounds = {};
  std::vector<std::string> words = {};  ///< a choice: what can be chosen
  std::string study_key = {};           ///< "material.saturation_pressure"; "": in no study file
  std::string flag = {};                ///< "" : "--" and the name with hyphens
  std::string placeholder = {};         ///< "PS", of the option; a choice shows its words
  std::string argument = {};            ///< of Python; "": the name
  std::string absent = {};              ///< what holds where it is not given: "rigid"
  std::string none = {};                ///< the word for no value: "auto"; of a number without a
                                        ///< bound, for infinity: "inf"
  std::string group = {};               ///< heading of its option in help: "Material"; grouped()
                                        ///< gives it to the rest of a table
  bool is_of_material = false;          ///< a named material gives it
  ValueKind kind = ValueKind::number;   ///< says the constructor
  Needed needed = Needed::no;
  Identity identity = Identity::no;
  std::string default_text = {};  ///< "7 MPa", "true"; says heads_of()

  std::string option() const;                      ///< "--saturation-pressure"
  std::string option_by_name() const;              ///< "--poissons-ratio" beside --poisson-ratio
  std::string python_argument() const;             ///< "saturation_pressure"
  std::string json_key() const;                    ///< "saturation_pressure_Pa"
  std::string study_table() const;                 ///< "material" of a study file; "": its head
  std::string study_name() const;                  ///< "saturation_pressure" in that table
  bool is_in_table(std::string_view table) const;  ///< of a study file; "": its head
  std::string file_key() const;                    ///< of a study or a case file

  std::string in_toml(const std::string& value) const;  ///< in quotes, where TOML asks for them
  std::string sample() const;  ///< the default, or else the example, as TOML writes it

  // The columns of a table for people.
  std::string shown_unit() const;   ///< "Pa"; "" for plain numbers and words
  std::string when_absent() const;  ///< what holds where it is not given: "7 MPa", "required"
  std::string meaning() const;      ///< help, or else what can be chosen
};

/// What somebody gave for a setting, on the command line, in a file or in a program. Every
/// function throws InputError or UsageError for what is something else.
class Given {
 public:
  virtual ~Given() = default;
  virtual double number(const Dimension& expected) const = 0;                ///< SI
  virtual std::vector<double> numbers(const Dimension& expected) const = 0;  ///< SI
  virtual std::uint64_t count() const = 0;
  virtual bool flag() const = 0;
  virtual std::string word(const std::vector<std::string>& choices) const = 0;
  virtual std::string text() const = 0;
  virtual std::vector<std::string> texts() const = 0;
  virtual bool is_word(const std::string& word) const = 0;  ///< exactly this word
};

/// The SI unit of a dimension, "kg/m^3"; "" for a plain number.
std::string si_unit(const Dimension& dimension);

/// True where a cell holds a text, a count, or a number above zero: a default, where nothing was
/// given.
bool holds_default(const Cell& cell);

/// A value as messages show it: "7 MPa", "0.45 g/m^2", "0.33".
std::string text_of(double value, const Dimension& dimension);
/// The same in the unit of a parameter.
std::string text_of(double value, const ParameterHead& parameter);

/// "rigid or full", "constant, barus or roelands".
std::string one_of(const std::vector<std::string>& words);

/// Returns the word, which `what` says. Throws InputError with the nearest choice if it is none.
std::string checked_choice(const std::string& what, std::string word,
                           const std::vector<std::string>& choices);

namespace detail {

inline void read(double& target, const Given& given, const ParameterHead& head) {
  const bool is_infinite = !head.none.empty() && given.is_word(head.none);
  target = is_infinite ? std::numeric_limits<double>::infinity() : given.number(head.dimension);
}
inline void read(std::optional<double>& target, const Given& given, const ParameterHead& head) {
  target.reset();
  if (head.none.empty() || !given.is_word(head.none)) target = given.number(head.dimension);
}
inline void read(std::vector<double>& target, const Given& given, const ParameterHead& head) {
  target = given.numbers(head.dimension);
}
inline void read(std::uint64_t& target, const Given& given, const ParameterHead&) {
  target = given.count();
}
inline void read(bool& target, const Given& given, const ParameterHead&) { target = given.flag(); }
inline void read(std::string& target, const Given& given, const ParameterHead& head) {
  target = head.words.empty() ? given.text() : given.word(head.words);
}
inline void read(std::vector<std::string>& target, const Given& given, const ParameterHead&) {
  target = given.texts();
}
template <typename Value>
void read(std::optional<Value>& target, const Given& given, const ParameterHead& head) {
  read(target.emplace(), given, head);
}

template <typename Value>
Value held(const Value&);
template <typename Value>
Value held(const std::optional<Value>&);

template <typename Member>
constexpr ValueKind kind_of() {
  using Value = decltype(held(std::declval<Member>()));
  if (std::is_same_v<Value, std::vector<double>>) return ValueKind::numbers;
  if (std::is_same_v<Value, std::vector<std::string>>) return ValueKind::texts;
  if (std::is_same_v<Value, std::uint64_t>) return ValueKind::count;
  if (std::is_same_v<Value, bool>) return ValueKind::flag;
  return std::is_same_v<Value, std::string> ? ValueKind::text : ValueKind::number;
}

/// A list has no cell.
inline Cell to_cell(const std::vector<double>&) { return {}; }

inline std::vector<double> numbers_of(double value) { return {value}; }
inline std::vector<double> numbers_of(std::uint64_t value) { return {static_cast<double>(value)}; }
inline std::vector<double> numbers_of(const std::vector<double>& values) { return values; }
template <typename Value>
std::vector<double> numbers_of(const Value&) {
  return {};
}
template <typename Value>
std::vector<double> numbers_of(const std::optional<Value>& value) {
  return value ? numbers_of(*value) : std::vector<double>{};
}

template <typename Enum>
std::optional<Enum> chosen(const std::optional<Enum>& value) {
  return value;
}
template <typename Enum>
std::optional<Enum> chosen(Enum value) {
  return value;
}

}  // namespace detail

/// One setting of a struct of settings: how it is called, read and written.
template <typename Settings>
struct Parameter : ParameterHead {
  /// A value of the setting, found in the settings.
  using Value = std::function<Cell(const Settings&)>;

  Value value;        ///< as given; NaN or nothing: not given
  Value in_force;     ///< with what other settings say of it
  Value identifying;  ///< in the text that names a stored result
  std::function<std::vector<double>(const Settings&)> numbers;  ///< that must lie within bounds
  std::function<void(Settings&, const Given&)> read;  ///< takes what was given; without bounds

  /// A number, a list of numbers, a count, a switch or a text; `access`: a member pointer or
  /// member_of().
  template <typename Access>
  Parameter(ParameterHead head, Access access)
      : ParameterHead(std::move(head)),
        value([access](const Settings& one) {
          using detail::to_cell;
          return to_cell(std::invoke(access, one));
        }),
        in_force(value),
        identifying(value),
        numbers([access](const Settings& one) {
          return detail::numbers_of(std::invoke(access, one));
        }) {
    kind = detail::kind_of<std::decay_t<std::invoke_result_t<Access, Settings&>>>();
    const ParameterHead& own = *this;
    read = [access, own](Settings& one, const Given& given) {
      detail::read(std::invoke(access, one), given, own);
    };
  }

  /// One of the names of an enumeration (core/names.hpp).
  template <typename Access, typename Names>
  Parameter(ParameterHead head, Access access, const Names& names)
      : ParameterHead(std::move(head)),
        value([access, names](const Settings& one) -> Cell {
          const auto chosen = detail::chosen(std::invoke(access, one));
          return chosen ? Cell(std::string(names.of(*chosen))) : Cell();
        }),
        in_force(value),
        identifying(value),
        numbers([](const Settings&) { return std::vector<double>(); }),
        read([access, names](Settings& one, const Given& given) {
          std::invoke(access, one) = *names.find(given.word(names.all()));
        }) {
    words = names.all();
    kind = ValueKind::word;
  }

  /// Numbers that the settings keep in a way of their own.
  template <typename Get, typename Set>
  static Parameter of_numbers(ParameterHead head, Get get, Set set) {
    Parameter one;
    static_cast<ParameterHead&>(one) = std::move(head);
    one.kind = ValueKind::numbers;
    one.value = one.in_force = one.identifying = [](const Settings&) { return Cell(); };
    one.numbers = get;
    one.read = [set, dimension = one.dimension](Settings& all, const Given& given) {
      set(all, given.numbers(dimension));
    };
    return one;
  }

  /// The same parameter of settings that have these as a part.
  template <typename Part>
  static Parameter of_part(const Parameter<Part>& parameter, Part Settings::*part) {
    Parameter one;
    static_cast<ParameterHead&>(one) = parameter;
    one.value = [=](const Settings& all) { return parameter.value(all.*part); };
    one.in_force = [=](const Settings& all) { return parameter.in_force(all.*part); };
    one.identifying = [=](const Settings& all) { return parameter.identifying(all.*part); };
    one.numbers = [=](const Settings& all) { return parameter.numbers(all.*part); };
    one.read = [=](Settings& all, const Given& given) { parameter.read(all.*part, given); };
    return one;
  }

  /// It has a value without being given: its example.
  bool has_default() const {
    if (needed == Needed::yes) return false;
    const Settings defaults{};
    return kind == ValueKind::numbers ? !numbers(defaults).empty() : holds_default(value(defaults));
  }

  /// Somebody said something about it.
  bool is_given(const Settings& settings) const {
    const Cell cell = value(settings);
    const auto* is_on = std::get_if<bool>(&cell);
    return !numbers(settings).empty() || std::holds_alternative<std::string>(cell) ||
           (is_on != nullptr && *is_on);
  }

  /// What holds where other settings decide about it.
  Parameter with_value_in_force(Value found) const {
    Parameter changed = *this;
    changed.in_force = changed.identifying = std::move(found);
    return changed;
  }
  /// What the text that names a stored result says of it.
  Parameter with_identifying_value(Value found) const {
    Parameter changed = *this;
    changed.identifying = std::move(found);
    return changed;
  }

 private:
  Parameter() = default;
};

/// The parameters of a struct of settings, in their order.
template <typename Settings>
using Parameters = std::vector<Parameter<Settings>>;

/// The same table, with this heading for every parameter that has none of its own.
template <typename Settings>
Parameters<Settings> grouped(const std::string& heading, Parameters<Settings> table) {
  for (Parameter<Settings>& one : table) {
    if (one.group.empty()) one.group = heading;
  }
  return table;
}

/// The parameters of settings that are a part of others.
template <typename Settings, typename Part>
Parameters<Settings> within(const Parameters<Part>& parameters, Part Settings::*part) {
  Parameters<Settings> all;
  for (const Parameter<Part>& parameter : parameters) {
    all.push_back(Parameter<Settings>::of_part(parameter, part));
  }
  return all;
}

/// The parameter of this name; throws std::out_of_range where there is none.
template <typename Settings>
const Parameter<Settings>& parameter_of(const Parameters<Settings>& parameters,
                                        std::string_view name) {
  for (const Parameter<Settings>& one : parameters) {
    if (one.name == name) return one;
  }
  throw std::out_of_range("no parameter " + std::string(name));
}

/// One table after the other.
template <typename Settings>
Parameters<Settings> joined(Parameters<Settings> first,
                            const std::vector<Parameters<Settings>>& more) {
  for (const Parameters<Settings>& table : more) {
    first.insert(first.end(), table.begin(), table.end());
  }
  return first;
}

/// A value as a file writes it: "7 MPa", ["0 m", "0 m"], "true"; "" where there is none.
std::string written(const ParameterHead& parameter, const std::vector<double>& numbers,
                    const Cell& value);

/// All of the parameters but their values, with the defaults of those that need not be given.
template <typename Settings>
std::vector<ParameterHead> heads_of(const Parameters<Settings>& parameters) {
  const Settings defaults{};
  std::vector<ParameterHead> heads(parameters.begin(), parameters.end());
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (heads[i].needed != Needed::no) continue;
    heads[i].default_text =
        written(parameters[i], parameters[i].numbers(defaults), parameters[i].value(defaults));
  }
  return heads;
}

/// What is wrong with settings before anything is computed.
struct Objection {
  std::string setting;  ///< "saturation_pressure"; the caller maps it to its own spelling
  std::string got;
  std::string expected;
  std::string remedy = {};
  bool is_about_use = false;  ///< settings that do not go together, not a value out of range
};

/// Objects to settings that do not go together.
inline Objection objection_to_use(std::string setting, std::string remedy) {
  return {.setting = std::move(setting),
          .got = "",
          .expected = "",
          .remedy = std::move(remedy),
          .is_about_use = true};
}

/// The first number of the settings that lies out of its bounds, if any. Settings that were not
/// given are in.
template <typename Table, typename Settings>
std::optional<Objection> objection_to_bounds(const Table& parameters, const Settings& settings) {
  for (const Parameter<Settings>& one : parameters) {
    for (const double number : one.numbers(settings)) {
      if (one.bounds.contain(number)) continue;
      return Objection{.setting = one.name,
                       .got = text_of(number, one),
                       .expected = one.bounds.text + (std::isinf(number) ? ", and finite" : "")};
    }
  }
  return std::nullopt;
}

/// Columns of the settings in force, for JSON objects and attributes; lists have none.
template <typename Settings>
Columns<Settings> columns_of(const Parameters<Settings>& parameters) {
  Columns<Settings> columns;
  for (const Parameter<Settings>& one : parameters) {
    columns.emplace_back(one.json_key(), si_unit(one.dimension), "", one.in_force);
  }
  return columns;
}

}  // namespace tabor
