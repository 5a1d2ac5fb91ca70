#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>
#include <optional>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/metrology/parameters.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::cli {

namespace {

using topography::Topography;

/// The numbers given on the command line. A recipe takes those it knows; whatever is left at the
/// end does not belong to the kind asked for and is rejected.
class Given {
 public:
  void set(const std::string& flag, double value) { values_[flag] = value; }

  std::optional<double> take(const std::string& flag) {
    const auto node = values_.extract(flag);
    return node ? std::optional(node.mapped()) : std::nullopt;
  }

  double take_or(const std::string& flag, double fallback) { return take(flag).value_or(fallback); }

  double need(const std::string& kind, const std::string& flag) {
    if (const auto value = take(flag)) return *value;
    throw UsageError(fmt::format("generate {}: {} is missing", kind, flag));
  }

  void reject_rest(const std::string& kind) const {
    if (values_.empty()) return;
    throw UsageError(
        fmt::format("generate {}: {} does not belong to this kind", kind, values_.begin()->first));
  }

 private:
  std::map<std::string, double> values_;
};

struct Request {
  std::string kind;
  std::optional<std::string> output;  // the parser sees to it that there is one
  std::string pixels = "512";
  std::string pixel = "0.67um";
  std::string stage = "before";
  bool not_periodic = false;
  bool random_amplitudes = false;
  Given given;
};

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

Topography make_self_affine(Request& request, std::uint64_t seed) {
  Given& given = request.given;
  synthesis::SelfAffine recipe;
  recipe.grid = grid_of(request);
  recipe.hurst = given.take_or("--hurst", recipe.hurst);
  recipe.rms_height = given.take("--rms-height");
  recipe.rms_slope = given.take("--rms-slope");
  recipe.roll_off_wavelength = given.take_or("--roll-off", 0);
  recipe.long_cutoff_wavelength = given.take_or("--long-cutoff", 0);
  recipe.short_cutoff_wavelength = given.take_or("--short-cutoff", 0);
  recipe.stretch = given.take_or("--stretch", 1);
  recipe.random_amplitudes = request.random_amplitudes;
  recipe.seed = seed;
  if (recipe.rms_height.has_value() == recipe.rms_slope.has_value()) {
    throw UsageError("generate self-affine: give either --rms-height or --rms-slope");
  }
  return synthesis::self_affine(recipe);
}

Topography make_edt(Request& request, std::uint64_t seed) {
  synthesis::Edt recipe{.grid = grid_of(request)};
  recipe.mean_abs_height = request.given.take_or("--mean-height", recipe.mean_abs_height);
  recipe.hurst = request.given.take_or("--hurst", recipe.hurst);
  recipe.stage =
      request.stage == "after" ? synthesis::EdtStage::after : synthesis::EdtStage::before;
  recipe.waviness = request.given.take_or("--waviness", recipe.waviness);
  recipe.plateau_share = request.given.take_or("--plateau-share", recipe.plateau_share);
  recipe.plateau_roughness = request.given.take_or("--plateau-roughness", recipe.plateau_roughness);
  recipe.noise = request.given.take_or("--noise", recipe.noise);
  if (recipe.stage == synthesis::EdtStage::after) {
    recipe.sliding_pressure = request.given.take_or("--pressure", recipe.sliding_pressure);
    recipe.sliding_density = request.given.take_or("--density", recipe.sliding_density);
  }
  recipe.periodic = !request.not_periodic;
  recipe.seed = seed;
  return synthesis::edt(recipe);
}

Topography make_ground(Request& request, std::uint64_t seed) {
  synthesis::Ground recipe{.grid = grid_of(request)};
  recipe.rms_height = request.given.take_or("--rms-height", recipe.rms_height);
  recipe.hurst = request.given.take_or("--hurst", recipe.hurst);
  recipe.groove_spacing = request.given.take_or("--groove-spacing", recipe.groove_spacing);
  recipe.groove_length = request.given.take_or("--groove-length", recipe.groove_length);
  recipe.seed = seed;
  return synthesis::ground(recipe);
}

Topography make_sinusoid(Request& request, std::uint64_t) {
  synthesis::Sinusoid recipe{.grid = grid_of(request)};
  recipe.amplitude = request.given.need("sinusoid", "--amplitude");
  recipe.wavelength_x = request.given.take_or("--wavelength-x", 0);
  recipe.wavelength_y = request.given.take_or("--wavelength-y", 0);
  return synthesis::sinusoid(recipe);
}

Topography make_sphere(Request& request, std::uint64_t) {
  return synthesis::sphere(
      {.grid = grid_of(request), .radius = request.given.need("sphere", "--radius")});
}

Topography make_bump(Request& request, std::uint64_t) {
  return synthesis::bump({.grid = grid_of(request),
                          .height = request.given.need("bump", "--height"),
                          .radius = request.given.need("bump", "--radius")});
}

using Maker = Topography (*)(Request&, std::uint64_t);

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"self-affine", make_self_affine}, {"edt", make_edt},       {"ground", make_ground},
      {"sinusoid", make_sinusoid},       {"sphere", make_sphere}, {"bump", make_bump}};
  return table;
}

Topography make(Request& request, std::uint64_t seed) {
  const auto maker = makers().find(request.kind);
  if (maker == makers().end()) {
    std::vector<std::string> kinds;
    for (const auto& [kind, unused] : makers()) kinds.push_back(kind);
    throw UsageError(fmt::format("generate: got kind '{}'; expected {}{}", request.kind,
                                 fmt::join(kinds, ", "), suggestion(request.kind, kinds)));
  }
  Topography surface = maker->second(request, seed);
  request.given.reject_rest(request.kind);
  return surface;
}

int generate(Request request, Context& context) {
  const Topography surface = make(request, context.seed_or_default());
  const std::string output = request.output.value();
  scan::write(surface, output);
  const double rms = metrology::rms_height(surface);
  const double slope = metrology::rms_slope(surface);
  io::Json object = json_head(context);
  object.update({{"output", output},
                 {"kind", request.kind},
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

void quantity(OptionSet& set, Given& given, const std::string& flag, const std::string& placeholder,
              const Dimension& unit, const std::string& help) {
  set.add({.flag = flag,
           .placeholder = placeholder,
           .help = help,
           .assign = [&given, flag, unit](const std::string& text) {
             given.set(flag, parse_si(text, unit, flag));
           }});
}

void length(OptionSet& set, Given& given, const std::string& flag, const std::string& help) {
  quantity(set, given, flag, "LENGTH", dimension::length, help);
}

void ratio(OptionSet& set, Given& given, const std::string& flag, const std::string& help) {
  quantity(set, given, flag, "X", dimension::none, help);
}

void word(OptionSet& set, const std::string& flag, const std::string& placeholder,
          const std::string& help, std::string& target) {
  set.add({.flag = flag,
           .placeholder = placeholder,
           .help = help,
           .assign = [&target](const std::string& text) { target = text; }});
}

void declare_rough(OptionSet& set, Request& request) {
  Given& given = request.given;
  set.group("self-affine, edt, ground");
  ratio(set, given, "--hurst", "Hurst exponent [0.8, edt 0.75, ground 0.7]");
  length(set, given, "--rms-height", "self-affine, ground: rms height [ground 0.3um]");
  ratio(set, given, "--rms-slope", "self-affine: rms slope, instead of the rms height");
  length(set, given, "--roll-off", "self-affine: the spectrum is flat above this wavelength");
  length(set, given, "--long-cutoff", "self-affine: no waves above this wavelength");
  length(set, given, "--short-cutoff", "self-affine: no waves below this wavelength [2 pixels]");
  ratio(set, given, "--stretch", "self-affine: features this much longer along x [1]");
  set.toggle("--random-amplitudes", "self-affine: Gaussian amplitudes, not random phases only",
             request.random_amplitudes);
  length(set, given, "--mean-height", "edt: mean absolute height Sa before sliding [0.9um]");
  length(set, given, "--waviness", "edt: rms of waves of 250 um and longer [0.6um]");
  ratio(set, given, "--plateau-share", "edt: share of the area that is plateaus [0.5]");
  length(set, given, "--plateau-roughness", "edt: rms of the roughness on the plateaus [50nm]");
  length(set, given, "--noise", "edt: rms of the microscope's noise [40nm]");
  set.choice("--stage", {"before", "after"}, "edt: before or after sliding [before]",
             request.stage);
  quantity(set, given, "--pressure", "P", dimension::pressure,
           "edt after sliding: mean pressure of it [7MPa]");
  quantity(set, given, "--density", "D", dimension::areal_density,
           "edt after sliding: lubricant density of it [0.45g/m^2]");
  set.toggle("--not-periodic", "edt: a cut-out instead of a tile", request.not_periodic);
  length(set, given, "--groove-spacing", "ground: roll-off wavelength across the grooves [20um]");
  length(set, given, "--groove-length", "ground: length of the grooves along x [400um]");
}

void declare_smooth(OptionSet& set, Request& request) {
  set.group("sinusoid, sphere, bump");
  length(set, request.given, "--amplitude", "sinusoid: amplitude");
  length(set, request.given, "--wavelength-x", "sinusoid: wavelength along x [constant along x]");
  length(set, request.given, "--wavelength-y", "sinusoid: wavelength along y [constant along y]");
  length(set, request.given, "--radius", "sphere, bump: radius");
  length(set, request.given, "--height", "bump: height");
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Surface");
  set.positional("KIND", "self-affine, edt, ground, sinusoid, sphere or bump", request.kind);
  set.output("OUT", "the file to write; its extension is the format", scan_extensions(),
             request.output)
      .required = true;
  word(set, "--pixels", "NX[,NY]", "number of pixels [512]", request.pixels);
  word(set, "--pixel", "DX[,DY]", "pixel size [0.67um]", request.pixel);
  declare_rough(set, request);
  declare_smooth(set, request);
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
