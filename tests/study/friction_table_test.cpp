#include "tabor/study/friction_table.hpp"

#include <gmock/gmock.h>

#include <set>

#include "example_study.hpp"
#include "tabor/cases/warning.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::study {
namespace {

using forming::Condition;
using forming::FrictionTable;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// One scan under 2, 5 and 7 MPa with 0.45 g/m^2; friction 0.3, lubricated 0.2.
FrictionNumbers three_pressures(const std::string& scan = "a.gsf") {
  FrictionNumbers made;
  for (const double pressure : {2e6, 5e6, 7e6}) {
    made.numbers.push_back({.scan = scan,
                            .group = "before",
                            .at = {pressure, 4.5e-4, {}},
                            .friction_dry = 0.3,
                            .friction = 0.2});
  }
  return made;
}

FrictionNumbers operator+(FrictionNumbers numbers, const FrictionNumbers& more) {
  numbers.numbers.insert(numbers.numbers.end(), more.numbers.begin(), more.numbers.end());
  return numbers;
}

TEST(FrictionTable, HoldsTheMeanAndDeviationOverTheScans) {
  FrictionNumbers numbers = three_pressures("a.gsf") + three_pressures("b.gsf");
  numbers.numbers[1].friction = 0.1;  // of 5 MPa, where the other scan has 0.2
  const FrictionTable table = friction_table(numbers);
  ASSERT_EQ(table.entries.size(), 3u);
  EXPECT_EQ(table.entries[1].at, (Condition{5e6, 4.5e-4, {}}));
  EXPECT_DOUBLE_EQ(table.entries[1].friction, 0.15);
  EXPECT_DOUBLE_EQ(table.entries[1].standard_deviation, std::sqrt(0.005));
  EXPECT_EQ(table.entries[1].n, 2u);
  EXPECT_EQ(table.group, "before");
  EXPECT_TRUE(table.left_out.empty());
}

TEST(FrictionTable, RisesWhateverTheOrderOfTheStudy) {
  FrictionNumbers numbers;
  for (const double density : {9e-4, 0.0, 4.5e-4}) {
    for (const double pressure : {7e6, 2e6}) {
      for (const double speed : {1.0, 0.01}) {
        numbers.numbers.push_back({.scan = "a", .group = "", .at = {pressure, density, speed}});
      }
    }
  }
  const FrictionTable table = friction_table(numbers);
  ASSERT_EQ(table.entries.size(), 12u);
  const auto place = [](const Condition& at) {
    return std::tuple(at.lubricant_density, at.mean_pressure, at.sliding_speed);
  };
  for (std::size_t i = 1; i < table.entries.size(); ++i) {
    EXPECT_LT(place(table.entries[i - 1].at), place(table.entries[i].at)) << i;
  }
}

TEST(FrictionTable, LeavesOutWhatCannotBeTrusted) {
  for (const std::string& code : untrusted_codes()) {
    FrictionNumbers numbers = three_pressures();
    numbers.numbers[2].codes = {"resolution", code};
    const FrictionTable table = friction_table(numbers);
    EXPECT_EQ(table.entries.size(), 2u) << code;
    ASSERT_EQ(table.left_out.size(), 1u) << code;
    EXPECT_EQ(table.left_out[0].code, code);
    EXPECT_EQ(table.left_out[0].at.mean_pressure, 7e6);
    EXPECT_THAT(table.left_out[0].scans, ElementsAre("a.gsf"));
    EXPECT_TRUE(table.left_out[0].whole);
    EXPECT_EQ(friction_table(numbers, {.kept_codes = {code}}).entries.size(), 3u) << code;
  }
}

TEST(FrictionTable, KeepsNumbersUnderOtherWarnings) {
  const std::vector<std::string>& untrusted = untrusted_codes();
  for (const cases::CodeEntry& entry : cases::all_codes()) {
    const std::string code(entry.code);
    if (std::find(untrusted.begin(), untrusted.end(), code) != untrusted.end()) continue;
    FrictionNumbers numbers = three_pressures();
    numbers.numbers[0].codes = {code};
    EXPECT_EQ(friction_table(numbers).entries.size(), 3u) << code;
  }
}

TEST(FrictionTable, SaysWhyItRefusesANumber) {
  EXPECT_EQ(refusal_of({"spill-over", "steep"}, true), "");
  EXPECT_EQ(refusal_of({}, false), "not-converged");
  for (const std::string& code : untrusted_codes()) EXPECT_EQ(refusal_of({code}, true), code);
}

TEST(FrictionTable, KnowsOnlyCodesThatExist) {
  for (const std::string& code : untrusted_codes()) {
    EXPECT_TRUE(std::any_of(cases::all_codes().begin(), cases::all_codes().end(),
                            [&](const auto& entry) { return entry.code == code; }))
        << code;
  }
}

TEST(FrictionTable, HoldsOrLeavesOutEveryConditionOnce) {
  // Any subset of two scans may be under a warning, or not converged, or have failed.
  for (int pattern = 0; pattern < 4096; ++pattern) {
    FrictionNumbers numbers = three_pressures("a") + three_pressures("b");
    for (std::size_t i = 0; i < numbers.numbers.size(); ++i) {
      const int kind = pattern >> (2 * i) & 3;
      numbers.numbers[i].converged = kind != 1;
      if (kind == 2) numbers.numbers[i].codes = {"flood"};
      numbers.numbers[i].failed = kind == 3;
    }
    FrictionTable table;
    try {
      table = friction_table(numbers);
    } catch (const InputError&) {
      continue;  // nothing remains
    }
    std::multiset<double> pressures;
    for (const auto& entry : table.entries) pressures.insert(entry.at.mean_pressure);
    for (const auto& one : table.left_out) {
      if (one.whole) pressures.insert(one.at.mean_pressure);
    }
    ASSERT_THAT(pressures, ElementsAre(2e6, 5e6, 7e6)) << pattern;
  }
}

TEST(FrictionTable, TakesMeansOverTheScansThatConverged) {
  FrictionNumbers numbers = three_pressures("a") + three_pressures("b") + three_pressures("c");
  numbers.numbers[0].converged = false;
  numbers.numbers[3].failed = true;
  const FrictionTable table = friction_table(numbers);
  ASSERT_EQ(table.entries.size(), 3u);
  EXPECT_EQ(table.entries[0].n, 1u);
  EXPECT_EQ(table.entries[1].n, 3u);
  ASSERT_EQ(table.left_out.size(), 2u);
  for (const auto& one : table.left_out) EXPECT_FALSE(one.whole);
}

TEST(FrictionTable, TakesNoMeanOverTheDrierScans) {
  FrictionNumbers numbers = three_pressures("a") + three_pressures("b");
  numbers.numbers[0].codes = {"flood"};
  const FrictionTable table = friction_table(numbers);
  EXPECT_EQ(table.entries.size(), 2u);
  EXPECT_EQ(reasons_of(table), "flood 1");
}

TEST(FrictionTable, HasDryFrictionOfAnyResult) {
  FrictionNumbers numbers = three_pressures("a") + three_pressures("b");
  for (FrictionNumber& number : numbers.numbers) number.codes = {"flood", "frictionless"};
  const FrictionTable table = friction_table(numbers, {.lubricant_densities = {0}});
  ASSERT_EQ(table.entries.size(), 3u);
  for (const auto& entry : table.entries) {
    EXPECT_EQ(entry.friction, 0.3);
    EXPECT_EQ(entry.at.lubricant_density, 0);
    EXPECT_EQ(entry.n, 2u);
  }
}

TEST(FrictionTable, CountsTheDryFrictionOfAScanOnce) {
  FrictionNumbers numbers = three_pressures();
  for (const FrictionNumber& number : three_pressures().numbers) {
    numbers.numbers.push_back(number);
    numbers.numbers.back().at.lubricant_density = 9e-4;
    numbers.numbers.back().converged = false;
  }
  const FrictionTable table = friction_table(numbers, {.lubricant_densities = {0, 4.5e-4}});
  ASSERT_EQ(table.entries.size(), 6u);
  for (const auto& entry : table.entries) EXPECT_EQ(entry.n, 1u);
  EXPECT_TRUE(table.left_out.empty());
}

TEST(FrictionTable, AsksForAGroupWhereThereAreSeveral) {
  FrictionNumbers numbers = three_pressures();
  numbers.numbers[0].group = "after";
  EXPECT_THAT(message_of([&] { friction_table(numbers); }),
              testing::AllOf(HasSubstr("after, before"), HasSubstr("<group>")));
  EXPECT_EQ(friction_table(numbers, {.group = "before"}).entries.size(), 2u);
  EXPECT_THAT(message_of([&] { friction_table(numbers, {.group = "befor"}); }),
              HasSubstr("did you mean 'before'"));
}

TEST(FrictionTable, RejectsWhatIsNotThere) {
  FrictionNumbers alone = three_pressures();
  for (FrictionNumber& number : alone.numbers) number.group = "";
  EXPECT_THAT(message_of([&] { friction_table(alone, {.group = "before"}); }),
              HasSubstr("these have none"));
  const FrictionNumbers numbers = three_pressures();
  EXPECT_THAT(message_of([&] { friction_table(numbers, {.lubricant_densities = {9e-4}}); }),
              testing::AllOf(HasSubstr("0.9 g/m^2"), HasSubstr("0.45 g/m^2")));
  EXPECT_THAT(message_of([&] { friction_table(numbers, {.kept_codes = {"floods"}}); }),
              HasSubstr("did you mean 'flood'"));
}

TEST(FrictionTable, SaysWhyNothingRemains) {
  FrictionNumbers numbers = three_pressures();
  for (FrictionNumber& number : numbers.numbers) number.codes = {"frictionless"};
  EXPECT_THAT(message_of([&] { friction_table(numbers); }),
              testing::AllOf(HasSubstr("frictionless 3"), HasSubstr("<keep")));
}

TEST(ReadFriction, RejectsWhatIsNoResultOfFriction) {
  const test::Folder folder;
  EXPECT_THAT(message_of([&] { read_friction(folder.path()); }), HasSubstr("without results.h5"));
  EXPECT_THROW(read_friction(folder / "absent"), InputError);
  test::put_bytes(folder / "text.h5", "no HDF5");
  EXPECT_THROW(read_friction(folder / "text.h5"), InputError);
  io::Hdf5Writer other(folder / "other.h5");
  other.write("/table/friction_dry", std::vector<double>{0.1});
  other.commit();
  EXPECT_THAT(message_of([&] { read_friction(folder / "other.h5"); }),
              HasSubstr("another program"));
  io::Hdf5Writer contact(folder / "contact.h5");
  contact.attribute("/", "format", "tabor");
  contact.group("/states/0000");
  contact.commit();
  EXPECT_THAT(message_of([&] { read_friction(folder / "contact.h5"); }),
              HasSubstr("without friction"));
  io::Hdf5Writer ragged(folder / "ragged.h5");
  ragged.attribute("/", "format", "tabor");
  for (const char* name : {"scan", "group", "error", "warning_codes"}) {
    ragged.write(std::string("/table/") + name, std::vector<std::string>{"a", "b"});
  }
  for (const char* name : {"mean_pressure_Pa", "lubricant_density_g_per_m2", "friction_dry",
                           "friction_lubricated", "converged"}) {
    ragged.write(std::string("/table/") + name, std::vector<double>{1, 2, 3});
  }
  ragged.commit();
  EXPECT_THAT(message_of([&] { read_friction(folder / "ragged.h5"); }), HasSubstr("length"));
}

/// The same mean that a study writes into averages.csv, wherever it is trusted.
void expect_as_in_averages(const test::ExampleStudy& example, const std::string& column) {
  const io::CsvTable averages = io::read_csv(example.results() / "averages.csv");
  const FrictionTable table =
      friction_table(read_friction(example.results()), {.kept_codes = untrusted_codes()});
  ASSERT_EQ(table.entries.size(), averages.rows.size());
  for (const auto& entry : table.entries) {
    bool is_there = false;
    for (std::size_t i = 0; i < averages.rows.size(); ++i) {
      if (averages.number(i, "mean_pressure_Pa") != entry.at.mean_pressure) continue;
      const double density = 1e-3 * averages.number(i, "lubricant_density_g_per_m2");
      if (std::abs(density - entry.at.lubricant_density) > 1e-12) continue;
      if (entry.at.sliding_speed &&
          averages.number(i, "sliding_speed_m_per_s") != *entry.at.sliding_speed) {
        continue;
      }
      is_there = true;
      EXPECT_EQ(averages.number(i, column + "_mean"), entry.friction);
      EXPECT_EQ(averages.number(i, column + "_std"), entry.standard_deviation);
      EXPECT_EQ(averages.number(i, "n"), entry.n);
    }
    EXPECT_TRUE(is_there);
  }
}

TEST(ReadFriction, OfAStudyGivesItsAverages) {
  const test::ExampleStudy example;
  example.run();
  expect_as_in_averages(example, "friction_lubricated");
  const FrictionNumbers numbers = read_friction(example.results() / "results.h5");
  EXPECT_EQ(numbers.numbers.size(), 8u);
  EXPECT_EQ(numbers.file, example.results() / "results.h5");
  EXPECT_FALSE(friction_table(numbers, {.kept_codes = untrusted_codes()}).has_speeds());
}

TEST(ReadFriction, SaysThatAStudyIsNotComplete) {
  const test::ExampleStudy example;
  SweepOptions half;
  half.shard = engine::Shard{1, 2};
  example.run(half);
  const FrictionNumbers part = read_friction(example.results());
  EXPECT_EQ(part.incomplete, "the study is not complete: 4 of 8 cases are done");
  EXPECT_THAT(friction_table(part, {.kept_codes = untrusted_codes()}).origin,
              testing::Contains(part.incomplete));
  example.run();
  EXPECT_EQ(read_friction(example.results()).incomplete, "");
}

TEST(ReadFriction, CountsAScanThatFailedInNoMean) {
  const test::ExampleStudy example;
  example.add_scan("scan_3.h5", 3, true);  // with a hole that nobody fills
  example.run();
  const FrictionTable table =
      friction_table(read_friction(example.results()), {.kept_codes = untrusted_codes()});
  ASSERT_EQ(table.entries.size(), 4u);
  for (const auto& entry : table.entries) EXPECT_EQ(entry.n, 2u);
  ASSERT_EQ(table.left_out.size(), 4u);
  for (const auto& one : table.left_out) {
    EXPECT_EQ(one.code, "failed");
    EXPECT_THAT(one.scans, ElementsAre("scan_3.h5"));
    EXPECT_FALSE(one.whole);
  }
}

TEST(ReadFriction, RejectsPlacesThatAreNone) {
  const test::Folder folder;
  for (const double pressure : {std::nan(""), 0.0, -1e6, HUGE_VAL}) {
    io::Hdf5Writer writer(folder / "results.h5");
    writer.attribute("/", "format", "tabor");
    for (const char* name : {"scan", "group", "error", "warning_codes"}) {
      writer.write(std::string("/table/") + name, std::vector<std::string>{""});
    }
    for (const char* name :
         {"lubricant_density_g_per_m2", "friction_dry", "friction_lubricated", "converged"}) {
      writer.write(std::string("/table/") + name, std::vector<double>{1});
    }
    writer.write("/table/mean_pressure_Pa", std::vector<double>{pressure});
    writer.commit();
    EXPECT_THAT(message_of([&] { read_friction(folder.path()); }), HasSubstr("no pressure"))
        << pressure;
  }
}

TEST(ReadFriction, OfAStudyWhoseOilFlowsGivesMixedFrictionAtEachSpeed) {  // slow
  const test::ExampleStudy example;
  example.write(test::flowing_study());
  example.run();
  expect_as_in_averages(example, "friction_mixed");
  const FrictionTable table =
      friction_table(read_friction(example.results()), {.kept_codes = untrusted_codes()});
  EXPECT_TRUE(table.has_speeds());
  EXPECT_EQ(table.entries.size(), 8u);
}

}  // namespace
}  // namespace tabor::study
