#include "tabor/topography/recipes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tabor::topography {

std::vector<Recipe> recipes() {
  return {{"sheet",
           "a flat sheet: spikes become holes, holes are closed from their rims, the plane is "
           "subtracted",
           {"despike=auto", "fill=harmonic", "level=plane"}},
          {"part",
           "a curved part, cut out of a larger one: the same with a form of second order; mirror "
           "images continue it",
           {"despike=auto", "fill=harmonic", "level=poly2", "edges=cut"}},
          {"pad",
           "a pad whose body ends at the edges of the scan: pores are no spikes, so that heights "
           "stay; edges carry load",
           {"fill=nearest", "level=plane", "edges=end"}}};
}

std::optional<Recipe> recipe_of(std::string_view name) {
  const std::vector<Recipe> all = recipes();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Recipe& recipe) { return recipe.name == name; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) names.push_back(recipe.name);
  return names;
}

std::string recipe_steps() {
  std::vector<std::string> lines;
  for (const Recipe& recipe : recipes()) {
    std::string steps = fmt::format("{}", fmt::join(recipe.steps, ", "));
    std::replace(steps.begin(), steps.end(), '=', ' ');
    lines.push_back(fmt::format("{} = {}", recipe.name, steps));
  }
  return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace tabor::topography
