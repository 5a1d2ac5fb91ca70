// What the sentence on friction against density says of the densities that were asked for, against
// the numbers in the table beside it: random surfaces, materials, pressures and densities.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tabor/core/units.hpp"
#include "tabor/results/density_answer.hpp"
#include "tabor/study/scan_friction.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::study {
namespace {

using cases::DensityCurve;
using results::AskedDensity;

class RandomCase {
 public:
  explicit RandomCase(unsigned seed) : random_(seed) {
    settings.contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33};
    if (seed % 2 == 0) settings.contact.saturation_pressure = 240e6;
    settings.mean_pressures = {power_of_ten(5.5, 7), power_of_ten(7, 8)};
    settings.friction.shear_strength = 70e6;
    settings.film.model = seed % 3 == 0 ? deposition::Model::droplets : deposition::Model::limit;
    settings.film.edge = static_cast<deposition::Edge>(seed % 3);
    settings.film.droplet_height = 2e-8;
    for (int i = 0; i < 7; ++i) settings.film.lubricant_densities.push_back(power_of_ten(-6, -2.5));
    settings.film.lubricant_densities.push_back(1e-4);
    const double side = 64e-6;
    if (seed % 4 == 0) {
      synthesis::Edt recipe;
      recipe.grid = {64, 64, side, side};
      recipe.seed = seed;
      surface = synthesis::edt(recipe);
    } else {
      synthesis::SelfAffine recipe;
      recipe.grid = {64, 64, side, side};
      recipe.rms_height = power_of_ten(-7.5, -6);
      recipe.seed = seed;
      surface = synthesis::self_affine(recipe);
    }
  }

  cases::CaseSettings settings;
  topography::Topography surface;

 private:
  double power_of_ten(double from, double to) {
    return std::pow(10, std::uniform_real_distribution<double>(from, to)(random_));
  }

  std::mt19937 random_;
};

/// What stands in the sentence behind a density, up to the next "; ": which word says where it is.
std::string clause_of(const std::string& sentence, const AskedDensity& asked) {
  const std::string text =
      fmt::format("{} g/m^2 ({} wet)", plain(in_g_per_m2(asked.lubricant_density)),
                  percent(asked.lubricated_share));
  const std::size_t at = sentence.find(text);
  if (at == std::string::npos) return "not named as " + text;
  return sentence.substr(at, sentence.find("; ", at) - at);
}

/// By the least and greatest wet share of the points of the curve between the ends of the plateau.
std::string expected_word(const DensityCurve& curve, double wet) {
  double least = 1, most = 0;
  for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
    const double density = curve.lubricant_densities[i];
    if (density < curve.plateau->first || density > curve.plateau->last) continue;
    least = std::min(least, curve.lubricated_shares[i]);
    most = std::max(most, curve.lubricated_shares[i]);
  }
  if (wet < least) return "below";
  return wet > most ? "beyond" : "between";
}

bool says(const std::string& clause, const std::string& word) {
  return clause.find(' ' + word + ',') != std::string::npos ||
         (word == "between" && clause.find(" there,") != std::string::npos) ||
         (word == "below" && clause.find(" less,") != std::string::npos);
}

TEST(DensityWords, AgreeWithTheWetSharesInTheTable) {
  int n_words = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomCase one(seed);
    std::vector<cases::FrictionRecord> records;
    const auto keep = [&](const FrictionState& state) { records.push_back(state.friction); };
    const auto curves =
        friction_of(one.surface, one.settings, keep, ContactMaps::dropped).density_curves;
    ASSERT_EQ(curves.size(), 2U);
    const bool is_limit = one.settings.film.model == deposition::Model::limit;
    for (const DensityCurve& curve : curves) {
      const auto asked = results::asked_at(curve.mean_pressure, records);
      EXPECT_EQ(asked.size(), 8U);
      const std::string sentence = results::sentence_of(curve, asked);
      for (const AskedDensity& density : asked) {
        if (is_limit) {  // the curve runs through the points of the table
          EXPECT_EQ(results::lubricated_share_at(curve, density.lubricant_density),
                    density.lubricated_share)
              << seed;
        }
        if (!curve.plateau) continue;
        const std::string clause = clause_of(sentence, density);
        if (is_limit) {
          EXPECT_TRUE(says(clause, expected_word(curve, density.lubricated_share)))
              << seed << ": " << clause << "\n"
              << sentence;
        } else {  // droplets may lie between the points and the tolerance
          const double dry = 1 - density.lubricated_share, plateau = curve.plateau->value;
          const bool is_on = std::abs(dry - plateau) <= 0.01 * plateau;
          EXPECT_TRUE(says(clause, is_on           ? "between"
                                   : dry > plateau ? "below"
                                                   : "beyond"))
              << seed << ": " << clause << "\n"
              << sentence;
        }
        ++n_words;
      }
    }
  }
  EXPECT_GT(n_words, 200);
}

TEST(DensityWords, OfDensitiesOnTheCurveFollowItsEdges) {
  for (unsigned seed = 41; seed <= 60; ++seed) {
    RandomCase one(seed);
    one.settings.film.model = deposition::Model::limit;
    const auto curves =
        friction_of(
            one.surface, one.settings, [](const FrictionState&) {}, ContactMaps::dropped)
            .density_curves;
    for (const DensityCurve& curve : curves) {
      if (!curve.plateau) continue;
      const results::BesidePlateau beside = results::beside_plateau(curve);
      EXPECT_LE(beside.beyond.value_or(0), 1.0501 * curve.plateau->last) << seed;
      EXPECT_GE(beside.below.value_or(1), curve.plateau->first / 1.0501) << seed;
      for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
        const double density = curve.lubricant_densities[i];
        const auto place = results::place_of(curve, curve.lubricated_shares[i]);
        const auto by_density = density < curve.plateau->first  ? results::Place::below
                                : density > curve.plateau->last ? results::Place::beyond
                                                                : results::Place::plateau;
        EXPECT_EQ(place, by_density) << seed << ' ' << density;
      }
    }
  }
}

}  // namespace
}  // namespace tabor::study
