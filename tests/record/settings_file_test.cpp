#include "tabor/record/settings_file.hpp"

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "tabor/core/names.hpp"

// Settings of files, by the table of their parameters.
namespace tabor {
namespace {

using testing::ElementsAre;

enum class Law { constant, barus };
constexpr auto kLaws = names<Law>("constant", "barus");

struct Oil {
  double viscosity = 0;
  double temperature = 300;
  std::optional<double> domain = 1.0;
  std::optional<std::uint64_t> nodes = {};
  std::vector<double> place = {};
  bool is_heavy = false;
  Law law = Law::barus;
  std::optional<std::string> kind = {};
  std::string file = {};
  std::optional<std::vector<std::string>> steps = {};
};

const Parameters<Oil>& table() {
  using One = Parameter<Oil>;
  static const Parameters<Oil> all{
      One({.name = "oil.viscosity",
           .dimension = dimension::viscosity,
           .bounds = bounds::above_zero,
           .needed = Needed::yes},
          &Oil::viscosity),
      One({.name = "temperature",
           .dimension = dimension::temperature,
           .study_key = "oil.temperature",
           .needed = Needed::unless_material},
          &Oil::temperature),
      One({.name = "oil.domain", .bounds = bounds::above_zero, .none = "auto"}, &Oil::domain),
      One({.name = "oil.nodes", .bounds = {.least = 3, .text = "3 or more"}}, &Oil::nodes),
      One({.name = "oil.place", .dimension = dimension::length}, &Oil::place),
      One({.name = "oil.is_heavy"}, &Oil::is_heavy),
      One({.name = "oil.law"}, &Oil::law, kLaws),
      One({.name = "oil.kind", .words = {"red", "blue"}}, &Oil::kind),
      One({.name = "oil.file"}, &Oil::file),
      One({.name = "oil.steps"}, &Oil::steps)};
  return all;
}

Oil read(const std::string& lines, bool has_material = true) {
  Oil oil;
  read_settings(io::Config::parse("[oil]\nviscosity = \"0.1 Pa s\"\n" + lines, "oil.toml"), table(),
                oil, has_material);
  return oil;
}

std::string rejection(const std::string& line) {
  return test::rejection([&] { read(line); });
}

TEST(SettingsFile, GivesEachMemberWhatItSays) {
  const Oil oil = read(
      "domain = 2\nnodes = 5\nplace = [\"1 m\", \"2 m\"]\nis_heavy = true\nlaw = \"constant\"\n"
      "kind = \"blue\"\nfile = \"a.h5\"\nsteps = [\"x\", \"y\"]\n");
  EXPECT_EQ(oil.viscosity, 0.1);
  EXPECT_EQ(oil.domain, 2);
  EXPECT_EQ(oil.nodes, 5U);
  EXPECT_THAT(oil.place, ElementsAre(1, 2));
  EXPECT_TRUE(oil.is_heavy);
  EXPECT_EQ(oil.law, Law::constant);
  EXPECT_EQ(oil.kind, "blue");
  EXPECT_EQ(oil.file, "a.h5");
  EXPECT_THAT(oil.steps.value(), ElementsAre("x", "y"));
}

TEST(SettingsFile, LeavesWhatItDoesNotSay) {
  const Oil oil = read("");
  EXPECT_EQ(oil.temperature, 300);
  EXPECT_EQ(oil.domain, 1);
  EXPECT_FALSE(oil.nodes || oil.kind || oil.steps);
}

TEST(SettingsFile, TakesAValueAwayByAWord) { EXPECT_FALSE(read("domain = \"auto\"\n").domain); }

TEST(SettingsFile, GivesTemperaturesInKelvin) {
  EXPECT_EQ(read("temperature = \"24 degC\"\n").temperature, 24 + 273.15);
  EXPECT_EQ(read("temperature = \"24 °C\"\n").temperature, 24 + 273.15);
  EXPECT_EQ(read("temperature = \"297 K\"\n").temperature, 297);
}

TEST(SettingsFile, MustHaveWhatIsNeeded) {
  Oil oil;
  const auto without = io::Config::parse("[oil]\nlaw = \"barus\"\n", "oil.toml");
  EXPECT_EQ(test::rejection([&] { read_settings(without, table(), oil); }),
            "oil.toml: oil.viscosity is missing");
  EXPECT_EQ(test::rejection([] { read("", false); }), "oil.toml: oil.temperature is missing");
}

TEST(SettingsFile, IsToldWhereAValueMakesNoSense) {
  EXPECT_EQ(rejection("domain = 0\n"), "oil.toml:3: oil.domain: got 0; expected more than zero");
  EXPECT_EQ(rejection("nodes = 2\n"), "oil.toml:3: oil.nodes: got 2; expected 3 or more");
  EXPECT_EQ(rejection("nodes = -2\n"), "oil.toml:3: oil.nodes: got -2; expected 3 or more");
  EXPECT_EQ(rejection("law = \"baruss\"\n"),
            "oil.toml:3: oil.law: got 'baruss'; expected constant or barus; did you mean 'barus'?");
  EXPECT_EQ(rejection("kind = \"green\"\n"),
            "oil.toml:3: oil.kind: got 'green'; expected red or blue");
  EXPECT_EQ(rejection("is_heavy = 1\n"),
            "oil.toml:3: oil.is_heavy: got the number 1; expected true or false");
}

}  // namespace
}  // namespace tabor
