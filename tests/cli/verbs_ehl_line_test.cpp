#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::cli {
namespace {

using test::json_of;
using test::Outcome;
using test::run_tabor;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> quick(const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"ehl", "line",
                                    TABOR_SOURCE_DIR "/examples/11_hdpe_glycerol/hdpe.toml",
                                    "--set", "grid.nodes=300"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(EhlLine, HasItsKeys) {
  const io::Json json = json_of(quick());
  for (const char* key : {"min_film_m", "central_film_m", "max_pressure_Pa", "hertz_half_width_m",
                          "hertz_pressure_Pa", "friction_coefficient", "newton_iterations",
                          "load_error", "mass_error"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_number()) << key;
  }
  EXPECT_EQ(json["converged"], true);
  EXPECT_NEAR(json["min_film_m"].get<double>(), 83.4e-9, 1e-9);
}

TEST(EhlLine, FilmGrowsWithSpeedInASweep) {
  const io::Json json = json_of(quick({"--set", "motion.entrainment_speed=1mm/s..10mm/s:log:3"}));
  ASSERT_EQ(json["results"].size(), 3u);
  EXPECT_LT(json["results"][0]["min_film_m"], json["results"][1]["min_film_m"]);
  EXPECT_LT(json["results"][1]["min_film_m"], json["results"][2]["min_film_m"]);
}

TEST(EhlLine, KeepsItsProfile) {
  const test::Folder folder;
  const std::string file = folder / "line.h5";
  ASSERT_EQ(run_tabor(quick({"-o", file})).code, 0);
  const io::Hdf5Reader reader(file);
  EXPECT_TRUE(reader.exists("/profile/pressure"));
  EXPECT_TRUE(reader.exists("/profile/hertz_pressure"));
  EXPECT_TRUE(reader.exists("/profile/shear_stress"));
  EXPECT_TRUE(reader.exists("/profile/local_friction"));
  const Outcome info = run_tabor({"info", file});
  EXPECT_EQ(info.code, 3);
  EXPECT_THAT(info.err, HasSubstr("got results of tabor (ehl line); expected a scan file"));
}

std::vector<std::string> with_asperity(const std::string& height) {
  return quick({"--set", "grid.nodes=1200", "--set", "roughness.width=10um", "--set",
                "roughness.height=" + height});
}

TEST(EhlLine, SaysWhatAnAsperityMakesOfLocalFrictionAndPressure) {
  const io::Json none = json_of(with_asperity("0nm"))["single_asperity"];
  EXPECT_EQ(none["local_friction_ratio"], 1);
  EXPECT_EQ(none["pressure_ratio"], 1);
  const io::Json some = json_of(with_asperity("80nm"))["single_asperity"];
  EXPECT_GT(some["local_friction_ratio"], 1.1);
  EXPECT_GT(some["pressure_ratio"], 1.1);
  EXPECT_GT(some["local_friction"], none["local_friction"]);
  EXPECT_THAT(run_tabor(with_asperity("80nm")).out, HasSubstr("on the asperity"));
  EXPECT_FALSE(json_of(quick()).contains("single_asperity"));
}

TEST(EhlLine, GivesNoLocalFrictionRatioWithoutSliding) {
  std::vector<std::string> words = with_asperity("80nm");
  words.insert(words.end(), {"--set", "motion.sliding_speed=0 m/s"});
  const io::Json effect = json_of(words)["single_asperity"];
  EXPECT_EQ(effect["local_friction"], 0);
  EXPECT_TRUE(effect["local_friction_ratio"].is_null());
  EXPECT_GT(effect["pressure_ratio"], 1);
}

TEST(EhlLine, RejectsAsperitiesOfNoUse) {
  const auto rejected = [](const std::vector<std::string>& changes, const std::string& message) {
    std::vector<std::string> words = quick();
    for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  rejected({"roughness.height=100nm", "roughness.width=1um"}, "give more nodes");
  rejected({"roughness.height=100nm"}, "roughness.width");
  rejected({"roughness.height=100nm", "roughness.width=50um", "roughness.place=5mm"},
           "place of an asperity");
}

TEST(EhlLine, RejectsWithTheReason) {
  const auto rejected = [](const std::string& change, const std::string& message) {
    const Outcome outcome = run_tabor(quick({"--set", change}));
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << change;
  };
  rejected("cylinder.load_per_length=5e9 N/m", "load of a line contact");
  rejected("grid.nodes=20", "more nodes");
  rejected("wear.steps=3", "wear.steps: got without wear.coefficient");
  rejected("wear.track_length=1m", "without wear.coefficient");
  rejected("roughness.row=1", "without roughness.file");
  rejected("film.penalty=10", "without film.cavitation");
  rejected("grid.outlet=50um", "domain");
  rejected("lubricant.viscosity=-1 Pa s", "above zero");
  rejected("lubricant.pressure_viscosity=5e-5 1/Pa", "viscosity");
  rejected("cylinder.radius=2.5", "unit");
  rejected("film.cavitation=penatly", "penalty");
  rejected("roughness.height=10nm", "roughness.width");
  rejected("roughness.amplitude=10nm", "roughness.wavelength");
}

TEST(EhlLine, KnowsTheViscosityOfGlycerolWater) {
  const test::Folder folder;
  const std::string file = folder / "mixture.toml";
  const auto film_of = [&](const std::string& lubricant) {
    std::ofstream(file) << "cylinder = {radius = \"2.5 mm\", load_per_length = \"5000 N/m\"}\n"
                           "solids = {youngs_modulus = \"1.05 GPa\", poissons_ratio = 0.35}\n"
                           "motion = {entrainment_speed = \"7.9 mm/s\"}\ngrid = {nodes = 300}\n"
                           "[lubricant]\npressure_viscosity = \"5.9e-9 1/Pa\"\n"
                        << lubricant;
    return run_tabor({"ehl", "line", file, "--json"});
  };
  const std::string mixture = "glycerol_fraction = 0.95\n";
  const Outcome given = film_of("viscosity = \"374.0 mPa s\"\n");  // Cheng 2008 at 24 degC
  const Outcome celsius = film_of(mixture + "temperature = \"24 degC\"\n");
  const Outcome kelvin = film_of(mixture + "temperature = \"297.15 K\"\n");
  ASSERT_EQ(celsius.code, 0) << celsius.err;
  const auto film = [](const Outcome& outcome) {
    return io::Json::parse(outcome.out)["min_film_m"].get<double>();
  };
  EXPECT_NEAR(film(celsius) / film(given), 1, 5e-4);
  EXPECT_DOUBLE_EQ(film(celsius), film(kelvin));
  for (const char* bad : {"temperature = \"24 degC\"\nviscosity = \"1 Pa s\"\n", "",
                          "temperature = \"140 degC\"\n", "temperature = \"hot degC\"\n"}) {
    EXPECT_EQ(film_of(mixture + bad).code, 3) << bad;
  }
  EXPECT_EQ(film_of("viscosity = \"1 Pa s\"\ntemperature = \"24 degC\"\n").code, 3);
}

TEST(EhlLine, ShowsAnAsperityOnlyWithTheNodesForIt) {
  const Outcome coarse =
      run_tabor(quick({"--set", "roughness.height=50nm", "--set", "roughness.width=2um"}));
  EXPECT_EQ(coarse.code, 3);
  EXPECT_THAT(coarse.err, HasSubstr("more nodes"));
  const double smooth = json_of(quick())["max_pressure_Pa"].get<double>();
  const io::Json rough =
      json_of(quick({"--set", "roughness.height=80nm", "--set", "roughness.width=40um"}));
  EXPECT_GT(rough["max_pressure_Pa"], smooth);
}

TEST(EhlLine, TakesARowOfAScanAsRoughness) {
  const std::string scan = TABOR_SOURCE_DIR "/surfaces/edt_before.x3p";
  const std::vector<std::string> rough =
      quick({"--set", "roughness.file=" + scan, "--set", "motion.entrainment_speed=10m/s", "--set",
             "grid.inlet=160um", "--set", "grid.outlet=140um", "--set", "grid.nodes=600"});
  const io::Json json = json_of(rough);
  EXPECT_EQ(json["converged"], true);
  const Outcome far = run_tabor(quick({"--set", "roughness.file=" + scan}));
  EXPECT_EQ(far.code, 3);
  EXPECT_THAT(far.err, HasSubstr("longer profile"));
  std::vector<std::string> outside = rough;
  outside.insert(outside.end(), {"--set", "roughness.row=512"});
  EXPECT_EQ(run_tabor(outside).code, 3);
}

TEST(EhlLine, WearsATrack) {  // slow
  const std::vector<std::string> wear =
      quick({"--set", "wear.coefficient=2.8e-15 m^2/N", "--set", "wear.track_length=15.7 mm",
             "--set", "wear.steps=50", "--set", "wear.cycles_each=3600"});
  const io::Json json = json_of(wear)["wear"];
  EXPECT_EQ(json["converged"], true);
  // Archard: kw F times the distance, whatever the film does.
  EXPECT_NEAR(json["volume_per_width_m2"].get<double>() /
                  (2.8e-15 * 5000 * json["distance_m"].get<double>()),
              1, 1e-6);
  EXPECT_NEAR(json["distance_m"].get<double>(), 3600 * 15.7e-3, 0.03 * 3600 * 15.7e-3);
  std::vector<std::string> both = wear;
  both.insert(both.end(), {"--set", "roughness.height=50nm", "--set", "roughness.width=50um"});
  EXPECT_EQ(run_tabor(both).code, 3);
}

TEST(EhlLine, WearsATrackToAndFro) {  // slow
  const std::vector<std::string> wear =
      quick({"--set", "wear.coefficient=2.8e-15 m^2/N", "--set", "wear.stroke=1 mm", "--set",
             "wear.steps=100", "--set", "wear.cycles=2"});
  const io::Json json = json_of(wear)["wear"];
  EXPECT_EQ(json["converged"], true);
  EXPECT_NEAR(json["distance_m"].get<double>(), 4e-3, 1e-9);
  EXPECT_NEAR(json["volume_per_width_m2"].get<double>() / (2.8e-15 * 5000 * 4e-3), 1, 1e-6);
  EXPECT_LT(json["thinnest_film_m"], json["min_film_m"]);
  std::vector<std::string> one_way = wear;
  one_way.insert(one_way.end(), {"--set", "grid.outlet=200um"});
  const Outcome rejected = run_tabor(one_way);
  EXPECT_EQ(rejected.code, 3);
  EXPECT_THAT(rejected.err, HasSubstr("way back"));
}

TEST(EhlLine, WeighsWhatIsWornAndShowsItInASweep) {
  const std::vector<std::string> wear =
      quick({"--set", "wear.coefficient=2.8e-15 m^2/N", "--set", "wear.track_length=15.7 mm",
             "--set", "wear.steps=20", "--set", "wear.density=950 kg/m^3", "--set",
             "wear.width=1 mm", "--set", "wear.cycles_each=1000..2000:2"});
  const Outcome table = run_tabor(wear);
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("mean wear"));
  EXPECT_THAT(table.out, HasSubstr("worn mass"));
  const io::Json results = json_of(wear)["results"];
  for (const io::Json& result : results) {
    const io::Json& worn = result["wear"];
    EXPECT_NEAR(
        worn["mass_kg"].get<double>() / (950 * 1e-3 * worn["volume_per_width_m2"].get<double>()), 1,
        1e-12);
  }
  EXPECT_NEAR(
      results[1]["wear"]["mass_kg"].get<double>() / results[0]["wear"]["mass_kg"].get<double>(), 2,
      1e-6);
  EXPECT_THAT(run_tabor(quick({"--set", "motion.entrainment_speed=8mm/s..9mm/s:2"})).out,
              testing::Not(HasSubstr("wear")));
}

TEST(EhlLine, WarningsAStrokeInTooFewSteps) {
  const auto warnings = [](const std::string& steps) {
    return io::to_text(
        json_of(quick({"--set", "wear.coefficient=2.8e-15 m^2/N", "--set", "wear.stroke=1 mm",
                       "--set", "wear.steps=" + steps}))["warnings"]);
  };
  EXPECT_THAT(warnings("40"), HasSubstr("steps per cycle"));
  EXPECT_THAT(warnings("120"), testing::Not(HasSubstr("steps per cycle")));
}

std::vector<std::string> mixed(const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"ehl", "line",
                                    TABOR_SOURCE_DIR "/examples/11_hdpe_glycerol/mixed.toml",
                                    "--set", "grid.nodes=600"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(EhlLine, SharesTheLoadWithAsperities) {
  const test::Folder folder;
  const std::string file = folder / "mixed.h5";
  const io::Json json = json_of(mixed({"-o", file}));
  EXPECT_EQ(json["converged"], true);
  for (const char* key : {"asperity_load_share", "solid_contact_fraction"}) {
    EXPECT_GT(json[key], 0.1) << key;
    EXPECT_LT(json[key], 0.9) << key;
  }
  EXPECT_NEAR(json["friction_solid"].get<double>() + json["friction_fluid"].get<double>(),
              json["friction_coefficient"].get<double>(), 1e-12);
  EXPECT_NEAR(json["friction_solid"].get<double>(),
              0.09 * json["asperity_load_share"].get<double>(), 1e-12);
  EXPECT_TRUE(io::Hdf5Reader(file).exists("/profile/asperity_pressure"));
  EXPECT_FALSE(json_of(quick()).contains("asperity_load_share"));
}

TEST(EhlLine, GivesNoFrictionOfSolidsThatTheCaseSaysNothingOf) {
  const test::Folder folder;
  const std::string file = folder / "bare.toml";
  std::string text = io::read_text(TABOR_SOURCE_DIR "/examples/11_hdpe_glycerol/mixed.toml");
  const std::string law = "friction_coefficient = 0.09";
  ASSERT_NE(text.find(law), std::string::npos);
  std::ofstream(file) << text.erase(text.find(law), law.size());
  const std::vector<std::string> bare = {"ehl", "line", file, "--set", "grid.nodes=600"};
  const io::Json json = json_of(bare);
  EXPECT_GT(json["asperity_load_share"], 0.1);
  EXPECT_TRUE(json["friction_solid"].is_null());
  EXPECT_TRUE(json["friction_coefficient"].is_null());
  EXPECT_TRUE(json["friction_force_N_per_m"].is_null());
  EXPECT_TRUE(json["friction_fluid"].is_number());
  EXPECT_THAT(io::to_text(json["warnings"]), HasSubstr("boundary-friction"));
  EXPECT_THAT(run_tabor(bare).out, HasSubstr("friction coefficient  -"));
}

TEST(EhlLine, GivesNoFrictionThatNoOilHas) {  // slow
  const std::vector<std::string> steel =
      quick({"--set", "solids.youngs_modulus=200GPa", "--set", "cylinder.load_per_length=100 kN/m",
             "--set", "lubricant.pressure_viscosity=2e-8 1/Pa", "--set", "grid.nodes=1200"});
  const io::Json json = json_of(steel);
  EXPECT_EQ(json["converged"], true);
  EXPECT_TRUE(json["friction_coefficient"].is_null());
  EXPECT_TRUE(json["max_shear_stress_Pa"].is_null());
  EXPECT_THAT(io::to_text(json["warnings"]), HasSubstr("newtonian-shear"));
  EXPECT_THAT(io::to_text(json["warnings"]), Not(HasSubstr("eyring_stress")));  // no key of a line
}

TEST(EhlLine, WarnsOfAnInletThatStarvesTheContact) {
  const auto warnings_with = [](const std::string& inlet) {
    return io::to_text(
        json_of(quick({"--set", "grid.inlet=" + inlet, "--set", "grid.nodes=1200"}))["warnings"]);
  };
  EXPECT_THAT(warnings_with("130um"), HasSubstr("short-inlet"));
  EXPECT_THAT(warnings_with("500um"), Not(HasSubstr("short-inlet")));
}

TEST(EhlLine, SaysWhoseNumbersThoseOfALostFilmAre) {
  const Outcome lost =
      run_tabor(quick({"--set", "roughness.amplitude=2um", "--set", "roughness.wavelength=50um"}));
  EXPECT_EQ(lost.code, 4);
  EXPECT_THAT(lost.err, HasSubstr("% of the roughness; these numbers are from there"));
}

TEST(EhlLine, RejectsAGridForWhichThereIsNoMemory) {
  const Outcome outcome = run_tabor(quick({"--set", "grid.nodes=1000000000"}));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("grid.nodes: got so many nodes, which take"));
  EXPECT_THAT(outcome.err, HasSubstr("take fewer nodes"));
}

TEST(EhlLine, ChoosesNoDomain) {
  const Outcome outcome = run_tabor(quick({"--domain", "auto"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("only 'tabor ehl point' chooses its domain"));
}

TEST(EhlLine, RejectsAsperitiesThatMakeNoSense) {
  const auto rejected = [](std::vector<std::string> words, const std::string& change,
                           const std::string& message) {
    words.insert(words.end(), {"--set", change});
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << change;
  };
  rejected(mixed(), "asperities.boundary_film=0 nm", "above zero");
  rejected(mixed(), "asperities.shear_strength=1 MPa", "one of the two");
  rejected(mixed(), "asperities.friction_coefficient=-0.1", "friction_coefficient");
  rejected(mixed(), "motion.sliding_speed=1 mm/s", "one of the two");
  rejected(quick(), "asperities.friction_coefficient=0.1", "boundary_film");
  rejected(quick({"--set", "asperities.boundary_film=30 nm", "--set", "wear.track_length=16 mm"}),
           "wear.coefficient=1e-15 m^2/N", "boundary film");
}

}  // namespace
}  // namespace tabor::cli
