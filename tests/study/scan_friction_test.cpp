// Friction of one surface by jobs beside each other: the same numbers as one after the other.

#include "tabor/study/scan_friction.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "support/rejection.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Place = std::array<double, 2>;  // pressure [Pa], density [kg/m^2]

topography::Topography rough() {
  synthesis::SelfAffine recipe;
  recipe.grid = {48, 32, 48e-6, 32e-6};
  recipe.rms_height = 0.5e-6;
  return synthesis::self_affine(recipe);
}

cases::CaseSettings settings() {
  cases::CaseSettings settings;
  settings.mean_pressures = {15e6, 2e6, 7e6};
  settings.contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33, .saturation_pressure = 240e6};
  settings.film.lubricant_densities = {9e-4, 4.5e-4};
  settings.friction.shear_strength = 70e6;
  return settings;
}

cases::CaseSettings along_a_load_path() {
  cases::CaseSettings path = settings();
  path.contact.load_path = true;
  return path;
}

cases::CaseSettings with_vanishing_droplets() {
  cases::CaseSettings limit = settings();
  limit.film.model = deposition::Model::limit;
  return limit;
}

/// A surface without relief has no density curve, and a friction all the same.
TEST(FrictionOf, IsFoundWithoutRelief) {
  topography::Topography flat = rough();
  flat.height.setZero();
  for (const cases::CaseSettings& asked : {settings(), with_vanishing_droplets()}) {
    std::vector<double> wet;
    const auto result = friction_of(flat, asked, [&](const FrictionState& state) {
      wet.push_back(state.friction.lubricated_share);
    });
    EXPECT_EQ(wet, std::vector<double>(6, 1.0));
    EXPECT_TRUE(result.density_curves.empty());
  }
}

TEST(FrictionOf, FindsTheDensityCurvesThatTheContactsAloneGive) {
  const topography::Topography surface = rough();
  for (const cases::CaseSettings& asked : {settings(), with_vanishing_droplets()}) {
    std::vector<cases::Touching> contacts;
    const auto receive = [&](const FrictionState& state) {
      if (state.friction.lubricant_density == asked.film.lubricant_densities.front()) {
        contacts.push_back(cases::touching_of(state.contact));
      }
    };
    const auto curves = friction_of(surface, asked, receive).density_curves;
    const auto alone = cases::density_curves(surface, contacts, asked);
    ASSERT_EQ(curves.size(), alone.size());
    for (std::size_t i = 0; i < curves.size(); ++i) {
      EXPECT_EQ(curves[i].lubricant_densities, alone[i].lubricant_densities);
      EXPECT_EQ(curves[i].lubricated_shares, alone[i].lubricated_shares);
    }
  }
}

cases::CaseSettings flowing() {
  cases::CaseSettings flow = settings();
  flow.mean_pressures = {7e6};
  flow.fluid = {.fluid = cases::Fluid::reynolds, .sliding_speed = 0.01, .viscosity = 0.2};
  return flow;
}

cases::CaseSettings under_a_tool() {
  cases::CaseSettings rough = settings();
  rough.contact.tool = {.tool = "ground:Sa=0.1um,groove-length=20um", .tool_places = 3};
  return rough;
}

/// What a state says, and a sum over its film.
std::string text_of(const FrictionState& state) {
  const io::Json numbers =
      io::json_of(cases::friction_columns(), state.friction, cases::media::kObject);
  return fmt::format("{} {}", io::to_text(numbers, -1), state.oil.film.film.thickness.sum());
}

std::vector<std::string> states_of(const cases::CaseSettings& asked, int jobs,
                                   ContactMaps maps = ContactMaps::kept) {
  std::vector<std::string> texts;
  engine::RunOptions options;
  options.jobs = jobs;
  friction_of(
      rough(), asked, [&](const FrictionState& state) { texts.push_back(text_of(state)); }, maps,
      options);
  return texts;
}

/// The same by the functions of analysis, one after the other.
std::vector<std::string> states_in_turn(const cases::CaseSettings& asked) {
  const topography::Topography surface = rough();
  const auto films = cases::film_state(surface, asked.film);
  const auto elasticity = cases::make_operator(asked.contact, surface.grid);
  std::vector<std::string> texts;
  const auto receive = [&](cases::ContactRecord&& contact) {
    const Mask touching = contact::contact_mask(contact.state);
    for (const cases::FilmRecord& film : films) {
      const cases::FrictionRecord friction =
          cases::friction_state(contact, {touching, contact.state.gap, surface.grid}, {film},
                                asked.contact, asked.friction);
      texts.push_back(text_of({.friction = friction, .contact = contact, .oil = {film}}));
    }
  };
  cases::contact_states(*elasticity, surface, asked.contact, cases::controls_of(asked), receive);
  return texts;
}

TEST(FrictionOf, HandsOnWhatTheStatesGiveOneAfterTheOther) {
  EXPECT_EQ(states_of(settings(), 1), states_in_turn(settings()));
  EXPECT_EQ(states_of(with_vanishing_droplets(), 1), states_in_turn(with_vanishing_droplets()));
  EXPECT_EQ(states_of(along_a_load_path(), 1), states_in_turn(along_a_load_path()));
  EXPECT_NE(states_of(along_a_load_path(), 1), states_of(settings(), 1));
}

TEST(FrictionOf, DoesNotDependOnTheNumberOfJobs) {
  for (const cases::CaseSettings& asked :
       {settings(), along_a_load_path(), flowing(), under_a_tool()}) {
    const std::vector<std::string> alone = states_of(asked, 1);
    EXPECT_EQ(states_of(asked, 4), alone);
    EXPECT_EQ(states_of(asked, 4, ContactMaps::dropped), alone);
  }
}

TEST(FrictionOf, IsTheMeanOverThePlacesOfATool) {
  std::vector<cases::FrictionRecord> means;
  friction_of(rough(), under_a_tool(),
              [&](const FrictionState& state) { means.push_back(state.friction); });
  std::vector<double> sums(means.size(), 0);
  for (const double x : {0.0, 16e-6, 32e-6}) {
    cases::CaseSettings at_x = under_a_tool();
    at_x.contact.tool.tool_places = 1;
    at_x.contact.tool.tool_x = x;
    std::size_t i = 0;
    friction_of(rough(), at_x, [&](const FrictionState& state) {
      EXPECT_DOUBLE_EQ(state.friction.tool->place->x, x);
      sums[i++] += state.friction.friction_lubricated;
    });
  }
  double spread = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    EXPECT_NEAR(means[i].friction_lubricated, sums[i] / 3, 1e-14);
    spread += means[i].tool->spread->friction_lubricated;
  }
  EXPECT_GT(spread, 0);
}

TEST(FrictionOf, AlongALoadPathEachPlaceOfTheToolHasAPathOfItsOwn) {
  cases::CaseSettings path = under_a_tool();
  path.contact.load_path = true;
  path.mean_pressures = {15e6, 7e6};
  const auto last = [&] {
    cases::FrictionRecord record;
    friction_of(rough(), path, [&](const FrictionState& state) { record = state.friction; });
    return record;
  };
  const cases::FrictionRecord mean = last();
  double sum = 0;
  path.contact.tool.tool_places = 1;
  for (const double x : {0.0, 16e-6, 32e-6}) {
    path.contact.tool.tool_x = x;
    sum += last().contact_area_fraction_pixels;
  }
  EXPECT_NEAR(mean.contact_area_fraction_pixels, sum / 3, 1e-14);
}

TEST(FrictionOf, GoesThroughPressuresAndDensitiesAsTheyWereGiven) {
  std::vector<Place> places;
  friction_of(rough(), settings(), [&](const FrictionState& state) {
    places.push_back({state.friction.mean_pressure, state.friction.lubricant_density});
  });
  EXPECT_THAT(places, ElementsAre(Place{15e6, 9e-4}, Place{15e6, 4.5e-4}, Place{2e6, 9e-4},
                                  Place{2e6, 4.5e-4}, Place{7e6, 9e-4}, Place{7e6, 4.5e-4}));
}

TEST(FrictionOf, SaysWhatToCite) {
  for (const cases::CaseSettings& asked : {settings(), flowing()}) {
    friction_of(rough(), asked, [&](const FrictionState& state) {
      EXPECT_EQ(state.friction.references, cases::references_of(asked));
    });
  }
}

TEST(FrictionOf, KeepsMapsOfContactsOnlyForThoseWhoLook) {
  for (const ContactMaps maps : {ContactMaps::kept, ContactMaps::dropped}) {
    friction_of(
        rough(), settings(),
        [&](const FrictionState& state) {
          EXPECT_EQ(state.contact.state.pressure.size() > 0, maps == ContactMaps::kept);
          EXPECT_EQ(state.contact.state.displacement.size() > 0, maps == ContactMaps::kept);
          EXPECT_EQ(state.contact.state.gap.size() > 0, maps == ContactMaps::kept);
        },
        maps);
  }
}

TEST(FrictionOf, StopsWhenAskedAndWhatItHandedOnIsWhole) {
  std::size_t n_states = 0;
  engine::RunOptions options;
  options.jobs = 2;
  options.observer = [&](const Progress&) { return n_states < 2; };
  const auto receive = [&](const FrictionState& state) {
    ++n_states;
    EXPECT_TRUE(state.friction.converged);
  };
  EXPECT_THROW(friction_of(rough(), settings(), receive, ContactMaps::kept, options), Interrupted);
  EXPECT_GE(n_states, 2u);
}

TEST(FrictionOf, PassesOnWhatTheReceiverThrows) {
  const auto full_disk = [](const FrictionState&) { throw OutputError("out.h5: no space"); };
  EXPECT_THROW(friction_of(rough(), settings(), full_disk), OutputError);
}

TEST(FrictionOf, RejectsSettingsThatMakeNoSense) {
  const auto rejected = [](const cases::CaseSettings& asked) {
    return test::rejection([&] { friction_of(rough(), asked, [](const FrictionState&) {}); });
  };
  cases::CaseSettings too_high = settings();
  too_high.mean_pressures.back() = 240e6;
  EXPECT_THAT(rejected(too_high), HasSubstr("saturation pressure"));
  cases::CaseSettings negative = settings();
  negative.film.lubricant_densities = {-1};
  EXPECT_THAT(rejected(negative), HasSubstr("density"));
}

CoarsePixels coarse_pixels_of(const topography::Topography& surface,
                              const cases::CaseSettings& asked, bool compares = true) {
  return friction_of(
             surface, asked, [](const FrictionState&) {}, ContactMaps::dropped, {}, compares)
      .coarse;
}

TEST(FrictionOf, SaysTheWetShareOnPixelsTwiceAsLarge) {
  // The verb says the same of the coarse scan.
  const auto coarse = topography::apply({"resample=24,16"}, rough());
  for (const cases::CaseSettings& asked : {settings(), along_a_load_path()}) {
    const CoarsePixels found = coarse_pixels_of(rough(), asked);
    std::vector<double> shares;
    friction_of(coarse, asked, [&](const FrictionState& state) {
      shares.push_back(state.friction.lubricated_share);
    });
    EXPECT_DOUBLE_EQ(found.pixel_x, 2e-6);
    ASSERT_EQ(found.lubricated_shares.size(), 3u);
    std::vector<double> told;
    for (const auto& one : found.lubricated_shares) told.insert(told.end(), one.begin(), one.end());
    EXPECT_EQ(told, shares);
  }
}

TEST(FrictionOf, ComparesNoPixelsWhereItIsNotAskedOrTheyAreFew) {
  EXPECT_TRUE(coarse_pixels_of(rough(), settings(), false).lubricated_shares.empty());
  const auto small = topography::apply({"crop=0,0,48,31"}, rough());
  EXPECT_TRUE(coarse_pixels_of(small, settings()).lubricated_shares.empty());
}

}  // namespace
}  // namespace tabor::study
