#include "tabor/forming/unit_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::forming {
namespace {

enum class Kind { length, time, mass, force };

struct Word {
  std::string_view name;
  double si;
  Kind kind;
};

constexpr double kPound = 0.45359237;  // [kg], exact by definition
constexpr double kFoot = 0.3048;       // [m], exact by definition
constexpr double kGravity = 9.80665;   // [m/s^2], of the pound-force
constexpr double kInch = kFoot / 12;   // [m]
constexpr double kPoundForce = kPound * kGravity;

constexpr std::array kWords{Word{"m", 1, Kind::length},
                            Word{"cm", 1e-2, Kind::length},
                            Word{"mm", 1e-3, Kind::length},
                            Word{"um", 1e-6, Kind::length},
                            Word{"in", kInch, Kind::length},
                            Word{"ft", kFoot, Kind::length},
                            Word{"s", 1, Kind::time},
                            Word{"ms", 1e-3, Kind::time},
                            Word{"us", 1e-6, Kind::time},
                            Word{"kg", 1, Kind::mass},
                            Word{"g", 1e-3, Kind::mass},
                            Word{"mg", 1e-6, Kind::mass},
                            Word{"t", 1e3, Kind::mass},
                            Word{"lb", kPound, Kind::mass},
                            Word{"slug", kPoundForce / kFoot, Kind::mass},
                            Word{"N", 1, Kind::force},
                            Word{"kN", 1e3, Kind::force},
                            Word{"mN", 1e-3, Kind::force},
                            Word{"lbf", kPoundForce, Kind::force}};

struct Named {
  std::string_view name;
  double si;
};
constexpr std::array kPressures{Named{"Pa", 1},
                                Named{"kPa", 1e3},
                                Named{"MPa", 1e6},
                                Named{"GPa", 1e9},
                                Named{"Mbar", 1e11},
                                Named{"psi", kPoundForce / (kInch * kInch)},
                                Named{"psf", kPoundForce / (kFoot * kFoot)}};

[[noreturn]] void reject(const std::string& got) {
  std::string known;
  for (const Word& word : kWords) known += (known.empty() ? "" : " ") + std::string(word.name);
  throw InputError("unit system", got,
                   "a length, a time and a mass or force, such as mm,s,t (MPa), m,s,kg (Pa), "
                   "mm,ms,kg (GPa) or in,s,lbf (psi)",
                   "known are " + known);
}

Word word_of(std::string_view name) {
  for (const Word& word : kWords) {
    if (word.name == name) return word;
  }
  reject(fmt::format("the unknown unit '{}'", name));
}

/// The three words in the order length, time, mass or force.
std::array<Word, 3> sorted_words(std::string_view text) {
  std::array<std::optional<Word>, 3> found;
  for (const std::string& part : split(text, ',')) {
    const Word word = word_of(trim(part));
    std::optional<Word>& place =
        found.at(std::min(static_cast<std::size_t>(word.kind), std::size_t{2}));
    if (place) reject(fmt::format("'{}' with both {} and {}", text, place->name, word.name));
    place = word;
  }
  constexpr std::array kNeeded{"length", "time", "mass or force"};
  for (std::size_t i = 0; i < kNeeded.size(); ++i) {
    if (!found.at(i)) reject(fmt::format("'{}' without a {}", text, kNeeded.at(i)));
  }
  return {*found[0], *found[1], *found[2]};
}

/// Returns the common name of a pressure unit, if it has one.
std::string pressure_name(double si, const std::string& otherwise) {
  constexpr double kRounding = 1e-9;
  for (const Named& unit : kPressures) {
    if (std::abs(si / unit.si - 1) < kRounding) return std::string(unit.name);
  }
  return otherwise;
}

}  // namespace

UnitSystem unit_system(std::string_view words) {
  const auto [length, time, third] = sorted_words(words);
  UnitSystem units;
  units.words = std::string(words);
  units.speed = {fmt::format("{}/{}", length.name, time.name), length.si / time.si};
  if (third.kind == Kind::force) {
    const double pressure = third.si / (length.si * length.si);
    units.pressure = {pressure_name(pressure, fmt::format("{}/{}^2", third.name, length.name)),
                      pressure};
    units.areal_density = {fmt::format("{} {}^2/{}^3", third.name, time.name, length.name),
                           pressure * time.si * time.si / length.si};
    return units;
  }
  const double pressure = third.si / (length.si * time.si * time.si);
  units.pressure = {
      pressure_name(pressure, fmt::format("{}/({} {}^2)", third.name, length.name, time.name)),
      pressure};
  units.areal_density = {fmt::format("{}/{}^2", third.name, length.name),
                         third.si / (length.si * length.si)};
  return units;
}

}  // namespace tabor::forming
