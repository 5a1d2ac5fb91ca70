#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "tabor/cli/ehl_case.hpp"
#include "tabor/cli/ehl_point_case.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/ehl/point/roughness.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/holes.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cli {

namespace {

using topography::Topography;

constexpr double kCoarse = 2;         // pixels between nodes
constexpr double kMostPixels = 4096;  // of a generated surface, along either side

/// A finish that is generated: Gaussian heights, a self-affine spectrum that is flat beyond the
/// roll-off. The heights are those that Redlich, Bartel & Deters (2003) print for their surfaces;
/// with the roll-off the dry contact of their ball touches and flows on about the shares they
/// print, 45 and 37 % lapped, 80 and 6 % polished (docs/ehl_point.md).
struct Finish {
  const char* name;
  double rms_height;  // [m]
  double roll_off;    // [m]
};
constexpr Finish kFinishes[] = {{"lapped-like", 0.15e-6, 8e-6}, {"polished-like", 0.08e-6, 60e-6}};
constexpr double kHurst = 0.8;
constexpr double kPixel = 784.3e-9;  // [m], of their measured surfaces
constexpr const char* kGround = "ground";
constexpr double kGroundRms = 0.15e-6;     // [m]
constexpr double kGrooveSpacing = 10e-6;   // [m]
constexpr double kGrooveSlenderness = 20;  // length over spacing

/// A length of each axis, "10 um" or ["10 um", "5 um"].
struct Place {
  double x = 0, y = 0;  // [m]
};

Place read_place(const io::Config& config, const char* key) {
  if (!config.has(key)) return {};
  const std::vector<double> values = config.quantities(key, dimension::length);
  if (values.size() != 2) {
    throw InputError(config.place(key), fmt::format("{} lengths", values.size()),
                     "two: along and across the flow", "[\"10 um\", \"0 um\"]");
  }
  return {values[0], values[1]};
}

void reject_without(const io::Config& config, const char* owner,
                    const std::vector<const char*>& keys) {
  if (config.has(owner)) return;
  for (const char* key : keys) {
    if (!config.has(key)) continue;
    throw InputError(config.place(key), std::string("without ") + owner, "both or none", "");
  }
}

/// Pixels that cover the whole domain of the film with what point_map() fades out around it, while
/// they move by `travel` [m].
Grid generated_grid(const io::Config& config, const ehl::PointProblem& problem, bool is_turned,
                    double travel) {
  const double pixel = positive_quantity_or(config, "roughness.pixel", dimension::length, kPixel);
  const reference::HertzEllipse hertz = hertz_of(problem);
  const auto pixels = [&](double half_length) {
    const double n = std::ceil(2 * ehl::kMapReach * half_length / pixel) + 2;
    if (!(n <= kMostPixels)) {
      throw InputError(config.place("roughness.kind"), fmt::format("{:.0f} pixels", n),
                       fmt::format("{:.0f} or less along a side", kMostPixels),
                       "give a larger roughness.pixel");
    }
    return static_cast<Index>(n);
  };
  Index nx =
      pixels(std::max(problem.inlet, problem.outlet) * hertz.half_axis_x + std::abs(travel) / 2);
  Index ny = pixels(problem.half_width * hertz.half_axis_y);
  if (is_turned) std::swap(nx, ny);
  return {nx, ny, static_cast<double>(nx) * pixel, static_cast<double>(ny) * pixel};
}

Topography generate(const io::Config& config, const ehl::PointProblem& problem, bool is_turned,
                    double travel, std::uint64_t seed) {
  const std::string kind = config.text("roughness.kind");
  const Grid grid = generated_grid(config, problem, is_turned, travel);
  const auto rms = [&](double usual) {
    return positive_quantity_or(config, "roughness.rms", dimension::length, usual);
  };
  if (kind == kGround) {
    const double spacing =
        positive_quantity_or(config, "roughness.groove_spacing", dimension::length, kGrooveSpacing);
    return synthesis::ground({.grid = grid,
                              .rms_height = rms(kGroundRms),
                              .groove_spacing = spacing,
                              .groove_length = kGrooveSlenderness * spacing,
                              .seed = seed});
  }
  std::vector<std::string> names = {kGround};
  for (const Finish& finish : kFinishes) {
    names.emplace_back(finish.name);
    if (kind != finish.name) continue;
    synthesis::SelfAffine recipe;
    recipe.grid = grid;
    recipe.hurst = kHurst;
    recipe.rms_height = rms(finish.rms_height);
    recipe.roll_off_wavelength = finish.roll_off;
    recipe.random_amplitudes = true;
    recipe.seed = seed;
    return synthesis::self_affine(recipe);
  }
  throw InputError(config.place("roughness.kind"), "'" + kind + "'",
                   fmt::format("{}{}", fmt::join(names, ", "), suggestion(kind, names)), "");
}

/// Turned by a quarter: what ran along the flow runs across it.
Field turned(const Field& height) { return height.transpose().rowwise().reverse(); }

/// Heights of a scan or a generated surface, x along the flow unless it is turned; its middle is
/// `behind` [m] the place that the case gives.
PointRoughness map_heights(const io::Config& config, const char* key,
                           const ehl::PointProblem& problem, const Topography& surface,
                           bool is_turned, double behind) {
  const Place place = read_place(config, "roughness.place");
  const Grid& grid = surface.grid;
  const ehl::PointMap map = {.height = is_turned ? turned(surface.height) : surface.height,
                             .spacing_x = is_turned ? grid.dy() : grid.dx(),
                             .spacing_y = is_turned ? grid.dx() : grid.dy(),
                             .centre_x = place.x - behind,
                             .centre_y = place.y};
  return [config, key, problem, map](double moved) {
    ehl::PointMap now = map;
    now.centre_x += moved;
    return at_key(config, key, [&] { return ehl::point_map(problem, now); });
  };
}

PointRoughness bump_heights(const io::Config& config, const ehl::PointProblem& problem) {
  const Place place = read_place(config, "roughness.bump.place");
  const double height = config.quantity("roughness.bump.height", dimension::length);
  const double wavelength =
      positive_quantity(config, "roughness.bump.wavelength", dimension::length);
  return [=](double moved) {
    return ehl::point_bump(problem, height, wavelength, place.x + moved, place.y);
  };
}

/// Contact and pressure depend on short waves, which a coarse grid averages away.
void warn_of_coarse_nodes(const ehl::PointProblem& problem, const Grid& surface, Context& context) {
  const Grid nodes = point_grid(problem);
  const double spacing = std::max(nodes.dx(), nodes.dy());
  const double pixel = std::min(surface.dx(), surface.dy());
  if (spacing <= kCoarse * pixel) return;
  context.warn(
      fmt::format("nodes are {} apart, pixels {}: roughness shorter than {} is averaged "
                  "away; give more nodes",
                  si(spacing, "m"), si(pixel, "m"), si(2 * spacing, "m")));
}

bool read_is_turned(const io::Config& config) {
  const std::string word = text_or(config, "roughness.orientation", "longitudinal");
  const std::vector<std::string> words = {"longitudinal", "transverse"};
  if (word == words[0] || word == words[1]) return word == words[1];
  throw InputError(config.place("roughness.orientation"), "'" + word + "'",
                   "longitudinal or transverse" + suggestion(word, words), "");
}

Topography read_scan(const io::Config& config, Context& context) {
  const std::filesystem::path file = named_file(config, "roughness.file");
  scan::ReadOptions options;
  if (config.has("roughness.channel")) options.channel = config.text("roughness.channel");
  topography::Treatment treatment = {"level=plane"};
  if (config.has("roughness.treatment")) treatment = config.texts("roughness.treatment");
  Topography scan =
      topography::apply(treatment, read_input(file, options, context), context.observer());
  pass_on_warnings(scan, file.string(), context);
  topography::require_no_holes(scan, config.place("roughness.file"),
                               "treatment = [\"fill=harmonic\", \"level=plane\"]");
  return scan;
}

std::string usual_rms() {
  std::string text;
  for (const Finish& finish : kFinishes) {
    text += fmt::format("{} ({}), ", si(finish.rms_height, "m"), finish.name);
  }
  return text + fmt::format("{} ({})", si(kGroundRms, "m"), kGround);
}

}  // namespace

EhlKeys point_roughness_keys() {
  return {
      {"roughness.file", "", "no scan", "a scan, larger than 1.25 times the contact, no holes"},
      {"roughness.channel", "", "as 'tabor info' picks it", "its height channel"},
      {"roughness.treatment", "", "[\"level=plane\"]", "its treatment, a list as in a study"},
      {"roughness.kind", "", "none", "a generated surface: lapped-like, polished-like or ground"},
      {"roughness.rms", "m", usual_rms(), "of the generated surface"},
      {"roughness.seed", "", "that of --seed", "of its random numbers"},
      {"roughness.pixel", "m", si(kPixel, "m"), "of the generated surface"},
      {"roughness.groove_spacing", "m", si(kGrooveSpacing, "m"),
       "of ground; grooves are 20 times as long"},
      {"roughness.orientation", "", "longitudinal",
       "longitudinal: x of the scan and grooves along the flow; transverse: turned by a quarter"},
      {"roughness.place", "m", "[\"0 m\", \"0 m\"]",
       "where the middle of the surface lies, along and across the flow"},
      {"roughness.bump.height", "m", "no bump", "of one bump in the middle of rings"},
      {"roughness.bump.wavelength", "m", "required beside height", "of its rings"},
      {"roughness.bump.place", "m", "[\"0 m\", \"0 m\"]", "of its middle"}};
}

PointRoughness read_point_roughness(const io::Config& config, const ehl::PointProblem& problem,
                                    double travel, Context& context) {
  reject_without(config, "roughness.file", {"roughness.channel", "roughness.treatment"});
  reject_without(
      config, "roughness.kind",
      {"roughness.rms", "roughness.pixel", "roughness.seed", "roughness.groove_spacing"});
  std::vector<PointRoughness> parts;
  const bool is_turned = read_is_turned(config);
  const auto add_map = [&](const char* key, const Topography& surface, double behind) {
    parts.push_back(map_heights(config, key, problem, surface, is_turned, behind));
    warn_of_coarse_nodes(problem, surface.grid, context);
  };
  if (config.has("roughness.file")) add_map("roughness.file", read_scan(config, context), 0);
  if (config.has("roughness.kind")) {
    const auto seed = static_cast<std::uint64_t>(
        integer_or(config, "roughness.seed", static_cast<std::int64_t>(context.seed_or_default())));
    add_map("roughness.kind", generate(config, problem, is_turned, travel, seed), travel / 2);
  }
  if (config.has("roughness.bump.height") || config.has("roughness.bump.wavelength")) {
    parts.push_back(bump_heights(config, problem));
  }
  if (parts.empty()) {
    reject_without(config, "roughness.file", {"roughness.orientation", "roughness.place"});
    return {};
  }
  return [parts](double moved) {
    Field sum = parts.front()(moved);
    for (std::size_t k = 1; k < parts.size(); ++k) sum += parts[k](moved);
    return sum;
  };
}

ehl::PointProblem read_rough_point(const io::Config& config, Context& context) {
  ehl::PointProblem problem = read_point(config);
  if (const PointRoughness roughness = read_point_roughness(config, problem, 0, context)) {
    problem.roughness = roughness(0);
  }
  return problem;
}

}  // namespace tabor::cli
