#include "tabor/cases/ehl/program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cli {
namespace {

using test::Outcome;
using test::run_tabor;
using testing::HasSubstr;

using Texts = std::vector<std::string>;

const std::string kGiven =
    "[solids]\ne_prime = \"230 GPa\"\n[lubricant]\nviscosity = \"0.1 Pa s\"\n"
    "pressure_viscosity = \"1.5e-8 1/Pa\"\n";
const std::string kDerived =
    "[solids]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n"
    "counter_youngs_modulus = \"210 GPa\"\ncounter_poissons_ratio = 0.3\n[lubricant]\n"
    "glycerol_fraction = 0.5\ntemperature = \"24 degC\"\npressure_viscosity = \"1.5e-8 1/Pa\"\n";

/// Small cases that say as little as they can, in all the ways there are to say it.
const std::map<std::string, Texts>& cases() {
  static const std::map<std::string, Texts> all = [] {
    const std::string ball = "ball = {radius = \"10 mm\", mass = \"32 g\", speed = \"0.2 m/s\"}\n";
    const std::string small = "[grid]\nnodes = 60\n";
    const std::string roller =
        "roller = {mass_per_length = \"30 kg/m\", effective_radius = \"9 mm\", "
        "spring = \"2e10 N/m^2\", speed = \"0.25 m/s\"}\ngrid = {time_step = \"20 us\"}\n"
        "[lubricant]\npressure_viscosity = \"1.5e-8 1/Pa\"\nlayer = \"0.4 mm\"\n";
    const std::string mixture = "glycerol_fraction = 0.99\ntemperature = \"24 degC\"\n";
    const std::string cylinder =
        "cylinder = {radius = \"2.5 mm\", load_per_length = \"5000 N/m\"}\n"
        "motion = {entrainment_speed = \"0.5 m/s\"}\ngrid = {nodes = 300}\n";
    const std::string sliding =
        "ball = {radius = \"10 mm\", load = \"20 N\"}\nmotion = {speed = \"5 m/s\"}\n"
        "grid = {nodes = 33}\n";
    const std::string ellipsoid =
        "ball = {radius_x = \"10 mm\", radius_y = \"12 mm\", load = \"20 N\"}\n"
        "motion = {entrainment_speed = \"5 m/s\"}\ngrid = {nodes = 33}\n";
    const std::string layer = "layer = \"50 um\"\n";
    return std::map<std::string, Texts>{
        {"impact", {ball + kGiven + layer + small, ball + kDerived + layer + small}},
        {"squeeze", {roller + "viscosity = \"0.5 Pa s\"\n", roller + mixture}},
        {"line", {cylinder + kGiven, cylinder + kDerived}},
        {"point",
         {sliding + kGiven, ellipsoid + kDerived,
          "groups = {M = 20, L = 10}\ngrid = {nodes = 33}\n"}}};
  }();
  return all;
}

const Texts kWear = {"wear.coefficient=1e-15 m^2/N", "wear.track_length=20 mm",
                     "motion.sliding_speed=1 m/s", "wear.steps=5"};
const Texts kBump = {"roughness.bump.height=20 nm", "roughness.bump.wavelength=400 um"};
const Texts kMoving = {"roughness.bump.height=20 nm", "roughness.bump.wavelength=400 um",
                       "motion.sliding_speed=0 m/s", "motion.duration=10 us"};

/// What must stand beside a key for it to be read.
Texts beside(const std::string& program, const std::string& key) {
  static const std::map<std::string, Texts> line = {
      {"roughness.height", {"roughness.width=100 um"}},
      {"roughness.amplitude", {"roughness.wavelength=100 um"}},
      {"wear.density", {kWear[0], kWear[1], kWear[2], kWear[3], "wear.width=1 mm"}},
      {"wear.width", {kWear[0], kWear[1], kWear[2], kWear[3], "wear.density=950 kg/m^3"}},
      {"roughness.width", {"roughness.height=10 nm"}},
      {"roughness.place", {"roughness.height=10 nm", "roughness.width=100 um"}},
      {"roughness.wavelength", {"roughness.amplitude=10 nm"}},
      {"roughness.row", {"roughness.file=" TABOR_SOURCE_DIR "/surfaces/edt_before.x3p"}},
      {"film.penalty", {"film.cavitation=penalty"}},
      {"wear.waves", {kWear[0], kWear[1], kWear[2], kWear[3], "wear.wave_amplitude=10 nm"}}};
  static const std::map<std::string, Texts> point = {
      {"lubricant.limiting_coefficient", {"lubricant.limiting_stress=100 MPa"}},
      {"roughness.bump.wavelength", {"roughness.bump.height=20 nm"}},
      {"roughness.bump.place", kBump},
      {"roughness.channel", {"roughness.file=" TABOR_SOURCE_DIR "/surfaces/edt_before.x3p"}},
      {"roughness.treatment", {"roughness.file=" TABOR_SOURCE_DIR "/surfaces/edt_before.x3p"}},
      {"motion.duration", kMoving},
      {"grid.time_step", kMoving}};
  if (program == "impact") return {};
  if (program == "squeeze") {
    return key == "roller.damping" ? Texts{"squeeze.model=linear"} : Texts{};
  }
  const auto& known = program == "line" ? line : point;
  if (const auto found = known.find(key); found != known.end()) return found->second;
  if (key.starts_with("wear.") && key != "wear.coefficient") {
    return key == "wear.steps" ? Texts{kWear[0], kWear[1], kWear[2]} : kWear;
  }
  const bool is_of_kind = program == "point" && key.starts_with("roughness.") &&
                          !key.starts_with("roughness.bump") && key != "roughness.file" &&
                          key != "roughness.kind";
  return is_of_kind ? Texts{"roughness.kind=ground"} : Texts{};
}

class EhlKeyTable : public testing::TestWithParam<std::string> {
 protected:
  const ehl::Program& program() const {
    for (const ehl::Program& program : ehl::programs()) {
      if (program.name == GetParam()) return program;
    }
    throw InputError(GetParam());
  }

  Outcome run(const std::string& text, const std::string& as, const Texts& changes) const {
    std::ofstream(file_) << text;
    Texts words = {"ehl", as, file_, "--json"};
    for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
    return run_tabor(words);
  }

  test::Folder folder_;
  std::string file_ = folder_ / "case.toml";
};

/// Whether the unit that a message proposes, if it does, is one of the same quantity.
bool fits(const std::string& unit, const std::string& message) {
  const std::string before = "a unit such as ";
  const std::size_t begin = message.find(before);
  if (begin == std::string::npos) return false;
  const std::size_t end = message.find_first_of(";\n\"", begin + before.size());
  const std::string proposed = message.substr(begin + before.size(), end - begin - before.size());
  return proposed.empty() ||
         parse_quantity("1 " + proposed).dimension == parse_quantity("1 " + unit).dimension;
}

TEST_P(EhlKeyTable, EveryKeyIsReadInItsUnit) {
  for (const ParameterHead& key : program().keys) {
    const std::string wrong = key.shown_unit() == "K" ? "1 kg" : "1 K";
    Texts changes = beside(GetParam(), key.name);
    changes.push_back(key.name + "=" + wrong);
    std::string said;
    bool is_rejected = false;
    for (const std::string& text : cases().at(GetParam())) {
      const Outcome outcome = run(text, GetParam(), changes);
      const auto has = [&](const std::string& part) {
        return outcome.err.find(part) != std::string::npos;
      };
      const std::string name = key.name.substr(key.name.rfind('.') + 1);
      bool is_it = outcome.code == 3 && has(wrong) && (has(name) || name == "file");
      if (!key.shown_unit().empty()) {
        is_it = is_it && has("whose unit does not fit") && fits(key.shown_unit(), outcome.err);
      }
      is_rejected = is_rejected || is_it;
      said += outcome.err + '\n';
    }
    EXPECT_TRUE(is_rejected) << key.name << ": " << said;
  }
}

/// A default that can be given as it stands.
bool is_value(const std::string& usual) {
  static const std::set<std::string> words = {
      "true",     "false",    "rigid",        "reynolds",     "barus",
      "roelands", "constant", "hydrodynamic", "longitudinal", "[\"0 m\", \"0 m\"]"};
  if (words.contains(usual)) return true;
  try {
    parse_quantity(usual);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Equal but for what the last digit of a default may change.
void expect_same(const io::Json& a, const io::Json& b, const std::string& where) {
  if (a.is_number_float() && b.is_number_float()) {
    // What is left of a balance that is met is rounding, and compares with one.
    const double rounding =
        where.ends_with("_error") ? 8 * std::numeric_limits<double>::epsilon() : 0.0;
    EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-5 * std::abs(b.get<double>()) + rounding)
        << where;
  } else if (a.is_object() && b.is_object()) {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (const auto& [key, value] : a.items()) {
      expect_same(value, b.value(key, io::Json()), where + " " + key);
    }
  } else {
    EXPECT_EQ(a, b) << where;
  }
}

TEST_P(EhlKeyTable, GivingADefaultChangesNothing) {
  int n_tried = 0;
  const std::string& text = cases().at(GetParam()).front();
  std::map<Texts, Outcome> without_keys;  // by what stands beside them: mostly nothing
  for (const ParameterHead& key : program().keys) {
    if (!is_value(key.when_absent()) || key.name.starts_with("grid.nodes")) continue;
    Texts changes = beside(GetParam(), key.name);
    if (!without_keys.contains(changes)) without_keys[changes] = run(text, GetParam(), changes);
    const Outcome& without = without_keys.at(changes);
    changes.push_back(key.name + "=" + key.when_absent());
    const Outcome with = run(text, GetParam(), changes);
    ASSERT_EQ(without.code, 0) << key.name << ": " << without.err;
    const auto numbers = [](const Outcome& outcome) {
      io::Json json = io::Json::parse(outcome.out);
      json.erase("command");
      return json;
    };
    ASSERT_EQ(with.code, 0) << key.name << ": " << with.err;
    expect_same(numbers(with), numbers(without), key.name);
    ++n_tried;
  }
  EXPECT_GE(n_tried, 3);
}

TEST_P(EhlKeyTable, HelpListsEveryKey) {
  const Outcome outcome = run_tabor({"ehl", GetParam(), "--help"});
  EXPECT_EQ(outcome.code, 0);
  for (const ParameterHead& key : program().keys) {
    EXPECT_THAT(outcome.out, testing::ContainsRegex("\n  " + key.name + "[ \n]"));
    EXPECT_FALSE(key.meaning().empty()) << key.name;
  }
  for (const ehl::Program& other : ehl::programs()) {
    const std::string title = "Keys of a case of 'tabor ehl " + other.name;
    EXPECT_EQ(outcome.out.find(title) != std::string::npos, other.name == GetParam());
  }
  EXPECT_EQ(run_tabor({"help", "ehl", GetParam()}).out, outcome.out);
}

TEST_P(EhlKeyTable, ACaseOfAnotherProgramIsSaidToBeOne) {
  for (const auto& [name, texts] : cases()) {
    if (name == GetParam()) continue;
    for (const std::string& text : texts) {
      const Outcome outcome = run(text, GetParam(), {});
      EXPECT_EQ(outcome.code, 3) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("a case of 'tabor ehl " + name + "'"));
      EXPECT_EQ(test::count_lines(outcome.err), 1u) << outcome.err;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EhlPrograms, EhlKeyTable,
                         testing::Values("impact", "squeeze", "line", "point"),
                         [](const auto& test) { return test.param; });

TEST(EhlKeys, AnUnknownKeyNamesItsNeighbourInAnyTable) {
  const test::Folder folder;
  const std::string file = folder / "roller.toml";
  const auto complaint = [&](const std::string& change) {
    std::ofstream(file) << cases().at("squeeze").front();
    return run_tabor({"ehl", "squeeze", file, "--set", change}).err;
  };
  EXPECT_THAT(complaint("roller.radius=9mm"), HasSubstr("did you mean 'roller.effective_radius'"));
  EXPECT_THAT(complaint("roller.viscosity=1 Pa s"),
              HasSubstr("did you mean 'lubricant.viscosity'"));
  EXPECT_THAT(complaint("sliding_speed=1 m/s"), HasSubstr("did you mean 'motion.sliding_speed'"));
  EXPECT_THAT(complaint("roller.spede=1 m/s"), HasSubstr("did you mean 'roller.speed'"));
  EXPECT_THAT(complaint("roller.colour=1"), testing::Not(HasSubstr("did you mean")));
}

}  // namespace
}  // namespace tabor::cli
