#include "tabor/synthesis/recipe_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::synthesis {
namespace {

constexpr double kSqOverSa = 1.25;  // of Gaussian heights; the recipe is scaled to Sa afterwards

std::string kind_of(std::string_view text) { return std::string(text.substr(0, text.find(':'))); }

std::string name_of(std::string_view text) {
  std::string name(text);
  std::replace(name.begin(), name.end(), '-', '_');
  if (name == "Sq") return "rms_height";
  return name == "H" ? "hurst" : name;
}

/// A name as recipes are documented with.
std::string shown_name(std::string name) {
  if (name == "rms_height") return "Sq";
  if (name == "hurst") return "H";
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// A name and its value, "Sa=0.1um".
struct Entry {
  std::string what;  // the recipe and the name, for messages
  std::string name;
  std::string value;
};

Entry entry_of(const std::string& kind, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw InputError("recipe " + kind, "'" + text + "'", "a name and its value, such as Sa=0.1um",
                     "");
  }
  const std::string name = text.substr(0, equals);
  return {fmt::format("recipe {}: {}", kind, name), name_of(name), text.substr(equals + 1)};
}

double positive(const Entry& entry) {
  const double value = parse_si(entry.value, dimension::length, entry.what);
  if (bounds::above_zero.contain(value)) return value;
  throw InputError(entry.what, entry.value, bounds::above_zero.text, "");
}

std::uint64_t whole(const Entry& entry) {
  std::uint64_t value = 0;
  const char* end = entry.value.data() + entry.value.size();
  const auto [stop, error] = std::from_chars(entry.value.data(), end, value);
  if (error == std::errc() && stop == end) return value;
  throw InputError(entry.what, "'" + entry.value + "'", "a whole number, zero or more", "");
}

const RecipeSetting& setting_of(const std::string& kind, const Entry& entry) {
  std::vector<std::string> names{"Sa", "length", "seed"};
  std::vector<std::string> known = names;
  for (const RecipeSetting& one : recipe_settings()) {
    const bool is_of_kind = std::any_of(one.kinds.begin(), one.kinds.end(), [&](const auto& name) {
      return name == kind || name.starts_with(kind + ",");
    });
    if (!is_of_kind) continue;
    if (one.name == entry.name) return one;
    known.push_back(one.name);
    names.push_back(shown_name(one.name));
  }
  throw InputError(
      entry.what, "a name that it does not have",
      fmt::format("one of {}{}", fmt::join(names, ", "), suggestion(entry.name, known)), "");
}

Cell value_of(const RecipeSetting& setting, const Entry& entry) {
  switch (setting.kind) {
    case ValueKind::number:
      return parse_si(entry.value, setting.dimension, entry.what);
    case ValueKind::count:
      return whole(entry);
    case ValueKind::flag:
      return checked_choice(entry.what, entry.value, {"true", "false"}) == "true";
    case ValueKind::word:
      return checked_choice(entry.what, entry.value, setting.words);
    default:
      return entry.value;
  }
}

void take(const Entry& entry, LineRecipe& recipe) {
  if (entry.name == "Sa") {
    recipe.mean_abs_height = positive(entry);
  } else if (entry.name == "length") {
    recipe.length = positive(entry);
  } else if (entry.name == "seed") {
    recipe.request.seed = whole(entry);
  } else {
    recipe.request.settings[entry.name] = value_of(setting_of(recipe.request.kind, entry), entry);
  }
}

bool has_rms_height(const std::string& kind) {
  const auto& all = recipe_settings();
  return std::any_of(all.begin(), all.end(), [&](const RecipeSetting& one) {
    return one.name == "rms_height" &&
           std::find(one.kinds.begin(), one.kinds.end(), kind) != one.kinds.end();
  });
}

/// Puts what stands for Sa where the recipe takes heights, so that it knows its own scale.
void add_height(LineRecipe& recipe) {
  if (!recipe.mean_abs_height) return;
  auto& settings = recipe.request.settings;
  if (!has_rms_height(recipe.request.kind)) {
    settings["mean_height"] = *recipe.mean_abs_height;
    return;
  }
  if (settings.contains("rms_height") || settings.contains("rms_slope")) {
    throw InputError("recipe " + recipe.request.kind, "Sa and another height", "one of them", "");
  }
  settings["rms_height"] = kSqOverSa * *recipe.mean_abs_height;
}

}  // namespace

bool is_recipe(std::string_view text) {
  const std::vector<std::string> kinds = recipe_kinds(true);
  return std::find(kinds.begin(), kinds.end(), kind_of(text)) != kinds.end();
}

LineRecipe parse_recipe(std::string_view text) {
  const std::string kind = kind_of(text);
  if (!is_recipe(text)) {
    throw InputError("recipe", "'" + kind + "'",
                     fmt::format("one of {}", fmt::join(recipe_kinds(true), ", ")), "");
  }
  LineRecipe recipe;
  recipe.request.kind = kind;
  if (kind.size() == text.size()) return recipe;
  std::vector<std::string> seen;
  for (const std::string& part : split(text.substr(kind.size() + 1), ',')) {
    const Entry entry = entry_of(kind, part);
    if (std::find(seen.begin(), seen.end(), entry.name) != seen.end()) {
      throw InputError(entry.what, "two values", "one", "");
    }
    seen.push_back(entry.name);
    take(entry, recipe);
  }
  add_height(recipe);
  return recipe;
}

topography::Topography generate(const LineRecipe& recipe, const Grid& pixels) {
  Request request = recipe.request;
  request.grid = pixels;
  if (recipe.length) {
    request.grid.nx = std::max<Index>(1, std::lround(*recipe.length / pixels.dx()));
    request.grid.lx = static_cast<double>(request.grid.nx) * pixels.dx();
  }
  const auto spelling = [&](std::string_view setting) {
    return fmt::format("recipe {}: {}", recipe.request.kind, shown_name(std::string(setting)));
  };
  topography::Topography surface = [&] {
    try {
      return generate(request, spelling);
    } catch (const UsageError& error) {  // a recipe is a value, not a command
      throw InputError(error.what());
    }
  }();
  if (recipe.mean_abs_height) {
    surface.height -= surface.height.mean();
    surface.height *= *recipe.mean_abs_height / surface.height.abs().mean();
    surface.source += fmt::format(", scaled to Sa = {}", format_si(*recipe.mean_abs_height, "m"));
  }
  return surface;
}

}  // namespace tabor::synthesis
