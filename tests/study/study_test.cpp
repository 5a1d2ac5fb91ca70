#include "tabor/study/study.hpp"

#include <cmath>

#include "study/example_study.hpp"
#include "tabor/core/units.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using test::kStudyText;
using test::message_of;
using test::replaced;
using testing::ElementsAre;
using testing::HasSubstr;

/// What read_study says about the example with one part of its text replaced.
std::string complaint(const std::string& part, const std::string& by) {
  const ExampleStudy example;
  example.write(replaced(kStudyText, part, by));
  return message_of([&] { example.read(); });
}

TEST(ReadStudy, ConvertsEverythingToSi) {
  const Study study = ExampleStudy().read();
  EXPECT_EQ(study.title, "two small scans");
  EXPECT_EQ(study.settings.friction.shear_strength, 70e6);
  EXPECT_EQ(study.settings.contact.saturation_pressure, 240e6);
  EXPECT_THAT(study.settings.mean_pressures, ElementsAre(5e6, 15e6));
  EXPECT_THAT(study.treatment, ElementsAre("level=mean"));
  EXPECT_NEAR(study.settings.contact.effective_modulus(), 70e9 / (1 - 0.33 * 0.33), 1);
  EXPECT_EQ(in_g_per_m2(study.settings.film.lubricant_densities[0]), 0.45);
  EXPECT_EQ(in_g_per_m2(study.settings.film.lubricant_densities[1]), 0.9);
  EXPECT_EQ(study.n_cases(), 8u);
}

TEST(ReadStudy, ExpandsPatternsInByteOrder) {
  const Study study = ExampleStudy().read();
  ASSERT_EQ(study.scans.size(), 2u);
  EXPECT_EQ(study.scans[0].label, "scan_1.h5");
  EXPECT_EQ(study.scans[1].label, "scan_2.h5");
  EXPECT_EQ(study.scans[1].group, "side A");
}

TEST(ReadStudy, NamesEveryScanAlsoOfAStudyInTheCurrentFolder) {
  const ExampleStudy example;
  const std::string scan = (example.folder / "scan_1.h5").string();
  example.write(replaced(kStudyText, "scan_*.h5", scan));
  EXPECT_EQ(example.read().scans.at(0).label, "scan_1.h5");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(example.folder / "");
  const Study study = read_study("study.toml");
  std::filesystem::current_path(before);
  EXPECT_EQ(study.scans.at(0).label, scan);
}

TEST(ReadStudy, TakesANameWithPatternCharactersLiterallyIfThatFileExists) {
  const ExampleStudy example;
  example.add_scan("scan[1].h5", 3);
  example.write(replaced(kStudyText, "scan_*.h5", "scan[1].h5"));
  EXPECT_EQ(example.read().scans.at(0).label, "scan[1].h5");
}

TEST(ReadStudy, WithoutSaturationIsElasticAndWithoutDensityIsDry) {
  const ExampleStudy example;
  std::string text = replaced(kStudyText, "saturation_pressure = \"240 MPa\"\n", "");
  text = replaced(text, "lubricant_density = [\"0.45 g/m^2\", \"0.9 g/m^2\"]\n", "");
  example.write(text);
  EXPECT_TRUE(std::isinf(example.read().settings.contact.pressure_cap()));
  EXPECT_THAT(example.read().settings.film.lubricant_densities, ElementsAre(0));
}

TEST(ReadStudy, ReadsBackWhatItWroteAsText) {
  const ExampleStudy example;
  example.write(replaced(kStudyText, "[sweep]\n",
                         "[contact]\nboundary = \"free\"\ntolerance = 1e-7\n"
                         "[lubricant]\nmodel = \"limit\"\nedge = \"open\"\nseed = 7\n[sweep]\n"));
  const std::string text = to_toml(example.read());
  example.write(text);
  EXPECT_EQ(to_toml(example.read()), text);
  EXPECT_FALSE(example.read().settings.contact.is_periodic());
  EXPECT_EQ(example.read().settings.film.seed, 7u);
  EXPECT_EQ(example.read().settings.film.edge, deposition::Edge::open);
}

/// The example with more keys in its [[scan]].
std::string with_scan_keys(const std::string& keys) {
  return replaced(kStudyText, "group = \"side A\"\n", "group = \"side A\"\n" + keys);
}

TEST(ReadStudy, TakesSettingsOfAScanInPlaceOfItsOwn) {
  const ExampleStudy example;
  example.write(
      with_scan_keys("pressure = \"7 MPa\"\ndensity = \"0.9 g/m^2\"\ntreatment = "
                     "[\"level=plane\"]\ncontact = \"elastic\"\nreading = "
                     "\"literal\"\n"));
  const Study study = example.read();
  EXPECT_EQ(study.n_cases(), 2u);
  const Study alone = study.of(study.scans[1]);
  ASSERT_EQ(alone.scans.size(), 1u);
  EXPECT_EQ(alone.scans[0].label, "scan_2.h5");
  EXPECT_THAT(alone.settings.mean_pressures, ElementsAre(7e6));
  EXPECT_EQ(in_g_per_m2(alone.settings.film.lubricant_densities.at(0)), 0.9);
  EXPECT_THAT(alone.treatment, ElementsAre("level=plane"));
  EXPECT_FALSE(alone.settings.contact.saturation_pressure);
  EXPECT_EQ(alone.settings.film.reading, deposition::Reading::literal);
  EXPECT_EQ(alone.settings.friction.area_of(alone.settings.contact), friction::Area::corrected);
  EXPECT_EQ(study.settings.friction.area_of(study.settings.contact), friction::Area::pixels);
  example.write(to_toml(study));
  EXPECT_EQ(to_toml(example.read()), to_toml(study));
}

TEST(ReadStudy, TakesOfAFileWhatItDoesNotSayItself) {
  const ExampleStudy example;
  const auto read_with = [&](const std::string& keys) {
    example.write(with_scan_keys(keys));
    const Study study = example.read();
    example.write(to_toml(study));
    EXPECT_EQ(to_toml(example.read()), to_toml(study));
    return study.scans.at(1).read;
  };
  const scan::ReadOptions square = read_with("pixel = \"2 um\"\nunit = \"nm\"\nchannel = \"3\"\n");
  EXPECT_EQ(square.pixel_x, 2e-6);
  EXPECT_EQ(square.pixel_y, 2e-6);  // also in the text that names what is stored
  EXPECT_EQ(square.unit, "nm");
  EXPECT_EQ(square.channel, "3");
  const scan::ReadOptions oblong = read_with("pixel = [\"2 um\", \"3 um\"]\n");
  EXPECT_EQ(oblong.pixel_x, 2e-6);
  EXPECT_EQ(oblong.pixel_y, 3e-6);
  EXPECT_THAT(message_of([&] { read_with("pixel = \"0 um\"\n"); }),
              HasSubstr("scan.pixel: got 0 m; expected a positive length"));
  EXPECT_THAT(message_of([&] { read_with("pixel = [\"1 um\", \"1 um\", \"1 um\"]\n"); }),
              HasSubstr("scan.pixel: got 3 lengths; expected one, or two for x and y"));
}

TEST(ReadStudy, NeedsNoCommonPressureWhereEveryScanHasItsOwn) {
  const ExampleStudy example;
  const std::string none = replaced(kStudyText, "mean_pressure = [\"5 MPa\", \"15 MPa\"]\n", "");
  example.write(replaced(none, "group =", "pressure = [\"7 MPa\", \"8 MPa\"]\ngroup ="));
  EXPECT_EQ(example.read().n_cases(), 8u);
  example.write(none);
  EXPECT_THAT(message_of([&] { example.read(); }),
              testing::AllOf(HasSubstr("sweep.mean_pressure"), HasSubstr("scan_*.h5"),
                             HasSubstr("no pressure of its own")));
}

TEST(ReadStudy, AFileMayStandInTwoGroupsButNotTwiceInOne) {
  const ExampleStudy example;
  const std::string again = "[[scan]]\nfile = \"scan_1.h5\"\ngroup = \"GROUP\"\n";
  example.write(kStudyText + replaced(again, "GROUP", "literal"));
  EXPECT_EQ(example.read().scans.size(), 3u);
  example.write(kStudyText + replaced(again, "GROUP", "side A"));
  EXPECT_THAT(message_of([&] { example.read(); }), HasSubstr("twice"));
}

TEST(ReadStudy, RejectsSettingsOfAScanThatCannotBe) {
  const auto complaint_of = [](const std::string& keys) {
    const ExampleStudy example;
    example.write(with_scan_keys(keys));
    return message_of([&] { example.read(); });
  };
  EXPECT_THAT(complaint_of("pressure = \"7\"\n"), HasSubstr("unit"));
  EXPECT_THAT(complaint_of("pressure = \"-7 MPa\"\n"), HasSubstr("more than zero"));
  EXPECT_THAT(complaint_of("pressure = \"300 MPa\"\n"),
              testing::AllOf(HasSubstr("pressure"), HasSubstr("240 MPa")));
  EXPECT_THAT(complaint_of("pressure = [\"7 MPa\", \"7 MPa\"]\n"), HasSubstr("twice"));
  EXPECT_THAT(complaint_of("density = \"-1 g/m^2\"\n"), HasSubstr("zero or more"));
  EXPECT_THAT(complaint_of("treatment = [\"levle=plane\"]\n"), HasSubstr("level"));
  EXPECT_THAT(complaint_of("contact = \"elastc\"\n"), HasSubstr("did you mean 'elastic'?"));
  EXPECT_THAT(complaint_of("reading = \"literl\"\n"), HasSubstr("literal"));
  EXPECT_THAT(complaint_of("presure = \"7 MPa\"\n"), HasSubstr("pressure"));
  const ExampleStudy elastic;
  elastic.write(replaced(with_scan_keys("contact = \"saturated\"\n"),
                         "saturation_pressure = \"240 MPa\"\n", ""));
  EXPECT_THAT(message_of([&] { elastic.read(); }), HasSubstr("material.saturation_pressure"));
}

TEST(ReadStudy, AnElasticScanMayBePressedBeyondTheSaturationOfTheOthers) {
  const ExampleStudy example;
  example.write(with_scan_keys("pressure = \"300 MPa\"\ncontact = \"elastic\"\n"));
  EXPECT_EQ(example.read().n_cases(), 4u);
}

TEST(ReadStudy, TakesOilThatFlows) {
  const ExampleStudy example;
  EXPECT_FALSE(example.read().flows());
  std::string text = test::flowing_study();
  text = replaced(text, "viscosity = ",
                  "pressure_viscosity = \"20 1/GPa\"\neyring_stress = \"5 MPa\"\nviscosity = ");
  example.write(text);
  const Study study = example.read();
  ASSERT_TRUE(study.flows());
  EXPECT_EQ(study.settings.fluid.viscosity, 0.2);
  EXPECT_NEAR(study.settings.fluid.pressure_viscosity.value(), 2e-8, 1e-20);
  EXPECT_EQ(study.settings.fluid.eyring_stress, 5e6);
  EXPECT_THAT(study.sliding_speeds, ElementsAre(0.1, 1));
  EXPECT_EQ(study.n_cases(), 16u);
  example.write(to_toml(study));
  EXPECT_EQ(to_toml(example.read()), to_toml(study));
}

TEST(ReadStudy, TakesOneSpeedAsAValue) {
  const ExampleStudy example;
  example.write(test::flowing_study("\"5 mm/s\""));
  EXPECT_THAT(example.read().sliding_speeds, ElementsAre(0.005));
}

/// The same as complaint() of the example whose oil flows.
std::string complaint_of_flow(const std::string& part, const std::string& by) {
  const ExampleStudy example;
  example.write(replaced(test::flowing_study(), part, by));
  return message_of([&] { example.read(); });
}

TEST(ReadStudy, RejectsAFlowThatMakesNoSense) {
  EXPECT_THAT(complaint_of_flow("reynolds", "renolds"), HasSubstr("did you mean 'reynolds'?"));
  EXPECT_THAT(complaint_of_flow("\"1 m/s\"", "\"-1 m/s\""),
              testing::AllOf(HasSubstr("sweep.sliding_speed"), HasSubstr("zero or more")));
  EXPECT_THAT(complaint_of_flow("\"1 m/s\"", "\"0.1 m/s\""), HasSubstr("twice"));
  EXPECT_THAT(complaint_of_flow("\"1 m/s\"", "1"), HasSubstr("without a unit"));
  EXPECT_THAT(complaint_of_flow("viscosity = \"0.2 Pa s\"\n", ""),
              HasSubstr("lubricant.viscosity is missing"));
  EXPECT_THAT(complaint_of_flow("0.2 Pa s", "-0.2 Pa s"), HasSubstr("more than zero"));
  EXPECT_THAT(complaint_of_flow("sliding_speed = [\"0.1 m/s\", \"1 m/s\"]\n", ""),
              HasSubstr("sweep.sliding_speed is missing"));
  EXPECT_THAT(complaint_of_flow("viscosity =", "eyring_stress = \"0 MPa\"\nviscosity ="),
              HasSubstr("lubricant.eyring_stress"));
  EXPECT_THAT(complaint_of_flow("[sweep]", "[contact]\nboundary = \"free\"\n[sweep]"),
              testing::AllOf(HasSubstr("contact.boundary"), HasSubstr("repeats")));
}

TEST(ReadStudy, EdgesSayWhatSurroundsEachScan) {
  for (const char* edges : {"tile", "cut", "end"}) {
    const ExampleStudy example;
    const std::string keys = "[contact]\nedges = \"" + std::string(edges) + "\"\n[sweep]";
    example.write(replaced(kStudyText, "[sweep]", keys));
    const Study study = example.read();
    const Study alone = study.of(study.scans.front());
    EXPECT_EQ(alone.treatment.back(), "edges=" + std::string(edges));
    EXPECT_EQ(alone.settings.contact.is_periodic(), std::string(edges) != "end");
    const std::string text = to_toml(study);
    EXPECT_THAT(text, HasSubstr("edges = \"" + std::string(edges) + "\""));
    EXPECT_EQ(to_toml(parse_study(text, study.file)), text);
  }
  EXPECT_THAT(complaint("[sweep]", "[contact]\nedges = \"cut\"\nboundary = \"free\"\n[sweep]"),
              testing::AllOf(HasSubstr("\"edges=cut\" and contact.boundary = \"free\" contradict"),
                             HasSubstr("contact.edges")));
  EXPECT_THAT(complaint("[sweep]", "[contact]\nedges = \"cutt\"\n[sweep]"),
              HasSubstr("did you mean 'cut'"));
  EXPECT_THAT(complaint_of_flow("[sweep]", "[contact]\nedges = \"end\"\n[sweep]"),
              testing::AllOf(HasSubstr("contact.edges"), HasSubstr("repeats")));
}

TEST(ReadStudy, RejectsKeysOfAFlowWithoutOne) {
  for (const char* idle : {"none", ""}) {
    const std::string instead = *idle == '\0' ? "" : "fluid = \"none\"\n";
    EXPECT_THAT(complaint_of_flow("fluid = \"reynolds\"\n", instead),
                HasSubstr("lubricant.fluid = \"reynolds\""));
  }
}

TEST(ReadStudy, NamesLineAndNearestMatchOfAnUnknownKey) {
  EXPECT_THAT(complaint("youngs_modulus", "young_modulus"),
              HasSubstr("study.toml:4: unknown key 'material.young_modulus'; did you mean "
                        "'material.youngs_modulus'?"));
  EXPECT_THAT(complaint("group =", "grup ="), HasSubstr("did you mean 'scan[].group'?"));
}

TEST(ReadStudy, RejectsValuesWithoutOrWithWrongUnits) {
  EXPECT_THAT(complaint("\"70 MPa\"", "70e6"), HasSubstr("shear_strength"));
  EXPECT_THAT(complaint("\"70 GPa\"", "\"70 GPa s\""), HasSubstr("material.youngs_modulus"));
  EXPECT_THAT(complaint("[\"5 MPa\", \"15 MPa\"]", "[\"5 MPa\", 15]"),
              HasSubstr("sweep.mean_pressure: got 15 without a unit"));
  EXPECT_THAT(complaint("\"0.45 g/m^2\"", "\"0.45 g/m^3\""), HasSubstr("lubricant_density"));
}

TEST(ReadStudy, RejectsValuesThatMakeNoSense) {
  EXPECT_THAT(complaint("\"5 MPa\"", "\"-5 MPa\""), HasSubstr("more than zero"));
  EXPECT_THAT(complaint("\"15 MPa\"", "\"300 MPa\""),
              HasSubstr("less than the saturation pressure 240 MPa"));
  EXPECT_THAT(complaint("\"15 MPa\"", "\"5 MPa\""), HasSubstr("twice"));
  EXPECT_THAT(complaint("0.33", "0.6"), HasSubstr("poissons_ratio"));
  EXPECT_THAT(complaint("level=mean", "levle=mean"), HasSubstr("treatment.steps"));
  EXPECT_THAT(complaint("[sweep]", "area = 3\n[sweep]"), HasSubstr("unknown key"));
  EXPECT_THAT(complaint("[sweep]", "[lubricant]\nmodel = \"dropets\"\n[sweep]"),
              HasSubstr("lubricant.model"));
  EXPECT_THAT(complaint("[sweep]", "[contact]\nboundary = \"fre\"\n[sweep]"),
              HasSubstr("did you mean 'free'?"));
}

TEST(ReadStudy, NamesWhatIsMissing) {
  EXPECT_THAT(complaint("shear_strength = \"70 MPa\"\n", ""),
              HasSubstr("shear_strength is missing"));
  EXPECT_THAT(complaint("mean_pressure = [\"5 MPa\", \"15 MPa\"]\n", ""),
              HasSubstr("sweep.mean_pressure is missing"));
  EXPECT_THAT(complaint("[[scan]]\nfile = \"scan_*.h5\"\ngroup = \"side A\"\n", ""),
              HasSubstr("no [[scan]]"));
  EXPECT_THAT(message_of([] { read_study("/no/such/study.toml"); }), HasSubstr("study.toml"));
}

TEST(ReadStudy, NamesTheNearestFileOfAScanThatIsNotThere) {
  EXPECT_THAT(complaint("scan_*.h5", "scan_1.hdf"), HasSubstr("did you mean 'scan_1.h5'?"));
  EXPECT_THAT(complaint("scan_*.h5", "other_*.x3p"), HasSubstr("no file 'other_*.x3p'"));
}

TEST(ReadStudy, RejectsAScanListedTwice) {
  EXPECT_THAT(complaint("\"scan_*.h5\"", "[\"scan_1.h5\", \"scan_*.h5\"]"), HasSubstr("twice"));
}

TEST(ReadStudy, TakesValuesInPlaceOfThoseOfTheFile) {
  const ExampleStudy example;
  example.write(kStudyText);
  const std::filesystem::path file = example.folder / "study.toml";
  const Study changed = read_study(file, {{"contact.tolerance", "1e-8"},
                                          {"lubricant.model", "limit"},
                                          {"sweep.mean_pressure", "[\"3 MPa\", \"4 MPa\"]"},
                                          {"material.saturation_pressure", "none"}});
  EXPECT_EQ(changed.settings.contact.tolerance, 1e-8);
  EXPECT_EQ(changed.settings.film.model, deposition::Model::limit);
  EXPECT_THAT(changed.settings.mean_pressures, ElementsAre(3e6, 4e6));
  EXPECT_FALSE(changed.settings.contact.saturation_pressure);
  EXPECT_THAT(message_of([&] {
                read_study(file, {{"contact.tolerence", "1e-8"}});
              }),
              HasSubstr("contact.tolerance"));
  EXPECT_THAT(message_of([&] {
                read_study(file, {{"contact.tolerance", "1"}});
              }),
              HasSubstr("contact.tolerance: got 1; expected 1e-12 to 1e-4"));
}

}  // namespace
}  // namespace tabor::study
