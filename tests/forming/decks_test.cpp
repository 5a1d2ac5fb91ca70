// Every format, read back by a reader of its own that knows the manual and not the writer.
#include <gmock/gmock.h>

#include "forming/deck_parsers.hpp"
#include "forming/made_table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/forming/darmstad.hpp"
#include "tabor/forming/deck.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::forming {
namespace {

using test::DeckNumber;
using test::made_table;
using test::some_law;
using testing::HasSubstr;

constexpr double kRounding = 1e-9;  // of numbers written with ten digits

const std::vector<double> kPressures{2e6, 5e6, 7e6, 15e6};
const std::vector<double> kDensities{0, 4.5e-4, 9e-4};
const std::vector<double> kSpeeds{0.01, 0.1, 1};

/// A table with several densities, with and without speeds; units of any kind.
struct Case {
  bool has_speeds;
  const char* units;
};
class Decks : public testing::TestWithParam<Case> {
 protected:
  const UnitSystem units = unit_system(GetParam().units);
  const FrictionTable table = made_table(
      kPressures, kDensities, GetParam().has_speeds ? kSpeeds : std::vector<double>{}, some_law);

  void expect_same(double in_deck, double si, const DeckUnit& unit) const {
    EXPECT_NEAR(in_deck * unit.si, si, kRounding * si);
  }
  void expect_same(const DeckNumber& number, const FrictionEntry& entry) const {
    expect_same(number.pressure, entry.at.mean_pressure, units.pressure);
    EXPECT_NEAR(number.friction, entry.friction, kRounding);
    EXPECT_EQ(std::isnan(number.speed), !entry.at.sliding_speed);
    if (entry.at.sliding_speed) expect_same(number.speed, *entry.at.sliding_speed, units.speed);
  }
};
INSTANTIATE_TEST_SUITE_P(InUnits, Decks,
                         testing::Values(Case{false, "mm,s,t"}, Case{true, "mm,s,t"},
                                         Case{true, "m,s,kg"}, Case{true, "mm,ms,kg"},
                                         Case{false, "in,s,lbf"}),
                         [](const auto& test) { return "Number" + std::to_string(test.index); });

TEST_P(Decks, OfAbaqusHoldEveryNumberOnce) {
  const std::vector<DeckNumber> numbers = test::parse_abaqus(abaqus_deck(table, units));
  ASSERT_EQ(numbers.size(), table.entries.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    expect_same(numbers[i], table.entries[i]);
    expect_same(numbers[i].density, table.entries[i].at.lubricant_density, units.areal_density);
  }
}

TEST_P(Decks, OfAnsysHoldEveryNumberOnce) {
  const test::AnsysMaterials materials = test::parse_ansys(ansys_deck(table, units, 41));
  ASSERT_EQ(materials.size(), kDensities.size());
  std::size_t i = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    EXPECT_EQ(materials[k].first, 41 + static_cast<int>(k));
    for (const DeckNumber& number : materials[k].second) expect_same(number, table.entries.at(i++));
  }
  EXPECT_EQ(i, table.entries.size());
}

TEST_P(Decks, OfLsdynaHoldEveryNumberFromRestOn) {
  const std::vector<test::LsdynaTable> tables = test::parse_lsdyna(lsdyna_deck(table, units, 1001));
  ASSERT_EQ(tables.size(), kDensities.size());
  EXPECT_EQ(tables[0].id, 1001);
  std::vector<DeckNumber> computed;
  std::size_t n_at_rest = 0;
  for (const test::LsdynaTable& one : tables) {
    for (std::size_t i = 0; i < one.numbers.size(); ++i) {
      const DeckNumber& number = one.numbers[i];
      if (number.speed != 0) {
        computed.push_back(number);
        if (!GetParam().has_speeds) computed.back().speed = std::nan("");
      } else {
        // At rest friction is that of the lowest speed.
        ASSERT_LT(i + 1, one.numbers.size());
        ++n_at_rest;
        EXPECT_EQ(number.friction, one.numbers[i + 1].friction);
        EXPECT_EQ(number.pressure, one.numbers[i + 1].pressure);
      }
    }
  }
  EXPECT_EQ(n_at_rest, kPressures.size() * kDensities.size());
  ASSERT_EQ(computed.size(), table.entries.size());
  for (std::size_t i = 0; i < computed.size(); ++i) expect_same(computed[i], table.entries[i]);
}

TEST_P(Decks, OfOpenradiossMissTheNumbersByWhatTheySay) {
  const std::string deck = openradioss_deck(table, units, 7);
  const std::vector<test::RadiossCard> cards = test::parse_openradioss(deck);
  const std::vector<DensityLayer> layers = layers_of(table);
  const std::vector<DarmstadFit> fits = fit_darmstad(table);
  ASSERT_EQ(cards.size(), layers.size());
  for (std::size_t k = 0; k < cards.size(); ++k) {
    EXPECT_EQ(cards[k].id, 7 + static_cast<int>(k));
    double largest = 0;
    for (const PressureRow& row : layers[k].rows) {
      for (const FrictionEntry& entry : row.entries) {
        const double fitted = cards[k].friction(units.pressure.of(row.mean_pressure),
                                                units.speed.of(entry.at.sliding_speed.value_or(0)));
        largest = std::max(largest, std::abs(fitted - entry.friction));
      }
    }
    EXPECT_NEAR(largest, fits[k].largest_error, 1e-9);
    EXPECT_LT(largest, 1e-3);  // the law is linear in pressure and nearly so in speed
  }
  EXPECT_THAT(deck, HasSubstr("largest error of the fit: "));
}

TEST_P(Decks, OfAnyProgramAsCsvHoldEveryNumberOnce) {
  const io::CsvTable csv = io::parse_csv(table_csv(table, units), "table.csv");
  ASSERT_EQ(csv.rows.size(), table.entries.size());
  ASSERT_EQ(csv.columns.size(), GetParam().has_speeds ? 6u : 5u);
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const FrictionEntry& entry = table.entries[i];
    expect_same(csv.number(i, csv.columns[0]), entry.at.mean_pressure, units.pressure);
    expect_same(csv.number(i, csv.columns[1]), entry.at.lubricant_density, units.areal_density);
    if (GetParam().has_speeds) {
      expect_same(csv.number(i, csv.columns[2]), *entry.at.sliding_speed, units.speed);
    }
    EXPECT_EQ(csv.number(i, "friction_coefficient"), entry.friction);
    EXPECT_EQ(csv.number(i, "standard_deviation"), 0.01);
    EXPECT_EQ(csv.number(i, "n"), 3);
  }
}

TEST_P(Decks, SayTheUnitsOfTheirColumns) {
  for (const std::string& name : kPrograms.all()) {
    const std::string deck = deck_for(*kPrograms.find(name), table, units);
    EXPECT_THAT(deck, HasSubstr(std::string("units: ") + GetParam().units)) << name;
    EXPECT_THAT(deck, HasSubstr("pressure in " + units.pressure.name)) << name;
    EXPECT_THAT(deck, HasSubstr("group: sheets before")) << name;
    EXPECT_THAT(deck, HasSubstr("command: tabor table results")) << name;
  }
}

TEST(TableCsv, NamesColumnsWithTheirUnits) {
  const FrictionTable table = made_table({2e6}, {9e-4}, {0.1}, some_law);
  EXPECT_EQ(io::parse_csv(table_csv(table, unit_system("mm,s,t")), "t").columns,
            (std::vector<std::string>{"mean_pressure_MPa", "lubricant_density_t_per_mm2",
                                      "sliding_speed_mm_per_s", "friction_coefficient",
                                      "standard_deviation", "n"}));
  EXPECT_EQ(io::parse_csv(table_csv(table, unit_system("in,s,lbf")), "t").columns[1],
            "lubricant_density_lbf_s2_per_in3");
}

TEST(TableCsv, HasAnEmptyDeviationOfOneScan) {
  FrictionTable table = made_table({2e6}, {9e-4}, {}, some_law);
  table.entries[0].standard_deviation = std::nan("");
  const io::CsvTable csv = io::parse_csv(table_csv(table, unit_system("m,s,kg")), "t");
  EXPECT_EQ(csv.text(0, "standard_deviation"), "");
}

TEST(AbaqusDeck, OfOneDensityHasNoFieldVariable) {
  const FrictionTable table = made_table(kPressures, {9e-4}, {}, some_law);
  const std::string deck = abaqus_deck(table, unit_system("mm,s,t"));
  EXPECT_THAT(deck, testing::Not(HasSubstr("DEPENDENCIES")));
  EXPECT_THAT(deck, HasSubstr("0.9 g/m^2"));
  EXPECT_EQ(test::parse_abaqus(deck).size(), kPressures.size());
}

TEST(Decks, SayWhichMeansAreOverFewerScans) {
  FrictionTable table = made_table(kPressures, kDensities, kSpeeds, some_law);
  table.left_out.push_back(
      {.at = {5e6, 0, 0.1}, .code = "failed", .scans = {"x_bad.gsf"}, .whole = false});
  const std::string deck = abaqus_deck(table, unit_system("mm,s,t"));
  EXPECT_THAT(deck, HasSubstr("over fewer scans: failed 1; none left"));
  EXPECT_THAT(deck, HasSubstr("mean without x_bad.gsf"));
}

TEST(Decks, OfATableWithGapsHaveTheRest) {
  FrictionTable table = made_table(kPressures, kDensities, kSpeeds, some_law);
  table.entries.erase(table.entries.begin() + 4);
  table.left_out.push_back({.at = {5e6, 0, 0.1}, .code = "flood", .scans = {"a.gsf"}});
  const UnitSystem units = unit_system("mm,s,t");
  EXPECT_EQ(test::parse_abaqus(abaqus_deck(table, units)).size(), table.entries.size());
  EXPECT_EQ(test::parse_ansys(ansys_deck(table, units))[0].second.size(), 11u);
  EXPECT_THROW(lsdyna_deck(table, units), InputError);
  EXPECT_EQ(test::parse_lsdyna(lsdyna_deck(complete_rows(table), units)).size(), 3u);
  for (const std::string& deck : {abaqus_deck(table, units), table_csv(table, units)}) {
    EXPECT_THAT(deck, HasSubstr("1 left out (flood 1)"));
    EXPECT_THAT(deck, HasSubstr("left out: 5 MPa, 0 g/m^2, 100 mm/s: flood (a.gsf)"));
  }
}

TEST(Decks, OfOnePressureAreCsvAlone) {
  const FrictionTable table = made_table({2e6}, kDensities, kSpeeds, some_law);
  const UnitSystem units = unit_system("mm,s,t");
  for (const Program program :
       {Program::abaqus, Program::lsdyna, Program::ansys, Program::openradioss}) {
    EXPECT_THROW(deck_for(program, table, units), InputError);
  }
  EXPECT_NO_THROW(deck_for(Program::csv, table, units));
}

TEST(Decks, OfNoNumbersAreRejected) {
  for (const std::string& name : kPrograms.all()) {
    EXPECT_THROW(deck_for(*kPrograms.find(name), {}, unit_system("mm,s,t")), InputError) << name;
  }
}

TEST(Decks, KeepTextOfOthersInTheirComments) {
  FrictionTable table = made_table(kPressures, kDensities, kSpeeds, some_law);
  table.group = "a\n*END\r\n/FRICTION/1\n" + std::string(300, 'x') + "\xe4 \xc3\xa4";
  table.origin = {"command: " + std::string(200, '-') + "\n*FRICTION\n" + std::string(90, 'y')};
  const UnitSystem units = unit_system("mm,s,t");
  EXPECT_EQ(test::parse_abaqus(abaqus_deck(table, units)).size(), table.entries.size());
  EXPECT_EQ(test::parse_lsdyna(lsdyna_deck(table, units)).size(), 3u);
  EXPECT_EQ(test::parse_ansys(ansys_deck(table, units)).size(), 3u);
  EXPECT_EQ(test::parse_openradioss(openradioss_deck(table, units)).size(), 3u);
  EXPECT_EQ(io::parse_csv(table_csv(table, units), "t").rows.size(), table.entries.size());
}

/// The comments as they were before they were broken into lines.
std::string joined_comments(const std::string& deck, const std::string& mark) {
  std::string text;
  for (const std::string& line : split(deck, '\n')) {
    if (!line.starts_with(mark)) continue;
    const std::string rest = line.substr(mark.size());
    text += rest.starts_with("   ") ? rest.substr(2) : "\n" + rest;
  }
  return text;
}

TEST(Decks, BreakTheirCommentsBetweenWords) {
  const FrictionTable table = made_table(kPressures, kDensities, kSpeeds, some_law);
  const std::string units =
      " units: mm,s,t: pressure in MPa, sliding speed in mm/s, lubricant density in t/mm^2 (1 "
      "g/m^2 "
      "is 1e-12)\n";
  EXPECT_THAT(joined_comments(abaqus_deck(table, unit_system("mm,s,t")), "**"), HasSubstr(units));
  EXPECT_THAT(joined_comments(lsdyna_deck(table, unit_system("mm,s,t")), "$"), HasSubstr(units));
}

TEST(LsdynaDeck, OfFrictionAtRestIsFlat) {
  const FrictionTable table = made_table(kPressures, {9e-4}, {0}, some_law);
  const auto tables = test::parse_lsdyna(lsdyna_deck(table, unit_system("mm,s,t")));
  ASSERT_EQ(tables.at(0).numbers.size(), 2 * kPressures.size());
  for (const DeckNumber& number : tables[0].numbers) {
    EXPECT_NEAR(number.friction, some_law(1e6 * number.pressure, 9e-4, 0), kRounding);
  }
}

TEST(LsdynaDeck, RejectsNumbersThatDoNotFitTheirField) {
  const FrictionTable table = made_table(kPressures, kDensities, {}, some_law);
  for (const int id : {0, -5, 99999999, 99999990}) {
    EXPECT_THROW(lsdyna_deck(table, unit_system("mm,s,t"), id), InputError) << id;
  }
  EXPECT_NO_THROW(lsdyna_deck(table, unit_system("mm,s,t"), 99999900));
}

}  // namespace
}  // namespace tabor::forming
