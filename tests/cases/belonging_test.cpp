#include "tabor/cases/belonging.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "support/rejection.hpp"
#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/digest.hpp"

namespace tabor::cases {
namespace {

using testing::HasSubstr;

topography::Topography rough(std::uint64_t seed) {
  synthesis::SelfAffine recipe;
  recipe.grid = {32, 24, 32e-6, 24e-6};
  recipe.rms_height = 0.2e-6;
  recipe.seed = seed;
  return synthesis::self_affine(recipe);
}

CaseSettings settings() {
  CaseSettings settings;
  settings.mean_pressures = {7e6};
  settings.contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33};
  settings.film.lubricant_densities = {4.5e-4};
  settings.fluid = {.fluid = Fluid::reynolds, .sliding_speed = 1e-3, .viscosity = 0.1};
  settings.friction.shear_strength = 70e6;
  return settings;
}

ContactRecord pressed(const topography::Topography& surface) {
  return contact_state(surface, settings().contact, contact::MeanPressure{7e6});
}

FilmRecord rained_on(const topography::Topography& surface) {
  return film_state(surface, settings().film).front();
}

FrictionRecord rubbed(const topography::Topography& surface, const ContactRecord& contact,
                      const FilmRecord& film, const FluidRecord* fluid = nullptr) {
  const Mask mask = contact::contact_mask(contact.state);
  return friction_state(contact, {mask, contact.state.gap, surface.grid}, {film, nullptr, fluid},
                        settings().contact, settings().friction);
}

FluidRecord flowing(const topography::Topography& surface, const ContactRecord& contact,
                    const FilmRecord& film) {
  const auto elasticity = make_operator(settings().contact, surface.grid);
  return fluid_state(*elasticity, surface, contact, film, settings().contact, settings().fluid);
}

/// The surface, one that a treatment made of it, and those that differ in grid or heights alone.
std::vector<topography::Topography> others(const topography::Topography& surface) {
  topography::Topography shifted = surface, wider = surface;
  shifted.height += 1e-9;
  wider.grid.lx *= 2;
  return {rough(2), shifted, wider};
}

TEST(Belonging, RecordsOfEqualSurfacesFit) {
  const topography::Topography surface = rough(1), copy = rough(1);
  const FrictionRecord found = rubbed(surface, pressed(surface), rained_on(copy));
  EXPECT_GT(found.friction_dry, 0);
}

TEST(Belonging, AFilmOfAnotherSurfaceIsRefused) {
  const topography::Topography surface = rough(1);
  const ContactRecord contact = pressed(surface);
  for (const topography::Topography& other : others(surface)) {
    const FilmRecord film = rained_on(other);
    EXPECT_THAT(test::rejection([&] { rubbed(surface, contact, film); }),
                HasSubstr("film: got a film on another surface"));
    EXPECT_THAT(test::rejection([&] { flowing(surface, contact, film); }),
                HasSubstr("film: got a film on another surface"));
  }
}

TEST(Belonging, AContactOfAnotherSurfaceIsRefused) {
  const topography::Topography surface = rough(1);
  const FilmRecord film = rained_on(surface);
  for (const topography::Topography& other : others(surface)) {
    const ContactRecord contact = pressed(other);
    EXPECT_THAT(test::rejection([&] { flowing(surface, contact, film); }),
                HasSubstr("contact: got one of another surface"));
    EXPECT_THAT(
        test::rejection([&] { density_curves(surface, {touching_of(contact)}, settings()); }),
        HasSubstr("contact: got one of another surface"));
  }
}

TEST(Belonging, AFlowOverAnotherSurfaceIsRefused) {
  const topography::Topography surface = rough(1), other = rough(2);
  FluidRecord fluid;  // one that flowing() would take minutes for where memory is watched
  fluid.surface = topography::digest_of(other.height, other.grid);
  const ContactRecord contact = pressed(surface);
  const FilmRecord film = rained_on(surface);
  EXPECT_THAT(test::rejection([&] { rubbed(surface, contact, film, &fluid); }),
              HasSubstr("flowing film: got one over another surface"));
}

TEST(Belonging, AContactOfALoadPathIsOfTheSurfaceThatItBeganWith) {
  const topography::Topography surface = rough(1);
  CaseSettings soft = settings();
  soft.contact.saturation_pressure = 100e6;
  soft.contact.load_path = true;
  std::vector<ContactRecord> path;
  const auto elasticity = make_operator(soft.contact, surface.grid);
  contact_states(*elasticity, surface, soft.contact,
                 {contact::MeanPressure{20e6}, contact::MeanPressure{7e6}},
                 [&](ContactRecord&& one) { path.push_back(std::move(one)); });
  EXPECT_GT(rubbed(surface, path[1], rained_on(surface)).friction_dry, 0);
}

TEST(Belonging, RecordsOfAStoreAreTakenByTheirShape) {
  const topography::Topography surface = rough(1);
  ContactRecord contact = pressed(surface);
  contact.surface = 0;
  EXPECT_NO_THROW(rubbed(surface, contact, rained_on(rough(2))));
  FilmRecord narrow = rained_on(surface);
  narrow.film.thickness = Field::Zero(24, 16);
  EXPECT_THAT(test::rejection([&] { rubbed(surface, contact, narrow); }),
              HasSubstr("film: got shape (24, 16); expected that of the contact, (24, 32)"));
}

}  // namespace
}  // namespace tabor::cases
