#include "tabor/study/ehl_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

// The numbers of a sweep of two cases as a table and as a result file.
namespace tabor::study {
namespace {

using testing::ElementsAre;

const ColumnHead kFilm{"film_m", "m", "film", ehl::kInTable};

ehl::Program program() {
  return {.name = "drop",
          .summary = "",
          .keys = {},
          .columns = {kFilm,
                      {"steps", "", "steps", ehl::kAlone},
                      {"wear.depth_m", "m", "depth", ehl::kInTableWhereKnown}},
          .studies = {},
          .methods = {},
          .solve = {}};
}

std::vector<ehl::CaseResult> two_results() {
  return {{.numbers = {{kFilm, 2e-7}}, .status = ehl::CaseStatus::converged},
          {.numbers = {{kFilm, std::nan("")}},
           .warnings = {{"coarse-grid", "thin"}, {"viscosity-law", "a \"hot\" film"}}}};
}

std::vector<SweepAxis> axes() {
  return {{.key = "kind", .values = {"ground"}, .is_range = true},
          {.key = "speed", .values = {"50 mm/s", "0.2 m/s"}, .is_range = true}};
}

TEST(EhlTables, HaveWhatTellsCasesApartBeforeTheirNumbers) {
  const ehl::Program drop = program();
  EXPECT_EQ(csv_of(sweep_of(drop, axes(), two_results())),
            "kind,speed [m/s],film_m,converged,warnings,warning_codes\n"
            "ground,0.05,2e-07,true,,\n"
            "ground,0.2,,false,\"thin; a \"\"hot\"\" film\",coarse-grid viscosity-law\n");
}

TEST(EhlTables, HaveOneRowForACaseAlone) {
  const ehl::Program drop = program();
  EXPECT_EQ(csv_of(sweep_of(drop, {}, {two_results().front()})),
            "film_m,converged,warnings,warning_codes\n2e-07,true,,\n");
}

TEST(EhlTables, AreKeptWithAxesAndWarnings) {
  const test::Folder folder;
  const ehl::Program drop = program();
  results::Finding thin;
  thin.text = "thin";
  write_sweep(folder / "sweep.h5", {"tabor ehl drop", "load = \"1 N\"", {}},
              sweep_of(drop, axes(), two_results()), {thin});

  const io::Hdf5Reader reader(folder / "sweep.h5");
  EXPECT_EQ(reader.text("/", "kind"), "ehl drop sweep");
  EXPECT_THAT(reader.attribute_texts("/sweep", "axes"), ElementsAre("kind", "speed"));
  EXPECT_THAT(reader.attribute_texts("/sweep/axes/kind", "words"), ElementsAre("ground"));
  EXPECT_THAT(reader.numbers("/sweep/axes/speed"), ElementsAre(0.05, 0.2));
  EXPECT_EQ(reader.text("/sweep/axes/speed", "units"), "m/s");
  const std::vector<double> films = reader.numbers("/sweep/film_m");
  EXPECT_EQ(films.at(0), 2e-7);
  EXPECT_TRUE(std::isnan(films.at(1)));
  EXPECT_FALSE(reader.exists("/sweep/wear.depth_m"));
  EXPECT_THAT(reader.numbers("/sweep/converged"), ElementsAre(1, 0));
  EXPECT_THAT(reader.texts("/sweep/warnings"), ElementsAre("", "thin\na \"hot\" film"));
  EXPECT_THAT(reader.texts("/sweep/warning_codes"), ElementsAre("", "coarse-grid viscosity-law"));
}

TEST(EhlTables, SayEachKindOfWarningOnceWithItsCases) {
  const ehl::Program drop = program();
  std::vector<ehl::CaseResult> results(4, two_results().front());
  results[1].warnings = {{"viscosity-law", "hot at 3 K", 3}, {"coarse-grid", "thin"}};
  results[3].warnings = {{"viscosity-law", "hot at 40 mK", 40}};
  const std::vector<SweepAxis> varied = {
      {.key = "kind", .values = {"ground", "lapped"}, .is_range = true},
      {.key = "nodes", .values = {"65", "129"}, .is_range = true}};
  const EhlSweep sweep = sweep_of(drop, varied, results);
  ASSERT_EQ(sweep.warnings.size(), 2u);
  EXPECT_EQ(results::line_of(sweep.warnings[0]),
            "hot at 40 mK (2 of 4 cases, the worst shown: lapped / nodes=129, ground / nodes=129) "
            "[viscosity-law]");
  EXPECT_EQ(results::line_of(sweep.warnings[1]),
            "thin (1 of 4 cases: ground / nodes=129) "
            "[coarse-grid]");
}

TEST(EhlTables, AreNotWrittenIntoAFolderThatIsNotThere) {
  const test::Folder folder;
  const ehl::Program drop = program();
  EXPECT_THROW(
      write_sweep(folder / "none" / "sweep.h5", {}, sweep_of(drop, axes(), two_results()), {}),
      OutputError);
}

}  // namespace
}  // namespace tabor::study
