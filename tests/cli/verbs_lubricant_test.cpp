// lubricate and friction on a small generated surface.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class LubricantVerbs : public testing::Test {
 protected:
  void SetUp() override { make_scan("64"); }
  void make_scan(const std::string& pixels) {
    const Outcome made = run_tabor({"generate", "edt", "-o", scan(), "--pixels", pixels, "--pixel",
                                    "2um", "--noise", "0nm", "--plateau-roughness", "80nm"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string scan() const { return file("scan.h5"); }
  Words lubricate(const std::string& density) const {
    return {"lubricate", scan(), "--density", density};
  }
  Words friction(const std::string& pressure, const std::string& density) const {
    return {"friction",
            scan(),
            "--pressure",
            pressure,
            "--density",
            density,
            "--youngs-modulus",
            "70GPa",
            "--poisson-ratio",
            "0.33",
            "--saturation-pressure",
            "240MPa",
            "--shear-strength",
            "70MPa"};
  }

  Folder folder_;
};

TEST_F(LubricantVerbs, AMaterialWithoutShearStrengthIsNamed) {
  Words words = {"friction",  scan(),     "--pressure", "7MPa",
                 "--density", "0.9g/m^2", "--material", "steel-100cr6"};
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("steel-100cr6 has no shear strength in the library; add --shear-strength"));
  EXPECT_EQ(run_tabor(words + Words{"--shear-strength", "70MPa"}).code, 0);
}

TEST_F(LubricantVerbs, LubricateHasTheAgreedKeys) {
  const io::Json result = json_of(lubricate("0.45g/m^2,0.9g/m^2"));
  for (const char* key : {"model", "reading", "edge", "seed", "droplet_height_m",
                          "oil_density_kg_per_m3", "states", "scan", "warnings"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  ASSERT_EQ(result.at("states").size(), 2u);
  for (const char* key :
       {"lubricant_density_g_per_m2", "mean_film_m", "n_droplets", "wet_fraction", "max_film_m",
        "deposited_volume_m3", "lost_volume_m3", "n_pools", "seconds", "peak_memory_bytes"}) {
    EXPECT_TRUE(result.at("states").at(0).contains(key)) << key;
  }
}

TEST_F(LubricantVerbs, MeanFilmIsArealDensityOverOilDensity) {
  const io::Json states =
      json_of(lubricate("0.9g/m^2") + Words{"--oil-density", "800kg/m^3"}).at("states");
  EXPECT_NEAR(states.at(0).at("mean_film_m").get<double>(), 0.9e-3 / 800, 1e-15);
  EXPECT_EQ(states.at(0).at("lubricant_density_g_per_m2"), 0.9);
}

TEST_F(LubricantVerbs, StatesComeInTheOrderAskedFor) {
  const io::Json states = json_of(lubricate("0.9g/m^2,0.45g/m^2")).at("states");
  EXPECT_EQ(states.at(0).at("lubricant_density_g_per_m2"), 0.9);
  EXPECT_EQ(states.at(1).at("lubricant_density_g_per_m2"), 0.45);
}

TEST_F(LubricantVerbs, EveryDropletIsOnTheSurfaceOrCountedAsLost) {
  const double area = 64 * 2e-6 * 64 * 2e-6;
  for (const char* edge : {"closed", "open"}) {
    const io::Json state =
        json_of(lubricate("0.9g/m^2") + Words{"--edge", edge}).at("states").at(0);
    const double volume =
        state.at("deposited_volume_m3").get<double>() + state.at("lost_volume_m3").get<double>();
    // Whole droplets of 0.1 um times a pixel: the dose is met within one of them.
    EXPECT_NEAR(volume, area * 1e-6, 1e-7 * 2e-6 * 2e-6 * 1.001) << edge;
  }
}

TEST_F(LubricantVerbs, AllModelsRun) {
  for (const char* model : {"droplets", "limit", "bottom-fill", "uniform"}) {
    EXPECT_EQ(json_of(lubricate("0.9g/m^2") + Words{"--model", model}).at("model"), model);
  }
}

TEST_F(LubricantVerbs, AFloodedSurfaceIsWarnedAbout) {
  const io::Json result =
      json_of(lubricate("100g/m^2") + Words{"--model", "bottom-fill", "-o", file("out.h5")});
  EXPECT_TRUE(result.at("states").at(0).at("flooded").get<bool>());
  EXPECT_EQ(result.at("states").at(0).at("wet_fraction"), 1);
  ASSERT_EQ(result.at("warnings").size(), 1u);
  EXPECT_EQ(result.at("warnings").at(0).at("code"), "flood");
  const io::Hdf5Reader written(file("out.h5"));
  EXPECT_THAT(written.attribute_texts("/", "warnings"),
              testing::ElementsAre(testing::HasSubstr("floods the surface")));
  EXPECT_EQ(written.attribute_texts("/states/0000", "warning_codes"), Words{"flood"});
}

TEST_F(LubricantVerbs, LubricateKeepsTheFilms) {
  ASSERT_EQ(run_tabor(lubricate("0.9g/m^2,0.45g/m^2") + Words{"-o", file("out.h5")}).code, 0);
  const io::Hdf5Reader result(file("out.h5"));
  EXPECT_NEAR(result.field("/states/0000/film_thickness").mean(), 1e-6, 1e-10);
  EXPECT_NEAR(result.field("/states/0001/film_thickness").mean(), 0.5e-6, 1e-10);
}

TEST_F(LubricantVerbs, NegativeDensityIsBadInput) {
  EXPECT_EQ(run_tabor(lubricate("-1g/m^2")).code, 3);
  EXPECT_EQ(run_tabor(lubricate("1g/m^2") + Words{"--oil-density", "0kg/m^3"}).code, 3);
  EXPECT_EQ(run_tabor(lubricate("1g/m^2") + Words{"--droplet", "0um"}).code, 3);
}

TEST_F(LubricantVerbs, FrictionHasTheAgreedKeysForEveryPressureAndDensity) {
  const io::Json states = json_of(friction("2MPa,7MPa", "0.45g/m^2,0.9g/m^2")).at("states");
  ASSERT_EQ(states.size(), 4u);
  for (const char* key : {"mean_pressure_Pa", "lubricant_density_g_per_m2", "contact_area_fraction",
                          "lubricated_share", "spill_over_fraction", "friction_dry",
                          "friction_lubricated", "certificate", "converged"}) {
    EXPECT_TRUE(states.at(0).contains(key)) << key;
  }
  EXPECT_EQ(states.at(1).at("mean_pressure_Pa"), 2e6);
  EXPECT_EQ(states.at(1).at("lubricant_density_g_per_m2"), 0.9);
}

TEST_F(LubricantVerbs, FrictionSaysWhereTheTimeWent) {
  const Words words = friction("2MPa", "0.45g/m^2");
  const io::Json seconds = json_of(words).at("seconds");
  const double all = seconds.at("all").get<double>();
  for (const char* part : {"reading", "rain", "contacts"}) {
    ASSERT_TRUE(seconds.contains(part)) << seconds;
    EXPECT_GE(seconds.at(part).get<double>(), 0) << part;
    EXPECT_LE(seconds.at(part).get<double>(), all) << part;
  }
  EXPECT_THAT(run_tabor(words).out, testing::ContainsRegex("\ntime +[0-9.]+ s"));
}

TEST_F(LubricantVerbs, FrictionSaysHowFarDropletsAreFromTheirLimit) {
  make_scan("128");
  const Words droplets = friction("2MPa,7MPa", "0.01g/m^2,0.05g/m^2") + Words{"--droplet", "2um"};
  const io::Json of_droplets = json_of(droplets);
  const io::Json of_limit = json_of(droplets + Words{"--model", "limit"});
  double largest = 0;
  for (std::size_t i = 0; i < of_droplets.at("states").size(); ++i) {
    const auto friction_in = [&](const io::Json& object) {
      return object.at("states").at(i).at("friction_lubricated").get<double>();
    };
    largest = std::max(largest, std::abs(friction_in(of_droplets) - friction_in(of_limit)));
  }
  EXPECT_GT(largest, 0);
  EXPECT_NEAR(of_droplets.at("limit_difference").at("friction").get<double>(), largest, 1e-12);
  EXPECT_FALSE(of_limit.contains("limit_difference"));
  EXPECT_THAT(run_tabor(droplets).out, testing::ContainsRegex("\nlimit +friction with vanishing"));
}

TEST_F(LubricantVerbs, FrictionIsAreaTimesShearStrengthOverPressure) {
  for (const char* area : {"corrected", "pixels"}) {
    const io::Json state =
        json_of(friction("7MPa", "0.9g/m^2") + Words{"--area", area}).at("states").at(0);
    const std::string key =
        std::string("contact_area_fraction") + (area == std::string("pixels") ? "_pixels" : "");
    const double dry = state.at(key).get<double>() * 70.0 / 7.0;
    EXPECT_NEAR(state.at("friction_dry").get<double>(), dry, 1e-12) << area;
    EXPECT_NEAR(state.at("friction_lubricated").get<double>(),
                dry * (1 - state.at("lubricated_share").get<double>()), 1e-12);
  }
}

TEST_F(LubricantVerbs, FrictionWithoutOilIsDry) {
  const io::Json state = json_of(friction("7MPa", "0g/m^2")).at("states").at(0);
  EXPECT_EQ(state.at("friction_lubricated"), state.at("friction_dry"));
}

TEST_F(LubricantVerbs, FrictionKeepsContactAndFilm) {
  ASSERT_EQ(run_tabor(friction("7MPa", "0.9g/m^2") + Words{"-o", file("out.h5")}).code, 0);
  const io::Hdf5Reader result(file("out.h5"));
  for (const char* map : {"pressure", "gap", "film_thickness"}) {
    EXPECT_EQ(result.shape(std::string("/states/0000/") + map), (std::vector<Index>{64, 64}));
  }
  const io::Json entries = json_of({"cite", file("out.h5")}).at("bibtex");
  for (const char* key : {"bowden1950", "almqvist2007", "costagliola2021", "hdf5"}) {
    EXPECT_TRUE(entries.contains(key)) << key;
  }
}

TEST_F(LubricantVerbs, FrictionStoresEveryMapOnceAndNamesItInEveryState) {
  const auto size_of = [&](const std::string& densities) {
    EXPECT_EQ(run_tabor(friction("2MPa,7MPa", densities) + Words{"-o", file("out.h5")}).code, 0);
    return std::filesystem::file_size(file("out.h5"));
  };
  const auto one = size_of("0.45g/m^2"), three = size_of("0.45g/m^2,0.9g/m^2,0.6g/m^2");
  EXPECT_LT(three - one, 2 * 64 * 64 * sizeof(float) + 40000);  // two films, no contact
  const io::Hdf5Reader result(file("out.h5"));
  const auto map = [&](int state, const std::string& name) {
    return result.field(fmt::format("/states/{:04}/{}", state, name));
  };
  for (const int state : {1, 2}) {
    EXPECT_TRUE((map(state, "gap") == map(0, "gap")).all());
    EXPECT_TRUE((map(state + 3, "film_thickness") == map(state, "film_thickness")).all());
    EXPECT_FALSE((map(state + 3, "pressure") == map(state, "pressure")).all());
    EXPECT_EQ(result.shape(fmt::format("/states/{:04}/x", state)), std::vector<Index>{64});
  }
}

TEST_F(LubricantVerbs, FilesKeepTheMapsAskedForInThePrecisionAskedFor) {
  const auto kept = [&](const Words& more) {
    EXPECT_EQ(run_tabor(friction("7MPa", "0.9g/m^2") + Words{"-o", file("out.h5")} + more).code, 0);
    return io::Hdf5Reader(file("out.h5")).children("/states/0000");
  };
  EXPECT_EQ(kept({}), (Words{"film_thickness", "gap", "pressure", "state", "x", "y"}));
  const Field rounded = io::Hdf5Reader(file("out.h5")).field("/states/0000/gap");
  EXPECT_EQ(kept({"--fields", "contact"}),
            (Words{"film_thickness", "pressure", "state", "x", "y"}));
  EXPECT_EQ(kept({"--fields", "none"}), Words{});
  EXPECT_FALSE(io::Hdf5Reader(file("out.h5")).exists("/surface"));
  EXPECT_GT(io::Hdf5Reader(file("out.h5")).number("/states/0000", "friction_dry"), 0);
  kept({"--double"});
  const Field exact = io::Hdf5Reader(file("out.h5")).field("/states/0000/gap");
  EXPECT_TRUE((exact.cast<float>().cast<double>() == rounded).all());
  EXPECT_FALSE((exact == rounded).all());
}

TEST_F(LubricantVerbs, MapsNeedAFileAndAKnownChoice) {
  EXPECT_EQ(run_tabor(friction("7MPa", "0.9g/m^2") + Words{"--double"}).code, 2);
  EXPECT_EQ(run_tabor(friction("7MPa", "0.9g/m^2") + Words{"--fields", "all"}).code, 2);
  const Outcome outcome =
      run_tabor(friction("7MPa", "0.9g/m^2") + Words{"-o", file("out.h5"), "--fields", "contacts"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, testing::HasSubstr("did you mean 'contact'"));
}

TEST_F(LubricantVerbs, FlowingOilCarriesLoadAndAddsViscousFriction) {
  const Words oil = {"--fluid", "reynolds", "--viscosity", "0.2Pa*s"};
  const io::Json without = json_of(friction("7MPa", "0.9g/m^2")).at("states").at(0);
  EXPECT_FALSE(without.contains("fluid_load_share"));
  const io::Json state =
      json_of(friction("7MPa", "0.9g/m^2") + oil + Words{"--speed", "50mm/s"}).at("states").at(0);
  ASSERT_TRUE(state.contains("friction_mixed")) << state;
  EXPECT_TRUE(state.at("converged").get<bool>());
  // What the contact alone says stays what it was.
  for (const char* key : {"friction_dry", "friction_lubricated", "contact_area_fraction"}) {
    EXPECT_EQ(state.at(key), without.at(key)) << key;
  }
  const auto number = [&](const char* key) { return state.at(key).get<double>(); };
  EXPECT_GT(number("fluid_load_share"), 0);
  EXPECT_LT(number("friction_solid"), number("friction_lubricated") * 1.001);
  EXPECT_GT(number("friction_viscous"), 0);
  EXPECT_DOUBLE_EQ(number("friction_mixed"), number("friction_solid") + number("friction_viscous"));
}

TEST_F(LubricantVerbs, FlowingOilAtRestLeavesFrictionAsItWas) {
  for (const auto& [density, speed] :
       {std::pair{"0.9g/m^2", "0m/s"}, std::pair{"0g/m^2", "1m/s"}}) {
    const io::Json state =
        json_of(friction("7MPa", density) +
                Words{"--fluid", "reynolds", "--viscosity", "0.2Pa*s", "--speed", speed})
            .at("states")
            .at(0);
    EXPECT_EQ(state.at("friction_mixed"), state.at("friction_lubricated")) << density;
    EXPECT_EQ(state.at("fluid_load_share"), 0);
  }
}

TEST_F(LubricantVerbs, FlowingOilNeedsSpeedViscosityAndAPatchThatRepeats) {
  const Words base = friction("7MPa", "0.9g/m^2");
  const Words fluid = {"--fluid", "reynolds"};
  const Words speed = {"--speed", "5mm/s"};
  const Words viscosity = {"--viscosity", "0.2Pa*s"};
  EXPECT_EQ(run_tabor(base + fluid + speed).code, 2);
  EXPECT_EQ(run_tabor(base + fluid + viscosity).code, 2);
  EXPECT_EQ(run_tabor(base + speed).code, 2);
  EXPECT_EQ(run_tabor(base + viscosity).code, 2);
  EXPECT_EQ(run_tabor(base + fluid + viscosity + Words{"--speed", "-5mm/s"}).code, 3);
  EXPECT_EQ(run_tabor(base + fluid + speed + Words{"--viscosity", "0Pa*s"}).code, 3);
  EXPECT_EQ(run_tabor(base + fluid + speed + viscosity + Words{"--eyring-stress", "0MPa"}).code, 3);
  EXPECT_EQ(run_tabor(base + fluid + speed + viscosity + Words{"--boundary", "free"}).code, 2);
}

TEST_F(LubricantVerbs, FrictionKeepsTheFlowingFilm) {
  make_scan("24");
  const Words words = friction("7MPa", "0.9g/m^2") + Words{"--fluid",
                                                           "reynolds",
                                                           "--speed",
                                                           "50mm/s",
                                                           "--viscosity",
                                                           "0.2Pa*s",
                                                           "--pressure-viscosity",
                                                           "2e-8/Pa",
                                                           "--eyring-stress",
                                                           "5MPa",
                                                           "-o",
                                                           file("out.h5")};
  ASSERT_EQ(run_tabor(words).code, 0);
  const io::Hdf5Reader result(file("out.h5"));
  for (const char* map : {"fluid_pressure", "fluid_fill", "fluid_gap", "fluid_solid_pressure"}) {
    EXPECT_EQ(result.shape(std::string("/states/0000/") + map), (std::vector<Index>{24, 24}));
  }
  EXPECT_TRUE(json_of({"cite", file("out.h5")}).at("bibtex").contains("elrod1981"));
}

TEST_F(LubricantVerbs, ShearStrengthMustBePositive) {
  Words words = friction("7MPa", "0.9g/m^2");
  words.back() = "0MPa";
  EXPECT_EQ(run_tabor(words).code, 3);
}

TEST_F(LubricantVerbs, OilThatHasRunOffFillsNoGap) {
  const Words words = friction("100MPa", "0.1g/m^2,2g/m^2") + Words{"--edge", "open"};
  const io::Json found = json_of(words);
  const io::Json& few = found.at("states")[0];
  const io::Json& much = found.at("states")[1];
  EXPECT_LT(much.at("mean_film_m").get<double>(), 1.5e-6);  // of 2.2 um
  EXPECT_LE(few.at("mean_film_m").get<double>(), much.at("mean_film_m").get<double>());
  const Words closed = friction("100MPa", "2g/m^2");
  EXPECT_NEAR(json_of(closed).at("states")[0].at("mean_film_m").get<double>(), 2.222e-6, 1e-9);
}

TEST_F(LubricantVerbs, FrictionIsWarnedOnceOfOneThing) {
  const io::Json found = json_of(friction("7MPa", "0.45g/m^2"));
  int n_clamp = 0;
  for (const io::Json& one : found.at("warnings")) n_clamp += one.at("code") == "clamp" ? 1 : 0;
  EXPECT_EQ(n_clamp, 1);
}

TEST_F(LubricantVerbs, TablesThatCannotBeMadeAreRejected) {
  for (const Words& more : {Words{"--trapped"}, Words{"--model", "uniform"},
                            Words{"--tool", "ground:Sa=0.1um", "--tool-places", "2"}}) {
    const Outcome outcome =
        run_tabor(friction("7MPa", "0.45g/m^2") + Words{"--density-curve"} + more);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--density-curve needs --model droplets or limit"));
  }
  EXPECT_EQ(run_tabor(friction("7MPa", "0g/m^2") + Words{"--density-curve"}).code, 2);
}

TEST_F(LubricantVerbs, TablesThatWouldNotBePrintedAreRejected) {
  for (const char* table : {"--density-curve", "--resolution-scan"}) {
    const Words words = friction("7MPa", "0.45g/m^2") + Words{table, "--csv"};
    const Outcome printed = run_tabor(words);
    EXPECT_EQ(printed.code, 2);
    EXPECT_THAT(printed.err, HasSubstr(std::string("without the table of ") + table));
    EXPECT_EQ(run_tabor(words + Words{file("states.csv")}).code, 0);
  }
}

TEST_F(LubricantVerbs, FilesAreNamed) {
  const Words words = friction("7MPa", "0.45g/m^2");
  const Outcome none = run_tabor(words + Words{"-o", ""});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("--output: got ''; expected OUT.h5"));
}

TEST_F(LubricantVerbs, AToolWithoutItsPixelIsToBeConverted) {
  io::write_file(file("tool.txt"), "1 2 3\n4 5 6\n");
  const Outcome outcome =
      run_tabor(friction("7MPa", "0.45g/m^2") + Words{"--tool", file("tool.txt")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no pixel size in the file"));
  EXPECT_THAT(outcome.err, HasSubstr("--pixel 0.67um --unit um with 'tabor convert TOOL OUT'"));
}

TEST_F(LubricantVerbs, ACutOutCountsTheDropletsThatFell) {
  Words words = {"lubricate", scan(), "--edges", "cut", "--density", "0.0001g/m^2", "--json"};
  const Outcome outcome = run_tabor(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(" on 4096 pixels show chance"));
}

}  // namespace
}  // namespace tabor::test
