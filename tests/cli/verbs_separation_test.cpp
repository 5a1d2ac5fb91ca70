// tabor contact at a separation, and under a force.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/reference/hertz.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class SeparationVerb : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", scan(), "--pixels", "64",
                                    "--pixel", "1um", "--rms-slope", "0.1"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string scan() const { return (folder_ / "scan.h5").string(); }
  std::string ball() const { return (folder_ / "ball.h5").string(); }
  static Words solid() { return {"--youngs-modulus", "70GPa", "--poisson-ratio", "0.33"}; }
  Words contact(const Words& options) const { return Words{"contact", scan()} + solid() + options; }
  io::Json state_of(const Words& options) const {
    return json_of(contact(options)).at("states").at(0);
  }

  Folder folder_;
};

TEST_F(SeparationVerb, LeadsBackToThePressure) {
  for (const Words& how : {Words{}, Words{"--saturation-pressure", "4GPa"},
                           Words{"--boundary", "free"}, Words{"--solver", "polonsky-keer"}}) {
    const io::Json there = state_of(Words{"--pressure", "50MPa"} + how);
    const double separation = there.at("separation_m").get<double>();
    const io::Json back = state_of(Words{"--separation", fmt::format("{} m", separation)} + how);
    EXPECT_EQ(back.at("separation_m").get<double>(), separation);
    EXPECT_NEAR(back.at("mean_pressure_Pa").get<double>() / 50e6, 1, 1e-4);
    EXPECT_EQ(back.at("approach_m"), there.at("approach_m"));
    EXPECT_TRUE(back.at("converged").get<bool>());
    EXPECT_LE(back.at("certificate").get<double>(), 1e-6);
  }
}

TEST_F(SeparationVerb, StandsInTheTableWhereItIsAskedFor) {
  EXPECT_THAT(run_tabor(contact({"--separation", "0.1um"})).out, HasSubstr("separation"));
  EXPECT_THAT(run_tabor(contact({"--pressure", "50MPa"})).out,
              testing::Not(HasSubstr("separation")));
}

TEST_F(SeparationVerb, TakesAListAndARange) {
  const double highest = state_of({"--pressure", "1MPa"}).at("approach_m").get<double>() +
                         state_of({"--pressure", "1MPa"}).at("separation_m").get<double>();
  const std::string list =
      fmt::format("{} m,{} m,{} m", 0.8 * highest, 0.6 * highest, 0.4 * highest);
  const io::Json listed = json_of(contact({"--separation", list})).at("states");
  ASSERT_EQ(listed.size(), 3u);
  double before = 0;
  for (const io::Json& state : listed) {
    EXPECT_GT(state.at("mean_pressure_Pa").get<double>(), before);
    before = state.at("mean_pressure_Pa").get<double>();
  }
  const std::string range = fmt::format("{} m..{} m:3", 0.8 * highest, 0.4 * highest);
  EXPECT_EQ(json_of(contact({"--separation", range})).at("states").size(), 3u);
}

TEST_F(SeparationVerb, ForceOnABallIsThatOfHertz) {
  ASSERT_EQ(run_tabor({"generate", "sphere", "-o", ball(), "--pixels", "64", "--pixel", "4um",
                       "--radius", "1mm"})
                .code,
            0);
  const Words press = Words{"contact", ball(), "--boundary", "free"} + solid();
  const io::Json found = json_of(press + Words{"--force", "8 N"}).at("states").at(0);
  const double modulus = 70e9 / (1 - 0.33 * 0.33);
  const auto hertz = reference::hertz_at_load(1e-3, modulus, 8);
  const double area = std::pow(64 * 4e-6, 2);
  EXPECT_NEAR(found.at("mean_pressure_Pa").get<double>() * area, 8, 1e-9);
  EXPECT_NEAR(found.at("approach_m").get<double>() / hertz.approach, 1, 5e-3);
  EXPECT_NEAR(found.at("max_pressure_Pa").get<double>() / hertz.max_pressure, 1, 5e-3);
  EXPECT_THAT(run_tabor(press + Words{"--force", "8 N,0.5N"}).out,
              HasSubstr("8 N, 500 mN on 256 µm x 256 µm"));
}

TEST_F(SeparationVerb, OneOfPressureSeparationAndForceIsGiven) {
  const Outcome none = run_tabor(contact({}));
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("give one of --pressure, --separation and --force"));
  for (const Words& two : {Words{"--pressure", "50MPa", "--separation", "0.1um"},
                           Words{"--separation", "0.1um", "--force", "1N"}}) {
    const Outcome both = run_tabor(contact(two));
    EXPECT_EQ(both.code, 2);
    EXPECT_THAT(both.err, HasSubstr("give only one of --pressure, --separation and --force"));
  }
}

TEST_F(SeparationVerb, RejectsAFlatThatDoesNotTouchBeforeItSolvesAny) {
  const Outcome away = run_tabor(contact({"--separation", "0.01um,1mm"}));
  EXPECT_EQ(away.code, 3);
  EXPECT_THAT(away.err, HasSubstr("the flat does not touch the surface there"));
  const Outcome below = run_tabor(contact({"--separation", "-1um"}));
  EXPECT_EQ(below.code, 3);
  EXPECT_THAT(below.err, HasSubstr("more than the mean height"));
}

TEST_F(SeparationVerb, RejectsUnitsThatAreNone) {
  for (const Words& bad :
       {Words{"--separation", "0.1"}, Words{"--separation", "1MPa"},
        Words{"--separation", "nan um"}, Words{"--force", "1"}, Words{"--force", "1MPa"}}) {
    const Outcome outcome = run_tabor(contact(bad));
    EXPECT_EQ(outcome.code, 2) << bad.back();
    EXPECT_THAT(outcome.err, HasSubstr(bad.front())) << bad.back();
  }
}

TEST_F(SeparationVerb, AForceNeedsABodyThatEnds) {
  for (const Words& how : {Words{}, Words{"--boundary", "periodic"}, Words{"--edges", "tile"}}) {
    const Outcome outcome = run_tabor(contact(Words{"--force", "1N"} + how));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("use --boundary free, or --pressure"));
  }
  EXPECT_EQ(run_tabor(contact({"--force", "0.1N", "--edges", "end"})).code, 0);
  const Outcome none = run_tabor(contact({"--force", "0N", "--boundary", "free"}));
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("more than zero"));
}

TEST_F(SeparationVerb, LowpassScanNeedsPressures) {
  const Outcome outcome = run_tabor(contact({"--separation", "0.1um", "--lowpass-scan", "4,8"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--lowpass-scan needs --pressure"));
}

}  // namespace
}  // namespace tabor::test
