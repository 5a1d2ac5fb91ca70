#include "tabor/cases/parameters.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <set>

#include "tabor/core/text.hpp"

namespace tabor::cases {
namespace {

/// The words of an example, of its own dimension.
class Example : public Given {
 public:
  explicit Example(const ParameterHead& parameter) : parameter_(parameter) {}
  double number(const Dimension& expected) const override {
    return parse_si(parameter_.example, expected, parameter_.option());
  }
  std::vector<double> numbers(const Dimension& expected) const override {
    return parse_si_list(parameter_.example, expected, parameter_.option());
  }
  std::uint64_t count() const override { return std::stoull(parameter_.example); }
  bool flag() const override { return true; }
  std::string word(const std::vector<std::string>& choices) const override {
    EXPECT_THAT(choices, testing::Contains(parameter_.example));
    return parameter_.example;
  }
  std::string text() const override { return parameter_.example; }
  std::vector<std::string> texts() const override { return {parameter_.example}; }
  bool is_word(const std::string&) const override { return false; }

 private:
  const ParameterHead& parameter_;
};

TEST(Parameters, HaveAnExampleThatIsReadLiesWithinBoundsAndIsTheDefaultWhereThereIsOne) {
  for (const auto& one : case_parameters()) {
    SCOPED_TRACE(one.name);
    EXPECT_FALSE(one.help.empty());
    CaseSettings settings;
    one.read(settings, Example(one));
    for (const double number : one.numbers(settings)) EXPECT_TRUE(one.bounds.contain(number));
    if (one.has_default()) {
      EXPECT_EQ(one.value(settings), one.value({}));
    }
  }
}

TEST(Parameters, AreNamedOnceOnEverySide) {
  std::set<std::string> names, options, keys, arguments;
  for (const ParameterHead& one : case_parameters()) {
    SCOPED_TRACE(one.name);
    EXPECT_TRUE(names.insert(one.name).second);
    EXPECT_TRUE(options.insert(one.option()).second);
    EXPECT_TRUE(arguments.insert(one.python_argument()).second);
    if (!one.study_key.empty()) {
      EXPECT_TRUE(keys.insert(one.study_key).second);
    }
    EXPECT_EQ(find_parameter(one.name), &one);
  }
  EXPECT_EQ(find_parameter("edges"), nullptr);
}

TEST(Parameters, ThatOthersDecideAboutSayWhatHolds) {
  const auto in_force = [](const char* name, const CaseSettings& settings) {
    return parameter_of(case_parameters(), name).in_force(settings);
  };
  EXPECT_EQ(in_force("boundary", {}), Cell(std::string("periodic")));
  CaseSettings settings;
  settings.friction.shear_strength = 2e8;
  EXPECT_EQ(in_force("boundary_shear_strength", settings), Cell());
  settings.friction.boundary_shear_share = 0.25;
  EXPECT_EQ(in_force("boundary_shear_strength", settings), Cell(5e7));
}

TEST(ObjectionToBounds, NamesTheSettingAndWhatIsExpected) {
  FilmSettings film;
  EXPECT_FALSE(objection_to_bounds(film_parameters(), film));
  film.lubricant_densities = {0, 1e-3, -1e-3};
  auto found = objection_to_bounds(film_parameters(), film);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->setting, "lubricant_density");
  EXPECT_EQ(found->got, "-1 g/m^2");
  EXPECT_EQ(found->expected, "zero or more");
  film.lubricant_densities = {};
  film.droplet_height = 0;
  found = objection_to_bounds(film_parameters(), film);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->setting, "droplet_height");
  EXPECT_EQ(found->expected, "more than zero");
  film.droplet_height = std::numeric_limits<double>::infinity();
  EXPECT_EQ(objection_to_bounds(film_parameters(), film)->expected, "more than zero, and finite");
}

}  // namespace
}  // namespace tabor::cases
