#include "tabor/study/sweep.hpp"

#include <cmath>
#include <stdexcept>

#include "study/example_study.hpp"
#include "tabor/engine/plan.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/results/citations.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/tables.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using test::replaced;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Lets a sweep go on for `n` messages, then asks it to stop.
SweepOptions stopping_after(int n) {
  SweepOptions options;
  options.observer = [left = n](const Progress&) mutable { return --left >= 0; };
  return options;
}

TEST(Sweep, ComputesEveryCaseOnce) {
  const ExampleStudy example;
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_cases, 8u);
  EXPECT_EQ(outcome.n_done, 8u);
  EXPECT_EQ(outcome.n_failed, 0u);
  EXPECT_EQ(outcome.n_not_converged, 0u);
  EXPECT_EQ(outcome.n_surfaces, 2u);
  EXPECT_EQ(outcome.n_contacts, 4u);  // one per scan and pressure, not per density
  EXPECT_EQ(outcome.n_films, 2u);     // one per scan for all densities
  EXPECT_EQ(outcome.n_rows, 8u);
  EXPECT_TRUE(outcome.warnings.empty());
}

TEST(Sweep, RowsAreInTheOrderOfTheStudy) {
  const ExampleStudy example;
  example.run();
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  ASSERT_EQ(table.rows.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(table.text(i, "scan"), i < 4 ? "scan_1.h5" : "scan_2.h5");
    EXPECT_EQ(table.number(i, "mean_pressure_Pa"), i % 4 < 2 ? 5e6 : 15e6);
    EXPECT_EQ(table.number(i, "lubricant_density_g_per_m2"), i % 2 == 0 ? 0.45 : 0.9);
    EXPECT_EQ(table.text(i, "converged"), "true");
  }
}

TEST(Sweep, RowsObeyBowdenAndTabor) {
  const ExampleStudy example;
  example.run();
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double area = table.number(i, "contact_area_fraction_pixels");
    const double pressure = table.number(i, "mean_pressure_Pa");
    const double dry = table.number(i, "friction_dry");
    const double share = table.number(i, "lubricated_share");
    EXPECT_GE(area, pressure / 240e6 * (1 - 1e-12));
    EXPECT_DOUBLE_EQ(dry, area * 70e6 / pressure);
    EXPECT_DOUBLE_EQ(table.number(i, "friction_lubricated"), dry * (1 - share));
  }
}

TEST(Sweep, MoreLubricantNeverMeansMoreFriction) {
  const ExampleStudy example;
  example.run();
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  for (std::size_t i = 0; i + 1 < table.rows.size(); i += 2) {
    EXPECT_LE(table.number(i + 1, "friction_lubricated"), table.number(i, "friction_lubricated"));
    EXPECT_EQ(table.number(i + 1, "friction_dry"), table.number(i, "friction_dry"));
  }
}

/// What one row is warned of does not depend on the others, nor on when it was computed.
TEST(Sweep, WarningsAreThoseOfTheRowsWheneverTheyWereComputed) {
  const ExampleStudy example;
  example.write(replaced(test::kStudyText, "\"0.9 g/m^2\"", "\"9 g/m^2\""));
  const Outcome first = example.run();
  const auto lines = [](const Outcome& outcome) {
    std::vector<std::string> all;
    for (const results::Finding& finding : outcome.findings) {
      all.push_back(results::line_of(finding));
    }
    return all;
  };
  EXPECT_THAT(lines(first), testing::Contains(HasSubstr("floods the surface")));
  EXPECT_THAT(lines(first), testing::Contains(testing::AllOf(HasSubstr("(4 of 8 cases"),
                                                             HasSubstr("[frictionless]"))));
  EXPECT_EQ(lines(example.run()), lines(first));
  for (const int index : {1, 2}) {
    SweepOptions options;
    options.shard = engine::Shard{index, 2};
    const Outcome part = example.run(options, "parts");
    EXPECT_EQ(lines(part) == lines(first), index == 2);  // the last has seen every row
  }
  const io::Hdf5Reader results(example.results() / "results.h5");
  EXPECT_EQ(results.attribute_texts("/", "warnings"), lines(first));
  const auto codes = results.texts("/table/warning_codes");
  ASSERT_EQ(codes.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(codes[i].find("flood") != std::string::npos, i % 2 == 1) << codes[i];
  }
}

TEST(Sweep, SecondRunComputesNothingAndChangesNothing) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  int n_messages = 0;
  SweepOptions options;
  options.observer = [&](const Progress& progress) {
    const bool looks = progress.stage == "look at the store" || progress.stage.starts_with("hash ");
    n_messages += looks ? 0 : 1;
    return true;
  };
  const Outcome again = example.run(options);
  EXPECT_EQ(again.n_rows + again.n_contacts + again.n_films + again.n_surfaces, 0u);
  EXPECT_EQ(again.n_done, 8u);
  EXPECT_EQ(n_messages, 0);
  EXPECT_EQ(example.csv(), csv);
}

TEST(Sweep, IsInterruptedWhileItHashes) {
  const ExampleStudy example;
  SweepOptions options;
  options.observer = [](const Progress& progress) { return !progress.stage.starts_with("hash "); };
  EXPECT_THROW(example.run(options), Interrupted);
}

TEST(Sweep, SameBytesForAnyNumberOfJobs) {
  const ExampleStudy example;
  SweepOptions options;
  options.jobs = 1;
  example.run(options, "one");
  for (const int jobs : {0, 2, 16}) {
    options.jobs = jobs;
    const std::string folder = "jobs" + std::to_string(jobs);
    example.run(options, folder);
    EXPECT_EQ(example.csv("one"), example.csv(folder));
  }
}

TEST(Sweep, JobsFillThreadsOrHalfOfTheMemory) {
  constexpr std::size_t size = 80'000'000;
  const auto room_for = [](std::size_t n_jobs) { return 2 * n_jobs * size; };
  EXPECT_EQ(engine::jobs_that_fit(size, room_for(8), 2), 2);
  EXPECT_EQ(engine::jobs_that_fit(size, room_for(8), 16), 8);
  EXPECT_EQ(engine::jobs_that_fit(size, room_for(1) - 1, 16), 1);
  EXPECT_EQ(engine::jobs_that_fit(size, 0, 16), 1);
  EXPECT_EQ(engine::jobs_that_fit(0, room_for(8), 4), 4);
}

TEST(Sweep, StoppedAnywhereAndResumedGivesTheSameBytes) {
  const ExampleStudy example;
  example.run({}, "whole");
  for (const int jobs : {1, 2}) {
    bool stopped = true;
    for (int n = 0; stopped && n < 1000; n += 7) {  // each run a little further than the one before
      SweepOptions options = stopping_after(n);
      options.jobs = jobs;
      try {
        example.run(options, "resumed" + std::to_string(jobs));
        stopped = false;
      } catch (const Interrupted&) {
      }
    }
    EXPECT_FALSE(stopped);
    EXPECT_EQ(example.csv("whole"), example.csv("resumed" + std::to_string(jobs)));
  }
}

TEST(Sweep, InterruptedKeepsWhatIsFinished) {
  const ExampleStudy example;
  SweepOptions options;
  options.jobs = 1;
  options.observer = [](const Progress& progress) {
    return progress.stage != "contact scan_1.h5 15 MPa";  // the second contact
  };
  EXPECT_THROW(example.run(options), Interrupted);
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  EXPECT_EQ(table.rows.size(), 2u);  // both densities of the first
  const Outcome rest = example.run();
  EXPECT_EQ(rest.n_rows, 8 - table.rows.size());
}

TEST(Sweep, AnExceptionOfTheObserverEndsItWithoutLoss) {
  const ExampleStudy example;
  example.run({}, "whole");
  SweepOptions options;
  options.jobs = 2;
  options.observer = [](const Progress& progress) -> bool {
    if (progress.whole > 0.5) throw std::runtime_error("from outside");
    return true;
  };
  EXPECT_THROW(example.run(options), std::runtime_error);
  EXPECT_GT(example.run().n_rows, 0u);
  EXPECT_EQ(example.csv(), example.csv("whole"));
}

TEST(FailuresIn, SayOnceWhatFailsUnderSeveralPressures) {
  const auto row = [](const char* scan, double pressure, const char* error) {
    Row one;
    one.scan = scan;
    one.mean_pressure = pressure;
    one.error = error;
    return one;
  };
  EXPECT_THAT(
      failures_in({row("a", 2e6, "a: too short"), row("a", 7e6, "a: too short"), row("b", 2e6, ""),
                   row("b", 7e6, "above p_sat"), row("b", 9e6, "above p_sat"),
                   row("b", 11e6, "lost")}),
      ElementsAre("a: too short", "b under 7 MPa, 9 MPa: above p_sat", "b under 11 MPa: lost"));
}

TEST(Sweep, AScanThatFailsIsRecordedAndTheRestGoesOn) {
  const ExampleStudy example;
  example.add_scan("scan_1.h5", 1, true);
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_done, 8u);
  EXPECT_EQ(outcome.n_failed, 4u);
  ASSERT_EQ(outcome.failures.size(), 1u);  // of both pressures
  EXPECT_THAT(outcome.failures[0], StartsWith("scan_1.h5: "));
  EXPECT_THAT(outcome.failures[0],
              HasSubstr("got 1 missing pixel; expected a height at every pixel"));
  EXPECT_THAT(outcome.failures[0], HasSubstr("fill=harmonic"));
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  EXPECT_EQ(table.text(0, "friction_dry"), "");
  EXPECT_EQ(table.text(0, "converged"), "false");
  EXPECT_GT(table.number(4, "friction_dry"), 0);
  const io::CsvTable averages = io::read_csv(example.results() / "averages.csv");
  EXPECT_EQ(averages.number(0, "n"), 1);
}

TEST(Sweep, FailedCasesWaitForRetry) {
  const ExampleStudy example;
  example.add_scan("scan_1.h5", 1, true);
  example.run();
  EXPECT_EQ(example.run().n_rows, 0u);
  SweepOptions options;
  options.retry = true;
  const Outcome again = example.run(options);
  EXPECT_EQ(again.n_rows, 4u);  // tried again, failed again
  EXPECT_EQ(again.n_failed, 4u);
  EXPECT_EQ(again.n_contacts, 0u);
}

/// Puts a contact that did not converge into the store, in place of the first of the study.
void store_unfinished_contact(const ExampleStudy& example) {
  const Study study = example.read();
  const engine::Store store(example.results(), engine::Store::Use::alone);
  cases::ContactRecord record;
  record.state.pressure = Field::Constant(24, 32, study.settings.mean_pressures[0]);
  record.state.gap = Field::Zero(24, 32);
  record.convergence.certificate = 0.5;
  contact::Summary& summary = record.summary;
  summary.mean_pressure = study.settings.mean_pressures[0];
  summary.contact_area_fraction = summary.contact_area_fraction_pixels = 1;
  write_contact(store, tasks_of(study)[0].contacts[0], {32, 24, 32e-6, 24e-6},
                study.settings.contact.pressure_cap(), record);
}

TEST(Sweep, NotConvergedCasesAreSolvedAgainOnlyByRetry) {
  const ExampleStudy example;
  store_unfinished_contact(example);
  const Outcome first = example.run();
  EXPECT_EQ(first.n_contacts, 3u);
  EXPECT_EQ(first.n_not_converged, 2u);  // two densities
  const io::CsvTable averages = io::read_csv(example.results() / "averages.csv");
  EXPECT_EQ(averages.number(0, "n"), 1);
  EXPECT_EQ(averages.number(2, "n"), 2);
  EXPECT_EQ(example.run().n_contacts, 0u);
  SweepOptions options;
  options.retry = true;
  const Outcome again = example.run(options);
  EXPECT_EQ(again.n_contacts, 1u);
  EXPECT_EQ(again.n_not_converged, 0u);
  example.run({}, "fresh");
  EXPECT_EQ(example.csv(), example.csv("fresh"));
}

TEST(Sweep, ANewPressureAddsOnlyItsOwnWork) {
  const ExampleStudy example;
  example.run();
  example.write(replaced(test::kStudyText, "\"15 MPa\"", "\"10 MPa\", \"15 MPa\""));
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts, 2u);
  EXPECT_EQ(outcome.n_films, 0u);
  EXPECT_EQ(outcome.n_rows, 4u);
  EXPECT_EQ(outcome.n_done, 12u);
}

TEST(Sweep, ResultsFileLeadsToEveryMap) {
  const ExampleStudy example;
  example.write(std::string(test::kStudyText) + "[experiment]\nfile = \"measured.csv\"\n");
  test::put_bytes(example.folder / "measured.csv", "mean_pressure_Pa,friction\n2e6,0.3\n");
  SweepOptions options;
  options.command = "tabor sweep study.toml";
  example.run(options);
  const io::Hdf5Reader results(example.results() / "results.h5");
  EXPECT_EQ(results.text("/", "format"), "tabor");
  EXPECT_EQ(results.text("/", "command"), "tabor sweep study.toml");
  EXPECT_EQ(results.number("/", "saturation_pressure_Pa"), 240e6);
  EXPECT_EQ(results.integer("/", "n_cases_done"), 8);
  EXPECT_EQ(results.numbers("/table/friction_dry").size(), 8u);
  EXPECT_EQ(results.text("/table/friction_dry", "heading"), "friction dry");
  EXPECT_EQ(results.text("/table/lubricated_share", "style"), "percent");
  EXPECT_EQ(results.text("/averages/mean_pressure_Pa", "units"), "Pa");
  EXPECT_EQ(results.texts("/table/scan").front(), "scan_1.h5");
  EXPECT_EQ(results.integers("/averages/n").front(), 2);
  EXPECT_THAT(results.children("/scans"), ElementsAre("0000", "0001"));
  EXPECT_EQ(results.integer("/scans/0001", "nx"), 32);
  EXPECT_NEAR(results.number("/scans/0001", "pixel_x_m"), 1e-6, 1e-18);
  EXPECT_THAT(results.shape("/scans/0001/surface/height"), ElementsAre(24, 32));
  EXPECT_THAT(results.shape("/scans/0001/contact/0001/state"), ElementsAre(24, 32));
  EXPECT_THAT(results.shape("/scans/0001/films/0001/film_thickness"), ElementsAre(24, 32));
  EXPECT_EQ(results.number("/scans/0001/contact/0001", "mean_pressure_Pa"), 15e6);
  EXPECT_EQ(results.number("/scans/0001/films/0001", "lubricant_density_g_per_m2"), 0.9);
  EXPECT_FALSE(results.numbers("/scans/0000/psd/x_q_rad_per_m").empty());
  EXPECT_EQ(results.numbers("/experiment/friction").front(), 0.3);
}

TEST(Sweep, StoredStatesAgreeWithTheTable) {
  const ExampleStudy example;
  example.run();
  const io::Hdf5Reader results(example.results() / "results.h5");
  const io::ByteMap state = results.bytes("/scans/0000/contact/0001/state");
  const double pixels = (state > 0).cast<double>().mean();
  EXPECT_NEAR(pixels, results.numbers("/table/contact_area_fraction_pixels")[2], 1e-12);
  EXPECT_NEAR((state == 2).cast<double>().mean(),
              results.numbers("/table/saturated_area_fraction")[2], 1e-12);
}

TEST(Sweep, AScanWithSettingsOfItsOwnGivesTheRowsOfAStudyThatSharesThem) {
  const ExampleStudy example;
  example.write(test::kStudyText + std::string(R"(contact = "elastic"
reading = "literal"
[[scan]]
file = "scan_1.h5"
group = "saturated"
pressure = "15 MPa"
)"));
  run(example.read(), example.results("mixed"));
  const io::CsvTable mixed = io::parse_csv(example.csv("mixed"), "results.csv");
  ASSERT_EQ(mixed.rows.size(), 10u);
  example.write(
      test::replaced(replaced(test::kStudyText, "saturation_pressure = \"240 MPa\"\n", ""),
                     "[sweep]", "[lubricant]\nreading = \"literal\"\n[sweep]"));
  run(example.read(), example.results("elastic"));
  const io::CsvTable elastic = io::parse_csv(example.csv("elastic"), "results.csv");
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(mixed.rows[i], elastic.rows[i]);
  example.write(test::kStudyText);
  run(example.read(), example.results("saturated"));
  const io::CsvTable saturated = io::parse_csv(example.csv("saturated"), "results.csv");
  EXPECT_EQ(mixed.text(8, "friction_lubricated"), saturated.text(2, "friction_lubricated"));
  EXPECT_EQ(mixed.text(8, "group"), "saturated");
  const io::Hdf5Reader results(example.results("mixed") / "results.h5");
  EXPECT_EQ(results.text("/scans/0000", "contact"), "elastic");
  EXPECT_EQ(results.text("/scans/0000", "reading"), "literal");
  EXPECT_EQ(results.text("/scans/0002", "contact"), "saturated");
  EXPECT_EQ(results.text("/scans/0002", "area"), "pixels");
}

TEST(Sweep, OilOnAFilteredScanSaysSo) {
  const ExampleStudy example;
  example.write(std::string(test::kStudyText) + R"(treatment = ["lowpass=hann:4/L"]
[[scan]]
file = "scan_1.h5"
group = "unfiltered"
)");
  const Outcome outcome = example.run();
  const auto filtered =
      std::find_if(outcome.findings.begin(), outcome.findings.end(),
                   [](const results::Finding& one) { return one.code == "filtered"; });
  ASSERT_NE(filtered, outcome.findings.end());
  EXPECT_EQ(filtered->n_cases, 8u);  // not those of the third scan
  EXPECT_THAT(filtered->text, HasSubstr("lowpass=hann:4/L"));
}

TEST(Sweep, FrictionAgainstDensityIsThatOfTheFilmsOfItsDensities) {
  const ExampleStudy example;
  const Outcome outcome = example.run();
  ASSERT_EQ(outcome.density_curves.size(), 2u);  // one for each pressure
  const GroupCurve& mean = outcome.density_curves[0];
  EXPECT_EQ(mean.n, 2u);
  EXPECT_EQ(mean.asked.size(), 2u);
  const io::Hdf5Reader results(example.results() / "results.h5");
  const auto densities = results.numbers("/density_curves/lubricant_density_g_per_m2");
  const auto friction = results.numbers("/density_curves/friction_lubricated");
  const auto dry = results.numbers("/table/friction_dry");
  ASSERT_EQ(densities.size(), friction.size());
  EXPECT_LE(friction.front(), dry.front());
  EXPECT_TRUE(std::filesystem::exists(example.results() / "density_curves.csv"));
  // The limit of small droplets is what the droplets of the rows come close to.
  const std::string text =
      test::replaced(test::kStudyText, "[\"0.45 g/m^2\", \"0.9 g/m^2\"]", "\"1 g/m^2\"");
  example.write(test::replaced(text, "[sweep]", "[lubricant]\nmodel = \"limit\"\n[sweep]"));
  run(example.read(), example.results("limit"));
  const io::Hdf5Reader limit(example.results("limit") / "results.h5");
  const auto at = std::find_if(densities.begin(), densities.end(),
                               [](double density) { return std::abs(density - 1) < 1e-6; });
  ASSERT_NE(at, densities.end());
  EXPECT_NEAR(friction[static_cast<std::size_t>(at - densities.begin())],
              limit.numbers("/table/friction_lubricated").front(), 1e-12);
}

TEST(Sweep, ADamagedCurveIsComputedAgain) {
  const ExampleStudy example;
  example.run();
  const std::string before = test::bytes_of(example.results() / "density_curves.csv");
  for (const auto& file : std::filesystem::directory_iterator(example.results() / "store")) {
    const std::string name = file.path().filename().string();
    if (name.starts_with("wetshares-")) test::put_bytes(file.path(), "{}");
  }
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts, 0u);
  EXPECT_EQ(outcome.warnings.size(), 4u);
  EXPECT_EQ(test::bytes_of(example.results() / "density_curves.csv"), before);
}

TEST(Sweep, WarnsAboutTwoScansWithTheSameBytes) {
  const ExampleStudy example;
  std::filesystem::copy_file(example.folder / "scan_1.h5", example.folder / "scan_3.h5");
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts, 4u);  // the copy's contacts are in the store already
  ASSERT_EQ(outcome.warnings.size(), 1u);
  EXPECT_THAT(outcome.warnings[0], HasSubstr("scan_1.h5 and scan_3.h5 are the same file"));
}

/// Whoever opens the results later reads what the run said: of the sweep, and of its rows.
TEST(Sweep, ResultsHoldWhatTheRunWarnedOf) {
  const ExampleStudy example;
  std::filesystem::copy_file(example.folder / "scan_1.h5", example.folder / "scan_3.h5");
  const Outcome outcome = example.run();
  std::vector<std::string> lines = outcome.warnings, classes(lines.size(), "doubt");
  for (const results::Finding& finding : outcome.findings) {
    lines.push_back(results::line_of(finding));
    classes.emplace_back(cases::name_of(finding.kind()));
  }
  ASSERT_GE(lines.size(), 2u);
  const io::Hdf5Reader results(example.results() / "results.h5");
  EXPECT_EQ(results.attribute_texts("/", "warnings"), lines);
  EXPECT_EQ(results.attribute_texts("/", "warning_classes"), classes);
}

TEST(Sweep, ItsFolderIsCitedAsItsResults) {
  const ExampleStudy example;
  example.run();
  const results::ReferenceKeys keys = results::references_in(example.results() / "results.h5");
  EXPECT_GT(keys.size(), 3U);
  EXPECT_EQ(results::references_in(example.results()), keys);
}

}  // namespace
}  // namespace tabor::study
