#include "tabor/synthesis/recipes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/synthesis/recipe_parameters.hpp"

namespace tabor::synthesis {
namespace {

using topography::Topography;

/// A value of a request, which is one of the setting's own kind.
class Asked : public Given {
 public:
  Asked(std::string setting, const Cell& value) : setting_(std::move(setting)), value_(value) {}

  double number(const Dimension&) const override { return as<double>("a number"); }
  std::vector<double> numbers(const Dimension& expected) const override {
    return {number(expected)};
  }
  std::uint64_t count() const override { return as<std::uint64_t>("a count"); }
  bool flag() const override { return as<bool>("true or false"); }
  std::string word(const std::vector<std::string>& choices) const override {
    return checked_choice(setting_, as<std::string>(one_of(choices)), choices);
  }
  std::string text() const override { return as<std::string>("a text"); }
  std::vector<std::string> texts() const override {
    return as<std::vector<std::string>>("a list of texts");
  }
  bool is_word(const std::string& word) const override {
    const auto* own = std::get_if<std::string>(&value_);
    return own != nullptr && *own == word;
  }

 private:
  template <typename Value>
  Value as(const std::string& expected) const {
    if (const auto* value = std::get_if<Value>(&value_)) return *value;
    throw InputError(setting_, "a value of another type", expected, "");
  }

  std::string setting_;
  const Cell& value_;
};

/// The one of this name, or the end of the list.
template <typename List>
auto find_named(List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
}

[[noreturn]] void reject(const Request& request, const std::string& what) {
  throw UsageError(fmt::format("generate {}: {}", request.kind, what));
}

template <typename Recipe>
void read(const Request& request, const Spelling& spelling, Recipe& recipe) {
  const auto& table = recipe_table<Recipe>().parameters;
  for (const RecipeParameter<Recipe>& one : table) {
    if (one.needed == Needed::yes && !request.settings.contains(one.name)) {
      reject(request, spelling(one.name) + " is missing");
    }
  }
  for (const auto& [name, value] : request.settings) {
    const auto found = find_named(table, name);
    if (found == table.end()) reject(request, spelling(name) + " does not belong to this kind");
    found->read(recipe, Asked(spelling(name), value));
  }
}

/// Throws for settings that mean nothing, or no one thing, together.
template <typename Recipe>
void check_together(const Request& request, const Spelling& spelling, const Recipe& recipe) {
  for (const RecipeParameter<Recipe>& one : recipe_table<Recipe>().parameters) {
    if (!one.applies || one.applies(recipe) || !request.settings.contains(one.name)) continue;
    reject(request, fmt::format("{} belongs to {} {}", spelling(one.name), spelling(one.condition),
                                one.condition_value));
  }
  const std::string found = contradiction(recipe, spelling);
  if (!found.empty()) reject(request, found);
}

template <typename Recipe>
Topography made(const Request& request, const Spelling& spelling,
                Topography (*make)(const Recipe&)) {
  Recipe recipe;
  recipe.grid = request.grid;
  if constexpr (requires { recipe.seed; }) recipe.seed = request.seed;
  read(request, spelling, recipe);
  check_bounds(recipe, spelling);
  check_together(request, spelling, recipe);
  return make(recipe);
}

/// A setting as one kind has it.
template <typename Recipe>
RecipeSetting setting_of(const RecipeParameter<Recipe>& parameter, const std::string& kind) {
  RecipeSetting one;
  static_cast<ParameterHead&>(one) = parameter;
  one.kinds = {kind};
  if (parameter.has_default()) one.defaults = {{kind, parameter.example}};
  one.default_value = parameter.value({});
  one.taken = [&parameter](const Given& given) {
    Recipe scratch;
    parameter.read(scratch, given);
    return parameter.value(scratch);
  };
  if (!parameter.applies) return one;
  one.kinds = {fmt::format("{}, {} {}", kind, parameter.condition, parameter.condition_value)};
  return one;
}

/// What can be asked for by a name.
struct Kind {
  std::string name;
  bool is_rough;
  std::vector<RecipeSetting> settings;
  std::function<Topography(const Request&, const Spelling&)> make;
};

template <typename Recipe>
Kind kind(bool is_rough, Topography (*make)(const Recipe&)) {
  const RecipeTable<Recipe>& table = recipe_table<Recipe>();
  Kind one{table.kind, is_rough, {}, [make](const Request& request, const Spelling& spelling) {
             return made(request, spelling, make);
           }};
  for (const RecipeParameter<Recipe>& parameter : table.parameters) {
    one.settings.push_back(setting_of(parameter, table.kind));
    one.settings.back().is_of_a_rough = is_rough;
  }
  return one;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{kind(true, self_affine), kind(true, edt),
                                     kind(true, ground),      kind(false, sinusoid),
                                     kind(false, sphere),     kind(false, bump)};
  return all;
}

void merge(const RecipeSetting& setting, std::vector<RecipeSetting>& all) {
  const auto known = find_named(all, setting.name);
  if (known == all.end()) {
    all.push_back(setting);
    return;
  }
  known->kinds.insert(known->kinds.end(), setting.kinds.begin(), setting.kinds.end());
  known->defaults.insert(known->defaults.end(), setting.defaults.begin(), setting.defaults.end());
}

/// "sphere, bump: radius"; what all rough surfaces have goes without their names.
std::string help_of(const RecipeSetting& setting) {
  if (setting.kinds.size() == recipe_kinds(setting.is_of_a_rough).size()) return setting.help;
  return fmt::format("{}: {}", fmt::join(setting.kinds, ", "), setting.help);
}

void reject_unknown(const Request& request) {
  std::vector<std::string> names;
  names.reserve(recipe_settings().size());
  for (const RecipeSetting& one : recipe_settings()) names.push_back(one.name);
  for (const auto& [name, value] : request.settings) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw UsageError(fmt::format("generate: got '{}'; expected one of {}{}", name,
                                 fmt::join(names, ", "), suggestion(name, names)));
  }
}

}  // namespace

const std::vector<RecipeSetting>& recipe_settings() {
  static const std::vector<RecipeSetting> all = [] {
    std::vector<RecipeSetting> settings;
    for (const Kind& one : kinds()) {
      for (const RecipeSetting& setting : one.settings) merge(setting, settings);
    }
    for (RecipeSetting& one : settings) one.help = help_of(one);
    return settings;
  }();
  return all;
}

const std::vector<std::string>& recipe_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& one : kinds()) all.push_back(one.name);
    return all;
  }();
  return names;
}

std::vector<std::string> recipe_kinds(bool are_rough) {
  std::vector<std::string> names;
  for (const Kind& one : kinds()) {
    if (one.is_rough == are_rough) names.push_back(one.name);
  }
  return names;
}

Grid grid_of(const PixelSettings& settings, const Spelling& spelling) {
  for (const Parameter<PixelSettings>& one : pixel_parameters()) {
    const std::vector<double> numbers = one.numbers(settings);
    if (!numbers.empty() && numbers.size() <= 2) continue;
    throw UsageError(fmt::format("{}: got {} numbers; expected one, or two for x and y",
                                 spelling(one.name), numbers.size()));
  }
  auto found = objection_to_bounds(pixel_parameters(), settings);
  for (const double count : settings.pixels) {
    if (found || count == std::floor(count)) continue;
    found = Objection{"pixels", fmt::format("{}", count),
                      parameter_of(pixel_parameters(), "pixels").bounds.text};
  }
  if (found) throw InputError(spelling(found->setting), found->got, found->expected, "");
  const double nx = settings.pixels.front(), ny = settings.pixels.back();
  return {static_cast<Index>(nx), static_cast<Index>(ny), nx * settings.pixel.front(),
          ny * settings.pixel.back()};
}

Topography generate(const Request& request, const Spelling& spelling) {
  const auto found = find_named(kinds(), request.kind);
  if (found == kinds().end()) {
    throw UsageError(fmt::format("generate: got kind '{}'; expected {}{}", request.kind,
                                 fmt::join(recipe_kinds(), ", "),
                                 suggestion(request.kind, recipe_kinds())));
  }
  reject_unknown(request);
  return found->make(request, spelling);
}

}  // namespace tabor::synthesis
