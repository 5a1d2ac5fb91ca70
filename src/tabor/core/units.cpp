#include "tabor/core/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "tabor/core/error.hpp"
#include "tabor/core/likely_unit.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/value_range.hpp"

namespace tabor {
namespace {

struct Unit {
  std::string_view name;
  double factor;
  Dimension dimension;
  bool takes_prefix;
};

constexpr double kDegree = 3.14159265358979323846 / 180;

constexpr double kPsi =
    4.4482216152605 / (0.0254 * 0.0254);  // a pound-force on a square inch, both exact

constexpr std::array kUnits{
    Unit{"m", 1, {1, 0, 0, 0}, true},
    Unit{"g", 1e-3, {0, 1, 0, 0}, true},
    Unit{"s", 1, {0, 0, 1, 0}, true},
    Unit{"K", 1, {0, 0, 0, 1}, true},
    Unit{"Pa", 1, {-1, 1, -2, 0}, true},
    Unit{"N", 1, {1, 1, -2, 0}, true},
    Unit{"J", 1, {2, 1, -2, 0}, true},
    Unit{"W", 1, {2, 1, -3, 0}, true},
    Unit{"Hz", 1, {0, 0, -1, 0}, true},
    Unit{"l", 1e-3, {3, 0, 0, 0}, true},
    Unit{"L", 1e-3, {3, 0, 0, 0}, true},
    Unit{"bar", 1e5, {-1, 1, -2, 0}, true},
    Unit{"P", 0.1, {-1, 1, -1, 0}, true},
    Unit{"St", 1e-4, {2, 0, -1, 0}, true},
    Unit{"Å", 1e-10, {1, 0, 0, 0}, false},
    Unit{"Ang", 1e-10, {1, 0, 0, 0}, false},
    Unit{"micron", 1e-6, {1, 0, 0, 0}, false},
    Unit{"in", 0.0254, {1, 0, 0, 0}, false},
    Unit{"inch", 0.0254, {1, 0, 0, 0}, false},
    Unit{"min", 60, {0, 0, 1, 0}, false},
    Unit{"h", 3600, {0, 0, 1, 0}, false},
    Unit{"rad", 1, {0, 0, 0, 0}, false},
    Unit{"deg", kDegree, {0, 0, 0, 0}, false},
    Unit{"%", 0.01, {0, 0, 0, 0}, false},
    Unit{"1", 1, {0, 0, 0, 0}, false},
    Unit{"psi", kPsi, {-1, 1, -2, 0}, false},
    Unit{"ksi", 1e3 * kPsi, {-1, 1, -2, 0}, false},
};

struct Prefix {
  std::string_view name;
  double factor;
};

constexpr std::array kPrefixes{
    Prefix{"f", 1e-15}, Prefix{"p", 1e-12},     Prefix{"n", 1e-9},    Prefix{"u", 1e-6},
    Prefix{"µ", 1e-6},  Prefix{"\u03bc", 1e-6}, Prefix{"\xb5", 1e-6}, Prefix{"m", 1e-3},
    Prefix{"c", 1e-2},  Prefix{"d", 1e-1},      Prefix{"k", 1e3},     Prefix{"M", 1e6},
    Prefix{"G", 1e9},   Prefix{"T", 1e12},
};

Dimension scaled(Dimension d, int power) {
  return {d.metre * power, d.kilogram * power, d.second * power, d.kelvin * power};
}

Dimension added(Dimension a, Dimension b) {
  return {a.metre + b.metre, a.kilogram + b.kilogram, a.second + b.second, a.kelvin + b.kelvin};
}

/// Spelled out parts of units.
struct Spelling {
  std::string_view word, symbol;
};

constexpr std::array kSpelledPrefixes{
    Spelling{"nano", "n"}, Spelling{"micro", "u"}, Spelling{"milli", "m"}, Spelling{"centi", "c"},
    Spelling{"kilo", "k"}, Spelling{"mega", "M"},  Spelling{"giga", "G"},  Spelling{"", ""}};

constexpr std::array kSpelledUnits{Spelling{"meter", "m"},
                                   Spelling{"metre", "m"},
                                   Spelling{"pascal", "Pa"},
                                   Spelling{"newton", "N"},
                                   Spelling{"second", "s"},
                                   Spelling{"sec", "s"},
                                   Spelling{"gram", "g"},
                                   Spelling{"kelvin", "K"},
                                   Spelling{"poise", "P"},
                                   Spelling{"angstrom", "Ang"},
                                   Spelling{"micron", "um"},
                                   Spelling{"liter", "l"},
                                   Spelling{"litre", "l"},
                                   Spelling{"minute", "min"},
                                   Spelling{"hour", "h"},
                                   Spelling{"degree", "deg"},
                                   Spelling{"percent", "%"},
                                   Spelling{"dimensionless", "1"},
                                   Spelling{"pound_force_per_square_inch", "psi"}};

/// "micrometers" -> "um"; "" for what is no unit.
std::string symbol_of_words(std::string_view words) {
  const std::string word = lower(words);
  for (const auto& [prefix, prefix_symbol] : kSpelledPrefixes) {
    if (!word.starts_with(prefix)) continue;
    const std::string_view rest = std::string_view(word).substr(prefix.size());
    for (const auto& [unit, symbol] : kSpelledUnits) {
      const bool is_plural = rest.ends_with('s') && rest.substr(0, rest.size() - 1) == unit;
      if (rest == unit || is_plural) return std::string(prefix_symbol) + std::string(symbol);
    }
  }
  return "";
}

/// A unit by its symbol, with or without a prefix.
std::optional<Quantity> find_symbol(std::string_view name) {
  for (const Unit& unit : kUnits) {
    if (name == unit.name) return Quantity{unit.factor, unit.dimension};
  }
  for (const Prefix& prefix : kPrefixes) {
    if (!name.starts_with(prefix.name)) continue;
    const std::string_view stem = name.substr(prefix.name.size());
    for (const Unit& unit : kUnits) {
      if (unit.takes_prefix && stem == unit.name) {
        return Quantity{prefix.factor * unit.factor, unit.dimension};
      }
    }
  }
  return std::nullopt;
}

/// One unit, "um" or "micrometers", without a power.
std::optional<Quantity> find_unit(std::string_view name) {
  const auto unit = find_symbol(name);
  return unit ? unit : find_symbol(symbol_of_words(name));
}

constexpr int kHighestPower = 9;  // of a unit that means something

/// "m^2", "m2", "s^-1": a unit and its integer power.
std::optional<Quantity> find_power(std::string_view factor) {
  int power = 1;
  std::string_view name = factor;
  if (const std::size_t digits = name.find_first_of("^-0123456789");
      digits != std::string_view::npos && digits > 0) {
    const std::string_view exponent = name.substr(digits + (name[digits] == '^' ? 1 : 0));
    const auto [end, error] =
        std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
    if (error != std::errc{} || end != exponent.data() + exponent.size() ||
        power < -kHighestPower || power > kHighestPower) {
      return std::nullopt;
    }
    name = name.substr(0, digits);
  }
  const auto unit = find_unit(name);
  if (!unit) return std::nullopt;
  return Quantity{std::pow(unit->value, power), scaled(unit->dimension, power)};
}

/// Signs of other programs and of print, and what stands for them here.
constexpr std::array kSigns{Spelling{" ** ", "^"},   Spelling{"**", "^"},     Spelling{"·", "*"},
                            Spelling{"\u22c5", "*"}, Spelling{"\u207b", "-"}, Spelling{"¹", "1"},
                            Spelling{"²", "2"},      Spelling{"³", "3"}};

void replace_all(std::string& text, std::string_view part, std::string_view by) {
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) {
    text.replace(at, part.size(), by);
    at += by.size();
  }
}

/// True for a full stop between two units, as in "mPa.s".
bool is_product(std::string_view expression, std::size_t dot) {
  const auto is_letter = [&](std::size_t place) {
    return place < expression.size() && std::isalpha(static_cast<unsigned char>(expression[place]));
  };
  return dot > 0 && expression[dot - 1] != '.' && is_letter(dot + 1);
}

/// "gram / meter ** 2" -> "gram / meter^2", "mPa.s" and "mPa·s" -> "mPa*s", "s⁻¹" -> "s-1"
std::string with_plain_signs(std::string_view expression) {
  std::string plain(expression);
  for (const auto& [sign, stands_for] : kSigns) replace_all(plain, sign, stands_for);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] == '.' && is_product(plain, i)) plain[i] = '*';
  }
  return plain;
}

/// "g/m^2", "Pa s", "Pa*s", "1/Pa", "kg m^-3": factors left to right, one '/' inverts what follows
/// it directly. On failure `culprit` holds the factor that is not a unit.
std::optional<Quantity> find_expression(std::string_view text, std::string& culprit) {
  const std::string expression = with_plain_signs(text);
  Quantity result{1, {}};
  int sign = 1;
  std::size_t begin = 0;
  while (begin < expression.size()) {
    const std::size_t end = std::min(expression.find_first_of(" */", begin), expression.size());
    const std::string_view factor = std::string_view(expression).substr(begin, end - begin);
    if (!factor.empty()) {
      const auto unit = find_power(factor);
      if (!unit) {
        culprit = std::string(factor);
        return std::nullopt;
      }
      result.value = sign > 0 ? result.value * unit->value : result.value / unit->value;
      result.dimension = added(result.dimension, scaled(unit->dimension, sign));
      sign = 1;
    }
    if (end < expression.size() && expression[end] == '/') sign = -1;
    begin = end + 1;
  }
  return result;
}

/// Letters that two words of one length have alike.
std::size_t n_alike(std::string_view a, std::string_view b) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += a[i] == b[i] ? 1 : 0;
  return n;
}

/// All units written like `name` but for the case of their letters.
std::vector<std::string> units_of_other_case(std::string_view name) {
  std::vector<std::string> found;
  const auto add = [&](const std::string& unit) {
    if (lower(unit) == lower(name)) found.push_back(unit);
  };
  for (const Unit& unit : kUnits) {
    add(std::string(unit.name));
    if (!unit.takes_prefix) continue;
    for (const Prefix& prefix : kPrefixes) add(std::string(prefix.name) + std::string(unit.name));
  }
  return found;
}

/// The unit that `factor` may have been meant to be, "MPa" for "Mpa"; of several `likely`, if it is
/// among them. "" if there is none.
std::string similar_unit(std::string_view factor, std::string_view likely) {
  const std::size_t end = std::min(factor.find_first_of("^-0123456789"), factor.size());
  const std::string_view name = factor.substr(0, end);
  std::string best;
  for (const std::string& unit : units_of_other_case(name)) {
    if (unit == likely || best.empty() || n_alike(unit, name) > n_alike(best, name)) best = unit;
    if (unit == likely) break;
  }
  return best.empty() ? "" : best + std::string(factor.substr(end));
}

/// "0.5um" for "0,5um"; "" if the text has no decimal comma.
std::string with_decimal_point(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma + 1 == text.size()) return "";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!is_digit(text[comma - 1]) || !is_digit(text[comma + 1])) return "";
  std::string pointed(text);
  pointed[comma] = '.';
  return parse_number(pointed.substr(0, pointed.find_first_not_of("+-0123456789.eE"))) ||
                 parse_number(pointed.substr(0, pointed.find_first_not_of("+-0123456789.")))
             ? pointed
             : "";
}

/// Splits "7e6Pa" into the longest number at its start and the rest.
std::optional<double> take_number(std::string_view& text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// As it is typed: behind its option, or in the quotes of a file.
std::string shown(std::string_view name, const WrittenValue& value) {
  if (name.starts_with("--")) return fmt::format("{} {}", name, value.as_word());
  return fmt::format("\"{}\"", value.as_text());
}

/// The values of one part of a list: those of a range, else the part itself.
std::vector<std::string> listed(const std::string& part, std::string_view name) {
  if (!is_value_range(part)) return {part};
  try {
    return values_of_range(part);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}; write a range like 2MPa..15MPa:7 or 1MPa..100MPa:log:5",
                                 name, error.what()));
  }
}

}  // namespace

namespace {

/// `likely`: the unit that an ordinary value of this number would have.
Quantity parse_quantity(std::string_view text, std::string_view likely) {
  std::string_view rest = trim(text);
  const auto number = take_number(rest);
  if (!number || !std::isfinite(*number)) {
    throw InputError(fmt::format("'{}', which does not begin with a finite number", text));
  }
  if (const std::string pointed = with_decimal_point(trim(text)); !pointed.empty()) {
    throw InputError(fmt::format("'{}' with a decimal comma; write {}", text, pointed));
  }
  std::string culprit;
  const auto unit = find_expression(trim(rest), culprit);
  if (!unit) {
    const std::string similar = similar_unit(culprit, likely);
    throw InputError(
        fmt::format("'{}': unknown unit '{}'{}", text, culprit,
                    similar.empty() ? "" : fmt::format("; did you mean '{}'?", similar)));
  }
  return {*number * unit->value, unit->dimension};
}

/// The number that a text begins with, as it is written.
std::string_view number_of(std::string_view text) {
  std::string_view rest = trim(text);
  const std::string_view whole = rest;
  return take_number(rest) ? whole.substr(0, whole.size() - rest.size()) : std::string_view();
}

}  // namespace

Quantity parse_quantity(std::string_view text) { return parse_quantity(text, ""); }

double parse_si(std::string_view text, Dimension expected, std::string_view name) {
  Quantity quantity;
  try {
    quantity = parse_quantity(text, with_likely_unit(number_of(text), name, expected).unit);
  } catch (const InputError& error) {
    const std::string likely = expected == dimension::none
                                   ? std::string("a plain number")
                                   : "a value like " + shown(name, example_value(name, expected));
    throw InputError(std::string(name), error.what(), likely, "");
  }
  if (quantity.dimension == expected) return quantity.value;
  if (quantity.dimension == dimension::none) {
    const WrittenValue likely = with_likely_unit(trim(text), name, expected);
    throw InputError(std::string(name), fmt::format("'{}' without a unit", trim(text)), "",
                     "write it with its unit, for example " + shown(name, likely));
  }
  throw InputError(std::string(name), fmt::format("'{}', whose unit does not fit", trim(text)),
                   expected == dimension::none
                       ? std::string("a plain number")
                       : "a unit such as " + example_value(name, expected).unit,
                   "");
}

std::vector<double> parse_si_list(std::string_view text, Dimension expected,
                                  std::string_view name) {
  const std::vector<std::string> parts = split(text, ',');
  std::vector<double> values;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // "0,5um": the unit stands behind the last part only.
    const bool is_bare = expected != dimension::none && parse_number(parts[i]);
    if (is_bare && i + 1 < parts.size()) {
      const std::string both = parts[i] + "," + parts[i + 1];
      if (const std::string pointed = with_decimal_point(both); !pointed.empty()) {
        throw InputError(std::string(name), fmt::format("'{}'", both),
                         "a decimal point, or a unit behind every value of a list",
                         "write " + pointed);
      }
    }
    for (const std::string& value : listed(parts[i], name)) {
      values.push_back(parse_si(value, expected, name));
    }
  }
  return values;
}

std::optional<double> unit_factor(std::string_view unit, Dimension expected) {
  std::string culprit;
  const auto found = find_expression(trim(unit), culprit);
  if (!found || found->dimension != expected) return std::nullopt;
  return found->value;
}

std::string format_si(double value, std::string_view si_unit, int significant_digits) {
  constexpr std::array<std::string_view, 9> prefixes{"f", "p", "n", "µ", "m", "", "k", "M", "G"};
  constexpr std::ptrdiff_t plain = 5;
  std::ptrdiff_t step = 0;
  if (value == 0) value = 0;  // not -0
  if (value != 0 && std::isfinite(value)) {
    step = static_cast<std::ptrdiff_t>(std::floor(std::log10(std::abs(value)) / 3 + 1e-12));
    step = std::clamp(step, -plain, std::ssize(prefixes) - 1 - plain);
  }
  return fmt::format("{:.{}g} {}{}", value * std::pow(1000.0, static_cast<double>(-step)),
                     significant_digits, *std::next(prefixes.begin(), step + plain), si_unit);
}

std::string si(double value, const std::string& unit) {
  return std::isnan(value) ? "-" : format_si(value, unit);
}

std::string plain(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string percent(double fraction, int digits) {
  if (std::isnan(fraction)) return "-";
  const double value = 100 * fraction;
  const bool is_long = std::abs(value) >= std::pow(10.0, digits) - 0.5;  // "1e+02" else
  return is_long ? fmt::format("{:.0f} %", value) : fmt::format("{:.{}g} %", value, digits);
}

double in_g_per_m2(double lubricant_density) {
  return parse_number(fmt::format("{:.15g}", 1e3 * lubricant_density)).value();
}

}  // namespace tabor
