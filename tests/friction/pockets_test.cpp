// Contact, film and friction of surfaces whose wet share is known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pockets.hpp"
#include "support/validation.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/reference/waves.hpp"

namespace tabor::friction {
namespace {

using test::expect_within;
using test::kPocketDepth;
using test::kPocketMap;
using test::Pocket;

constexpr double kArea = kPocketMap * kPocketMap;
constexpr double kCap = 240e6;   // [Pa], p_sat
constexpr double kShear = 70e6;  // [Pa], tau_y
constexpr double kClosed = 0.5;  // depth at which the surfaces close, over that of the pocket
constexpr double kLevels[] = {0.4, 0.25, 0.1};  // depth of the liquid's level, likewise

/// Numbers of one state: contact down to a depth and liquid up to another one.
struct WetState {
  double wet_share = 0;
  double spill_over = 0;
  double friction = 0;
};

/// Everything above the closing plane touches at p_sat; what is wet of it lies below the level.
WetState closed_form(const Pocket& pocket, double level) {
  const double open = pocket.area_below(kClosed * kPocketDepth);
  const double wet = pocket.area_below(level * kPocketDepth) - open;
  const double share = wet / (kArea - open);
  return {
      share,
      1 - pocket.volume_below(kClosed * kPocketDepth) / pocket.volume_below(level * kPocketDepth),
      (1 - share) * kShear / kCap};
}

/// A body so stiff that its contact is its bearing area.
contact::State press(const Field& height, const Grid& grid, double mean_pressure) {
  const auto elasticity = elastic::make_periodic(grid, 1e9 * kCap);
  contact::State state =
      contact::solve(*elasticity, {.height = height,
                                   .control = contact::MeanPressure{mean_pressure},
                                   .bounds = {.upper = kCap}});
  EXPECT_TRUE(state.convergence.converged());
  return state;
}

Field film_of(const Field& height, const Grid& grid, double mean_film, deposition::Edge edge) {
  deposition::Dose dose;
  dose.mean_films = {mean_film};
  dose.model = deposition::Model::limit;
  dose.edge = edge;
  return deposition::deposit(height, grid, dose).front().thickness;
}

WetState computed(const Pocket& pocket, double level, Index n) {
  const Grid grid = test::pocket_grid(n);
  const Field height = test::heights_of(pocket, n);
  const double mean_pressure = kCap * (1 - pocket.area_below(kClosed * kPocketDepth) / kArea);
  const contact::State state = press(height, grid, mean_pressure);
  const Field film = film_of(height, grid, pocket.volume_below(level * kPocketDepth) / kArea,
                             deposition::Edge::closed);
  const Mask contact = contact::contact_mask(state);
  const double share = lubricated_share(contact, film);
  const Contact asked = {.mean_pressure = mean_pressure,
                         .contact_area_fraction = contact.cast<double>().mean(),
                         .contact_area_fraction_pixels = contact.cast<double>().mean(),
                         .saturation_pressure = kCap,
                         .lubricated_share = share};
  return {share, spill_over_fraction(film, state.gap),
          estimate(asked, kShear, Area::pixels).friction_lubricated};
}

/// Largest errors over the levels: absolute for shares, relative for friction.
WetState errors(const Pocket& pocket, Index n) {
  WetState largest;
  for (const double level : kLevels) {
    const WetState ours = computed(pocket, level, n);
    const WetState theirs = closed_form(pocket, level);
    const auto take = [](double& most, double error) { most = std::max(most, std::abs(error)); };
    take(largest.wet_share, ours.wet_share - theirs.wet_share);
    take(largest.spill_over, ours.spill_over - theirs.spill_over);
    take(largest.friction, ours.friction / theirs.friction - 1);
  }
  return largest;
}

void expect_small(const std::string& name, const WetState& error, const WetState& tolerance) {
  expect_within("Wet contact", name, "wet share of the contact at three doses, absolute",
                "closed form", error.wet_share, tolerance.wet_share);
  expect_within("Wet contact", name, "spill-over at three doses, absolute", "closed form",
                error.spill_over, tolerance.spill_over);
  expect_within("Friction", name, "lubricated friction at three doses, relative",
                "(1 - wet share) tau_y / p_sat in closed form", error.friction, tolerance.friction);
}

TEST(Pockets, WithCurvedShoresHaveTheSharesOfTheirClosedForms) {  // slow
  for (const Pocket& pocket : {test::spherical_pit(), test::tilted_groove()}) {
    const WetState coarse = errors(pocket, 64);
    const WetState fine = errors(pocket, 512);
    EXPECT_LT(fine.wet_share, coarse.wet_share / 2) << pocket.name;
    EXPECT_LT(fine.spill_over, coarse.spill_over / 2) << pocket.name;
    expect_small(pocket.name + " in a plateau, 512 x 512", fine, {6e-5, 2e-4, 8e-5});
  }
}

TEST(Pockets, WithStraightShoresHaveThemWithinAFewRowsOfPixels) {  // slow
  // Along the pixels a shore moves by whole rows: each of the four of a groove by half a one.
  for (const Pocket& pocket :
       {test::v_groove(), test::cylindrical_groove(), test::sinusoidal_pocket()}) {
    for (const Index n : {64, 128, 256, 512}) {
      const double row = 1 / static_cast<double>(n);
      expect_small(fmt::format("{} in a plateau, {} x {}", pocket.name, n, n), errors(pocket, n),
                   {3.5 * row, 5 * row, 2.5 * row});
    }
  }
}

/// Elastic: Westergaard's contact reaches as far from a crest as its valley's liquid leaves dry.
double westergaard_error(Index n) {
  const reference::WestergaardWave wave{
      .amplitude = 1e-6, .wavelength = kPocketMap, .effective_modulus = 1e9};
  const double wavevector = 2 * std::numbers::pi / wave.wavelength;
  const Grid grid{n, 4, kPocketMap, 4 * kPocketMap / static_cast<double>(n)};
  const Field height = Field::NullaryExpr(4, n, [&](Index, Index i) {
    return wave.amplitude * std::cos(wavevector * grid.dx() * (static_cast<double>(i) + 0.5));
  });
  const double mean_pressure = 0.5 * wave.full_contact_pressure();
  const double level = 0.5 * wave.amplitude;
  const double shore = std::acos(level / wave.amplitude) / wavevector;  // from the crest
  const double mean_film = 2 / wave.wavelength *
                           (level * (wave.wavelength / 2 - shore) +
                            wave.amplitude * std::sin(wavevector * shore) / wavevector);
  const auto elasticity = elastic::make_periodic(grid, wave.effective_modulus);
  const contact::State state = contact::solve(
      *elasticity, {.height = height, .control = contact::MeanPressure{mean_pressure}});
  const Field film = film_of(height, grid, mean_film, deposition::Edge::periodic);
  const double expected = 1 - shore / wave.half_width(mean_pressure);
  return std::abs(lubricated_share(contact::contact_mask(state), film) - expected);
}

TEST(Pockets, OfAnElasticWaveAreWetAsFarAsTheLiquidStands) {
  EXPECT_LT(westergaard_error(2048), westergaard_error(128) / 4);
  expect_within("Wet contact", "Westergaard wave at half its load of full contact, n = 2048",
                "wet share of the contact, absolute", "Westergaard 1939 and the volume of a wave",
                westergaard_error(2048), 1.3e-3);
}

}  // namespace
}  // namespace tabor::friction
