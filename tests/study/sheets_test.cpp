// What Costagliola et al. (2021, 2022) find on their sheets, on generated ones: lubricated friction
// falls with the pressure, a little with the dose where a full pit drops what does not fit, and the
// elastic dry friction of sheets after sliding rises with the pressure of the sliding.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tabor/cases/states.hpp"
#include "tabor/study/scan_friction.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

synthesis::Edt sheet(Index n, std::uint64_t seed) {
  synthesis::Edt recipe;
  const double side = static_cast<double>(n) * 0.67e-6;
  recipe.grid = {n, n, side, side};
  recipe.seed = seed;
  return recipe;
}

cases::CaseSettings lubricated(deposition::Reading reading) {
  cases::CaseSettings settings;
  cases::take_material("aluminium-6016", settings);
  settings.mean_pressures = {2e6, 15e6};
  settings.film.lubricant_densities = {0.45e-3, 0.9e-3};
  settings.film.reading = reading;
  return settings;
}

/// A sheet before sliding under the pressures of `lubricated`, for every reading of the rain.
struct PressedSheet {
  topography::Topography surface;
  std::vector<cases::ContactRecord> contacts;

  PressedSheet(Index n, std::uint64_t seed) : surface(synthesis::edt(sheet(n, seed))) {
    const cases::CaseSettings settings = lubricated({});
    const auto elasticity = cases::make_operator(settings.contact, surface.grid);
    cases::contact_states(
        *elasticity, surface, settings.contact, cases::controls_of(settings),
        [&](cases::ContactRecord&& contact) { contacts.push_back(std::move(contact)); });
  }
};

/// Lubricated friction by density [kg/m^2], then pressure [Pa].
using Frictions = std::map<double, std::map<double, double>>;

Frictions friction_of(const PressedSheet& sheet, deposition::Reading reading) {
  const cases::CaseSettings settings = lubricated(reading);
  const auto films = cases::film_state(sheet.surface, settings.film);
  Frictions friction;
  for (const cases::ContactRecord& contact : sheet.contacts) {
    const Mask touching = contact::contact_mask(contact.state);
    for (const cases::FilmRecord& film : films) {
      const auto record =
          cases::friction_state(contact, {touching, contact.state.gap, sheet.surface.grid}, {film},
                                settings.contact, settings.friction);
      friction[record.lubricant_density][record.mean_pressure] = record.friction_lubricated;
    }
  }
  return friction;
}

double fall_with_pressure(const std::map<double, double>& by_pressure) {
  return 1 - by_pressure.at(15e6) / by_pressure.at(2e6);
}

void expect_a_little_lower_at_the_higher_dose(const Frictions& friction) {
  for (const double pressure : {2e6, 15e6}) {
    const double ratio = friction.at(0.9e-3).at(pressure) / friction.at(0.45e-3).at(pressure);
    EXPECT_LT(ratio, 1) << pressure;
    EXPECT_GT(ratio, 0.97) << pressure;
  }
}

void expect_lower_friction_at_more_pressure_and_oil(Index n, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  const PressedSheet sheet(n, seed);
  const Frictions conserving = friction_of(sheet, deposition::Reading::conserving);
  EXPECT_GT(fall_with_pressure(conserving.at(0.45e-3)), 0.1);
  expect_a_little_lower_at_the_higher_dose(friction_of(sheet, deposition::Reading::literal));
}

TEST(EdtSheet, LubricatedFrictionFallsWithPressureAndALittleWithTheDose) {
  expect_lower_friction_at_more_pressure_and_oil(512, 2);
}

TEST(EdtSheet, FourLargeSheetsDoTheSame) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    expect_lower_friction_at_more_pressure_and_oil(1280, seed);
  }
}

TEST(EdtSheet, PocketsAreFullLongBeforeTheDoseOfTheSheet) {
  const cases::CaseSettings settings = lubricated(deposition::Reading::conserving);
  const auto result = friction_of(
      synthesis::edt(sheet(512, 2)), settings, [](const FrictionState&) {}, ContactMaps::dropped);
  ASSERT_EQ(result.density_curves.size(), settings.mean_pressures.size());
  for (const cases::DensityCurve& curve : result.density_curves) {
    ASSERT_TRUE(curve.plateau);
    EXPECT_LT(curve.plateau->first, 0.1e-3);
    EXPECT_GT(curve.plateau->last, 0.9e-3);
    EXPECT_LT(curve.plateau->last, 2e-3);
  }
}

double dry_friction_after_sliding(std::uint64_t seed, double pressure) {
  synthesis::Edt recipe = sheet(512, seed);
  recipe.stage = synthesis::EdtStage::after;
  recipe.sliding_pressure = pressure;
  const auto surface = topography::apply({"lowpass=hann:4.5um"}, synthesis::edt(recipe));
  const cases::ContactSettings elastic{.youngs_modulus = 70e9, .poissons_ratio = 0.33};
  const auto contact = cases::contact_state(surface, elastic, contact::MeanPressure{pressure});
  return cases::estimate_of(contact.summary, 0, elastic, {.shear_strength = 70e6}).friction_dry;
}

TEST(EdtSheet, ElasticDryFrictionAfterSlidingRisesWithItsPressure) {
  for (const std::uint64_t seed : {1, 2}) {
    const double at_2 = dry_friction_after_sliding(seed, 2e6);
    const double at_4 = dry_friction_after_sliding(seed, 4e6);
    const double at_7 = dry_friction_after_sliding(seed, 7e6);
    EXPECT_GT(at_4, 1.1 * at_2) << seed;
    EXPECT_GT(at_7, at_4) << seed;
    EXPECT_GT(at_7, 1.25 * at_2) << seed;
  }
}

}  // namespace
}  // namespace tabor::study
