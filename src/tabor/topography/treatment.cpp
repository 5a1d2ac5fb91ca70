#include "tabor/topography/treatment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/holes.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/recipes.hpp"
#include "tabor/topography/row_offsets.hpp"
#include "tabor/topography/spikes.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::topography {
namespace {

using Action = std::function<Topography(Topography, const Observer&)>;

/// A step of the chain: how it is written and how its argument becomes an action.
struct Step {
  StepDescription description;
  Action (*parse)(const std::string& argument);
};

[[noreturn]] void reject(const std::string& step, const std::string& argument,
                         const std::vector<std::string>& known) {
  throw InputError(step, argument.empty() ? "no value" : fmt::format("'{}'", argument),
                   fmt::format("{}", fmt::join(known, "|")),
                   fmt::format("e.g. {}={}{}", step, known.back(), suggestion(argument, known)));
}

/// Treats the scan alone where mirror images continue it, and continues it again.
Topography on_scan(Topography t, const std::function<Topography(Topography)>& treat) {
  std::optional<Topography> scan = scan_of_images(t);
  if (!scan) return treat(std::move(t));
  Topography treated = treat(*std::move(scan));
  t.height = mirror_images(treated.height);
  t.history = std::move(treated.history);
  t.warnings = std::move(treated.warnings);
  return t;
}

Action parse_level(const std::string& argument) {
  if (argument == "rows") {
    return [](Topography t, const Observer&) { return on_scan(std::move(t), &level_rows); };
  }
  const auto form = form_from(argument);
  if (!form) {
    reject("level", argument, {"none", "mean", "poly2", "poly3", "poly4", "rows", "plane"});
  }
  return [form](Topography t, const Observer&) {
    return on_scan(std::move(t), [form](Topography s) { return level(std::move(s), *form); });
  };
}

Action parse_fill(const std::string& argument) {
  const auto fill = fill_from(argument);
  if (!fill) reject("fill", argument, {"nearest", "mean", "harmonic"});
  return [fill](Topography t, const Observer& observer) {
    return fill_holes(std::move(t), *fill, observer);
  };
}

Action parse_low_pass(const std::string& argument) {
  return [filter = parse_filter(argument, "lowpass")](Topography t, const Observer&) {
    return low_pass(std::move(t), filter);
  };
}

Action parse_high_pass(const std::string& argument) {
  return [filter = parse_filter(argument, "highpass")](Topography t, const Observer&) {
    return high_pass(std::move(t), filter);
  };
}

/// A coordinate in pixels ("128") or as a length ("85um").
struct Coordinate {
  double value = 0;
  bool is_length = false;

  Index pixels(double spacing) const {
    return static_cast<Index>(std::llround(is_length ? value / spacing : value));
  }
};

/// Pixel counts beyond this are typing errors, and would overflow sums of them.
constexpr double kLargestCoordinate = 1e9;

Coordinate parse_coordinate(const std::string& step, const std::string& text) {
  if (const auto pixels = parse_number(text)) {
    if (*pixels != std::round(*pixels) || *pixels < 0 || *pixels > kLargestCoordinate) {
      throw InputError(step, fmt::format("'{}'", text),
                       "a whole number of pixels or a length such as 100um", "");
    }
    return {*pixels, false};
  }
  const double length = parse_si(text, dimension::length, "--" + step);
  if (!(length >= 0) || length > kLargestCoordinate) {
    throw InputError(step, fmt::format("'{}'", text), "a length that is not negative", "");
  }
  return {length, true};
}

std::vector<Coordinate> parse_coordinates(const std::string& step, const std::string& argument,
                                          std::size_t count, const std::string& form) {
  std::vector<Coordinate> coordinates;
  const auto parts = split(argument, ',');
  if (parts.size() != count) {
    throw InputError(step, argument.empty() ? "no value" : fmt::format("'{}'", argument), form, "");
  }
  coordinates.reserve(count);
  for (const auto& part : parts) {
    coordinates.push_back(parse_coordinate(step, std::string(trim(part))));
  }
  return coordinates;
}

Action parse_crop(const std::string& argument) {
  const auto c = parse_coordinates(
      "crop", argument, 4, "x0,y0,nx,ny in pixels or lengths (0,0,512,512 or 0um,0um,300um,300um)");
  return [c](Topography t, const Observer&) {
    const double dx = t.grid.dx(), dy = t.grid.dy();
    return crop(std::move(t), {c[0].pixels(dx), c[1].pixels(dy), c[2].pixels(dx), c[3].pixels(dy)});
  };
}

Action parse_trim(const std::string& argument) {
  const auto c =
      parse_coordinates("trim", argument, 1, "a margin in pixels or as a length (125um)");
  return [margin = c[0]](Topography t, const Observer&) {
    const Index mx = margin.pixels(t.grid.dx()), my = margin.pixels(t.grid.dy());
    return trim_margins(std::move(t), mx, my);
  };
}

Action parse_despike(const std::string& argument) {
  return [rule = parse_spike_rule(argument)](Topography t, const Observer&) {
    return remove_spikes(std::move(t), rule);
  };
}

Action parse_resample(const std::string& argument) {
  const auto c = parse_coordinates("resample", argument, 2, "nx,ny in pixels (1024,1024)");
  if (c[0].is_length || c[1].is_length) {
    throw InputError("resample", fmt::format("'{}'", argument), "nx,ny in pixels (1024,1024)", "");
  }
  return [c](Topography t, const Observer&) {
    return resample(std::move(t), c[0].pixels(1), c[1].pixels(1));
  };
}

Action parse_mirror(const std::string& argument) {
  if (!argument.empty()) {
    throw InputError("mirror", fmt::format("'{}'", argument), "no value", "write just mirror");
  }
  return [](Topography t, const Observer&) { return mirror(std::move(t)); };
}

Action parse_edges(const std::string& argument) {
  const auto edges = kEdges.find(argument);
  if (!edges) reject("edges", argument, {"tile", "end", "cut"});
  return [edges](Topography t, const Observer&) { return with_edges(std::move(t), *edges); };
}

Action parse_flip(const std::string& argument) {
  if (argument != "x" && argument != "y") reject("flip", argument, {"y", "x"});
  return [axis = argument == "x" ? Axis::x : Axis::y](Topography t, const Observer&) {
    return flip(std::move(t), axis);
  };
}

Action parse_recipe(const std::string& argument);

const std::array<Step, 12>& steps() {
  static const std::array<Step, 12> table{{
      {{"recipe", fmt::format("{}", fmt::join(recipe_names(), "|")),
        "steps that such a scan usually needs: " + recipe_steps()},
       parse_recipe},
      {{"crop", "x0,y0,nx,ny", "keep a rectangle, in pixels or lengths"}, parse_crop},
      {{"trim", "MARGIN", "cut a margin off all sides, in pixels or as a length"}, parse_trim},
      {{"despike", "auto|8|8,7|8,7,median",
        "turn spikes into holes (or medians): robust deviations from the median, and window [8,5]"},
       parse_despike},
      {{"level", "none|mean|plane|poly2|poly3|poly4|rows",
        "subtract a least-squares polynomial; rows subtracts the offsets between scan lines"},
       parse_level},
      {{"fill", "harmonic|nearest|mean",
        "fill holes; harmonic continues the rim of each hole "
        "smoothly"},
       parse_fill},
      {{"lowpass",
        "hann:512/L|hann-full:512/L|hann-separable:512/L|hann:8um|gauss:8um|gauss-reflect:8um",
        "smooth with a Hann window in frequency (L = scan side) or the ISO Gaussian S-filter"},
       parse_low_pass},
      {{"highpass", "gauss:250um|hann:8/L",
        "subtract the smoothed surface (gauss: ISO Gaussian "
        "L-filter)"},
       parse_high_pass},
      {{"resample", "nx,ny",
        "change the number of pixels: area averages to fewer, cubic spline "
        "to more"},
       parse_resample},
      {{"mirror", "", "make the surface periodic with mirror images, 2 x 2"}, parse_mirror},
      {{"edges", "tile|cut|end",
        "tile repeats the surface, cut mirrors it as a cut-out, end lets the body end [tile, with "
        "a warning if opposite edges differ]"},
       parse_edges},
      {{"flip", "x|y", "reverse the columns (x) or the rows (y)"}, parse_flip},
  }};
  return table;
}

/// "level=plane" -> ("level", "plane").
std::pair<std::string, std::string> split_step(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos) return {std::string(trim(text)), ""};
  return {std::string(trim(text.substr(0, equals))), std::string(trim(text.substr(equals + 1)))};
}

Action parse_step(std::string_view text) {
  const auto [name, argument] = split_step(text);
  std::vector<std::string> names;
  for (const Step& step : steps()) {
    if (step.description.name == name) return step.parse(argument);
    names.push_back(step.description.name);
  }
  throw InputError("treatment", fmt::format("'{}'", text),
                   fmt::format("one of {}{}", fmt::join(names, ", "), suggestion(name, names)), "");
}

Action parse_recipe(const std::string& argument) {
  const std::optional<Recipe> recipe = recipe_of(argument);
  if (!recipe) reject("recipe", argument, recipe_names());
  std::vector<Action> actions;
  for (const std::string& step : recipe->steps) actions.push_back(parse_step(step));
  return [actions](Topography t, const Observer& observer) {
    for (const Action& act : actions) t = act(std::move(t), observer);
    return t;
  };
}

}  // namespace

std::vector<StepDescription> treatment_steps() {
  std::vector<StepDescription> descriptions;
  for (const Step& step : steps()) descriptions.push_back(step.description);
  return descriptions;
}

Treatment expanded(const Treatment& treatment) {
  Treatment steps;
  for (const std::string& step : treatment) {
    const auto [name, argument] = split_step(step);
    const auto recipe = name == "recipe" ? recipe_of(argument) : std::nullopt;
    if (recipe) {
      steps.insert(steps.end(), recipe->steps.begin(), recipe->steps.end());
    } else {
      steps.push_back(step);
    }
  }
  return steps;
}

std::optional<Edges> edges_of(const Treatment& treatment) {
  std::optional<Edges> said;
  for (const std::string& step : expanded(treatment)) {
    const auto [name, argument] = split_step(step);
    if (name != "edges") continue;
    const std::optional<Edges> edges = kEdges.find(argument);
    if (said && edges != said) {
      throw InputError("edges", fmt::format("'{}' after '{}'", argument, kEdges.of(*said)),
                       "one of them", "");
    }
    said = edges;
  }
  if (said && said != Edges::cut && mirrors(treatment)) {
    throw InputError("edges", fmt::format("'{}' with mirror", kEdges.of(*said)),
                     "'cut' with mirror, which says the same",
                     "leave out either; mirror images repeat");
  }
  return said;
}

bool mirrors(const Treatment& treatment) {
  const Treatment steps = expanded(treatment);
  return std::any_of(steps.begin(), steps.end(), [](const std::string& step) {
    const auto [name, argument] = split_step(step);
    return name == "mirror" || (name == "edges" && argument == kEdges.of(Edges::cut));
  });
}

namespace {

/// A part of a cut-out is another one: which is meant would be a guess.
void check_parts(const Treatment& treatment) {
  bool is_cut = false;
  for (const std::string& step : expanded(treatment)) {
    const auto [name, argument] = split_step(step);
    if (is_cut && (name == "crop" || name == "trim")) {
      throw InputError(
          name, "a step after edges=cut", "a place before it",
          fmt::format("<{}> takes a part of the scan before <edges=cut> continues it", name));
    }
    is_cut = is_cut || (name == "edges" && argument == kEdges.of(Edges::cut));
  }
}

}  // namespace

void check(const Treatment& treatment) {
  for (const auto& step : treatment) parse_step(step);
  edges_of(treatment);
  check_parts(treatment);
}

Topography apply(const Treatment& treatment, Topography topography, const Observer& observer) {
  check(treatment);  // a typing error in the last step is found before the first one runs
  Watch watch(observer, "treatment");
  for (std::size_t i = 0; i < treatment.size(); ++i) {
    watch.tell(static_cast<double>(i) / static_cast<double>(treatment.size()));
    topography = parse_step(treatment[i])(std::move(topography), observer);
  }
  if (!treatment.empty()) renew_warnings(topography);
  watch.tell(1);
  return topography;
}

}  // namespace tabor::topography
