// Trapped oil that carries load: what friction makes of it.
#include <gmock/gmock.h>

#include <cmath>

#include "cases/small_sheet.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::cases {
namespace {

using testing::HasSubstr;

constexpr double kPressure = 60e6;  // pockets under it hold oil

CaseSettings aluminium() {
  CaseSettings settings;
  settings.mean_pressures = {kPressure};
  settings.contact = test::aluminium();
  settings.film.lubricant_densities = {0.45e-3};
  settings.friction = {.shear_strength = 70e6, .boundary_shear_strength = 5e6};
  settings.trapped.trapped = true;
  return settings;
}

/// A sheet, its contact, oil on it, and the oil in its pockets.
struct Pressed {
  explicit Pressed(const CaseSettings& settings)
      : surface(test::small_sheet()),
        elasticity(make_operator(settings.contact, surface.grid)),
        contact(contact_state(*elasticity, surface, settings.contact,
                              contact::MeanPressure{settings.mean_pressures.front()})),
        film(film_state(surface, settings.film).front()),
        trapped(trapped_state(*elasticity, surface, contact, film, settings)) {}

  FrictionRecord friction(const CaseSettings& settings, bool with_trapped = true) const {
    const Mask mask = contact::contact_mask(contact.state);
    return friction_state(contact, {mask, contact.state.gap, surface.grid},
                          {film, with_trapped ? &trapped : nullptr}, settings.contact,
                          settings.friction);
  }

  topography::Topography surface;
  std::unique_ptr<elastic::ElasticOperator> elasticity;
  ContactRecord contact;
  FilmRecord film;
  TrappedRecord trapped;
};

TEST(TrappedOil, LeavesTheShareOfTheLoadToTheSolidsThatTheirPressureSays) {
  const Pressed pressed(aluminium());
  const contact::TrappedState& state = pressed.trapped.state;
  const Mask touching = contact::solid_contact(state);
  double solids = 0;
  for (Index i = 0; i < touching.size(); ++i) {
    if (touching(i)) solids += state.contact.pressure(i);
  }
  const double load = state.contact.pressure.sum();
  EXPECT_GT(pressed.trapped.liquid.load_share, 0);
  EXPECT_NEAR(load / static_cast<double>(touching.size()) / kPressure, 1, 1e-12);
  EXPECT_NEAR(pressed.trapped.liquid.load_share, 1 - solids / load, 1e-9);
  EXPECT_EQ(pressed.trapped.liquid.max_pressure, state.liquid_pressure.maxCoeff());
}

TEST(TrappedOil, ShearsTheSolidsAlone) {
  const CaseSettings settings = aluminium();
  const Pressed pressed(settings);
  const FrictionRecord record = pressed.friction(settings);
  const Mask touching = contact::solid_contact(pressed.trapped.state);
  const Field& film = pressed.film.film.thickness;
  double dry = 0;
  double wet = 0;
  for (Index i = 0; i < touching.size(); ++i) {
    if (touching(i)) (film(i) > 0 ? wet : dry) += 1.0 / static_cast<double>(touching.size());
  }
  ASSERT_TRUE(record.trapped);
  EXPECT_NEAR(record.trapped->friction_solid, 70e6 * dry / kPressure, 1e-12);
  EXPECT_NEAR(record.trapped->friction_boundary, 5e6 * wet / kPressure, 1e-12);
  EXPECT_DOUBLE_EQ(record.friction_lubricated,
                   record.trapped->friction_solid + record.trapped->friction_boundary);
  const FrictionRecord without = pressed.friction(settings, false);
  EXPECT_EQ(record.friction_dry, without.friction_dry);
  EXPECT_LT(record.friction_lubricated, without.friction_lubricated);
  EXPECT_TRUE(record.converged);
}

TEST(TrappedOil, WithoutStiffnessOrOilChangesNothing) {
  CaseSettings soft = aluminium();
  soft.trapped.bulk_modulus = 1e-3;
  CaseSettings dry = aluminium();
  dry.film.lubricant_densities = {0};
  for (const CaseSettings& settings : {soft, dry}) {
    const Pressed pressed(settings);
    EXPECT_LT(pressed.trapped.liquid.load_share, 1e-9);
    EXPECT_NEAR(pressed.friction(settings).friction_lubricated,
                pressed.friction(settings, false).friction_lubricated, 1e-12);
  }
}

TEST(TrappedOil, DoesNotWetWhereItIsThinnerThanAsked) {
  CaseSettings settings = aluminium();
  const double as_laid = Pressed(settings).friction(settings).lubricated_share;
  settings.friction.dry_below = 5e-9;
  const Pressed thick_alone(settings);
  const FrictionRecord record = thick_alone.friction(settings);
  EXPECT_LT(record.lubricated_share, as_laid);
  settings.friction.dry_below = 1;
  EXPECT_EQ(Pressed(settings).friction(settings).trapped->lubricated_share, 0);
  EXPECT_EQ(thick_alone.friction(settings).lubricated_share, 0);
}

TEST(TrappedOil, OfSeveralPlacesIsTheirMean) {
  const CaseSettings settings = aluminium();
  const Pressed pressed(settings);
  FrictionRecord one = pressed.friction(settings);
  FrictionRecord other = one;
  one.tool = other.tool = ToolFriction{};
  other.trapped->load_share += 0.1;
  other.trapped->n_pockets += 4;
  other.trapped->certificate = 1;
  other.trapped->converged = false;
  const FrictionRecord mean = mean_over_places({one, other});
  EXPECT_DOUBLE_EQ(mean.trapped->load_share, one.trapped->load_share + 0.05);
  EXPECT_EQ(mean.trapped->n_pockets, one.trapped->n_pockets + 2);
  EXPECT_EQ(mean.trapped->certificate, 1);
  EXPECT_FALSE(mean.trapped->converged);
}

TEST(TrappedOil, IsRejectedWithWhatExcludesIt) {
  const auto remedy = [](const CaseSettings& settings) {
    const auto found = objection_to_trapped(settings, test::own_name);
    return found ? found->remedy + found->expected : "";
  };
  CaseSettings settings = aluminium();
  EXPECT_EQ(remedy(settings), "");
  settings.trapped.bulk_modulus = std::numeric_limits<double>::infinity();
  EXPECT_EQ(remedy(settings), "");
  settings.trapped.bulk_modulus = 0;
  EXPECT_THAT(remedy(settings), HasSubstr("inf"));
  settings.trapped = {.trapped = false, .bulk_modulus = 2e9};
  EXPECT_THAT(remedy(settings), HasSubstr("bulk_modulus needs trapped"));
  settings = aluminium();
  settings.contact.load_path = true;
  EXPECT_THAT(remedy(settings), HasSubstr("load_path"));
  settings = aluminium();
  settings.fluid.fluid = Fluid::reynolds;
  EXPECT_THAT(remedy(settings), HasSubstr("flows"));
  settings.trapped.trapped = false;
  settings.friction.dry_below = 1e-9;
  EXPECT_THAT(remedy(settings), HasSubstr("dry_below"));
}

}  // namespace
}  // namespace tabor::cases
