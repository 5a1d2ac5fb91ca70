// Cases that make no sense are refused before anything is computed.

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "tabor/cases/ehl/program.hpp"

namespace tabor::ehl {
namespace {

using testing::HasSubstr;
using testing::Ne;

io::Config example_of(const Program& program) {
  return io::Config::parse(case_template(program), "case");
}

TEST(CheckCase, TakesEveryTemplate) {
  for (const Program& program : programs()) {
    EXPECT_NO_THROW(check_case(program, example_of(program))) << program.name;
  }
}

TEST(CheckCase, RefusesEmptyCases) {
  for (const Program& program : programs()) {
    EXPECT_THAT(test::rejection([&] { check_case(program, io::Config::parse("", "case")); }),
                HasSubstr("case: "))
        << program.name;
  }
}

TEST(CheckCase, RefusesCasesWithoutARequiredKey) {
  for (const Program& program : programs()) {
    for (const ParameterHead& key : program.keys) {
      if (key.needed != Needed::yes) continue;
      io::Config config = io::Config::parse("", "case");
      for (const auto& [name, value] : program.example) {
        if (name != key.name) config = config.with(name, value);
      }
      EXPECT_THAT(test::rejection([&] { check_case(program, config); }), HasSubstr(key.name))
          << program.name;
    }
  }
}

TEST(CheckCase, RefusesAnotherDimensionInEveryKeyThatTheExampleHas) {
  for (const Program& program : programs()) {
    for (const auto& [name, value] : program.example) {
      const io::Config config = example_of(program).with(name, "\"5 K\"");
      EXPECT_THAT(test::rejection([&] { check_case(program, config); }), HasSubstr(name))
          << program.name;
    }
  }
}

TEST(CheckCase, RefusesUnknownKeys) {
  for (const Program& program : programs()) {
    const io::Config config = example_of(program).with("ball.colour", "\"red\"");
    EXPECT_THAT(test::rejection([&] { check_case(program, config); }), Ne("accepted"));
  }
}

TEST(CheckCase, DoesNotReadTheFilesThatACaseNames) {
  for (const char* name : {"line", "point"}) {
    for (const Program& program : programs()) {
      if (program.name != name) continue;
      const io::Config config = example_of(program).with("roughness.file", "\"none.x3p\"");
      EXPECT_NO_THROW(check_case(program, config)) << name;
    }
  }
}

}  // namespace
}  // namespace tabor::ehl
