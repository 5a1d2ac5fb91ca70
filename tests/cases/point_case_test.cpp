#include "tabor/cases/ehl/point_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/ehl/friction.hpp"

// A case of a point contact from C++, without the command line.
namespace tabor::ehl {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

io::Config config(const std::string& more = "") {
  return io::Config::parse("[groups]\nM = 20\nL = 10\n[grid]\nnodes = 33\n" + more, "case.toml");
}

bool has_fact(const CaseResult& result, const std::string& label) {
  for (const Facts& group : result.facts) {
    for (const Fact& fact : group) {
      if (fact.label == label) return !fact.value.empty();
    }
  }
  return false;
}

TEST(PointCase, HasTheMoesGroupsThatItIsGiven) {
  const reference::PointContactFilm groups = film_groups_of(read_point(config()));
  EXPECT_NEAR(groups.moes_load(), 20, 1e-12);
  EXPECT_NEAR(groups.moes_viscosity(), 10, 1e-12);
  const CaseResult result = solve_case(point_program(), config());
  EXPECT_TRUE(result.converged());
  EXPECT_NEAR(result.number("M"), 20, 1e-12);
  EXPECT_NEAR(result.number("L"), 10, 1e-12);
  EXPECT_TRUE(has_fact(result, "Moes' groups"));
  EXPECT_TRUE(has_fact(result, "smallest film"));
}

TEST(PointCase, IsIsoviscousWithoutAGroupOfViscosity) {
  const PointProblem problem =
      read_point(io::Config::parse("[groups]\nM = 50\nL = 0\n[grid]\nnodes = 33\n", "case.toml"));
  EXPECT_EQ(film_groups_of(problem).moes_viscosity(), 0);
  EXPECT_NEAR(film_groups_of(problem).moes_load(), 50, 1e-12);
  EXPECT_EQ(material::law_of(problem.lubricant.viscosity), material::ViscosityLaw::constant);
}

TEST(PointCase, HasTheFilmOfItsProblem) {
  const PointResult film = solve_point(read_point(config()));
  const double centre = film.film(film.film.rows() / 2, (film.film.cols() * 3) / 4);
  const CaseResult result = solve_case(point_program(), config());
  EXPECT_NEAR(result.number("film_at_centre_m") / centre, 1, 1e-12);
}

TEST(PointCase, RejectsAKeyThatNoCaseHas) {
  EXPECT_THROW(solve_case(point_program(), config("[ball]\nradious = \"1 m\"\n")), InputError);
}

/// What becomes of a friction of 0.2 of a film so sheared under a gigapascal.
double friction_at(double ratio, const material::Shear& shear) {
  double stress = ratio * 1e9, fluid = 0.2, solid = 0, coefficient = 0.2;
  const auto warnings = void_friction(shear, {},
                                      {.max_pressure = 1e9,
                                       .solid_load_share = 0,
                                       .max_shear_stress = stress,
                                       .fluid = fluid,
                                       .solid = solid,
                                       .coefficient = coefficient});
  EXPECT_EQ(warnings.empty(), !std::isnan(coefficient));
  EXPECT_EQ(std::isnan(stress), std::isnan(coefficient));
  return coefficient;
}

TEST(VoidFriction, TakesWhatIsShearedBeyondTheYieldRatioOfOils) {
  EXPECT_EQ(friction_at(0.999 * kYieldRatio, material::NewtonianShear{}), 0.2);
  EXPECT_TRUE(std::isnan(friction_at(1.001 * kYieldRatio, material::NewtonianShear{})));
  EXPECT_TRUE(std::isnan(friction_at(-1.001 * kYieldRatio, material::NewtonianShear{})));
  EXPECT_EQ(friction_at(10 * kYieldRatio, material::ree_eyring_shear(5e6)), 0.2);
}

TEST(VoidFriction, TakesThatOfSolidsOfWhichNothingIsKnown) {
  double stress = 0, fluid = 0, solid = std::nan(""), coefficient = std::nan("");
  const auto warnings = void_friction(material::NewtonianShear{}, {},
                                      {.max_pressure = 1e9,
                                       .solid_load_share = 0.4,
                                       .max_shear_stress = stress,
                                       .fluid = fluid,
                                       .solid = solid,
                                       .coefficient = coefficient});
  EXPECT_THAT(texts_of(warnings), ElementsAre(HasSubstr("Solids carry 40 % of the load")));
  EXPECT_TRUE(std::isnan(coefficient));
}

TEST(PointCase, GivesNoFrictionThatNoOilHas) {
  const CaseResult result =
      solve_case(point_program(), config("[motion]\nsliding_speed = \"100 m/s\"\n"));
  EXPECT_TRUE(std::isnan(result.number("friction_coefficient")));
  EXPECT_THAT(texts_of(result.warnings), Contains(HasSubstr("Newtonian shear would be")));
}

/// A source of flat surfaces, which notes what it is asked for.
struct FlatSurfaces {
  std::vector<GeneratedSurface> generated = {};
  std::vector<NamedScan> read = {};

  SurfaceSource source() {
    return {.read =
                [this](const NamedScan& scan, const Observer&) {
                  read.push_back(scan);
                  const Grid grid{400, 400, 0.01, 0.01};
                  return Surface{.grid = grid,
                                 .height = Field::Zero(400, 400),
                                 .sha256 = "abc",
                                 .warnings = {{"spikes", "a warning"}}};
                },
            .generate =
                [this](const GeneratedSurface& finish) {
                  generated.push_back(finish);
                  return Surface{.grid = finish.grid,
                                 .height = Field::Zero(finish.grid.ny, finish.grid.nx)};
                }};
  }
};

TEST(PointCase, AsksForItsFinish) {
  ASSERT_EQ(finishes().size(), 2u);
  for (const Finish& finish : finishes()) {
    FlatSurfaces flat;
    read_rough_point(config("[roughness]\nkind = \"" + finish.name + "\"\n"),
                     {.observer = {}, .seed = 7, .surfaces = flat.source()});
    ASSERT_EQ(flat.generated.size(), 1u);
    EXPECT_EQ(flat.generated[0].rms_height, finish.rms_height);
    EXPECT_EQ(flat.generated[0].roll_off_wavelength, finish.roll_off_wavelength);
    EXPECT_EQ(flat.generated[0].groove_length, 0);
    EXPECT_EQ(flat.generated[0].seed, 7u);
  }
  FlatSurfaces flat;
  read_rough_point(config("[roughness]\nkind = \"ground\"\nrms = \"1 um\"\nseed = 3\n"),
                   {.observer = {}, .seed = 7, .surfaces = flat.source()});
  EXPECT_EQ(flat.generated.at(0).rms_height, 1e-6);
  EXPECT_GT(flat.generated[0].groove_length, flat.generated[0].roll_off_wavelength);
  EXPECT_EQ(flat.generated[0].seed, 3u);
}

TEST(PointCase, SaysWhatItsScanIsAndWhatIsWarnedOfOfIt) {
  FlatSurfaces flat;
  const RoughPoint rough =
      read_rough_point(config("[roughness]\nfile = \"scan.x3p\"\nchannel = \"2\"\n"),
                       {.observer = {}, .seed = 1, .surfaces = flat.source()});
  ASSERT_EQ(flat.read.size(), 1u);
  EXPECT_EQ(flat.read[0].file, "scan.x3p");
  EXPECT_EQ(flat.read[0].channel, "2");
  EXPECT_THAT(flat.read[0].treatment, ElementsAre("level=plane"));
  EXPECT_THAT(flat.read[0].rejects_holes_at, HasSubstr("roughness.file"));
  EXPECT_EQ(rough.notes.scan_sha256, "abc");
  EXPECT_THAT(texts_of(rough.notes.warnings), Contains("a warning"));
  EXPECT_EQ(rough.problem.roughness.rows(), rough.problem.nodes_y);
}

TEST(PointCase, NeedsSomethingThatMakesItsSurface) {
  for (const char* given : {"file = \"scan.x3p\"", "kind = \"ground\""}) {
    EXPECT_THAT([&] { read_rough_point(config(std::string("[roughness]\n") + given), {}); },
                ThrowsMessage<InputError>(HasSubstr("surfaces")));
  }
}

TEST(Programs, KnowTheMemoryOfTheirCases) {
  const Program program = point_program();
  EXPECT_GT(program.memory(config("nodes_x = 401\n")), 0u);
  EXPECT_THROW(program.memory(config("domain = -1\n")), InputError);
}

}  // namespace
}  // namespace tabor::ehl
