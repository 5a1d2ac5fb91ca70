#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/record/parameter.hpp"
#include "tabor/synthesis/recipes.hpp"

// The settings of generated surfaces, each said in one line. Options of `tabor generate`, arguments
// of Python, bounds and the description of a surface are made from these tables.
namespace tabor::synthesis {

/// "40 nm" or a word; "" for a setting that has no value.
std::string value_text(const ParameterHead& parameter, const Cell& value);
/// "noise 40 nm": a setting that has a value, by its name; "" for one that has none.
std::string plain_phrase(const ParameterHead& parameter, const Cell& value);

/// One setting of a recipe.
template <typename Recipe>
struct RecipeParameter : Parameter<Recipe> {
  /// What the description of a surface says of it, "" for nothing. One that begins with a blank
  /// belongs to the phrase before.
  std::function<std::string(const Recipe&)> phrase;
  std::function<bool(const Recipe&)> applies;  ///< empty: always
  std::string condition;                       ///< the setting that says whether: "stage"
  std::string condition_value;                 ///< and what it must be: "after"

  template <typename... More>
  RecipeParameter(ParameterHead head, More... more) : Parameter<Recipe>(std::move(head), more...) {
    const Parameter<Recipe>& own = *this;
    phrase = [own](const Recipe& recipe) { return plain_phrase(own, own.value(recipe)); };
  }

  /// The same with `before` in place of its name, and `behind` its value.
  RecipeParameter said(const std::string& before, const std::string& behind = "") const {
    RecipeParameter changed = *this;
    const Parameter<Recipe>& own = *this;
    changed.phrase = [own, before, behind](const Recipe& recipe) {
      const std::string text = value_text(own, own.value(recipe));
      return text.empty() ? text : before + text + behind;
    };
    return changed;
  }
  RecipeParameter said_by(std::function<std::string(const Recipe&)> text) const {
    RecipeParameter changed = *this;
    changed.phrase = std::move(text);
    return changed;
  }
  /// Returns the same parameter, which means something under this condition only.
  RecipeParameter only_with(const std::string& setting, const std::string& must_be,
                            std::function<bool(const Recipe&)> holds) const {
    RecipeParameter changed = *this;
    changed.condition = setting;
    changed.condition_value = must_be;
    changed.applies = holds;
    changed.phrase = [text = phrase, holds](const Recipe& recipe) {
      return holds(recipe) ? text(recipe) : "";
    };
    return changed;
  }
};

/// The settings of a kind of surface, in their order. The grid and the seed are not among them.
template <typename Recipe>
struct RecipeTable {
  std::string kind;  ///< "edt"
  std::vector<RecipeParameter<Recipe>> parameters;
};

template <typename Recipe>
const RecipeTable<Recipe>& recipe_table();
template <>
const RecipeTable<SelfAffine>& recipe_table();
template <>
const RecipeTable<Edt>& recipe_table();
template <>
const RecipeTable<Ground>& recipe_table();
template <>
const RecipeTable<Sinusoid>& recipe_table();
template <>
const RecipeTable<Sphere>& recipe_table();
template <>
const RecipeTable<Bump>& recipe_table();

/// The name itself.
std::string as_named(std::string_view setting);

/// Settings that do not go together, each rule in one sentence; "" where they do.
std::string contradiction(const SelfAffine& recipe, const Spelling& spelling);
std::string contradiction(const Sinusoid& recipe, const Spelling& spelling);
template <typename Recipe>
std::string contradiction(const Recipe&, const Spelling&) {
  return "";
}

/// Throws InputError for the first number out of its bounds.
template <typename Recipe>
void check_bounds(const Recipe& recipe, const Spelling& spelling) {
  const auto found = objection_to_bounds(recipe_table<Recipe>().parameters, recipe);
  if (found) throw InputError(spelling(found->setting), found->got, found->expected, "");
}

/// The same, and for settings that contradict each other.
template <typename Recipe>
void check_settings(const Recipe& recipe) {
  check_bounds(recipe, as_named);
  const std::string found = contradiction(recipe, as_named);
  if (!found.empty()) throw InputError("generate " + recipe_table<Recipe>().kind + ": " + found);
}

/// "generate ground: Sq = 300 nm, H = 0.7, groove spacing 20 µm, length 400 µm, seed 1"
template <typename Recipe>
std::string describe(const Recipe& recipe) {
  const RecipeTable<Recipe>& table = recipe_table<Recipe>();
  std::string text;
  const auto add = [&](const std::string& phrase) {
    if (!text.empty() && !phrase.empty() && phrase.front() != ' ') text += ", ";
    text += phrase;
  };
  for (const RecipeParameter<Recipe>& one : table.parameters) add(one.phrase(recipe));
  if constexpr (requires { recipe.seed; }) add("seed " + std::to_string(recipe.seed));
  return "generate " + table.kind + ": " + text;
}

}  // namespace tabor::synthesis
