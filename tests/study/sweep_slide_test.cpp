// Studies whose sheets a rough tool slides over.
#include <gmock/gmock.h>

#include "study/example_study.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/study/case.hpp"
#include "tabor/study/slides.hpp"
#include "tabor/study/treated_scan.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::HasSubstr;

std::string with_slide(const std::string& lines = "", const std::string& lubricant = "") {
  std::string text = test::kStudyText;
  text.insert(text.find("[[scan]]"),
              "[contact]\ntool = \"ground:Sa=0.1um,groove-length=20um\"\n" + lubricant +
                  "[slide]\ndistance = \"4 um\"\nstep = \"1 um\"\nevery = \"2 um\"\n" + lines);
  return text;
}

io::CsvTable slides_of(const ExampleStudy& example) {
  return io::parse_csv(test::bytes_of(example.results() / "slides.csv"), "slides.csv");
}

std::string key_of_slide(const Study& study) { return tasks_of(study)[0].slides[0][0].key; }

TEST(SweepSlide, HasTheStatesOfEveryScanPressureAndDensity) {
  const ExampleStudy example;
  example.write(with_slide());
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_slides, 8U);
  EXPECT_EQ(outcome.slides.size(), 24U);
  const io::CsvTable table = slides_of(example);
  ASSERT_EQ(table.rows.size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR(table.number(i, "distance_m"), 2e-6 * static_cast<double>(i % 3), 1e-9);
    EXPECT_EQ(table.text(i, "converged"), "true");
  }
  EXPECT_EQ(example.run().n_slides, 0U);
}

TEST(SweepSlide, HasTheNumbersOfASlideAlone) {
  const ExampleStudy example;
  example.write(with_slide("", "[lubricant]\ntrapped = true\n"));
  example.run();
  const Study study = example.read();
  const Study alone = study.of(study.scans[0]);
  const double pressure = alone.settings.mean_pressures[1];
  const double density = alone.settings.film.lubricant_densities[1];
  const topography::Topography surface =
      treated_surface(alone, alone.scans[0], tasks_of(study)[0].sha256, {});
  const cases::SlideResult expected =
      cases::slide(surface, alone.slide_settings(pressure, density), *alone.slide);
  const io::CsvTable table = slides_of(example);
  const std::size_t last = 3 * 3 + 2;  // the fourth slide of the first scan
  EXPECT_DOUBLE_EQ(table.number(last, "friction_lubricated"),
                   expected.states.back().friction_lubricated);
  EXPECT_DOUBLE_EQ(table.number(last, "liquid_load_share"),
                   expected.states.back().trapped->load_share);
}

TEST(SweepSlide, IsKnownByItsSettings) {
  const ExampleStudy example;
  example.write(with_slide());
  const std::string key = key_of_slide(example.read());
  EXPECT_EQ(key_of_slide(parse_study(to_toml(example.read()), example.folder / "study.toml")), key);
  for (const char* line : {"displaced = \"uniform\"\n", "reach = \"3 um\"\n", "liquid = \"kept\"\n",
                           "until_steady = true\n", "wear_coefficient = \"1e-15 m^2/N\"\n",
                           "hardening = \"100 MPa/um\"\n"}) {
    example.write(with_slide(line));
    EXPECT_NE(key_of_slide(example.read()), key) << line;
    const std::string again = to_toml(example.read());
    EXPECT_EQ(key_of_slide(parse_study(again, example.folder / "study.toml")),
              key_of_slide(example.read()))
        << again;
  }
}

TEST(SweepSlide, RecordsWhyOneFailed) {
  const ExampleStudy example;
  std::string text = with_slide();
  text += "contact = \"elastic\"\n";  // of the last scan: nothing is displaced
  example.write(text);
  const Outcome outcome = example.run();
  EXPECT_GT(outcome.n_failed_slides, 0U);
  EXPECT_EQ(outcome.n_failed, 0U);
  EXPECT_THAT(outcome.failures, testing::Contains(HasSubstr("saturation pressure")));
}

TEST(SweepSlide, SaysWithItsLineWhatDoesNotGoTogether) {
  const ExampleStudy example;
  const auto message = [&](const std::string& text) {
    example.write(text);
    return test::message_of([&] { example.read(); });
  };
  EXPECT_THAT(message(with_slide("reach = \"0 um\"\n")), HasSubstr("slide.reach"));
  EXPECT_THAT(message(with_slide("displaced = \"gone\"\n")), HasSubstr("slide.displaced"));
  std::string text = test::kStudyText;
  text.insert(text.find("[[scan]]"),
              "[contact]\ntool = \"ground:Sa=0.1um\"\n[slide]\nstep = \"1 um\"\n");
  EXPECT_THAT(message(text), HasSubstr("slide.distance"));
  text = test::kStudyText;
  text.insert(text.find("[[scan]]"), "[slide]\ndistance = \"4 um\"\n");
  EXPECT_THAT(message(text), HasSubstr("contact.tool"));
}

// A slide begins with the contact of its case: one number, warned of once.
TEST(SweepSlide, IsWarnedOfWithItsCase) {
  const ExampleStudy example;
  example.write(with_slide());
  for (const results::Finding& finding : example.run().findings) {
    EXPECT_LE(finding.n_cases, 8U) << finding.code;
    EXPECT_EQ(finding.n_all, 8U) << finding.code;
  }
}

}  // namespace
}  // namespace tabor::study
