// Studies whose trapped oil carries load.
#include <gmock/gmock.h>

#include "study/example_study.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/study/case.hpp"
#include "tabor/study/study_maps.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::HasSubstr;

std::string with_trapped(const std::string& lines = "") {
  std::string text = test::kStudyText;
  text.insert(text.find("[[scan]]"), "[lubricant]\ntrapped = true\n" + lines);
  return text;
}

io::CsvTable table_of(const ExampleStudy& example) {
  return io::parse_csv(example.csv(), "results.csv");
}

std::string key_of_case(const Study& study) { return tasks_of(study)[0].cases[0][0].key; }

TEST(SweepTrapped, HasTheNumbersOfTheOilBesideThoseOfTheContact) {
  const ExampleStudy example;
  example.run();
  const io::CsvTable before = table_of(example);
  example.write(with_trapped());
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts + outcome.n_films, 0U);  // both are in the store
  EXPECT_EQ(outcome.n_trapped, 8U);
  const io::CsvTable table = table_of(example);
  ASSERT_EQ(table.rows.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(table.text(i, "friction_dry"), before.text(i, "friction_dry"));
    EXPECT_GE(table.number(i, "liquid_load_share"), 0);
    EXPECT_DOUBLE_EQ(table.number(i, "friction_lubricated"),
                     table.number(i, "friction_solid") + table.number(i, "friction_boundary"));
    EXPECT_EQ(table.text(i, "converged"), "true");
  }
  EXPECT_EQ(example.run().n_trapped, 0U);
  example.write(test::kStudyText);
  EXPECT_EQ(example.run().n_rows, 0U);  // the old rows are still there
}

TEST(SweepTrapped, SolvesItUnderEveryPlaceOfATool) {
  const ExampleStudy example;
  example.write(
      with_trapped("[contact]\ntool = \"ground:Sa=0.1um,groove-length=20um\"\n"
                   "tool_places = 2\n"));
  EXPECT_EQ(example.run().n_trapped, 16U);
  const io::CsvTable table = table_of(example);
  EXPECT_EQ(table.number(0, "tool_places"), 2);
  EXPECT_GE(table.number(0, "n_pockets"), table.number(0, "n_squeezed"));
}

TEST(SweepTrapped, KeepsItsMapsForConvert) {
  const ExampleStudy example;
  example.write(with_trapped());
  example.run();
  const auto maps = read_maps(example.results(), 0);
  std::vector<std::string> names;
  for (const scan::NamedMap& map : maps.states.at(0).maps) names.push_back(map.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"liquid_pressure", "trapped_pressure", "trapped_gap"}));
}

TEST(SweepTrapped, IsKnownByTheOilItHas) {
  const ExampleStudy example;
  example.write(with_trapped());
  const std::string key = key_of_case(example.read());
  EXPECT_EQ(key_of_case(parse_study(to_toml(example.read()), example.folder / "study.toml")), key);
  for (const char* lines :
       {"bulk_modulus = \"inf\"\n", "bulk_modulus = \"2 GPa\"\n", "dry_below = \"2 nm\"\n"}) {
    example.write(with_trapped(lines));
    EXPECT_NE(key_of_case(example.read()), key) << lines;
    const std::string again = to_toml(example.read());
    EXPECT_EQ(key_of_case(parse_study(again, example.folder / "study.toml")),
              key_of_case(example.read()))
        << again;
  }
}

TEST(SweepTrapped, SaysWithItsLineWhatDoesNotGoTogether) {
  const ExampleStudy example;
  example.write(with_trapped("fluid = \"reynolds\"\nviscosity = \"0.1 Pa s\"\n"));
  EXPECT_THAT(test::message_of([&] { example.read(); }), HasSubstr("sliding_speed"));
  example.write(with_trapped("bulk_modulus = \"-1 GPa\"\n"));
  EXPECT_THAT(test::message_of([&] { example.read(); }), HasSubstr("lubricant.bulk_modulus"));
}

}  // namespace
}  // namespace tabor::study
