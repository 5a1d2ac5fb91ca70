#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <string_view>

#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/synthesis/recipes.hpp"

namespace tabor::cli {

namespace {

struct Request {
  synthesis::Request recipe;
  synthesis::PixelSettings pixels;
  std::optional<std::string> output;  // the parser sees to it that there is one
};

/// "--rms-height" for "rms_height".
std::string flag_of(std::string_view name) {
  for (const ParameterHead& one : synthesis::recipe_settings()) {
    if (one.name == name) return one.option();
  }
  return ParameterHead{.name = std::string(name), .help = ""}.option();
}

topography::Topography make(const Request& request, std::uint64_t seed) {
  synthesis::Request recipe = request.recipe;
  recipe.grid = synthesis::grid_of(request.pixels, flag_of);
  recipe.seed = seed;
  return synthesis::generate(recipe, flag_of);
}

int generate(const Request& request, Context& context) {
  const topography::Topography surface = make(request, context.seed_or_default());
  const std::string output = request.output.value();
  scan::write(surface, output);
  const double rms = metrology::rms_height(surface);
  const double slope = metrology::rms_slope(surface);
  io::Json object = json_head(context);
  object.update({{"output", output},
                 {"kind", request.recipe.kind},
                 {"recipe", surface.source},
                 {"seed", context.seed_or_default()},
                 {"nx", surface.grid.nx},
                 {"ny", surface.grid.ny},
                 {"pixel_x_m", surface.grid.dx()},
                 {"pixel_y_m", surface.grid.dy()},
                 {"periodic", surface.periodic},
                 {"height_rms_m", io::number(rms)},
                 {"rms_slope", io::number(slope)}});
  Facts facts;
  facts.fact("written", output);
  facts.fact("recipe", surface.source);
  facts.fact("pixels", fmt::format("{} x {} of {} x {}", surface.grid.nx, surface.grid.ny,
                                   si(surface.grid.dx(), "m"), si(surface.grid.dy(), "m")));
  facts.fact("rms height", si(rms, "m"));
  facts.fact("rms slope", plain(slope) + " (between neighbouring pixels)");
  return finish(context, object, facts.text());
}

/// " [ground 0.3um]": the defaults of a setting of several kinds.
std::string defaults_of(const synthesis::RecipeSetting& setting) {
  std::vector<std::string> texts;
  for (const auto& [kind, value] : setting.defaults) {
    texts.push_back(kind + " " + in_a_shell(value));
  }
  return texts.empty() ? "" : fmt::format(" [{}]", fmt::join(texts, ", "));
}

void declare(OptionSet& set, const synthesis::RecipeSetting& setting, synthesis::Request& recipe) {
  const bool is_of_one = setting.kinds.size() == 1;
  Option option = option_of(setting, is_of_one && !setting.defaults.empty());
  if (!is_of_one) option.help = setting.help + defaults_of(setting);
  option.required = false;  // of the kind that needs it
  option.assign = [&recipe, &setting, flag = option.flag](const std::string& word) {
    recipe.settings[setting.name] = setting.taken(*given(flag, word));
  };
  set.add(std::move(option));
}

void declare_settings(OptionSet& set, bool of_rough, synthesis::Request& recipe) {
  set.group(fmt::format("{}", fmt::join(synthesis::recipe_kinds(of_rough), ", ")));
  for (const synthesis::RecipeSetting& setting : synthesis::recipe_settings()) {
    if (setting.is_of_a_rough == of_rough) declare(set, setting, recipe);
  }
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Surface");
  const std::vector<std::string>& kinds = synthesis::recipe_kinds();
  set.positional("KIND", one_of(kinds), request.recipe.kind).words = kinds;
  set.output("OUT", "the file to write; its extension is the format", scan_extensions(),
             request.output)
      .required = true;
  for (const auto& parameter : synthesis::pixel_parameters()) {
    declare(set, parameter, request.pixels);
  }
  declare_settings(set, true, request.recipe);
  declare_settings(set, false, request.recipe);
}

}  // namespace

Verb generate_verb() {
  return {.name = "generate",
          .arguments = "KIND -o OUT [options]",
          .summary = fmt::format("make a surface: {}", fmt::join(synthesis::recipe_kinds(), ", ")),
          .details = "",
          .examples =
              {"tabor generate edt -o edt.x3p --pixels 256 --seed 7",
               "tabor generate edt -o after.x3p --stage after --pressure 10MPa --density 0.9g/m^2",
               "tabor generate self-affine -o rough.h5 --pixels 256 --rms-slope 0.1 --hurst "
               "0.8 --short-cutoff 4um"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return generate(*request, context); };
          }};
}

}  // namespace tabor::cli
