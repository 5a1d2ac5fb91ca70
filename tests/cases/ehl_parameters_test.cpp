// What is true of every line of the tables that cases are read by.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/rejection.hpp"
#include "tabor/cases/ehl/impact_parameters.hpp"
#include "tabor/cases/ehl/line_parameters.hpp"
#include "tabor/cases/ehl/point_case.hpp"
#include "tabor/cases/ehl/point_parameters.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/cases/ehl/squeeze_parameters.hpp"
#include "tabor/record/settings_file.hpp"

namespace tabor::ehl {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const Program& program_of(const std::string& name) {
  return *std::find_if(programs().begin(), programs().end(),
                       [&](const Program& one) { return one.name == name; });
}

class EhlParameters : public testing::TestWithParam<const char*> {
 protected:
  const Program& program() const { return program_of(GetParam()); }
  io::Config template_case() const {
    return io::Config::parse(case_template(program()), "case.toml");
  }
  /// What is said of the template with one other value, in TOML.
  std::string complaint(const std::string& key, const std::string& value) const {
    return test::rejection([&] { check_case(program(), template_case().with(key, value)); });
  }
};

/// A number of this key as TOML writes it, with its unit.
std::string toml_of(double value, const ParameterHead& key) {
  const std::string unit = key.shown_unit();
  return unit.empty() ? fmt::format("{}", value) : fmt::format("\"{} {}\"", value, unit);
}

/// Numbers next to both ends of the bounds, out of them.
std::vector<double> out_of(const Bounds& bounds) {
  std::vector<double> numbers;
  if (std::isfinite(bounds.least)) {
    numbers.push_back(bounds.least_is_out ? bounds.least : bounds.least - 1);
  }
  if (std::isfinite(bounds.most)) numbers.push_back(2 * bounds.most);
  return numbers;
}

TEST_P(EhlParameters, SayWhatTheyAreUnderANameOfTheirOwn) {
  std::set<std::string> names;
  for (const ParameterHead& key : program().keys) {
    SCOPED_TRACE(key.name);
    EXPECT_TRUE(names.insert(key.file_key()).second);
    EXPECT_FALSE(key.meaning().empty());
    EXPECT_EQ(key.when_absent() == "required", key.needed == Needed::yes);
  }
}

TEST_P(EhlParameters, RefuseNumbersOutOfTheirBounds) {
  int n_bounded = 0;
  for (const ParameterHead& key : program().keys) {
    EXPECT_EQ(key.bounds.text.empty(), out_of(key.bounds).empty()) << key.name;
    for (const double number : out_of(key.bounds)) {
      ++n_bounded;
      const std::string said = complaint(key.name, toml_of(number, key));
      EXPECT_THAT(said,
                  AllOf(HasSubstr("case.toml: " + key.name + ": got "), Not(HasSubstr("\n"))));
      EXPECT_TRUE(said.ends_with("expected " + key.bounds.text)) << said;
    }
  }
  EXPECT_GT(n_bounded, 8);
}

TEST_P(EhlParameters, RefuseAnotherDimensionAndWordsThatAreNoChoice) {
  for (const ParameterHead& key : program().keys) {
    if (key.dimension != dimension::none) {
      const std::string other = key.dimension == dimension::temperature ? "5 kg" : "5 K";
      EXPECT_THAT(complaint(key.name, '"' + other + '"'),
                  AllOf(HasSubstr(key.name), HasSubstr("unit"), Not(HasSubstr("\n"))));
    }
    if (key.words.empty()) continue;
    const std::string said = complaint(key.name, "\"none of them\"");
    for (const std::string& word : key.words) {
      EXPECT_THAT(said, AllOf(HasSubstr(key.name), HasSubstr(word), Not(HasSubstr("\n"))));
    }
  }
}

TEST_P(EhlParameters, OfWhichACaseLacksOneItNeedsAreNamed) {
  for (const ParameterHead& key : program().keys) {
    if (key.needed != Needed::yes) continue;
    io::Config config = io::Config::parse("", "case.toml");
    for (const auto& [name, value] : program().example) {
      if (name != key.name) config = config.with(name, value);
    }
    EXPECT_EQ(test::rejection([&] { check_case(program(), config); }),
              "case.toml: " + key.name + " is missing");
  }
}

INSTANTIATE_TEST_SUITE_P(EhlPrograms, EhlParameters,
                         testing::Values("impact", "squeeze", "line", "point"),
                         [](const auto& test) { return std::string(test.param); });

/// Equal, no number being equal to none.
bool are_equal(const Cell& a, const Cell& b) {
  const auto is_none = [](const Cell& cell) {
    const auto* const number = std::get_if<double>(&cell);
    return number != nullptr && std::isnan(*number);
  };
  return is_none(a) && is_none(b) ? true : a == b;
}

/// Whether a setting is what it is by default.
template <typename Settings>
bool is_usual(const Parameter<Settings>& one, const Settings& settings) {
  return are_equal(one.value(settings), one.value({})) && one.numbers(settings) == one.numbers({});
}

/// The template gives the values of the example, and else what holds by default; what it shows of
/// every key is read, and is the default where there is one.
template <typename Settings>
void expect_template(const Program& program, const Parameters<Settings>& parameters) {
  const io::Config config = io::Config::parse(case_template(program), program.name);
  Settings settings;
  read_settings(config, parameters, settings);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter<Settings>& one = parameters[i];
    const ParameterHead& key = program.keys[i];
    SCOPED_TRACE(program.name + ": " + one.name);
    EXPECT_EQ(key.name, one.name);
    const bool is_set = std::any_of(program.example.begin(), program.example.end(),
                                    [&](const auto& line) { return line.first == one.name; });
    EXPECT_NE(is_usual(one, settings), is_set);
    ASSERT_FALSE(key.sample().empty());
    Settings shown;
    read_setting(io::Config::parse("", "sample").with(one.name, key.sample()), one, shown);
    EXPECT_EQ(is_usual(one, shown), !key.default_text.empty()) << key.sample();
  }
}

TEST(EhlTemplate, GivesTheExampleAndElseTheDefaults) {
  expect_template(impact_program(), impact_parameters());
  expect_template(squeeze_program(), squeeze_parameters());
  expect_template(line_program(), line_parameters());
  expect_template(point_program(), point_parameters());
}

// What one setting makes of another.

/// A case in place of another: lines of TOML, and what is said of it.
struct Rule {
  std::string program;
  std::vector<std::pair<std::string, std::string>> changes;
  std::string said;
};

TEST(EhlRules, NameTheSettingThatDoesNotGoWithAnother) {
  const std::vector<Rule> rules = {
      {"impact", {{"solids.youngs_modulus", "\"1 GPa\""}}, "solids.e_prime: got beside"},
      {"impact", {{"lubricant.temperature", "\"24 degC\""}}, "temperature: got without"},
      {"impact",
       {{"lubricant.glycerol_fraction", "0.5"}},
       "glycerol_fraction: got beside viscosity"},
      {"squeeze", {{"squeeze.model", "\"linear\""}}, "roller.damping is missing"},
      {"squeeze",
       {{"squeeze.model", "\"linear\""}, {"roller.damping", "\"1e9 N s/m^2\""}},
       "roller.damping: got 1000000000 N s/m^2; expected less than the critical damping"},
      {"squeeze", {{"lubricant.viscosity_law", "\"roelands\""}}, "expected constant or barus"},
      {"line",
       {{"solids.counter_youngs_modulus", "\"1 GPa\""}},
       "counter_poissons_ratio is missing"},
      {"line", {{"motion.slide_to_roll_ratio", "2"}}, "slide_to_roll_ratio: got beside"},
      {"line", {{"asperities.friction_coefficient", "0.1"}}, "asperities: got no boundary_film"},
      {"line", {{"roughness.height", "\"1 nm\""}}, "roughness.width is missing"},
      {"line", {{"wear.coefficient", "\"1e-15 m^2/N\""}}, "wear.track_length is missing"},
      {"line",
       {{"wear.coefficient", "\"1e-15 m^2/N\""}, {"wear.width", "\"1 mm\""}},
       "wear.width: got without wear.density"},
      {"point", {{"ball.radius_x", "\"1 mm\""}}, "ball.radius: got beside radius_x"},
      {"point", {{"motion.sliding_speed", "\"1 m/s\""}}, "sliding_speed: got beside motion.speed"},
      {"point", {{"groups.M", "20"}}, "ball.load: got beside [groups]"},
      {"point", {{"lubricant.limiting_stress", "\"1 MPa\""}}, "limiting_stress: got beside"},
      {"point", {{"asperities.shear_strength", "\"1 MPa\""}}, "shear_strength: got beside"}};
  for (const Rule& rule : rules) {
    io::Config config = io::Config::parse(case_template(program_of(rule.program)), "case.toml");
    for (const auto& [key, value] : rule.changes) config = config.with(key, value);
    const std::string said = test::rejection([&] { check_case(program_of(rule.program), config); });
    EXPECT_THAT(said, AllOf(HasSubstr(rule.said), Not(HasSubstr("\n")))) << rule.program;
  }
}

TEST(EhlRules, OfAPointContactNameWhatIsMissing) {
  const io::Config whole = io::Config::parse("", "case.toml")
                               .with("ball.radius", "\"10 mm\"")
                               .with("solids.e_prime", "\"230 GPa\"")
                               .with("lubricant.viscosity", "\"0.1 Pa s\"")
                               .with("lubricant.pressure_viscosity", "\"2e-8 1/Pa\"")
                               .with("ball.load", "\"20 N\"");
  const auto said = [](const io::Config& config) {
    return test::rejection([&] { check_case(point_program(), config); });
  };
  EXPECT_EQ(said(io::Config::parse("", "case.toml")), "case.toml: ball.radius is missing");
  EXPECT_EQ(said(io::Config::parse("[ball]\nradius_x = \"1 mm\"\n", "case.toml")),
            "case.toml: ball.radius_y is missing");
  EXPECT_EQ(said(whole), "case.toml: motion.speed is missing");
  EXPECT_EQ(said(io::Config::parse("[groups]\nM = 20\n", "case.toml")),
            "case.toml: groups.L is missing");
}

TEST(EhlRules, SayWhereTheSettingStands) {
  const auto config =
      io::Config::parse("[ball]\nradius = \"10 mm\"\nload = \"-1 N\"\n", "case.toml");
  EXPECT_EQ(test::rejection([&] { check_case(point_program(), config); }),
            "case.toml:3: ball.load: got -1 N; expected a value above zero");
}

TEST(EhlGroups, FillInWhatACaseDoesNotGive) {
  const auto problem = [](const std::string& more) {
    return read_point(io::Config::parse("[groups]\nM = 20\nL = 10\n" + more, "case.toml"));
  };
  EXPECT_EQ(problem("").radius_x, 10e-3);
  EXPECT_EQ(problem("").effective_modulus, 113.2e9);
  EXPECT_EQ(material::ambient_viscosity(problem("").lubricant.viscosity), 0.0837);
  EXPECT_EQ(problem("[ball]\nradius_x = \"2 mm\"\nradius_y = \"3 mm\"\n").radius_y, 3e-3);
  EXPECT_EQ(problem("[solids]\ne_prime = \"200 GPa\"\n").effective_modulus, 100e9);
  EXPECT_EQ(problem("[lubricant]\ndensity_law = \"constant\"\n").lubricant.density.limit, 1);
  EXPECT_GT(problem("").lubricant.density.limit, 1);
}

}  // namespace
}  // namespace tabor::ehl
