// What is proposed to whoever forgets a unit: every dimensional option and key is asked.
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <sstream>

#include "run_tabor.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/likely_unit.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/text/toml.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

/// Within these bounds [SI] nobody would wonder about a value.
struct Plausible {
  Dimension dimension;
  double least, most;
};

constexpr Plausible kSurfaceLength{dimension::length, 1e-13, 0.1};
constexpr Plausible kModulus{dimension::pressure, 1e5, 2e12};
constexpr Plausible kOilPressureViscosity{dimension::per_pressure, 1e-10, 1e-6};
constexpr Plausible kOilViscosity{dimension::viscosity, 1e-5, 100};
constexpr Plausible kOilDensity{dimension::density, 500, 3000};

const std::map<std::string, Plausible>& plausible_options() {
  static const std::map<std::string, Plausible> table = {
      {"--pressure", {dimension::pressure, 1, 1e10}},
      {"--youngs-modulus", kModulus},
      {"--counter-youngs-modulus", kModulus},
      {"--bulk-modulus", kModulus},
      {"--saturation-pressure", {dimension::pressure, 1e5, 1e11}},
      {"--shear-strength", {dimension::pressure, 1e3, 1e10}},
      {"--boundary-shear-strength", {dimension::pressure, 1e3, 1e10}},
      {"--eyring-stress", {dimension::pressure, 1e4, 1e9}},
      {"--density", {dimension::areal_density, 1e-9, 0.1}},
      {"--oil-density", kOilDensity},
      {"--viscosity", kOilViscosity},
      {"--pressure-viscosity", kOilPressureViscosity},
      {"--speed", {dimension::speed, 1e-7, 100}},
      {"--force", {dimension::force, 1e-6, 1e7}},  // of a microscope, of a press
      {"--fit-min", {dimension::wavevector, 1, 1e12}},
      {"--hardening", {dimension::pressure_gradient, 1e9, 1e16}},
      {"--wear-coefficient", {dimension::per_pressure, 0, 1e-8}},
      {"--fit-max", {dimension::wavevector, 1, 1e12}},
      {"--profile-cutoff", {dimension::length, 1e-6, 0.1}}};
  return table;
}

constexpr const char* kBareNumbers[] = {"0.001", "0.05", "0.9", "3",    "20",
                                        "70",    "250",  "900", "5000", "2e6"};

/// Why `assign` rejects the value, "" if it takes it.
std::string complaint(const std::function<void(const std::string&)>& assign,
                      const std::string& value) {
  try {
    assign(value);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool is_dimensional(const cli::Option& option) {
  return !option.is_switch() &&
         complaint(option.assign, "0.9").find("without a unit") != std::string::npos;
}

/// Calls `look` with every dimensional option of every verb.
void for_each_dimensional_option(const std::function<void(const cli::Option&)>& look) {
  for (const cli::Verb& verb : cli::verbs()) {
    cli::OptionSet set;
    const cli::Action action = verb.declare(set);
    for (const cli::Option& option : set.options()) {
      if (is_dimensional(option)) look(option);
    }
  }
}

std::string after(const std::string& text, const std::string& words) {
  const std::size_t place = text.find(words);
  return place == std::string::npos ? "" : text.substr(place + words.size());
}

TEST(MissingUnit, OfEveryOptionIsMendedByWhatTheMessageProposes) {
  int n_options = 0;
  for_each_dimensional_option([&](const cli::Option& option) {
    ++n_options;
    const auto known = plausible_options().find(option.flag);
    const Plausible& plausible =
        known == plausible_options().end() ? kSurfaceLength : known->second;
    for (const char* number : kBareNumbers) {
      const std::string hint =
          after(complaint(option.assign, number), "for example " + option.flag + " ");
      ASSERT_NE(hint, "") << option.flag << ' ' << number;
      EXPECT_EQ(complaint(option.assign, hint), "") << option.flag;
      const double value = parse_si(hint, plausible.dimension, option.flag);
      EXPECT_GE(value, plausible.least) << option.flag << ' ' << number << " -> " << hint;
      EXPECT_LE(value, plausible.most) << option.flag << ' ' << number << " -> " << hint;
    }
  });
  EXPECT_GT(n_options, 30);
}

TEST(MissingUnit, OfEveryOptionStandsInItsHelpAsItsParserTakesIt) {
  const std::regex value_with_unit("[0-9][0-9.e-]*[a-zA-Z/][A-Za-z0-9/^*]*");
  for_each_dimensional_option([&](const cli::Option& option) {
    const std::string& help = option.help;
    for (std::sregex_iterator found(help.begin(), help.end(), value_with_unit), end; found != end;
         ++found) {
      const std::string value = found->str() + (option.flag == "--shift" ? ",1um" : "");
      EXPECT_EQ(complaint(option.assign, value), "") << option.flag << ": " << help;
    }
  });
}

TEST(MissingUnit, IsProposedByTheQuantityAndNotByItsDimension) {
  const auto proposed = [](const char* number, const char* name, Dimension dimension) {
    return with_likely_unit(number, name, dimension).as_word();
  };
  EXPECT_EQ(proposed("70", "--youngs-modulus", dimension::pressure), "70GPa");
  EXPECT_EQ(proposed("7e10", "--counter-youngs-modulus", dimension::pressure), "7e10Pa");
  EXPECT_EQ(proposed("7", "--pressure", dimension::pressure), "7MPa");
  EXPECT_EQ(proposed("7e6", "--pressure", dimension::pressure), "7e6Pa");
  EXPECT_EQ(proposed("0.9", "--oil-density", dimension::density), "0.9g/cm^3");
  EXPECT_EQ(proposed("900", "--oil-density", dimension::density), "900kg/m^3");
  EXPECT_EQ(proposed("12", "--oil-density", dimension::density), "900kg/m^3");
  EXPECT_EQ(proposed("0.1", "--fit-min", dimension::wavevector), "0.1/um");
  EXPECT_EQ(proposed("2e-8", "--pressure-viscosity", dimension::per_pressure), "2e-8/Pa");
  EXPECT_EQ(proposed("1e-15", "wear.coefficient", dimension::per_pressure), "1e-15m^2/N");
  EXPECT_EQ(proposed("20", "--pressure-viscosity", dimension::per_pressure), "20/GPa");
  EXPECT_EQ(proposed("10", "ball.radius", dimension::length), "10mm");
  EXPECT_EQ(proposed("0.67", "scan.pixel", dimension::length), "0.67um");
  EXPECT_EQ(proposed("0", "--density", dimension::areal_density), "0g/m^2");
}

constexpr Plausible kBody{dimension::length, 1e-6, 100};
constexpr Plausible kMotion{dimension::speed, 1e-7, 100};

/// The keys of cases and studies that have a dimension.
const std::map<std::string, Plausible>& plausible_keys() {
  static const std::map<std::string, Plausible> table = {
      {"ball.radius", kBody},
      {"ball.radius_x", kBody},
      {"ball.radius_y", kBody},
      {"ball.mass", {dimension::mass, 1e-9, 1e3}},
      {"ball.speed", kMotion},
      {"ball.load", {dimension::force, 1e-6, 1e6}},
      {"cylinder.radius", kBody},
      {"cylinder.load_per_length", {dimension::force_per_length, 1e-2, 1e9}},
      {"roller.effective_radius", kBody},
      {"roller.mass_per_length", {dimension::mass_per_length, 1e-6, 1e5}},
      {"roller.spring", {dimension::pressure, 1e6, 1e13}},
      {"roller.damping", {dimension::viscosity, 1e-3, 1e9}},
      {"roller.speed", kMotion},
      {"motion.speed", kMotion},
      {"motion.sliding_speed", kMotion},
      {"motion.entrainment_speed", kMotion},
      {"motion.duration", {dimension::time, 1e-6, 1e4}},
      {"solids.e_prime", kModulus},
      {"solids.youngs_modulus", kModulus},
      {"solids.counter_youngs_modulus", kModulus},
      {"solids.plastic_pressure", {dimension::pressure, 1e7, 1e11}},
      {"lubricant.viscosity", kOilViscosity},
      {"lubricant.pressure_viscosity", kOilPressureViscosity},
      {"lubricant.temperature", {dimension::temperature, 200, 700}},
      {"lubricant.layer", {dimension::length, 1e-9, 0.1}},
      {"lubricant.eyring_stress", {dimension::pressure, 1e4, 1e9}},
      {"lubricant.limiting_stress", {dimension::pressure, 1e4, 1e10}},
      {"lubricant.oil_density", kOilDensity},
      {"lubricant.droplet", kSurfaceLength},
      {"asperities.boundary_film", {dimension::length, 1e-10, 1e-6}},
      {"asperities.shear_strength", {dimension::pressure, 1e3, 1e10}},
      {"wear.coefficient", {dimension::per_pressure, 1e-25, 1e-8}},
      {"wear.density", {dimension::density, 500, 25000}},
      {"wear.width", kBody},
      {"wear.track_length", {dimension::length, 1e-6, 1e4}},
      {"wear.stroke", kBody},
      {"grid.time_step", {dimension::time, 1e-12, 1e-2}},
      {"impact.profiles", {dimension::time, 1e-10, 1}},
      {"material.youngs_modulus", kModulus},
      {"material.counter_youngs_modulus", kModulus},
      {"material.saturation_pressure", {dimension::pressure, 1e5, 1e11}},
      {"shear_strength", {dimension::pressure, 1e3, 1e10}},
      {"sweep.mean_pressure", {dimension::pressure, 1, 1e10}},
      {"sweep.lubricant_density", {dimension::areal_density, 1e-9, 0.1}},
      {"sweep.sliding_speed", kMotion},
      {"scan.pixel", kSurfaceLength}};
  return table;
}

TEST(MissingUnit, OfEveryKeyIsMendedByWhatTheMessageProposes) {
  for (const auto& [key, plausible] : plausible_keys()) {
    for (const char* number : kBareNumbers) {
      // Once as text without a unit, once as a number of the file.
      for (const std::string& value : {"\"" + std::string(number) + "\"", std::string(number)}) {
        const std::string text = key + " = " + value + "\n";
        const auto config = io::Config::parse(text, "case.toml");
        std::string message;
        try {
          config.quantity(key, plausible.dimension);
        } catch (const InputError& error) {
          message = error.what();
        }
        std::smatch hint;
        ASSERT_TRUE(std::regex_search(message, hint, std::regex("(?:example|=) \"([^\"]*)\"")))
            << text << message;
        const double proposed = parse_si(hint[1].str(), plausible.dimension, key);
        EXPECT_GE(proposed, plausible.least) << text << message;
        EXPECT_LE(proposed, plausible.most) << text << message;
      }
    }
  }
}

TEST(MissingUnit, IsKnownOfEveryKeyOfACase) {
  // Lengths of a surface or a grid, for which the usual unit of lengths does.
  const std::regex no_table("(roughness|grid|film|groups)\\..*|wear\\.wave_amplitude");
  for (const ehl::Program& program : ehl::programs()) {
    for (const ParameterHead& key : program.keys) {
      EXPECT_TRUE(key.shown_unit().empty() || plausible_keys().count(key.name) == 1 ||
                  std::regex_match(key.name, no_table))
          << "what is an ordinary value of " << key.name << "? See core/likely_unit.cpp";
    }
  }
}

}  // namespace
}  // namespace tabor::test
