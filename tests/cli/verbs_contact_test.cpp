#include <gmock/gmock.h>

#include <algorithm>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class ContactVerb : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", scan(), "--pixels", "64",
                                    "--pixel", "1um", "--rms-slope", "0.1"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string scan() const { return file("scan.h5"); }
  Words contact(const std::string& pressure) const {
    return {"contact",          scan(),  "--pressure",      pressure,
            "--youngs-modulus", "70GPa", "--poisson-ratio", "0.33"};
  }

  Folder folder_;
};

TEST_F(ContactVerb, HasTheAgreedKeys) {
  const io::Json result = json_of(contact("20MPa,50MPa"));
  for (const char* key : {"nx", "ny", "effective_modulus_Pa", "saturation_pressure_Pa", "boundary",
                          "solver", "threads", "states", "warnings"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  ASSERT_EQ(result.at("states").size(), 2u);
  for (const char* key :
       {"mean_pressure_Pa", "contact_area_fraction", "contact_area_fraction_pixels",
        "saturated_area_fraction", "mean_gap_m", "separation_m", "max_pressure_Pa",
        "elastic_energy_J_per_m2", "n_patches", "perimeter_m", "certificate", "contact_gap_error_m",
        "converged", "iterations", "operator_applications", "fft_seconds", "seconds",
        "peak_memory_bytes"}) {
    EXPECT_TRUE(result.at("states").at(0).contains(key)) << key;
  }
}

TEST_F(ContactVerb, TakesPoissonsRatioBySpellingOfPythonToo) {
  Words words = contact("20MPa");
  const auto area = [&] {
    return json_of(words).at("states").at(0).at("contact_area_fraction").get<double>();
  };
  const double usual = area();
  std::replace(words.begin(), words.end(), std::string("--poisson-ratio"),
               std::string("--poissons-ratio"));
  EXPECT_EQ(area(), usual);
  const Outcome both = run_tabor(words + Words{"--poisson-ratio", "0.33"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--poisson-ratio is given more than once"));
}

TEST_F(ContactVerb, AreaGrowsWithPressureAndReachesTheTolerance) {
  const io::Json states = json_of(contact("20MPa,50MPa")).at("states");
  EXPECT_LT(states.at(0).at("contact_area_fraction").get<double>(),
            states.at(1).at("contact_area_fraction").get<double>());
  for (const io::Json& state : states) {
    EXPECT_TRUE(state.at("converged").get<bool>());
    EXPECT_LE(state.at("certificate").get<double>(), 1e-6);
  }
}

TEST_F(ContactVerb, TakesARangeOfPressures) {
  const io::Json ranged = json_of(contact("20MPa..80MPa:log:3")).at("states");
  ASSERT_EQ(ranged.size(), 3u);
  const io::Json listed = json_of(contact("20MPa,40MPa,80MPa")).at("states");
  for (std::size_t i = 0; i < ranged.size(); ++i) {
    for (const char* key : {"mean_pressure_Pa", "contact_area_fraction"}) {
      EXPECT_EQ(ranged.at(i).at(key), listed.at(i).at(key)) << key;
    }
  }
}

TEST_F(ContactVerb, RangesThatCannotBeAreUsageErrors) {
  for (const char* pressure : {"20MPa..80mm:3", "0MPa..80MPa:log:3", "20MPa..80MPa:many"}) {
    const Outcome outcome = run_tabor(contact(pressure));
    EXPECT_EQ(outcome.code, 2) << pressure;
    EXPECT_THAT(outcome.err, HasSubstr("--pressure: ")) << pressure;
    EXPECT_THAT(outcome.err, HasSubstr("write a range like")) << pressure;
  }
}

TEST_F(ContactVerb, StatisticsAddStiffnessAndHistograms) {
  EXPECT_FALSE(json_of(contact("20MPa")).at("states").at(0).contains("contact_stiffness_Pa_per_m"));
  const io::Json state = json_of(contact("20MPa") + Words{"--statistics"}).at("states").at(0);
  EXPECT_GT(state.at("contact_stiffness_Pa_per_m").get<double>(), 0);
  for (const char* key : {"pressure_histogram", "gap_histogram", "patch_area_histogram"}) {
    EXPECT_TRUE(state.at(key).contains("count")) << key;
  }
}

TEST_F(ContactVerb, ALoadPathKeepsThePlasticIndentation) {
  const Words path = contact("20MPa,60MPa,20MPa") + Words{"--saturation-pressure", "2GPa"};
  const io::Json kept = json_of(path + Words{"--load-path"}).at("states");
  const io::Json fresh = json_of(path).at("states");
  const auto area = [](const io::Json& states, std::size_t k) {
    return states.at(k).at("contact_area_fraction_pixels").get<double>();
  };
  EXPECT_EQ(area(fresh, 0), area(fresh, 2));
  EXPECT_EQ(area(kept, 0), area(fresh, 0));
  EXPECT_GT(area(kept, 2), area(kept, 0));
}

TEST_F(ContactVerb, EffectiveModulusFollowsFromBothBodies) {
  const io::Json rigid = json_of(contact("20MPa"));
  EXPECT_NEAR(rigid.at("effective_modulus_Pa").get<double>(), 70e9 / (1 - 0.33 * 0.33), 1);
  const io::Json equal = json_of(contact("20MPa") + Words{"--counter-youngs-modulus", "70GPa",
                                                          "--counter-poisson-ratio", "0.33"});
  EXPECT_NEAR(equal.at("effective_modulus_Pa").get<double>(), 35e9 / (1 - 0.33 * 0.33), 1);
}

TEST_F(ContactVerb, SaturationCapsThePressure) {
  const io::Json result = json_of(contact("20MPa") + Words{"--saturation-pressure", "240MPa"});
  const io::Json& state = result.at("states").at(0);
  EXPECT_LE(state.at("max_pressure_Pa").get<double>(), 240e6);
  EXPECT_GE(state.at("contact_area_fraction").get<double>(), 20.0 / 240);
  EXPECT_EQ(result.at("saturation_pressure_Pa"), 240e6);
}

TEST_F(ContactVerb, PressureAtOrAboveSaturationIsBadInput) {
  for (const char* pressure : {"240MPa", "20MPa,300MPa"}) {
    const Outcome outcome = run_tabor(contact(pressure) + Words{"--saturation-pressure", "240MPa"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(count_lines(outcome.err), 1u);
    EXPECT_THAT(outcome.err, HasSubstr("saturation"));
  }
}

TEST_F(ContactVerb, SolidsThatDoNotExistAreBadInput) {
  const Words base = {"contact", scan(), "--pressure", "1MPa"};
  EXPECT_EQ(run_tabor(base + Words{"--youngs-modulus", "-70GPa", "--poisson-ratio", "0.3"}).code,
            3);
  EXPECT_EQ(run_tabor(base + Words{"--youngs-modulus", "70GPa", "--poisson-ratio", "0.7"}).code, 3);
  EXPECT_EQ(run_tabor(contact("-1MPa")).code, 3);
}

TEST_F(ContactVerb, HalfACounterBodyIsAUsageError) {
  const Outcome outcome = run_tabor(contact("1MPa") + Words{"--counter-youngs-modulus", "1GPa"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--counter-poisson-ratio"));
}

TEST_F(ContactVerb, HolesAreRejectedWithTheOptionThatFillsThem) {
  put_bytes(folder_ / "holes.txt", "1 2 3\n4 NaN 6\n7 8 10\n");
  const Words words = {"contact",          file("holes.txt"),
                       "--pixel",          "1um",
                       "--unit",           "nm",
                       "--pressure",       "1MPa",
                       "--youngs-modulus", "70GPa",
                       "--poisson-ratio",  "0.33"};
  const Outcome rejected = run_tabor(words);
  EXPECT_EQ(rejected.code, 3);
  EXPECT_THAT(rejected.err, HasSubstr("--fill harmonic"));
  EXPECT_EQ(run_tabor(words + Words{"--fill", "harmonic"}).code, 0);
}

TEST_F(ContactVerb, BothSolversAndBothBoundariesAgreeOnALightContact) {
  const auto area = [&](const Words& more) {
    return json_of(contact("5MPa") + more)
        .at("states")
        .at(0)
        .at("contact_area_fraction_pixels")
        .get<double>();
  };
  EXPECT_EQ(area({}), area({"--solver", "polonsky-keer"}));
  EXPECT_GT(area({"--boundary", "free"}), 0);
}

TEST_F(ContactVerb, KeepsTheMapsOfEveryState) {
  const Outcome outcome = run_tabor(contact("20MPa,50MPa") + Words{"-o", file("out.h5")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::Hdf5Reader result(file("out.h5"));
  for (const std::string state : {"/states/0000", "/states/0001"}) {
    for (const std::string map : {"/pressure", "/gap"}) {
      EXPECT_EQ(result.shape(state + map), (std::vector<Index>{64, 64}));
      EXPECT_TRUE(result.has_attribute(state + map, "units"));
    }
  }
  EXPECT_NEAR(result.field("/states/0001/pressure").mean(), 50e6, 1);
  EXPECT_EQ(result.number("/states/0000", "mean_pressure_Pa"), 20e6);
  EXPECT_EQ(result.text("/", "format"), "tabor");
  EXPECT_THAT(result.text("/", "command"), HasSubstr("tabor contact"));
  EXPECT_THAT(result.text("/", "config_toml"), HasSubstr("youngs_modulus_Pa = 70000000000.0"));
}

TEST_F(ContactVerb, CiteNamesWhatTheResultUsed) {
  ASSERT_EQ(run_tabor(contact("20MPa") + Words{"-o", file("out.h5")}).code, 0);
  const io::Json elastic = json_of({"cite", file("out.h5")}).at("bibtex");
  EXPECT_TRUE(elastic.contains("stanley1997"));
  EXPECT_FALSE(elastic.contains("almqvist2007"));
  EXPECT_FALSE(elastic.contains("barnes2021"));
}

TEST_F(ContactVerb, ResultsDoNotDependOnTheThreadCount) {
  const auto state = [&](const std::string& threads) {
    io::Json json = json_of(contact("20MPa") + Words{"--threads", threads}).at("states").at(0);
    for (const char* timing : {"seconds", "fft_seconds", "peak_memory_bytes"}) json.erase(timing);
    return json;
  };
  EXPECT_EQ(state("1"), state("2"));
}

TEST_F(ContactVerb, InterruptedKeepsWhatWasFinishedAndLeaves) {
  cli::set_interrupted(true);
  const Outcome outcome = run_tabor(contact("20MPa") + Words{"--json"});
  cli::set_interrupted(false);
  EXPECT_EQ(outcome.code, 130);
}

TEST_F(ContactVerb, LowPassScanRepeatsTheContactForEveryCutoff) {
  const io::Json result =
      json_of(contact("20MPa") + Words{"--lowpass-scan", "4,8,16", "--shear-strength", "70MPa"});
  const io::Json& states = result.at("states");
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states.at(1).at("lowpass"), "lowpass=hann:8/L");
  EXPECT_LT(states.at(0).at("rms_slope").get<double>(), states.at(2).at("rms_slope").get<double>());
  for (const io::Json& state : states) {
    EXPECT_NEAR(state.at("friction_dry").get<double>(),
                state.at("contact_area_fraction").get<double>() * 70 / 20, 1e-12);
  }
  EXPECT_EQ(result.at("plateaus").size(), 1u);
}

/// The scan's numbers are those of the plain command with the same filter, on rectangular scans and
/// after --mirror too, and the wavelength it shows is the filter's.
TEST_F(ContactVerb, LowPassScanMeansTheCutoffsOfTheFilter) {
  const std::string wide = file("wide.h5");
  ASSERT_EQ(run_tabor({"generate", "self-affine", "-o", wide, "--pixels", "64,32", "--pixel",
                       "1um,0.5um", "--rms-slope", "0.1"})
                .code,
            0);
  const double side = std::sqrt(64e-6 * 16e-6);
  for (const Words& treatment : {Words{}, Words{"--mirror"}}) {
    Words words = contact("20MPa") + treatment;
    words[1] = wide;
    const io::Json state = json_of(words + Words{"--lowpass-scan", "4,8"}).at("states").at(1);
    EXPECT_NEAR(state.at("cutoff_wavelength_m").get<double>(), side / 8, 1e-12 * side);
    const io::Json plain = json_of(words + Words{"--lowpass", "hann:8/L"}).at("states").at(0);
    for (const char* key : {"contact_area_fraction", "mean_gap_m", "max_pressure_Pa"}) {
      EXPECT_EQ(state.at(key), plain.at(key)) << key;
    }
  }
}

TEST_F(ContactVerb, TableShowsCertificateAndConvergence) {
  const Outcome outcome = run_tabor(contact("20MPa"));
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("20 MPa"), HasSubstr("certificate"),
                                          HasSubstr("converged"), HasSubstr("yes")));
}

TEST_F(ContactVerb, EdgesAreTheBoundaryAndTheMirrorInOneWord) {
  const auto states = [&](const Words& more) {
    io::Json all = json_of(contact("20MPa") + more);
    io::Json numbers = {all.at("nx"), all.at("boundary")};
    for (const char* key : {"contact_area_fraction", "mean_gap_m", "max_pressure_Pa"}) {
      numbers.push_back(all.at("states").at(0).at(key));
    }
    return numbers;
  };
  const Words crop = {"--crop", "0,0,48,40"};
  EXPECT_EQ(states(crop + Words{"--edges", "tile"}),
            states(crop + Words{"--boundary", "periodic"}));
  EXPECT_EQ(states(crop + Words{"--edges", "cut"}), states(crop + Words{"--mirror"}));
  EXPECT_EQ(states(crop + Words{"--edges", "end"}), states(crop + Words{"--boundary", "free"}));
  EXPECT_EQ(states({"--boundary", "free", "--edges", "end"}), states({"--edges", "end"}));
}

TEST_F(ContactVerb, EdgesAreWarnedAboutUntilTheyAreSaid) {
  const auto warns = [&](const Words& more) {
    return run_tabor(contact("20MPa") + more).err.find("[not-periodic]") != std::string::npos;
  };
  const Words crop = {"--crop", "0,0,48,40"};
  EXPECT_FALSE(warns({}));
  EXPECT_TRUE(warns(crop));
  for (const char* edges : {"tile", "cut", "end"}) {
    EXPECT_FALSE(warns(crop + Words{"--edges", edges})) << edges;
  }
}

TEST_F(ContactVerb, EdgesOfAFileAreThoseItWasWrittenWith) {
  const std::string ends = file("ends.h5");
  ASSERT_EQ(run_tabor({"convert", scan(), ends, "--crop", "0,0,48,40", "--edges", "end"}).code, 0);
  Words words = contact("20MPa");
  words[1] = ends;
  EXPECT_EQ(json_of(words).at("boundary"), "free");
  const Outcome contradiction = run_tabor(words + Words{"--boundary", "periodic"});
  EXPECT_EQ(contradiction.code, 2);
  EXPECT_THAT(contradiction.err, HasSubstr("contradict each other"));
}

TEST_F(ContactVerb, RejectsEdgesThatContradictEachOther) {
  for (const Words& wrong : {Words{"--edges", "cut", "--boundary", "free"},
                             {"--edges", "tile", "--boundary", "free"},
                             {"--boundary", "periodic", "--edges", "end"},
                             {"--edges", "tile", "--edges", "cut"},
                             {"--edges", "end", "--mirror"},
                             {"--mirror", "--edges", "tile"},
                             {"--edges", "endless"}}) {
    const Outcome outcome = run_tabor(contact("20MPa") + wrong);
    EXPECT_EQ(outcome.code, 2) << wrong[1] << wrong.back();
    EXPECT_THAT(outcome.err, HasSubstr("edges"));
  }
  const Outcome psd = run_tabor({"psd", scan(), "--edges", "end", "--mirror"});
  EXPECT_EQ(psd.code, 2) << psd.err;
}

}  // namespace
}  // namespace tabor::test
