#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cli/axis_option.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::cli {
namespace {

using study::SweepAxis;
using test::json_of;
using test::Outcome;
using test::run_tabor;
using testing::HasSubstr;

const std::string kBall = TABOR_SOURCE_DIR "/examples/10_restitution_map/ball.toml";
const std::vector<std::string> kQuick = {"ehl", "impact", kBall, "--set", "grid.nodes=80"};

std::vector<std::string> quick(const std::vector<std::string>& more) {
  std::vector<std::string> words = kQuick;
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(SweepAxis, ReadsRangesInTheUnitOfTheirBeginning) {
  const SweepAxis axis = parse_axis("ball.speed=50mm/s..1m/s:log:3");
  EXPECT_EQ(axis.key, "ball.speed");
  ASSERT_EQ(axis.values.size(), 3u);
  EXPECT_EQ(axis.values[0], "50 mm/s");
  EXPECT_EQ(axis.values[2], "1000 mm/s");
  EXPECT_NEAR(axis.numbers()[1], std::sqrt(0.05), 1e-6);
  EXPECT_EQ(parse_axis("grid.nodes=100..300:3").values[1], "200");
  EXPECT_FALSE(parse_axis("ball.speed=0.1 m/s").is_range);
  EXPECT_EQ(parse_axis("a=-1..1:3").values[1], "0");
}

TEST(SweepAxis, ReadsLists) {
  const SweepAxis nodes = parse_axis("grid.nodes=65, 97,145");
  EXPECT_TRUE(nodes.is_range);
  EXPECT_EQ(nodes.values, (std::vector<std::string>{"65", "97", "145"}));
  EXPECT_FALSE(nodes.has_words());
  const SweepAxis words = parse_axis("impact.start=rigid,full");
  EXPECT_TRUE(words.has_words());
  EXPECT_EQ(words.numbers(), (std::vector<double>{0, 1}));
  for (const char* value : {"[\"1 us\", \"2 us\"]", "\"a,b.x3p\""}) {
    EXPECT_EQ(parse_axis(std::string("a.b=") + value).values, std::vector<std::string>{value});
  }
}

TEST(SweepAxis, KnowsTheUnitOfItsNumbers) {
  EXPECT_EQ(parse_axis("ball.speed=50mm/s..1m/s:log:3").unit(), "m/s");
  EXPECT_EQ(parse_axis("lubricant.viscosity=1 mPa s, 2 Pa s").unit(), "Pa s");
  EXPECT_EQ(parse_axis("cylinder.load_per_length=1 kN/m,2 kN/m").unit(), "N/m");
  EXPECT_EQ(parse_axis("grid.nodes=65,97").unit(), "");
  EXPECT_EQ(parse_axis("impact.start=rigid,full").unit(), "");
  EXPECT_EQ(parse_axis("a=1 m^3..2 m^3").unit(), "SI");
}

TEST(SweepAxis, TakesTwoDotsInAPathForAFolder) {
  for (const char* path : {"../scan.x3p", "../../scan 2.x3p", "scans/../scan.x3p", "1..scan.x3p"}) {
    const SweepAxis axis = parse_axis(std::string("roughness.file=") + path);
    EXPECT_FALSE(axis.is_range) << path;
    EXPECT_EQ(axis.values, std::vector<std::string>{path});
  }
}

TEST(SweepAxis, RejectsWhatIsNoRange) {
  for (const char* text :
       {"ball.speed", "=1", "ball.speed=1m/s..2kg", "a=1..2:often", "a=0..2:log", "a=1..2:1",
        "a=1...2", "a=1 m/s...10 m/s", "a=1..2:100000", "a=1m/s..2 hollow/s", "a=1,,2", "a=1,"}) {
    EXPECT_THROW(parse_axis(text), UsageError) << text;
  }
}

TEST(SweepAxis, CombinesAllValuesTheLastFastest) {
  const auto all = study::combinations({parse_axis("a=1..2:2"), parse_axis("b=1..3:3")});
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[1], (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(all[3], (std::vector<std::size_t>{1, 0}));
}

TEST(EhlImpact, HasItsKeys) {
  const io::Json json = json_of(kQuick);
  for (const char* key :
       {"impact_time_s", "time_max_force_s", "max_force_N", "min_film_m", "time_min_film_s",
        "turning_time_s", "rebound_speed_m_per_s", "restitution", "max_deformation_m",
        "primary_center_pressure_Pa", "phase_shift_s"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_number()) << key;
  }
  for (const char* key : {"H00", "V0", "M", "G", "W", "Pcl", "Hmin", "dT_over_Tr"}) {
    EXPECT_TRUE(json["groups"].contains(key)) << key;
  }
  for (const char* key : {"impact_time_s", "max_force_N", "max_deformation_m", "max_pressure_Pa"}) {
    EXPECT_TRUE(json["dry"].contains(key)) << key;
  }
  EXPECT_EQ(json["converged"], true);
  EXPECT_TRUE(json.contains("warnings"));
}

TEST(EhlImpact, KeepsHistoriesAndProfiles) {
  const test::Folder folder;
  const std::string file = folder / "impact.h5";
  ASSERT_EQ(run_tabor(quick({"-o", file})).code, 0);
  const io::Hdf5Reader reader(file);
  const auto times = reader.numbers("/history/time");
  EXPECT_EQ(reader.numbers("/history/force").size(), times.size());
  const auto shape = reader.shape("/profiles/film");
  EXPECT_EQ(shape[0], static_cast<Index>(reader.numbers("/profiles/time").size()));
  EXPECT_EQ(shape[1], 81);
  EXPECT_THAT(reader.text("/", "config_toml"), HasSubstr("e_prime"));
  EXPECT_GT(reader.number("/result/dry", "max_force_N"), 0);
}

TEST(EhlImpact, SweepsAndStudies) {
  const io::Json sweep = json_of(quick({"--set", "ball.speed=0.1m/s..0.4m/s:log:3"}));
  ASSERT_EQ(sweep["results"].size(), 3u);
  EXPECT_LT(sweep["results"][0]["restitution"], sweep["results"][2]["restitution"]);
  const io::Json study = json_of(quick({"--study", "grid"}));
  EXPECT_EQ(study["results"][2]["nodes"], 160);
  EXPECT_TRUE(study["limits"].contains("max_force_N"));
}

TEST(EhlImpact, ASweepOverThreeGridsShowsTheLimit) {
  const io::Json sweep = json_of(quick({"--set", "grid.nodes=40,57,80"}));
  ASSERT_EQ(sweep["results"].size(), 3u);
  EXPECT_TRUE(sweep["limits"]["max_deformation_m"].is_number());
  EXPECT_GT(sweep["orders"]["max_deformation_m"], 0);
  EXPECT_FALSE(json_of(quick({"--set", "ball.speed=0.2m/s,0.3m/s,0.4m/s"})).contains("limits"));
}

TEST(EhlImpact, KeepsTheWordsOfASweep) {
  const test::Folder folder;
  const std::string file = folder / "start.h5";
  ASSERT_EQ(run_tabor(quick({"--set", "impact.start=rigid,full", "-o", file})).code, 0);
  const io::Hdf5Reader reader(file);
  EXPECT_EQ(reader.attribute_texts("/sweep/axes/impact.start", "words"),
            (std::vector<std::string>{"rigid", "full"}));
  EXPECT_EQ(reader.numbers("/sweep/converged"), (std::vector<double>{1, 1}));
}

TEST(EhlImpact, GoesOnWithASweepBehindACaseThatMakesNoSense) {
  const test::Folder folder;
  const std::string file = folder / "sweep.h5";
  std::vector<std::string> words =
      quick({"--set", "ball.speed=0.2m/s..4m/s:2", "-o", file, "--json"});
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 4);
  const io::Json results = io::Json::parse(outcome.out)["results"];
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0]["converged"], true);
  EXPECT_EQ(results[1]["converged"], false);
  EXPECT_EQ(results[1]["status"], "rejected");
  EXPECT_THAT(results[1]["error"].get<std::string>(), HasSubstr("thicker layer"));
  const std::vector<std::string> warnings = io::Hdf5Reader(file).texts("/sweep/warnings");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[1], HasSubstr("thicker layer"));
  words.pop_back();
  EXPECT_THAT(run_tabor(words).err,
              testing::AllOf(HasSubstr("(1 of 2 cases"), HasSubstr("[rejected]")));
}

TEST(EhlImpact, RejectsASweepOfWhichNoCaseMakesSense) {
  const Outcome outcome = run_tabor(quick({"--set", "ball.speed=1..10"}));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("without a unit"));
  EXPECT_EQ(test::count_lines(outcome.err), 1u);
  EXPECT_EQ(outcome.out, "");
}

TEST(EhlImpact, InterruptedBeforeItsFirstCaseLeavesNothing) {
  const test::Folder folder;
  const auto interrupted = [&](const std::vector<std::string>& more) {
    set_interrupted(true);
    std::vector<std::string> words = quick(more);
    words.insert(words.end(), {"-o", folder / "out.h5"});
    const Outcome outcome = run_tabor(words);
    set_interrupted(false);
    EXPECT_EQ(outcome.code, 130);
    EXPECT_EQ(outcome.err, "tabor: interrupted\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.n_files(), 0u);
  };
  interrupted({"--set", "ball.speed=0.1m/s,0.2m/s"});
  interrupted({});
}

TEST(EhlImpact, SaysThatABallSticks) {
  const Outcome outcome = run_tabor(quick({"--set", "ball.speed=1mm/s"}));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("sticks"));
}

TEST(EhlVerb, RejectsWithTheReason) {
  const auto rejected = [](const std::vector<std::string>& words, int code,
                           const std::string& message) {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  rejected({"ehl", "impakt", kBall}, 2, "did you mean 'impact'");
  rejected(quick({"--set", "ball.spede=1m/s"}), 3, "ball.speed");
  rejected(quick({"--set", "ball.spede=1m/s"}), 3, "ball.toml: unknown key");
  rejected(quick({"--set", "ball.speed=0.2"}), 3, "unit");
  rejected(quick({"--set", "ball.speed=1m/s,2m/s", "--set", "ball.speed=3m/s,4m/s"}), 2,
           "varied twice");
  rejected(quick({"--set", "lubricant.layer=1um"}), 3, "thicker layer");
  rejected(quick({"--set", "lubricant.viscosity_law=baruss"}), 3, "barus");
  rejected(quick({"--set", "lubricant.viscosity=-1 Pa s"}), 3, "above zero");
  rejected(quick({"--study", "gird"}), 2, "did you mean 'grid'");
  rejected({"ehl", "impact", "nowhere.toml"}, 3, "nowhere.toml");
}

TEST(EhlSqueeze, HasItsKeys) {
  const test::Folder folder;
  const std::string file = folder / "roller.toml";
  test::put_bytes(file,
                  "[roller]\nmass_per_length = \"30.2 kg/m\"\neffective_radius = \"9.2 mm\"\n"
                  "spring = \"2.2e10 N/m^2\"\nspeed = \"0.25 m/s\"\n[lubricant]\n"
                  "viscosity = \"0.5 Pa s\"\npressure_viscosity = \"1.5e-8 1/Pa\"\n"
                  "layer = \"0.4 mm\"\n[motion]\nsliding_speed = \"5 m/s\"\n"
                  "[grid]\ntime_step = \"4 us\"\n");
  const io::Json json = json_of({"ehl", "squeeze", file});
  for (const char* key : {"max_force_N_per_m", "time_max_force_s", "min_film_m", "time_min_film_s",
                          "turning_time_s", "lag_s"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_number()) << key;
  }
  EXPECT_EQ(json["gap_closing_at_turning"], true);
  EXPECT_EQ(json["converged"], true);
  const io::Json linear = json_of({"ehl", "squeeze", file, "--set", "squeeze.model=linear", "--set",
                                   "roller.damping=1e6 N*s/m^2"});
  EXPECT_GT(linear["lag_s"], 0);
  // A film of less than nothing is no number.
  const io::Json closed = json_of({"ehl", "squeeze", file, "--set", "squeeze.model=linear", "--set",
                                   "roller.damping=1e3 N*s/m^2", "--set", "lubricant.layer=1um"});
  for (const char* key : {"min_film_m", "time_min_film_s", "turning_time_s", "lag_s"}) {
    EXPECT_TRUE(closed[key].is_null()) << key;
  }
  EXPECT_THAT(io::to_text(closed["warnings"]), HasSubstr("would close"));
}

}  // namespace
}  // namespace tabor::cli
