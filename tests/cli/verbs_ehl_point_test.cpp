#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "run_tabor.hpp"
#include "support/container_files.hpp"
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

/// The ball of Redlich, Bartel & Deters on a grid that is quick rather than fine.
class EhlPoint : public testing::Test {
 protected:
  EhlPoint() {
    std::ofstream(ball_) << "ball = {radius = \"1.5 mm\", load = \"16.6 N\"}\n"
                            "solids = {e_prime = \"230.8 GPa\"}\n"
                            "motion = {speed = \"1 m/s\"}\n[lubricant]\n"
                            "viscosity = \"0.149 Pa s\"\npressure_viscosity = \"2.131e-8 1/Pa\"\n"
                            "density_law = \"dowson-higginson\"\neyring_stress = \"6.8 MPa\"\n";
    std::ofstream(groups_) << "groups = {M = 20, L = 10}\n";
  }

  std::vector<std::string> words(const std::string& file,
                                 const std::vector<std::string>& changes = {},
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"ehl", "point", file, "--set", "grid.nodes=33"};
    for (const std::string& change : changes) all.insert(all.end(), {"--set", change});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<std::string> ball(const std::vector<std::string>& changes = {},
                                const std::vector<std::string>& more = {}) const {
    return words(ball_, changes, more);
  }

  void rejected(const std::vector<std::string>& words, const std::string& message) const {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << words.back();
    EXPECT_EQ(test::count_lines(outcome.err), 1u) << outcome.err;
  }

  test::Folder folder_;
  std::string ball_ = folder_ / "ball.toml";
  std::string groups_ = folder_ / "groups.toml";
};

TEST_F(EhlPoint, HasItsKeys) {
  const io::Json json = json_of(ball());
  for (const char* key :
       {"hertz_radius_m", "hertz_pressure_Pa", "M", "L", "central_film_m", "min_film_m", "Hc", "Hm",
        "max_pressure_Pa", "solid_contact_fraction", "plastic_fraction", "max_plastic_depth_m",
        "friction_fluid", "friction_solid", "friction_coefficient", "newton_iterations",
        "load_error", "mass_error"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_number()) << key;
  }
  EXPECT_EQ(json["converged"], true);
  EXPECT_TRUE(json["warnings"].is_array());
  // Hertz and the groups of the paper's Table 1, here at ten times its speed.
  EXPECT_NEAR(json["hertz_radius_m"].get<double>(), 54.49e-6, 0.01e-6);
  EXPECT_NEAR(json["hertz_pressure_Pa"].get<double>(), 2.669e9, 0.001e9);
  EXPECT_NEAR(json["M"].get<double>(), 1892 * std::pow(10, -0.75), 3);
  EXPECT_NEAR(json["L"].get<double>(), 12.61 * std::pow(10, 0.25), 0.03);
}

TEST_F(EhlPoint, TouchingSolidsRubAsTheCaseSays) {  // slow
  const std::vector<std::string> slow = {"motion.speed=0.01mm/s", "grid.inlet=2.5",
                                         "grid.half_width=1.75"};
  const auto with = [&](const std::string& change) {
    std::vector<std::string> changes = slow;
    changes.push_back(change);
    return json_of(ball(changes));
  };
  const io::Json bare = json_of(ball(slow));
  ASSERT_GT(bare["contact_load_share"].get<double>(), 0.5);
  EXPECT_TRUE(bare["friction_solid"].is_null());
  EXPECT_TRUE(bare["friction_coefficient"].is_null());
  EXPECT_THAT(io::to_text(bare["warnings"]), HasSubstr("boundary-friction"));
  const io::Json smooth = with("asperities.friction_coefficient=0");  // said, so believed
  EXPECT_EQ(smooth["friction_solid"], 0);
  EXPECT_THAT(io::to_text(smooth["warnings"]), Not(HasSubstr("boundary-friction")));
  const io::Json rubbing = with("asperities.friction_coefficient=0.1");
  EXPECT_NEAR(rubbing["friction_solid"].get<double>(),
              0.1 * bare["contact_load_share"].get<double>(), 1e-9);
  EXPECT_NEAR(rubbing["friction_coefficient"].get<double>(),
              rubbing["friction_solid"].get<double>() + bare["friction_fluid"].get<double>(), 1e-9);
  EXPECT_GT(with("asperities.shear_strength=50MPa")["friction_solid"].get<double>(), 0);
  rejected(ball({"asperities.shear_strength=50MPa", "asperities.friction_coefficient=0.1"}),
           "one of the two");
  rejected(ball({"asperities.friction_coefficient=-0.1"}), "zero or more");
}

TEST_F(EhlPoint, TheCentralFilmIsOneQuantityInAllUnits) {
  for (const std::vector<std::string>& changes :
       {std::vector<std::string>{}, {"roughness.kind=lapped-like", "grid.nodes=49"}}) {
    const io::Json json = json_of(ball(changes));
    const double film = json["central_film_m"].get<double>();
    const double least = json["min_film_m"].get<double>();
    EXPECT_NEAR(json["Hc"].get<double>() / json["Hm"].get<double>() / (film / least), 1, 1e-12);
    // U = eta0 u_m/(E' R)
    const double moes = 1.5e-3 * std::sqrt(2 * 0.149 * 0.5 / (230.8e9 * 1.5e-3));
    EXPECT_NEAR(json["Hc"].get<double>() * moes / film, 1, 1e-6);
    const double hertz = json["hertz_radius_m"].get<double>();
    EXPECT_NEAR(json["hertz_units"]["Hc"].get<double>() * hertz * hertz / 1.5e-3 / film, 1, 1e-6);
  }
}

TEST_F(EhlPoint, GivesNoFrictionThatNoOilHas) {
  std::vector<std::string> words = {"ehl",           "point", groups_,       "--set",
                                    "grid.nodes=33", "--set", "groups.M=200"};
  const auto with = [&](const std::string& change) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--set", change});
    return all;
  };
  const io::Json sliding = json_of(with("motion.sliding_speed=1 m/s"));
  for (const char* key : {"friction_fluid", "friction_coefficient", "max_shear_stress_Pa"}) {
    EXPECT_TRUE(sliding[key].is_null()) << key;
  }
  EXPECT_EQ(sliding["friction_solid"], 0);
  EXPECT_THAT(io::to_text(sliding["warnings"]), HasSubstr("eyring_stress"));
  const io::Json rolling = json_of(with("motion.sliding_speed=0 m/s"));
  EXPECT_EQ(rolling["friction_coefficient"], 0);
}

TEST_F(EhlPoint, TakesMoesGroups) {
  const io::Json json = json_of(words(groups_, {"grid.nodes=65"}));
  EXPECT_NEAR(json["M"].get<double>(), 20, 1e-9);
  EXPECT_NEAR(json["L"].get<double>(), 10, 1e-9);
  EXPECT_EQ(json["friction_coefficient"], 0);  // it rolls
  // 0.427 and 0.291 a^2/R on infinitely many nodes (tests/independent/point_film.py).
  EXPECT_NEAR(json["hertz_units"]["Hc"].get<double>(), 0.427, 0.05 * 0.427);
  EXPECT_NEAR(json["hertz_units"]["Hm"].get<double>(), 0.291, 0.05 * 0.291);
  const double per_moes = std::pow(1.5 * 20, 2.0 / 3);
  EXPECT_NEAR(json["Hc"].get<double>() / json["hertz_units"]["Hc"].get<double>(), per_moes, 1e-6);
  // The scale is free: another radius has the same film in these units.
  const io::Json larger = json_of(words(groups_, {"grid.nodes=65", "ball.radius=30mm"}));
  EXPECT_NEAR(larger["Hc"].get<double>() / json["Hc"].get<double>(), 1, 1e-6);
}

TEST_F(EhlPoint, GroupsOfAnIsoviscousLiquid) {
  const io::Json json = json_of(words(groups_, {"groups.L=0", "lubricant.viscosity_law=constant"}));
  EXPECT_EQ(json["L"], 0);
  EXPECT_NEAR(json["M"].get<double>(), 20, 1e-9);
  rejected(words(groups_, {"groups.L=5", "lubricant.viscosity_law=constant"}), "groups.L");
}

TEST_F(EhlPoint, FilmGrowsAcrossAnEllipsoid) {
  const io::Json round = json_of(words(groups_));
  const io::Json wide =
      json_of(words(groups_, {"ball.radius_x=10mm", "ball.radius_y=20mm", "grid.half_width=2"}));
  EXPECT_EQ(wide["converged"], true);
  EXPECT_GT(wide["Hc"], round["Hc"]);
  rejected(words(groups_, {"ball.radius_x=10mm"}), "ball.radius_y");
}

TEST_F(EhlPoint, SweepsTheStribeckCurve) {
  const std::string file = folder_ / "stribeck.h5";
  const io::Json json = json_of(ball({"motion.speed=0.1m/s..10m/s:log:3"}, {"-o", file}));
  ASSERT_EQ(json["results"].size(), 3u);
  EXPECT_EQ(json["results"][0]["set"]["motion.speed"], "0.1 m/s");
  EXPECT_LT(json["results"][0]["central_film_m"], json["results"][1]["central_film_m"]);
  EXPECT_LT(json["results"][1]["central_film_m"], json["results"][2]["central_film_m"]);
  const io::Hdf5Reader reader(file);
  EXPECT_EQ(reader.numbers("/sweep/friction_coefficient").size(), 3u);
}

TEST_F(EhlPoint, ASweepSaysOnceWhatVoidsTheNumbersOfItsRows) {
  const std::string file = folder_ / "newton.toml";
  std::ofstream(file) << "ball = {radius = \"1.5 mm\", load = \"16.6 N\"}\n"
                         "solids = {e_prime = \"230.8 GPa\"}\n"
                         "motion = {entrainment_speed = \"1 m/s\"}\n[lubricant]\n"
                         "viscosity = \"0.149 Pa s\"\npressure_viscosity = \"2.131e-8 1/Pa\"\n";
  const std::string out = folder_ / "sweep.h5";
  const std::vector<std::string> sweep =
      words(file, {"motion.sliding_speed=0m/s,1m/s,2m/s"}, {"-o", out});
  const Outcome table = run_tabor(sweep);
  EXPECT_EQ(table.code, 0) << table.err;
  const std::string which = " (2 of 3 cases, the worst shown";
  EXPECT_THAT(table.err, HasSubstr("Newtonian shear would be"));
  EXPECT_THAT(table.err, HasSubstr(which));
  EXPECT_THAT(table.err, HasSubstr("(all 3 cases"));
  EXPECT_THAT(table.err, Not(HasSubstr("--json")));
  EXPECT_THAT(table.out, HasSubstr("warnings\n"));
  const io::Json json = json_of(sweep);
  EXPECT_EQ(json["warnings"][2]["code"], "newtonian-shear");
  EXPECT_EQ(json["warnings"][2]["n_cases"], 2);
  EXPECT_EQ(json["results"][1]["warning_codes"][2], "newtonian-shear");
  EXPECT_EQ(json["results"][0]["friction_coefficient"], 0);
  EXPECT_TRUE(json["results"][1]["friction_coefficient"].is_null());
  EXPECT_TRUE(json["results"][2]["friction_coefficient"].is_null());
  const io::Hdf5Reader reader(out);
  EXPECT_TRUE(std::isnan(reader.numbers("/sweep/friction_coefficient")[1]));
  EXPECT_THAT(reader.attribute_texts("/", "warnings"), testing::Contains(HasSubstr(which)));
  const std::vector<std::string> codes = reader.texts("/sweep/warning_codes");
  ASSERT_EQ(codes.size(), 3u);
  EXPECT_THAT(codes[0], Not(HasSubstr("newtonian-shear")));
  EXPECT_THAT(codes[1], HasSubstr("newtonian-shear"));
  EXPECT_EQ(codes[1], codes[2]);
}

TEST_F(EhlPoint, FindsTheLimitOfThreeGrids) {  // slow
  const io::Json json = json_of(words(groups_, {"grid.nodes=33,49,73"}));
  const double extrapolated = 0.429 * std::pow(1.5 * 20, 2.0 / 3);  // as above
  EXPECT_NEAR(json["limits"]["Hc"].get<double>(), extrapolated, 0.03 * extrapolated);
  const io::Json study = json_of(words(groups_, {"grid.nodes=73"}, {"--study", "grid"}));
  EXPECT_EQ(study["results"][0]["nodes_x"], 33);
  EXPECT_EQ(study["limits"]["Hc"], json["limits"]["Hc"]);
}

TEST_F(EhlPoint, KeepsMapsAndCurves) {
  const std::string file = folder_ / "point.h5";
  const std::vector<std::string> bump = {"roughness.bump.height=20nm",
                                         "roughness.bump.wavelength=120um", "grid.nodes=41"};
  ASSERT_EQ(run_tabor(ball(bump, {"-o", file})).code, 0);
  const io::Hdf5Reader reader(file);
  EXPECT_EQ(reader.shape("/contact/film"), (std::vector<Index>{41, 41}));
  const std::vector<double> x = reader.numbers("/contact/x");
  const std::vector<double> place = reader.numbers("/along/place");
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(x[i], place[i], 1e-12);
  }
  EXPECT_NEAR(reader.field("/contact/roughness").maxCoeff(), 20e-9, 1e-9);
  EXPECT_TRUE(reader.exists("/along/smooth_film"));
  EXPECT_TRUE(reader.exists("/across/hertz_pressure"));
  const std::vector<double> share = reader.numbers("/slice_plane/share");
  EXPECT_EQ(share.front(), 0);
  EXPECT_EQ(share.back(), 1);
}

TEST_F(EhlPoint, TakesAScanAsRoughness) {
  const std::string scan = folder_ / "waves.h5";
  ASSERT_EQ(run_tabor({"generate", "sinusoid", "--amplitude", "5nm", "--wavelength-x", "80um",
                       "--pixels", "64", "--pixel", "4um", "-o", scan})
                .code,
            0);
  const auto json = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> all = {"roughness.file=" + scan, "grid.nodes=41"};
    all.insert(all.end(), changes.begin(), changes.end());
    return json_of(ball(all));
  };
  const io::Json across = json({});
  EXPECT_EQ(across["scan"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_NEAR(across["roughness_rms_m"].get<double>(), 5e-9 / std::sqrt(2), 1e-9);
  const io::Json along = json({"roughness.orientation=transverse"});
  EXPECT_NE(along["min_film_m"], across["min_film_m"]);
  const io::Json elsewhere = json({"roughness.place=[\"20um\", \"0um\"]"});
  EXPECT_NE(elsewhere["film_at_centre_m"], across["film_at_centre_m"]);
  const io::Json plane = json({"roughness.treatment=[\"lowpass=gauss:1mm\"]"});
  EXPECT_LT(plane["roughness_rms_m"], 0.1e-9);
}

TEST_F(EhlPoint, SaysWhatAScanOfRoughnessLacksInWordsOfTheCase) {
  const std::string layers = folder_ / "layers.plux";
  io::write_file(layers, test::two_layer_plux());
  const Outcome several = run_tabor(ball({"roughness.file=" + layers}));
  EXPECT_EQ(several.code, 3);
  EXPECT_THAT(several.err, HasSubstr("for example roughness.channel = \"0\""));
  const std::string numbers = folder_ / "numbers.txt";
  io::write_file(numbers, "1 2 3\n4 5 6\n7 8 9\n");
  EXPECT_THAT(run_tabor(ball({"roughness.file=" + numbers})).err,
              HasSubstr("--pixel 0.67um --unit um with 'tabor convert FILE OUT', and name OUT"));
}

TEST_F(EhlPoint, GeneratesFinishesFromTheirSeed) {  // slow
  const auto rms = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> all = {"motion.speed=100m/s", "grid.inlet=1.5", "grid.half_width=1.5"};
    all.insert(all.end(), changes.begin(), changes.end());
    return json_of(ball(all))["roughness_rms_m"].get<double>();
  };
  const double lapped = rms({"roughness.kind=lapped-like"});
  EXPECT_EQ(lapped, rms({"roughness.kind=lapped-like", "roughness.seed=1"}));
  EXPECT_NE(lapped, rms({"roughness.kind=lapped-like", "roughness.seed=2"}));
  EXPECT_GT(lapped, rms({"roughness.kind=polished-like"}));
  EXPECT_GT(rms({"roughness.kind=ground", "roughness.rms=0.2um"}),
            rms({"roughness.kind=ground", "roughness.rms=0.1um"}));
}

TEST_F(EhlPoint, SharesTheLoadWithSolids) {  // slow
  const std::vector<std::string> rough = {"roughness.kind=lapped-like", "grid.nodes=49",
                                          "grid.inlet=1.6", "grid.half_width=1.6",
                                          "solids.plastic_pressure=4GPa"};
  const io::Json json = json_of(ball(rough));
  EXPECT_EQ(json["converged"], true);
  EXPECT_EQ(json["max_pressure_Pa"], 4e9);
  EXPECT_GT(json["plastic_fraction"], 0);
  EXPECT_GT(json["dry"]["plastic_fraction"], json["plastic_fraction"]);
  EXPECT_GT(json["dry"]["solid_contact_fraction"], json["solid_contact_fraction"]);
  EXPECT_NEAR(json["friction_coefficient"].get<double>(),
              json["friction_fluid"].get<double>() + json["friction_solid"].get<double>(), 1e-12);
  std::vector<std::string> thick = rough;
  thick.emplace_back("asperities.boundary_film=20nm");
  const io::Json thickly = json_of(ball(thick));
  EXPECT_GT(thickly["solid_contact_fraction"], json["solid_contact_fraction"]);
  EXPECT_GE(thickly["contact_load_share"], json["contact_load_share"]);
}

TEST_F(EhlPoint, MovesItsRoughnessWithItsBody) {
  const std::vector<std::string> bump = {"motion.sliding_speed=0m/s", "roughness.bump.height=50nm",
                                         "roughness.bump.wavelength=100um",
                                         "roughness.bump.place=[\"-220um\", \"0um\"]"};
  std::vector<std::string> moving = bump;
  moving.emplace_back("motion.duration=1ms");
  const std::string file = folder_ / "passage.h5";
  const io::Json json = json_of(words(groups_, moving, {"-o", file}));
  EXPECT_TRUE(json.at("converged").get<bool>());
  const io::Json& history = json.at("history");
  EXPECT_DOUBLE_EQ(history.at("end_s").get<double>(), 1e-3);
  // Pure rolling: the roughness moves as fast as the liquid is drawn in.
  EXPECT_DOUBLE_EQ(history.at("roughness_speed_m_per_s").get<double>(),
                   json.at("entrainment_speed_m_per_s").get<double>());
  EXPECT_LE(history.at("min_film_m").get<double>(), json.at("min_film_m").get<double>());
  const io::Hdf5Reader reader(file);
  EXPECT_EQ(reader.shape("/history/central_film"),
            std::vector<Index>{history.at("steps").get<Index>() + 1});
  EXPECT_THAT(run_tabor(words(groups_, bump)).err,
              HasSubstr("Give motion.duration to let it move"));
}

TEST_F(EhlPoint, RejectsTransientsThatCannotBe) {
  rejected(words(groups_, {"motion.duration=1ms", "motion.sliding_speed=0m/s"}), "a [roughness]");
  rejected(words(groups_, {"motion.duration=1ms", "roughness.bump.height=50nm",
                           "roughness.bump.wavelength=100um"}),
           "a rough surface at rest");
  rejected(words(groups_, {"motion.duration=1s", "motion.sliding_speed=0m/s", "grid.time_step=1us",
                           "roughness.bump.height=50nm", "roughness.bump.wavelength=100um"}),
           "100000 or less");
  rejected(words(groups_, {"motion.duration=1ms", "motion.sliding_speed=0m/s",
                           "solids.plastic_pressure=4GPa", "roughness.bump.height=50nm",
                           "roughness.bump.wavelength=100um"}),
           "beside motion.duration");
}

TEST_F(EhlPoint, WarnsOfWhatItsEquationsDoNotSee) {
  std::ofstream(folder_ / "newtonian.toml")
      << "groups = {M = 200, L = 10}\n[motion]\nsliding_speed = \"1 m/s\"\n";
  const Outcome newtonian = run_tabor(words(folder_ / "newtonian.toml"));
  EXPECT_THAT(newtonian.err, HasSubstr("eyring_stress"));
  const Outcome moving =
      run_tabor(words(groups_, {"motion.sliding_speed=0m/s", "roughness.bump.height=5nm",
                                "roughness.bump.wavelength=200um"}));
  EXPECT_THAT(moving.err, HasSubstr("solved at rest"));
}

TEST_F(EhlPoint, RejectsWithTheReason) {
  rejected(ball({"ball.load=0 N"}), "above zero");
  rejected(ball({"ball.load=16.6"}), "unit");
  rejected(ball({"ball.load=1 MN"}), "load of a point contact");
  rejected(ball({"ball.radius_x=1mm"}), "ball.radius");
  rejected(ball({"groups.M=20"}), "beside [groups]");
  rejected(words(groups_, {"groups.M=-1"}), "groups.M");
  rejected(ball({"motion.sliding_speed=1m/s"}), "beside motion.speed");
  rejected(ball({"lubricant.viscosity=-1 Pa s"}), "above zero");
  rejected(ball({"lubricant.viscosity_law=barus", "lubricant.pressure_viscosity=5e-5 1/Pa"}),
           "viscosity");
  rejected(ball({"lubricant.limiting_stress=1MPa"}), "eyring_stress");
  rejected(ball({"solids.plastic_presure=4GPa"}), "solids.plastic_pressure");
  rejected(ball({"grid.nodes=5"}), "17 to");
  rejected(ball({"grid.inlet=0.5"}), "half axes");
  rejected(ball({"grid.domain=0"}), "factor");
  rejected(ball({"roughness.kind=laped-like"}), "did you mean 'lapped-like'");
  rejected(ball({"roughness.kind=ground", "roughness.orientation=across"}), "transverse");
  rejected(ball({"roughness.kind=ground", "roughness.pixel=1nm"}), "roughness.pixel");
  rejected(ball({"roughness.rms=1um"}), "without roughness.kind");
  rejected(ball({"roughness.bump.height=1um"}), "roughness.bump.wavelength");
  rejected(ball({"roughness.bump.height=1um", "roughness.bump.wavelength=1um"}), "more nodes");
  rejected(ball({"roughness.bump.height=1um", "roughness.bump.wavelength=200um",
                 "roughness.bump.place=3um"}),
           "two");
  rejected(ball({"roughness.file=nowhere.x3p"}), "nowhere.x3p");
}

}  // namespace
}  // namespace tabor::cli
