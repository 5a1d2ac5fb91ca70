#include "tabor/record/parameter.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/names.hpp"

namespace tabor {
namespace {

using testing::ElementsAre;

enum class Kind { sheet, film };
constexpr auto kKinds = names<Kind>("sheet", "film");

struct Settings {
  double strength = 3;
  std::optional<double> cap = {};
  std::vector<double> loads = {};
  std::uint64_t seed = 1;
  bool keeps = false;
  Kind kind = Kind::sheet;
  std::optional<Kind> other = {};
  std::vector<double> places = {0, 1e-3};
};

struct Whole {
  Settings part;
};

const Parameters<Settings>& table() {
  using One = Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "shear_strength", .help = "", .dimension = dimension::pressure},
          &Settings::strength),
      One({.name = "cap", .help = "", .dimension = dimension::pressure, .none = "none"},
          &Settings::cap),
      One({.name = "load", .help = "", .dimension = dimension::force}, &Settings::loads),
      One({.name = "seed", .help = ""}, &Settings::seed),
      One({.name = "keeps", .help = ""}, &Settings::keeps),
      One({.name = "kind", .help = ""}, &Settings::kind, kKinds),
      One({.name = "other", .help = ""}, &Settings::other, kKinds),
      One({.name = "places", .help = "", .dimension = dimension::length}, &Settings::places)};
  return all;
}

/// A value that is given in SI, or a word.
class Text : public Given {
 public:
  explicit Text(std::string text) : text_(std::move(text)) {}
  double number(const Dimension&) const override { return std::stod(text_); }
  std::vector<double> numbers(const Dimension&) const override { return {std::stod(text_), 7}; }
  std::uint64_t count() const override { return std::stoull(text_); }
  bool flag() const override { return text_ == "true"; }
  std::string word(const std::vector<std::string>&) const override { return text_; }
  std::string text() const override { return text_; }
  std::vector<std::string> texts() const override { return {text_, "more"}; }
  bool is_word(const std::string& word) const override { return text_ == word; }

 private:
  std::string text_;
};

template <typename Owner>
void give(const Parameters<Owner>& parameters, const std::string& name, const std::string& text,
          Owner& settings) {
  parameter_of(parameters, name).read(settings, Text(text));
}

TEST(Parameter, ReadsWhatIsGivenIntoItsMember) {
  Settings settings;
  give(table(), "shear_strength", "5", settings);
  give(table(), "load", "4", settings);
  give(table(), "seed", "9", settings);
  give(table(), "keeps", "true", settings);
  give(table(), "kind", "film", settings);
  give(table(), "other", "film", settings);
  EXPECT_EQ(settings.strength, 5);
  EXPECT_THAT(settings.loads, ElementsAre(4, 7));
  EXPECT_EQ(settings.seed, 9U);
  EXPECT_TRUE(settings.keeps);
  EXPECT_EQ(settings.kind, Kind::film);
  EXPECT_EQ(settings.other, Kind::film);
}

TEST(Parameter, TakesAValueAwayByTheWordForNone) {
  Settings settings;
  give(table(), "cap", "6", settings);
  EXPECT_EQ(settings.cap, 6);
  give(table(), "cap", "none", settings);
  EXPECT_FALSE(settings.cap);
}

TEST(Parameter, GivesItsValueAsACell) {
  const auto value = [](const char* name, const Settings& settings) {
    return parameter_of(table(), name).value(settings);
  };
  EXPECT_EQ(value("shear_strength", {}), Cell(3.0));
  EXPECT_TRUE(std::isnan(std::get<double>(value("cap", {}))));
  EXPECT_EQ(value("load", {}), Cell());
  EXPECT_EQ(value("seed", {}), Cell(std::uint64_t{1}));
  EXPECT_EQ(value("kind", {}), Cell(std::string("sheet")));
  EXPECT_EQ(value("other", {}), Cell());
  EXPECT_EQ(value("other", {.other = Kind::film}), Cell(std::string("film")));
}

TEST(Parameter, IsThatOfAPartInTheWhole) {
  const auto parameters = within(table(), &Whole::part);
  Whole whole;
  give(parameters, "cap", "6", whole);
  EXPECT_EQ(whole.part.cap, 6);
  const auto& cap = parameter_of(parameters, "cap");
  EXPECT_EQ(cap.value(whole), Cell(6.0));
  EXPECT_THAT(cap.numbers(whole), ElementsAre(6));
  EXPECT_EQ(cap.none, "none");
}

TEST(Parameter, HasOtherValuesInForceAndInTheTextOfAResult) {
  const auto& cap = parameter_of(table(), "cap");
  const auto doubled =
      cap.with_value_in_force([](const Settings& one) { return Cell(2 * one.cap.value_or(1)); });
  EXPECT_EQ(doubled.in_force({}), Cell(2.0));
  EXPECT_EQ(doubled.identifying({}), Cell(2.0));
  EXPECT_TRUE(std::isnan(std::get<double>(doubled.value({}))));
  const auto named = cap.with_identifying_value([](const Settings&) { return Cell(8.0); });
  EXPECT_EQ(named.identifying({}), Cell(8.0));
  EXPECT_TRUE(std::isnan(std::get<double>(named.in_force({}))));
}

TEST(Parameter, IsNamedAfterItsNameEverywhere) {
  const ParameterHead head{.name = "oil_density", .help = "", .dimension = dimension::density};
  EXPECT_EQ(head.option(), "--oil-density");
  EXPECT_EQ(head.python_argument(), "oil_density");
  EXPECT_EQ(head.json_key(), "oil_density_kg_per_m3");
  const auto key = [](const Dimension& dimension) {
    return ParameterHead{.name = "x", .help = "", .dimension = dimension}.json_key();
  };
  EXPECT_EQ(key(dimension::none), "x");
  EXPECT_EQ(key(dimension::per_pressure), "x_per_Pa");
  EXPECT_EQ(key(dimension::viscosity), "x_Pa_s");
  EXPECT_EQ(key(dimension::speed), "x_m_per_s");
}

TEST(Parameter, SaysWhatHoldsWhereItIsNotGiven) {
  std::vector<ParameterHead> heads = heads_of(table());
  const auto usual = [&](const std::string& name) {
    return std::find_if(heads.begin(), heads.end(),
                        [&](const ParameterHead& one) { return one.name == name; })
        ->when_absent();
  };
  EXPECT_EQ(usual("shear_strength"), "3 Pa");
  EXPECT_EQ(usual("cap"), "");
  EXPECT_EQ(usual("seed"), "1");
  EXPECT_EQ(usual("keeps"), "false");
  EXPECT_EQ(usual("kind"), "sheet");
  EXPECT_EQ(usual("places"), "[\"0 m\", \"1 mm\"]");
  heads.push_back({.name = "given", .absent = "that of --seed"});
  heads.push_back({.name = "needed", .absent = "never", .needed = Needed::yes});
  EXPECT_EQ(usual("given"), "that of --seed");
  EXPECT_EQ(usual("needed"), "required");
}

TEST(Parameter, ShowsItsDefaultOrItsExampleAsTomlWritesIt) {
  std::vector<ParameterHead> heads = heads_of(table());
  EXPECT_EQ(heads.at(0).sample(), "\"3 Pa\"");
  EXPECT_EQ(heads.at(3).sample(), "1");
  EXPECT_EQ(heads.at(4).sample(), "false");
  EXPECT_EQ(heads.at(5).sample(), "\"sheet\"");
  EXPECT_EQ(heads.at(7).sample(), "[\"0 m\", \"1 mm\"]");
  EXPECT_EQ((ParameterHead{.name = "x", .example = "0.3"}.sample()), "0.3");
  EXPECT_EQ((ParameterHead{.name = "x", .example = "a.h5", .kind = ValueKind::text}.sample()),
            "\"a.h5\"");
  const Parameter<Settings> needed({.name = "x", .example = "5", .needed = Needed::yes},
                                   &Settings::strength);
  EXPECT_EQ(heads_of<Settings>({needed}).front().sample(), "5");
}

TEST(Parameter, SaysWhatItMeans) {
  const std::vector<ParameterHead> heads = heads_of(table());
  EXPECT_EQ(heads.at(4).meaning(), "true or false");
  EXPECT_EQ(heads.at(5).meaning(), "sheet or film");
  EXPECT_EQ((ParameterHead{.name = "x", .help = "a length", .words = {"a"}}.meaning()), "a length");
  EXPECT_EQ(one_of({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(one_of({"a"}), "a");
}

TEST(TextOfANumber, IsInTheUnitOfItsParameter) {
  const ParameterHead spring{.name = "spring", .dimension = dimension::pressure, .unit = "N/m^2"};
  EXPECT_EQ(text_of(2e9, spring), "2 GN/m^2");
  const ParameterHead wear{.name = "wear", .dimension = dimension::per_pressure, .unit = "m^2/N"};
  EXPECT_EQ(text_of(-2e-15, wear), "-2e-15 m^2/N");
  EXPECT_EQ(text_of(2e-8, dimension::per_pressure), "2e-08 1/Pa");
  EXPECT_EQ(text_of(5000, dimension::mass_per_length), "5000 kg/m");
  EXPECT_EQ(text_of(5000, dimension::force_per_length), "5 kN/m");
  EXPECT_EQ(text_of(0.45e-3, dimension::areal_density), "0.45 g/m^2");
  EXPECT_EQ(text_of(0.33, dimension::none), "0.33");
}

TEST(Bounds, LeaveOutWhatIsNoNumber) {
  EXPECT_FALSE(bounds::above_zero.contain(0));
  EXPECT_TRUE(bounds::above_zero.contain(1e-300));
  EXPECT_TRUE(bounds::zero_or_more.contain(0));
  EXPECT_FALSE(bounds::zero_or_more.contain(-1e-300));
  EXPECT_FALSE(bounds::zero_or_more.contain(std::nan("")));
  EXPECT_FALSE(bounds::above_zero.contain(HUGE_VAL));
  EXPECT_TRUE(Bounds{}.contain(-HUGE_VAL));
  const Bounds share{.least = 0, .most = 1, .text = "0 to 1"};
  EXPECT_TRUE(share.contain(1));
  EXPECT_FALSE(share.contain(1.0000001));
}

}  // namespace
}  // namespace tabor
