// Friction of solids and oil together, by the numbers of a state made up for the purpose.
#include "tabor/friction/mixed_friction.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <string>
#include <vector>

#include "tabor/core/error.hpp"

namespace tabor::friction {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kLoad = 10e6;           // [Pa]
constexpr double kShearStrength = 70e6;  // [Pa]
constexpr double kNoCap = contact::kNoSaturation;

/// The oil carries three quarters.
FluidSummary three_quarters_on_oil() {
  FluidSummary fluid;
  fluid.solid_share = 0.25;
  fluid.contact_area_fraction = 0.02;
  fluid.contact_area_fraction_pixels = 0.03;
  fluid.lubricated_share = 0.5;
  fluid.viscous_stress = 1e5;
  return fluid;
}

TEST(MixedFriction, IsTheShearOfDryContactAndOilOverTheWholeLoad) {
  const FluidSummary fluid = three_quarters_on_oil();
  const MixedEstimate mixed = estimate(fluid, kLoad, kNoCap, kShearStrength);
  EXPECT_DOUBLE_EQ(mixed.area_fraction, 0.02);
  EXPECT_DOUBLE_EQ(mixed.friction_solid, 0.02 * 0.5 * 7);  // dry area times 70 MPa / 10 MPa
  EXPECT_DOUBLE_EQ(mixed.friction_viscous, 0.01);
  EXPECT_DOUBLE_EQ(mixed.friction_mixed, 0.08);
  const MixedEstimate pixels = estimate(fluid, kLoad, kNoCap, kShearStrength, Area::pixels);
  EXPECT_DOUBLE_EQ(pixels.friction_solid, 0.03 * 0.5 * 7);
}

TEST(MixedFriction, SolidsAtTheCapSlideOnTheAreaThatCarriesTheirShare) {
  FluidSummary fluid = three_quarters_on_oil();
  fluid.contact_area_fraction = 0;  // corrected to nothing
  fluid.lubricated_share = 0;
  EXPECT_DOUBLE_EQ(estimate(fluid, kLoad, 250e6, kShearStrength).friction_solid, 0.25 * 70 / 250);
}

TEST(MixedFriction, OfSurfacesApartIsTheOilsAlone) {
  FluidSummary fluid;
  fluid.viscous_stress = 2e5;
  const MixedEstimate mixed = estimate(fluid, kLoad, kNoCap, kShearStrength);
  EXPECT_EQ(mixed.area_fraction, 0);
  EXPECT_EQ(mixed.friction_solid, 0);
  EXPECT_DOUBLE_EQ(mixed.friction_mixed, 0.02);
}

/// 4 x 5 pixels of 1 m x 2 m: solids in a block of 2 x 2, of which one is wet.
struct Patch {
  Grid grid{5, 4, 5, 8};
  FluidFilmProblem problem;
  FluidFilmState state;

  Patch() {
    problem.contact.height = Field::Zero(4, 5);
    problem.contact.control = contact::MeanPressure{kLoad};
    problem.film = Field::Zero(4, 5);
    problem.film(1, 1) = 1e-6;
    problem.lubricant.viscosity = material::constant_viscosity(0.2);
    state.contact.pressure = Field::Zero(4, 5);
    state.contact.displacement = Field::Zero(4, 5);
    state.contact.gap = Field::Constant(4, 5, 1e-6);
    state.contact.pressure.block(1, 1, 2, 2) = 12.5e6;
    state.contact.gap.block(1, 1, 2, 2) = 0;
    state.contact.mean_pressure = 2.5e6;
    state.contact.convergence.status = Status::converged;
    state.solid_pressure = 2.5e6;
    state.fluid_pressure = 7.5e6;
    state.viscous_stress = 1e5;
    state.mean_gap = 0.8e-6;
    state.film.pressure = Field::Constant(4, 5, 7.5e6);
    state.film.pressure(3, 4) = 9e6;
    state.film.fill = Field::Constant(4, 5, 0.5);
    state.film.fill.row(0) = 1;
    state.film.oil.outside = 6e-6;
    state.film.convergence.status = Status::converged;
    state.convergence.status = Status::converged;
  }
  std::vector<std::string> warnings() const { return texts_of(friction::warnings(state, problem)); }
};

TEST(FluidSummary, SharesTheLoadAndCountsThePixels) {
  const Patch patch;
  const FluidSummary found = summarise(patch.state, patch.problem, patch.grid);
  EXPECT_DOUBLE_EQ(found.load_share, 0.75);
  EXPECT_DOUBLE_EQ(found.solid_share, 0.25);
  EXPECT_EQ(found.max_pressure, 9e6);
  EXPECT_DOUBLE_EQ(found.contact_area_fraction_pixels, 4.0 / 20);
  const double transition = (std::numbers::pi - 1 + std::numbers::ln2) / 24;  // [pixels]
  EXPECT_DOUBLE_EQ(found.contact_area_fraction, (4 - 8 * transition) / 20);
  EXPECT_DOUBLE_EQ(found.lubricated_share, 0.25);
  EXPECT_EQ(found.mean_gap, 0.8e-6);
  EXPECT_DOUBLE_EQ(found.full_fraction, 5.0 / 20);
  EXPECT_DOUBLE_EQ(found.outside_film, 6e-6 / 20);
  EXPECT_TRUE(found.convergence.converged());
}

TEST(FluidSummary, OfSurfacesApartHasNoContact) {
  Patch patch;
  patch.state.solid_pressure = 0;
  patch.state.contact.pressure.setZero();
  const FluidSummary found = summarise(patch.state, patch.problem, patch.grid);
  EXPECT_EQ(found.contact_area_fraction, 0);
  EXPECT_EQ(found.lubricated_share, 0);
}

TEST(FluidWarnings, AreNoneOfAGoodState) { EXPECT_THAT(Patch().warnings(), IsEmpty()); }

TEST(FluidWarnings, SayWhetherTheOilStillMoves) {
  for (const Status status : {Status::converged, Status::stalled, Status::iteration_limit}) {
    Patch patch;
    patch.state.convergence.status = Status::iteration_limit;
    patch.state.film.convergence.status = status;
    EXPECT_THAT(patch.warnings(), Contains(HasSubstr("film is NOT CONVERGED")));
    const auto moves = Contains(HasSubstr("oil is still moving"));
    if (status == Status::converged) {
      EXPECT_THAT(patch.warnings(), Not(moves));
    } else {
      EXPECT_THAT(patch.warnings(), moves);
    }
  }
}

TEST(FluidWarnings, NameAnOilThatTheSolidsWouldNotBear) {
  Patch patch;
  patch.problem.contact.bounds.upper = 8e6;  // the film reaches 9 MPa
  EXPECT_THAT(patch.warnings(), Contains(HasSubstr("reaches 9 MPa, more than the solids bear")));
  patch.problem.contact.bounds.upper = 9e6;
  EXPECT_THAT(patch.warnings(), IsEmpty());
}

TEST(FlowingOil, TakesTheLawsThatItsNumbersCallFor) {
  FlowingOil oil;
  oil.viscosity = 0.1;
  EXPECT_EQ(law_of(lubricant_of(oil).viscosity), material::ViscosityLaw::constant);
  EXPECT_EQ(law_of(lubricant_of(oil).shear), material::ShearLaw::newtonian);
  oil.pressure_viscosity = 2e-8;
  oil.eyring_stress = 5e6;
  EXPECT_EQ(law_of(lubricant_of(oil).viscosity), material::ViscosityLaw::roelands);
  EXPECT_DOUBLE_EQ(material::ambient_viscosity(lubricant_of(oil).viscosity), 0.1);
  EXPECT_EQ(law_of(lubricant_of(oil).shear), material::ShearLaw::ree_eyring);
}

}  // namespace
}  // namespace tabor::friction
