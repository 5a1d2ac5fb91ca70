// What is asked of friction, and the library of materials.
#include "tabor/cases/settings.hpp"

#include <gmock/gmock.h>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/material/library.hpp"

namespace tabor::cases {
namespace {

std::string same(std::string_view setting) { return std::string(setting); }

double lubricated(const FrictionSettings& friction, double wet) {
  contact::Summary contact;
  contact.mean_pressure = 7e6;
  contact.contact_area_fraction = contact.contact_area_fraction_pixels = 0.03;
  return estimate_of(contact, wet, {}, friction).friction_lubricated;
}

TEST(BoundaryFilm, AddsItsShearOnWetContact) {
  const double area_over_pressure = 0.03 / 7e6;
  EXPECT_NEAR(lubricated({.shear_strength = 70e6, .boundary_shear_strength = 5e6}, 0.25),
              (0.75 * 70e6 + 0.25 * 5e6) * area_over_pressure, 1e-15);
  EXPECT_NEAR(lubricated({.shear_strength = 70e6, .boundary_shear_share = 0.1}, 0.25),
              (0.75 + 0.025) * 70e6 * area_over_pressure, 1e-15);
}

TEST(BoundaryFilm, AsStrongAsTheSolidsMakesOilOfNoEffect) {
  const FrictionSettings friction{.shear_strength = 70e6, .boundary_shear_share = 1};
  EXPECT_DOUBLE_EQ(lubricated(friction, 0.6), lubricated(friction, 0));
}

TEST(BoundaryFilm, IsNoStrongerThanTheSolidsAndSaidOnce) {
  for (const FrictionSettings& wrong :
       {FrictionSettings{.shear_strength = 70e6, .boundary_shear_strength = 71e6},
        FrictionSettings{.shear_strength = 70e6, .boundary_shear_strength = -1.0},
        FrictionSettings{.shear_strength = 70e6, .boundary_shear_share = 1.1},
        FrictionSettings{
            .shear_strength = 70e6, .boundary_shear_strength = 5e6, .boundary_shear_share = 0.1}}) {
    EXPECT_TRUE(objection(wrong, same));
  }
  EXPECT_FALSE(objection(FrictionSettings{.shear_strength = 70e6}, same));
}

TEST(ShearStrength, IsMissedOnlyWhereTheLibraryHasNone) {
  const FrictionSettings none{.shear_strength = 0};
  const auto said = [&](std::string_view material) {
    const auto found = objection(none, same, material);
    return found ? found->expected + found->remedy : std::string();
  };
  EXPECT_THAT(said("glass"), testing::HasSubstr("no shear strength in the library"));
  EXPECT_THAT(said("aluminium-6016"), testing::HasSubstr("more than zero"));
  EXPECT_THAT(said(""), testing::HasSubstr("more than zero"));
}

TEST(Edges, SayWhatSurroundsTheScanUnlessTheBoundaryDoes) {
  using topography::Edges;
  ContactSettings settings;
  EXPECT_TRUE(settings.is_periodic());
  settings.take_edges(Edges::end);
  EXPECT_FALSE(settings.is_periodic());
  settings.take_edges(Edges::tile);  // the boundary is said
  EXPECT_FALSE(settings.is_periodic());
  for (const Edges edges : {Edges::tile, Edges::cut, Edges::end}) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
      settings.boundary = boundary;
      const bool agree = (edges == Edges::end) == (boundary == Boundary::free);
      EXPECT_EQ(objection(settings, edges).has_value(), !agree);
    }
    EXPECT_FALSE(objection(ContactSettings{}, edges));
  }
  settings.boundary = Boundary::free;
  EXPECT_FALSE(objection(settings, std::nullopt));
  const auto found = objection(settings, Edges::cut);
  EXPECT_TRUE(found->is_about_use);
  EXPECT_EQ(found->remedy,
            "<edges=cut> and <boundary=free> contradict each other; give one of them");
}

TEST(Materials, EachValueHasItsSource) {
  for (const material::NamedSolid& solid : material::solids()) {
    EXPECT_EQ(&material::find_solid(solid.name), &solid);
    for (const material::Sourced& number : {solid.youngs_modulus, solid.poissons_ratio}) {
      EXPECT_GT(number.value, 0) << solid.name;
      EXPECT_FALSE(number.source.empty()) << solid.name;
    }
    for (const auto& number : {solid.saturation_pressure, solid.shear_strength}) {
      EXPECT_TRUE(!number || (number->value > 0 && !number->source.empty())) << solid.name;
    }
  }
}

TEST(Materials, GiveWhatIsKnownAndLeaveTheRest) {
  CaseSettings settings;
  settings.friction.shear_strength = 1;
  take_material("Copper", settings);
  EXPECT_EQ(settings.contact.material, "copper");
  EXPECT_EQ(settings.contact.youngs_modulus, 129.8e9);
  EXPECT_FALSE(settings.contact.saturation_pressure);
  EXPECT_EQ(settings.friction.shear_strength, 1);
  EXPECT_THROW(take_material("unobtainium", settings), InputError);
}

TEST(Materials, AreNamedByTheirFamilyWhereItHasOneMember) {
  CaseSettings settings;
  take_material("aluminium", settings);
  EXPECT_EQ(settings.contact.material, "aluminium-6016");
  EXPECT_THROW(take_material("steel", settings), InputError);
  EXPECT_THROW(take_material("", settings), InputError);
}

}  // namespace
}  // namespace tabor::cases
