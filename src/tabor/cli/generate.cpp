#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/metrology/parameters.hpp"
#include "tabor/synthesis/recipes.hpp"

namespace tabor::cli {

namespace {

struct Request {
  synthesis::Request recipe;
  std::optional<std::string> output;  // the parser sees to it that there is one
  std::string pixels = "512";
  std::string pixel = "0.67um";
  std::string stage = "before";
  bool not_periodic = false;
};

/// "--rms-height" for "rms_height".
std::string flag_of(std::string_view name) {
  std::string flag = "--" + std::string(name);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

Index whole_pixels(const std::string& text) {
  const std::optional<double> n = parse_number(text);
  if (!n || *n < 1 || *n > 1e6 || *n != static_cast<double>(static_cast<Index>(*n))) {
    throw UsageError(
        fmt::format("--pixels: got '{}'; expected numbers of pixels such as 512,256", text));
  }
  return static_cast<Index>(*n);
}

Grid grid_of(const Request& request) {
  const std::vector<std::string> counts = split(request.pixels, ',');
  const std::vector<double> pixel = parse_si_list(request.pixel, dimension::length, "--pixel");
  if (counts.size() > 2 || pixel.size() > 2 || pixel.front() <= 0 || pixel.back() <= 0) {
    throw UsageError("--pixels and --pixel take one positive value or two (x,y)");
  }
  const Index nx = whole_pixels(counts.front());
  const Index ny = whole_pixels(counts.back());
  return {nx, ny, static_cast<double>(nx) * pixel.front(), static_cast<double>(ny) * pixel.back()};
}

topography::Topography make(const Request& request, std::uint64_t seed) {
  synthesis::Request recipe = request.recipe;
  recipe.grid = grid_of(request);
  recipe.stage =
      request.stage == "after" ? synthesis::EdtStage::after : synthesis::EdtStage::before;
  recipe.periodic = !request.not_periodic;
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
  facts.fact("rms slope", plain(slope));
  return finish(context, object, facts.text());
}

std::string placeholder_of(const Dimension& dimension) {
  if (dimension == dimension::length) return "LENGTH";
  if (dimension == dimension::pressure) return "P";
  return dimension == dimension::areal_density ? "D" : "X";
}

void declare(OptionSet& set, const synthesis::RecipeNumber& number, synthesis::Request& recipe) {
  const std::string flag = flag_of(number.name);
  set.add({.flag = flag,
           .placeholder = placeholder_of(number.dimension),
           .help = number.help,
           .assign = [&recipe, flag, number](const std::string& text) {
             recipe.numbers[number.name] = parse_si(text, number.dimension, flag);
           }});
}

void declare_numbers(OptionSet& set, bool of_rough, synthesis::Request& recipe) {
  for (const synthesis::RecipeNumber& number : synthesis::recipe_numbers()) {
    if (number.is_of_a_rough == of_rough) declare(set, number, recipe);
  }
}

void word(OptionSet& set, const std::string& flag, const std::string& placeholder,
          const std::string& help, std::string& target) {
  set.add({.flag = flag,
           .placeholder = placeholder,
           .help = help,
           .assign = [&target](const std::string& text) { target = text; }});
}

void declare_rough(OptionSet& set, Request& request) {
  set.group("self-affine, edt, ground");
  declare_numbers(set, true, request.recipe);
  set.choice("--stage", {"before", "after"}, "edt: before or after sliding [before]",
             request.stage);
  set.toggle("--not-periodic", "edt: a cut-out instead of a tile", request.not_periodic);
  set.toggle("--random-amplitudes", "self-affine: Gaussian amplitudes, not random phases only",
             request.recipe.random_amplitudes);
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Surface");
  set.positional("KIND", "self-affine, edt, ground, sinusoid, sphere or bump", request.recipe.kind);
  set.output("OUT", "the file to write; its extension is the format", scan_extensions(),
             request.output)
      .required = true;
  word(set, "--pixels", "NX[,NY]", "number of pixels [512]", request.pixels);
  word(set, "--pixel", "DX[,DY]", "pixel size [0.67um]", request.pixel);
  declare_rough(set, request);
  set.group("sinusoid, sphere, bump");
  declare_numbers(set, false, request.recipe);
}

}  // namespace

Verb generate_verb() {
  return {.name = "generate",
          .arguments = "KIND -o OUT [options]",
          .summary = "make a surface: self-affine, edt, ground, sinusoid, sphere, bump",
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
