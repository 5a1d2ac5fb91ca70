#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/cases/ehl/point_case.hpp"
#include "tabor/cases/ehl/point_parameters.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/point/roughness.hpp"

namespace tabor::ehl {

namespace {

constexpr double kCoarse = 2;         // pixels between nodes
constexpr double kMostPixels = 4096;  // of a generated surface, along either side

constexpr double kGroundHurst = 0.7;
constexpr double kGrooveSlenderness = 20;  // length over spacing

/// A length of each axis, "10 um" or ["10 um", "5 um"].
struct Place {
  double x = 0, y = 0;  // [m]
};

Place place_of(const std::vector<double>& lengths, const io::Config& file, const char* key) {
  if (lengths.empty()) return {};
  if (lengths.size() != 2) {
    throw InputError(file.place(key), fmt::format("{} lengths", lengths.size()),
                     "two: along and across the flow", "[\"10 um\", \"0 um\"]");
  }
  return {lengths[0], lengths[1]};
}

bool is_turned(const PointRoughnessSettings& settings) {
  return settings.orientation == Orientation::transverse;
}

/// Pixels that cover the whole domain of the film with what point_map() fades out around it, while
/// they move by `travel` [m].
Grid generated_grid(const PointRoughnessSettings& settings, const io::Config& config,
                    const PointProblem& problem, double travel) {
  const double pixel = settings.pixel.value_or(kUsualPixel);
  const reference::HertzEllipse hertz = hertz_of(problem);
  const auto pixels = [&](double half_length) {
    const double n = std::ceil(2 * kMapReach * half_length / pixel) + 2;
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
  if (is_turned(settings)) std::swap(nx, ny);
  return {nx, ny, static_cast<double>(nx) * pixel, static_cast<double>(ny) * pixel};
}

GeneratedSurface finish_on(const PointRoughnessSettings& settings, const Grid& grid) {
  for (const Finish& finish : finishes()) {
    if (settings.kind != finish.name) continue;
    return {.grid = grid,
            .rms_height = settings.rms.value_or(finish.rms_height),
            .hurst = finish.hurst,
            .roll_off_wavelength = finish.roll_off_wavelength};
  }
  const double spacing = settings.groove_spacing.value_or(kGrooveSpacing);
  return {.grid = grid,
          .rms_height = settings.rms.value_or(kGroundRms),
          .hurst = kGroundHurst,
          .roll_off_wavelength = spacing,
          .groove_length = kGrooveSlenderness * spacing};
}

Surface generate(const PointRoughnessSettings& settings, const io::Config& config,
                 const PointProblem& problem, double travel, const CaseSetting& setting) {
  const SurfaceSource& source = with_source(config, "roughness.kind", setting);
  GeneratedSurface finish = finish_on(settings, generated_grid(settings, config, problem, travel));
  finish.seed = settings.seed.value_or(setting.seed);
  return source.generate(finish);
}

using Heights = std::function<Field(double moved)>;

/// Turned by a quarter: what ran along the flow runs across it.
Field turned(const Field& height) { return height.transpose().rowwise().reverse(); }

/// Heights of a scan or a generated surface, x along the flow unless it is turned; its middle is
/// `behind` [m] the place that the case gives.
Heights map_heights(const PointRoughnessSettings& settings, const io::Config& config,
                    const char* key, const PointProblem& problem, const Surface& surface,
                    double behind) {
  const Place place = place_of(settings.place, config, "roughness.place");
  const Grid& grid = surface.grid;
  const bool is_across = is_turned(settings);
  const PointMap map = {.height = is_across ? turned(surface.height) : surface.height,
                        .spacing_x = is_across ? grid.dy() : grid.dx(),
                        .spacing_y = is_across ? grid.dx() : grid.dy(),
                        .centre_x = place.x - behind,
                        .centre_y = place.y};
  return [config, key, problem, map](double moved) {
    PointMap now = map;
    now.centre_x += moved;
    return at_key(config, key, [&] { return point_map(problem, now); });
  };
}

Heights bump_heights(const PointRoughnessSettings& settings, const io::Config& config,
                     const PointProblem& problem) {
  const Place place = place_of(settings.bump_place, config, "roughness.bump.place");
  const double height = required(settings.bump_height, config, "roughness.bump.height");
  const double wavelength = required(settings.bump_wavelength, config, "roughness.bump.wavelength");
  return [=](double moved) {
    return point_bump(problem, height, wavelength, place.x + moved, place.y);
  };
}

/// Contact and pressure depend on short waves, which a coarse grid averages away: a warning, if so.
Warnings coarse_nodes(const PointProblem& problem, const Grid& surface) {
  const Grid nodes = point_grid(problem);
  const double spacing = std::max(nodes.dx(), nodes.dy());
  const double pixel = std::min(surface.dx(), surface.dy());
  if (spacing <= kCoarse * pixel) return {};
  return {{"coarse-roughness",
           fmt::format("Nodes are {} apart and pixels {}, so roughness shorter than {} is "
                       "averaged out. Give more nodes",
                       si(spacing, "m"), si(pixel, "m"), si(2 * spacing, "m")),
           spacing / pixel}};
}

Surface read_scan(const PointRoughnessSettings& settings, const io::Config& config,
                  const CaseSetting& setting) {
  const NamedScan scan{
      .file = named_file(config, "roughness.file"),
      .channel = settings.channel,
      .treatment = settings.treatment.value_or(std::vector<std::string>{kUsualTreatment}),
      .rejects_holes_at = config.place("roughness.file")};
  return with_source(config, "roughness.file", setting).read(scan, setting.observer);
}

}  // namespace

const std::vector<Finish>& finishes() {
  static const std::vector<Finish> all = {{"lapped-like", 0.15e-6, 8e-6},
                                          {"polished-like", 0.08e-6, 60e-6}};
  return all;
}

namespace {

/// The sum of several.
Heights sum_of(const std::vector<Heights>& parts) {
  return [parts](double moved) {
    Field sum = parts.front()(moved);
    for (std::size_t k = 1; k < parts.size(); ++k) sum += parts[k](moved);
    return sum;
  };
}

}  // namespace

PointRoughness read_point_roughness(const io::Config& config, const PointProblem& problem,
                                    double travel, const CaseSetting& setting) {
  const PointRoughnessSettings settings = read_point_settings(config).roughness;
  PointRoughness roughness;
  std::vector<Heights> parts;
  const auto add_map = [&](const char* key, const Surface& surface, double behind) {
    add(surface.warnings, roughness.notes.warnings);
    parts.push_back(map_heights(settings, config, key, problem, surface, behind));
    add(coarse_nodes(problem, surface.grid), roughness.notes.warnings);
  };
  if (settings.file) {
    const Surface scan = read_scan(settings, config, setting);
    roughness.notes.scan_sha256 = scan.sha256;
    add_map("roughness.file", scan, 0);
  }
  if (settings.kind) {
    add_map("roughness.kind", generate(settings, config, problem, travel, setting), travel / 2);
  }
  if (settings.bump_height || settings.bump_wavelength) {
    parts.push_back(bump_heights(settings, config, problem));
  }
  if (parts.empty()) {
    for (const char* key : {"roughness.orientation", "roughness.place"}) {
      if (config.has(key)) reject_without(config, key, "roughness.file or roughness.kind");
    }
    return {};
  }
  roughness.heights = sum_of(parts);
  return roughness;
}

RoughPoint read_rough_point(const io::Config& config, const CaseSetting& setting) {
  RoughPoint rough{.problem = read_point(config)};
  PointRoughness roughness = read_point_roughness(config, rough.problem, 0, setting);
  if (roughness.heights) rough.problem.roughness = roughness.heights(0);
  rough.notes = std::move(roughness.notes);
  return rough;
}

}  // namespace tabor::ehl
