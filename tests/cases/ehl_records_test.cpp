// Columns of the records of all programs, and the results of their examples.

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/text.hpp"

namespace tabor::ehl {
namespace {

using testing::IsEmpty;
using testing::Not;

/// How the keys of a unit end.
const std::map<std::string, std::string>& endings() {
  static const std::map<std::string, std::string> all{
      {"m", "_m"},    {"Pa", "_Pa"},  {"N", "_N"},         {"s", "_s"},        {"kg", "_kg"},
      {"m^2", "_m2"}, {"m^3", "_m3"}, {"m/s", "_m_per_s"}, {"N/m", "_N_per_m"}};
  return all;
}

/// The example of a program, small enough for a test.
io::Config small_example(const Program& program) {
  io::Config config = io::Config::parse(case_template(program), "case");
  if (program.name == "impact" || program.name == "line") config = config.with("grid.nodes", "100");
  if (program.name == "point") config = config.with("grid.nodes", "33");
  return config;
}

TEST(Records, HaveOneColumnPerKeyWithAHeadingAndTheUnitOfTheKey) {
  for (const Program& program : programs()) {
    std::set<std::string> keys;
    for (const ColumnHead& column : program.columns) {
      EXPECT_TRUE(keys.insert(column.key).second) << column.key;
      EXPECT_THAT(column.heading, Not(IsEmpty())) << column.key;
      EXPECT_TRUE(column.is_in(media::kCase)) << column.key;
      if (!column.unit.empty()) {
        ASSERT_TRUE(endings().contains(column.unit)) << column.unit;
        EXPECT_TRUE(column.key.ends_with(endings().at(column.unit))) << column.key;
      } else {
        for (const auto& [unit, ending] : endings()) {
          EXPECT_FALSE(column.key.ends_with(ending)) << column.key << ' ' << unit;
        }
      }
    }
  }
}

TEST(Records, OfStudiesHaveWhatTheyVary) {
  for (const Program& program : programs()) {
    for (const CaseStudy& study : program.studies) {
      EXPECT_TRUE(std::any_of(program.columns.begin(), program.columns.end(),
                              [&](const ColumnHead& one) { return one.key == study.number; }))
          << study.number;
    }
  }
}

TEST(Records, OfExamplesHaveTheirColumnsInOrderAndAStatus) {
  for (const Program& program : programs()) {
    const CaseResult result = solve_case(program, small_example(program));
    EXPECT_TRUE(result.converged()) << program.name;
    EXPECT_THAT(result.error, IsEmpty());
    std::size_t place = 0;
    for (const NamedCell& one : result.numbers) {
      while (place < program.columns.size() && program.columns[place].key != one.head.key) ++place;
      ASSERT_LT(place, program.columns.size()) << one.head.key;
    }
    for (const ColumnHead& column : program.columns) {
      if (column.is_in(media::kTable)) {
        EXPECT_FALSE(std::holds_alternative<std::monostate>(result.cell(column.key))) << column.key;
      }
    }
    EXPECT_EQ(std::get<bool>(result.cell("converged")), true);
    EXPECT_EQ(std::get<std::string>(result.cell("status")), "converged");
    EXPECT_TRUE(std::isnan(result.number("no such number")));
  }
}

}  // namespace
}  // namespace tabor::ehl
