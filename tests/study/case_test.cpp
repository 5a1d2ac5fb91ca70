#include "tabor/study/case.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <set>

#include "study/example_study.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::HasSubstr;
using testing::Not;

/// The same files for all keys of a test: written twice they hold two dates.
Study example() {
  static const ExampleStudy files;
  return files.read();
}

/// All keys of the example's first scan, after a change to the study.
ScanTasks tasks_after(const std::function<void(Study&)>& change) {
  Study study = example();
  change(study);
  return tasks_of(study).front();
}

ScanTasks tasks() {
  return tasks_after([](Study&) {});
}

TEST(Tasks, KeysDoNotDependOnWhereTheStudyLies) {
  const ExampleStudy one;
  const ExampleStudy other;
  for (const char* scan : {"scan_1.h5", "scan_2.h5"}) {  // written twice they hold two dates
    std::filesystem::copy_file(one.folder / scan, other.folder / scan,
                               std::filesystem::copy_options::overwrite_existing);
  }
  EXPECT_EQ(tasks_of(one.read())[0].cases[1][1].key, tasks_of(other.read())[0].cases[1][1].key);
}

TEST(Tasks, KeyIsTheDigestOfAFixedText) {
  // If this changes, stores written before are computed again: then kAlgorithms must change too.
  Study study;
  study.treatment = {"level=plane"};
  const engine::Task surface = surface_task(study, {}, "abc");
  EXPECT_EQ(surface.text,
            "tabor surface 5\nscan_sha256 = 3:abc\nchannel = 0:\nunit = 0:\npixel_x_m = 0\n"
            "pixel_y_m = 0\nstep = 11:level=plane\n");
  EXPECT_EQ(surface.file, "surface-" + surface.key + ".h5");
  EXPECT_EQ(surface.key.size(), 16u);
}

TEST(Tasks, TextOfACaseWithoutFlowIsWhatItWasBeforeOilCouldFlow) {
  Study study;
  study.settings.friction.shear_strength = 7e7;
  engine::Task contact;
  contact.key = "c";
  engine::Task film;
  film.key = "f";
  const Scan scan{"", "one", "all", {}};
  EXPECT_EQ(case_task(study, scan, {contact}, film, 9e-4).text,
            "tabor case 5\nscan = 3:one\ngroup = 3:all\ncontact = 1:c\nfilm = 1:f\n"
            "lubricant_density_kg_per_m2 = 0.00089999999999999998\n"
            "shear_strength_Pa = 70000000\narea = 9:corrected\n");
}

TEST(Tasks, FilmsOnMirrorImagesAloneKnowWhichRainFell) {
  const auto text = [](const topography::Treatment& steps) {
    Study study;
    study.treatment = steps;
    engine::Task surface;
    surface.key = "s";
    return film_task(study, surface).text;
  };
  EXPECT_THAT(text({"level=plane", "edges=tile"}), Not(HasSubstr("image")));
  for (const char* step : {"mirror", "edges=cut", "recipe=part"}) {
    EXPECT_THAT(text({"level=plane", step}), HasSubstr("image_algorithms = 2\n")) << step;
  }
}

cases::FluidSettings flowing(double viscosity, std::optional<double> pressure_viscosity = {},
                             std::optional<double> eyring_stress = {}) {
  return {.fluid = cases::Fluid::reynolds,
          .viscosity = viscosity,
          .pressure_viscosity = pressure_viscosity,
          .eyring_stress = eyring_stress};
}

/// Lets the oil of a study flow.
void let_flow(Study& study) {
  study.settings.fluid = flowing(0.2);
  study.sliding_speeds = {0.01, 0.1};
}

TEST(Tasks, OilThatFlowsChangesOnlyTheCases) {
  const ScanTasks before = tasks();
  const ScanTasks flowing = tasks_after(let_flow);
  EXPECT_EQ(flowing.surface.key, before.surface.key);
  EXPECT_EQ(flowing.film.key, before.film.key);
  EXPECT_EQ(flowing.contacts[1].key, before.contacts[1].key);
  ASSERT_EQ(flowing.cases[0].size(), 4u);  // 2 densities x 2 speeds
  EXPECT_TRUE(before.fluids[0].empty());
  std::set<std::string> keys{before.cases[0][0].key, before.cases[0][1].key};
  for (const auto& tasks : {flowing.cases[0], flowing.fluids[0], flowing.fluids[1]}) {
    for (const engine::Task& task : tasks) keys.insert(task.key);
  }
  EXPECT_EQ(keys.size(), 14u);
}

TEST(Tasks, AFilmThatFlowsDoesNotKnowTheShearStrengthButItsOil) {
  const ScanTasks before = tasks_after(let_flow);
  const ScanTasks stronger = tasks_after([](Study& study) {
    let_flow(study);
    study.settings.friction.shear_strength = 1e6;
  });
  EXPECT_EQ(stronger.fluids[0][0].key, before.fluids[0][0].key);
  EXPECT_NE(stronger.cases[0][0].key, before.cases[0][0].key);
  for (const cases::FluidSettings& oil :
       {flowing(0.3), flowing(0.2, 1e-8), flowing(0.2, {}, 1e6)}) {
    const ScanTasks other = tasks_after([&](Study& study) {
      let_flow(study);
      study.settings.fluid = oil;
    });
    EXPECT_NE(other.fluids[0][0].key, before.fluids[0][0].key);
    EXPECT_NE(other.cases[0][0].key, before.cases[0][0].key);
  }
  const ScanTasks faster = tasks_after([](Study& study) {
    let_flow(study);
    study.sliding_speeds = {0.1, 0.2};
  });
  EXPECT_EQ(faster.fluids[0][0].key, before.fluids[0][1].key);  // a speed keeps its key
}

TEST(Tasks, AllKeysOfAStudyDiffer) {
  std::set<std::string> keys;
  std::size_t n = 0;
  for (const ScanTasks& scan : tasks_of(ExampleStudy().read())) {
    for (const auto& cases : scan.cases) {
      for (const engine::Task& task : cases) {
        keys.insert(task.key);
        ++n;
      }
    }
  }
  EXPECT_EQ(n, 8u);
  EXPECT_EQ(keys.size(), n);
}

TEST(Tasks, ASettingChangesOnlyWhatDependsOnIt) {
  const ScanTasks before = tasks();
  const ScanTasks strength =
      tasks_after([](Study& study) { study.settings.friction.shear_strength = 1e6; });
  EXPECT_EQ(strength.contacts[0].key, before.contacts[0].key);
  EXPECT_EQ(strength.film.key, before.film.key);
  EXPECT_NE(strength.cases[0][0].key, before.cases[0][0].key);

  const ScanTasks seed = tasks_after([](Study& study) { study.settings.film.seed = 2; });
  EXPECT_EQ(seed.contacts[0].key, before.contacts[0].key);
  EXPECT_NE(seed.film.key, before.film.key);
  EXPECT_NE(seed.cases[0][0].key, before.cases[0][0].key);

  const ScanTasks modulus =
      tasks_after([](Study& study) { study.settings.contact.youngs_modulus = 71e9; });
  EXPECT_EQ(modulus.film.key, before.film.key);
  EXPECT_NE(modulus.contacts[0].key, before.contacts[0].key);

  const ScanTasks treatment = tasks_after([](Study& study) { study.treatment = {}; });
  EXPECT_NE(treatment.surface.key, before.surface.key);
  EXPECT_NE(treatment.film.key, before.film.key);
  EXPECT_NE(treatment.contacts[0].key, before.contacts[0].key);
}

TEST(Tasks, SettingsOfAScanAreAsGoodAsThoseOfItsStudy) {
  Study own = example();
  own.scans[0].own = {.mean_pressures = {{7e6}},
                      .lubricant_densities = {{9e-4}},
                      .treatment = topography::Treatment{"level=plane"},
                      .deformation = Deformation::elastic,
                      .reading = deposition::Reading::literal};
  const ScanTasks theirs = tasks_after([](Study& study) {
    study.settings.mean_pressures = {7e6};
    study.settings.film.lubricant_densities = {9e-4};
    study.treatment = {"level=plane"};
    study.settings.contact.saturation_pressure.reset();
    study.settings.film.reading = deposition::Reading::literal;
  });
  const std::vector<ScanTasks> all = tasks_of(own);
  EXPECT_EQ(all[0].cases.at(0).at(0).key, theirs.cases.at(0).at(0).key);
  EXPECT_EQ(all[0].cases.size(), 1u);
  EXPECT_EQ(all[1].cases.at(0).at(0).key, tasks_of(example())[1].cases.at(0).at(0).key);
}

TEST(Tasks, WetSharesDependOnTheContactTheOilAndItsDensitiesButOnNoStrength) {
  const ScanTasks before = tasks();
  ASSERT_EQ(before.wet_shares.size(), 2u);
  const ScanTasks same = tasks_after([](Study& study) {
    study.settings.friction.shear_strength = 1e6;
    study.settings.film.lubricant_densities.push_back(0);  // no oil is no point of the curve
    study.settings.film.seed = 2;
  });
  EXPECT_EQ(same.wet_shares[0].key, before.wet_shares[0].key);
  const ScanTasks more =
      tasks_after([](Study& study) { study.settings.film.lubricant_densities.push_back(1e-3); });
  EXPECT_NE(more.wet_shares[0].key, before.wet_shares[0].key);
  const ScanTasks heavy = tasks_after([](Study& study) { study.settings.film.oil_density = 800; });
  EXPECT_NE(heavy.wet_shares[0].key, before.wet_shares[0].key);
  const ScanTasks stiff =
      tasks_after([](Study& study) { study.settings.contact.youngs_modulus = 71e9; });
  EXPECT_NE(stiff.wet_shares[0].key, before.wet_shares[0].key);
  const ScanTasks dry =
      tasks_after([](Study& study) { study.settings.film.lubricant_densities = {0}; });
  EXPECT_TRUE(dry.wet_shares.empty());
}

TEST(Tasks, APressureMoreLeavesTheOthersAlone) {
  const ScanTasks more = tasks_after([](Study& study) {
    study.settings.mean_pressures.insert(study.settings.mean_pressures.begin(), 1e6);
  });
  EXPECT_EQ(more.contacts[1].key, tasks().contacts[0].key);
  EXPECT_EQ(more.cases[1][0].key, tasks().cases[0][0].key);
}

}  // namespace
}  // namespace tabor::study
