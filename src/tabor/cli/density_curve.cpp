#include "tabor/cli/density_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::cli {
namespace {

using results::AskedDensity;
using study::GroupCurve;

io::Json in_grams(std::optional<double> density) {
  return density ? io::Json(io::number(in_g_per_m2(*density))) : io::Json();
}

std::string lower_edge(const GroupCurve& one) {
  return one.curve.plateau ? results::density_text(one.curve.plateau->first) : "-";
}

std::string upper_edge(const GroupCurve& one) {
  const std::string text = results::text_of_upper_edge(one.curve);
  return text.empty() ? "-" : text;
}

std::string place_text(const GroupCurve& one, double density) {
  const auto asked =
      std::find_if(one.asked.begin(), one.asked.end(), [&](const AskedDensity& candidate) {
        return cases::are_same_density(candidate.lubricant_density, density);
      });
  if (asked == one.asked.end()) return "-";
  return fmt::format("{} ({})", results::word_of_place(one.curve, asked->lubricated_share),
                     percent(asked->lubricated_share));
}

std::vector<double> pressures_of(const std::vector<GroupCurve>& curves) {
  std::vector<double> all;
  all.reserve(curves.size());
  for (const GroupCurve& one : curves) all.push_back(one.curve.mean_pressure);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The densities that were asked of a group, rising.
std::vector<double> densities_of(const std::vector<const GroupCurve*>& group) {
  std::vector<double> all;
  for (const GroupCurve* one : group) {
    for (const AskedDensity& asked : one->asked) all.push_back(asked.lubricant_density);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), cases::are_same_density), all.end());
  return all;
}

/// One line of a group: its name, what is said, and that of each pressure.
template <typename Text>
void add_line(const std::vector<const GroupCurve*>& group, const std::vector<double>& pressures,
              const std::string& title, const Text& text, Table& table) {
  std::vector<std::string> cells = {group.front()->group, title};
  for (const double pressure : pressures) {
    const auto one = std::find_if(group.begin(), group.end(), [&](const GroupCurve* curve) {
      return curve->curve.mean_pressure == pressure;
    });
    cells.push_back(one == group.end() ? "-" : text(**one));
  }
  table.row(cells);
}

void add_group(const std::vector<const GroupCurve*>& group, const std::vector<double>& pressures,
               Table& table) {
  add_line(group, pressures, "plateau from", lower_edge, table);
  for (const double density : densities_of(group)) {
    add_line(
        group, pressures, results::density_text(density),
        [&](const GroupCurve& one) { return place_text(one, density); }, table);
  }
  add_line(group, pressures, "plateau ends in", upper_edge, table);
}

}  // namespace

io::Json json_of(const cases::DensityCurve& curve, const std::vector<AskedDensity>& asked) {
  io::Json densities = io::Json::array();
  for (const double density : curve.lubricant_densities) densities.push_back(in_grams(density));
  const auto& plateau = curve.plateau;
  const results::BesidePlateau beside = results::beside_plateau(curve);
  io::Json places = io::Json::array();
  for (const AskedDensity& one : asked) {
    const auto place = results::place_of(curve, one.lubricated_share);
    places.push_back({{"lubricant_density_g_per_m2", in_grams(one.lubricant_density)},
                      {"lubricated_share", io::number(one.lubricated_share)},
                      {"limit_lubricated_share",
                       io::number(results::lubricated_share_at(curve, one.lubricant_density))},
                      {"place", place ? io::Json(results::kPlaces.of(*place)) : io::Json()}});
  }
  return {{"mean_pressure_Pa", curve.mean_pressure},
          {"lubricant_density_g_per_m2", densities},
          {"lubricated_share", curve.lubricated_shares},
          {"friction_lubricated", curve.friction_lubricated},
          {"below_plateau_g_per_m2", in_grams(beside.below)},
          {"plateau_from_g_per_m2", plateau ? in_grams(plateau->first) : io::Json()},
          {"plateau_to_g_per_m2", plateau ? in_grams(plateau->last) : io::Json()},
          {"beyond_plateau_g_per_m2", in_grams(beside.beyond)},
          {"asked", places}};
}

void describe(const cases::DensityCurve& curve, const std::vector<AskedDensity>& asked,
              Facts& facts) {
  facts.fact("density at " + si(curve.mean_pressure, "Pa"), sentence_of(curve, asked));
}

std::string places_text(const std::vector<GroupCurve>& curves) {
  if (curves.empty()) return "";
  const std::vector<double> pressures = pressures_of(curves);
  std::vector<std::string> headings = {"group", "density"};
  headings.reserve(headings.size() + pressures.size());
  for (const double pressure : pressures) headings.push_back(si(pressure, "Pa"));
  Table table(headings);
  std::vector<std::string> done;
  for (const GroupCurve& first : curves) {
    if (std::find(done.begin(), done.end(), first.group) != done.end()) continue;
    done.push_back(first.group);
    std::vector<const GroupCurve*> group;
    for (const GroupCurve& one : curves) {
      if (one.group == first.group) group.push_back(&one);
    }
    add_group(group, pressures, table);
  }
  return table.text() +
         "On the plateau the pockets under the contacts are full, or hardly any contact is wet "
         "(dry); where it ends the oil level reaches the contacts. In brackets: wet share of the "
         "contact.\n";
}

}  // namespace tabor::cli
