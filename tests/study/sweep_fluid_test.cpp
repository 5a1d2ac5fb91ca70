#include <cmath>

#include "study/example_study.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/treated_scan.hpp"

// Studies whose oil flows.
namespace tabor::study {
namespace {

using test::ExampleStudy;
using test::replaced;
using testing::HasSubstr;

/// One pressure and density of the example at two speeds: 2 scans, 4 cases.
std::string small_study() {
  std::string text = replaced(test::flowing_study(), "\"5 MPa\", ", "");
  return replaced(text, "\"0.45 g/m^2\", ", "");
}

io::CsvTable table_of(const ExampleStudy& example, const std::string& name = "results") {
  return io::parse_csv(example.csv(name), "results.csv");
}

TEST(FlowingSweep, MakesARowForEverySpeed) {
  const ExampleStudy example;
  example.write(small_study());
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_cases, 4u);
  EXPECT_EQ(outcome.n_done, 4u);
  EXPECT_EQ(outcome.n_contacts, 2u);  // per scan, not per speed
  EXPECT_EQ(outcome.n_fluids, 4u);
  EXPECT_EQ(outcome.n_failed, 0u);
  const io::CsvTable table = table_of(example);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(table.number(i, "sliding_speed_m_per_s"), i % 2 == 0 ? 0.1 : 1.0);
    EXPECT_GT(table.number(i, "fluid_load_share"), 0);
    EXPECT_GT(table.number(i, "friction_viscous"), 0);
    EXPECT_DOUBLE_EQ(table.number(i, "friction_mixed"),
                     table.number(i, "friction_solid") + table.number(i, "friction_viscous"));
    if (i % 2 == 1) {
      EXPECT_GT(table.number(i, "fluid_load_share"), table.number(i - 1, "fluid_load_share"));
    }
  }
}

TEST(FlowingSweep, LeavesWhatTheContactSaysAsItWas) {
  const ExampleStudy example;
  example.run();
  const io::CsvTable at_rest = table_of(example);
  example.write(test::flowing_study("\"1 m/s\""));
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts + outcome.n_films, 0u);  // both are in the store
  EXPECT_EQ(outcome.n_fluids, 8u);
  const io::CsvTable flowing = table_of(example);
  for (const std::string& column : at_rest.columns) {
    if (column == "case_id" || column == "converged") continue;
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(flowing.text(i, column), at_rest.text(i, column)) << column;
    }
  }
  // And back again: the old rows are still there.
  example.write(test::kStudyText);
  EXPECT_EQ(example.run().n_rows, 0u);
}

TEST(FlowingSweep, StudiesWithoutFlowKeepTheirRecords) {
  const ExampleStudy example;
  example.run();
  const engine::Task task = tasks_of(example.read())[0].cases[0][0];
  const io::Json json = io::read_json(example.results() / "store" / task.file);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(
      keys,
      testing::UnorderedElementsAre(
          "canonical_text", "case_id", "certificate", "contact_area_fraction",
          "contact_area_fraction_pixels", "converged", "error", "escaping_fraction", "friction_dry",
          "friction_lubricated", "group", "lubricant_density_kg_per_m2", "lubricated_share",
          "mean_film_m", "mean_gap_m", "mean_pressure_Pa", "saturated_area_fraction", "scan",
          "sha256", "software_version", "spill_over_fraction", "trapped_fraction", "warnings"));
}

TEST(FlowingSweep, AgreesWithTheSolverItself) {
  const ExampleStudy example;
  example.write(small_study());
  example.run();
  const Study study = example.read();
  const ScanTasks tasks = tasks_of(study)[0];
  const topography::Topography surface = treated_surface(study, study.scans[0], tasks.sha256, {});
  const contact::State dry =
      cases::contact_state(surface, study.settings.contact,
                           contact::MeanPressure{study.settings.mean_pressures[0]})
          .state;
  const engine::Store store(example.results(), engine::Store::Use::alone);
  const cases::FluidRecord stored = read_fluid(store, tasks.fluids[0][1]);
  ASSERT_TRUE(stored.summary.convergence.converged());
  EXPECT_NEAR(stored.summary.load_share + stored.summary.solid_share, 1, 1.1e-3);
  EXPECT_GT(stored.summary.mean_gap, dry.gap.max(0.0).mean());
  const io::CsvTable table = table_of(example);
  EXPECT_EQ(table.number(1, "fluid_load_share"), stored.summary.load_share);
  EXPECT_EQ(table.number(1, "friction_viscous"),
            stored.summary.viscous_stress / study.settings.mean_pressures[0]);
  const io::Hdf5Reader results(example.results() / "results.h5");
  const Field pressure = results.field("/scans/0000/fluid/0001/fluid_pressure");
  EXPECT_NEAR(pressure.mean() / study.settings.mean_pressures[0], stored.summary.load_share, 1e-6);
  EXPECT_EQ(results.number("/scans/0000/fluid/0001", "sliding_speed_m_per_s"), 1.0);
  EXPECT_EQ(results.text("/", "fluid"), "reynolds");
  EXPECT_EQ(results.numbers("/averages/friction_mixed_mean").size(), 2u);
}

TEST(FlowingSweep, AtRestTheOilCarriesNothing) {
  const ExampleStudy example;
  example.write(replaced(small_study(), "\"0.1 m/s\", \"1 m/s\"", "\"0 m/s\""));
  example.run();
  const io::CsvTable table = table_of(example);
  EXPECT_EQ(table.number(0, "fluid_load_share"), 0);
  EXPECT_EQ(table.number(0, "friction_mixed"), table.number(0, "friction_lubricated"));
}

TEST(FlowingSweep, SameBytesForAnyNumberOfJobsAndAfterStops) {
  const ExampleStudy example;
  example.write(small_study());
  SweepOptions options;
  options.jobs = 1;
  example.run(options, "one");
  options.jobs = 4;
  example.run(options, "four");
  EXPECT_EQ(example.csv("one"), example.csv("four"));
  bool stopped = true;
  for (int n = 3; stopped && n < 100000; n *= 4) {
    SweepOptions stopping;
    stopping.jobs = 2;
    stopping.observer = [left = n](const Progress&) mutable { return --left >= 0; };
    try {
      example.run(stopping, "resumed");
      stopped = false;
    } catch (const Interrupted&) {
    }
  }
  EXPECT_FALSE(stopped);
  EXPECT_EQ(example.csv("one"), example.csv("resumed"));
}

TEST(FlowingSweep, ShardsTogetherAreTheWhole) {
  const ExampleStudy example;
  example.write(small_study());
  example.run({}, "whole");
  std::size_t n_fluids = 0;
  for (const int index : {1, 2}) {
    SweepOptions options;
    options.shard = engine::Shard{index, 2};
    n_fluids += example.run(options, "parts").n_fluids;
  }
  EXPECT_EQ(n_fluids, 4u);
  EXPECT_EQ(example.csv("whole"), example.csv("parts"));
}

TEST(FlowingSweep, ASpeedMoreAddsOnlyItsOwnWork) {
  const ExampleStudy example;
  example.write(small_study());
  example.run();
  example.write(replaced(small_study(), "\"1 m/s\"", "\"0.5 m/s\", \"1 m/s\""));
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts + outcome.n_films, 0u);
  EXPECT_EQ(outcome.n_fluids, 2u);
  EXPECT_EQ(outcome.n_rows, 2u);
  EXPECT_EQ(example.run().n_fluids, 0u);
}

TEST(FlowingSweep, ANewShearStrengthLetsNoFilmFlowAgain) {
  const ExampleStudy example;
  example.write(small_study());
  example.run();
  example.write(replaced(small_study(), "70 MPa", "35 MPa"));
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_fluids, 0u);
  EXPECT_EQ(outcome.n_rows, 4u);
}

TEST(FlowingSweep, DeletedAndDamagedFilmsFlowAgain) {
  const ExampleStudy example;
  example.write(small_study());
  example.run();
  const std::string csv = example.csv();
  const engine::Task task = tasks_of(example.read())[1].fluids[0][1];
  const std::filesystem::path file = example.results() / "store" / task.file;
  const std::string bytes = test::bytes_of(file);
  test::put_bytes(file, bytes.substr(0, bytes.size() / 2));
  const Outcome damaged = example.run();
  EXPECT_EQ(damaged.n_fluids, 1u);
  EXPECT_THAT(damaged.warnings, testing::Contains(HasSubstr(task.file)));
  std::filesystem::remove(file);
  EXPECT_EQ(example.run().n_fluids, 1u);
  EXPECT_EQ(example.csv(), csv);
}

/// Puts a film that did not converge into the store, in place of the first of the study.
void store_unfinished_film(const ExampleStudy& example) {
  const engine::Store store(example.results(), engine::Store::Use::alone);
  cases::FluidRecord record;
  friction::FluidFilmState& state = record.state;
  state.film.pressure = state.film.fill = state.contact.gap = Field::Zero(24, 32);
  record.summary.solid_share = 1;
  record.warnings = {{"fluid-film", "film NOT CONVERGED"}};
  write_fluid(store, tasks_of(example.read())[0].fluids[0][0], {32, 24, 32e-6, 24e-6}, record, {});
}

TEST(FlowingSweep, SaysWhatDidNotConvergeAndTriesItAgainOnlyByRetry) {
  const ExampleStudy example;
  example.write(small_study());
  store_unfinished_film(example);
  const Outcome first = example.run();
  EXPECT_EQ(first.n_fluids, 3u);
  EXPECT_EQ(first.n_not_converged, 1u);
  EXPECT_THAT(first.findings,
              testing::Contains(testing::ResultOf(
                  results::line_of, testing::AllOf(HasSubstr("scan_1.h5"), HasSubstr("100 mm/s"),
                                                   HasSubstr("NOT CONVERGED")))));
  EXPECT_EQ(table_of(example).text(0, "converged"), "false");
  const io::CsvTable averages = io::read_csv(example.results() / "averages.csv");
  EXPECT_EQ(averages.number(0, "n"), 1);
  EXPECT_EQ(averages.number(1, "n"), 2);
  EXPECT_EQ(example.run().n_fluids, 0u);
  SweepOptions options;
  options.retry = true;
  const Outcome again = example.run(options);
  EXPECT_EQ(again.n_fluids, 1u);
  EXPECT_EQ(again.n_contacts, 0u);
  EXPECT_EQ(again.n_not_converged, 0u);
}

TEST(FlowingSweep, AScanThatFailsIsRecordedForEverySpeed) {
  const ExampleStudy example;
  example.add_scan("scan_1.h5", 1, true);
  example.write(small_study());
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_done, 4u);
  EXPECT_EQ(outcome.n_failed, 2u);
  EXPECT_EQ(outcome.n_fluids, 2u);
  EXPECT_EQ(table_of(example).text(1, "friction_mixed"), "");
  EXPECT_EQ(table_of(example).number(1, "sliding_speed_m_per_s"), 1);
  EXPECT_EQ(example.run().n_rows, 0u);
}

}  // namespace
}  // namespace tabor::study
