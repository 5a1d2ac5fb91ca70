#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/ehl/point/case.hpp"
#include "tabor/ehl/point/roughness.hpp"

namespace tabor::ehl {

namespace {

constexpr double kCoarse = 2;         // pixels between nodes
constexpr double kMostPixels = 4096;  // of a generated surface, along either side

constexpr double kPixel = 784.3e-9;  // [m], of the surfaces of Redlich, Bartel & Deters
constexpr const char* kGround = "ground";
constexpr double kGroundRms = 0.15e-6;  // [m]
constexpr double kGroundHurst = 0.7;
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
Grid generated_grid(const io::Config& config, const PointProblem& problem, bool is_turned,
                    double travel) {
  const double pixel = positive_quantity_or(config, "roughness.pixel", dimension::length, kPixel);
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
  if (is_turned) std::swap(nx, ny);
  return {nx, ny, static_cast<double>(nx) * pixel, static_cast<double>(ny) * pixel};
}

const Finish& read_finish(const io::Config& config) {
  const std::string kind = config.text("roughness.kind");
  std::vector<std::string> names = {kGround};
  for (const Finish& finish : finishes()) {
    if (kind == finish.name) return finish;
    names.push_back(finish.name);
  }
  throw InputError(config.place("roughness.kind"), "'" + kind + "'",
                   fmt::format("{}{}", fmt::join(names, ", "), suggestion(kind, names)), "");
}

GeneratedSurface read_finish_on(const io::Config& config, const Grid& grid) {
  const auto length = [&](const char* key, double usual) {
    return positive_quantity_or(config, key, dimension::length, usual);
  };
  if (config.text("roughness.kind") != kGround) {
    const Finish& finish = read_finish(config);
    return {.grid = grid,
            .rms_height = length("roughness.rms", finish.rms_height),
            .hurst = finish.hurst,
            .roll_off_wavelength = finish.roll_off_wavelength};
  }
  const double spacing = length("roughness.groove_spacing", kGrooveSpacing);
  return {.grid = grid,
          .rms_height = length("roughness.rms", kGroundRms),
          .hurst = kGroundHurst,
          .roll_off_wavelength = spacing,
          .groove_length = kGrooveSlenderness * spacing};
}

Surface generate(const io::Config& config, const PointProblem& problem, bool is_turned,
                 double travel, const CaseSetting& setting) {
  const SurfaceSource& source = with_source(config, "roughness.kind", setting);
  GeneratedSurface finish =
      read_finish_on(config, generated_grid(config, problem, is_turned, travel));
  finish.seed = static_cast<std::uint64_t>(
      integer_or(config, "roughness.seed", static_cast<std::int64_t>(setting.seed)));
  return source.generate(finish);
}

using Heights = std::function<Field(double moved)>;

/// Turned by a quarter: what ran along the flow runs across it.
Field turned(const Field& height) { return height.transpose().rowwise().reverse(); }

/// Heights of a scan or a generated surface, x along the flow unless it is turned; its middle is
/// `behind` [m] the place that the case gives.
Heights map_heights(const io::Config& config, const char* key, const PointProblem& problem,
                    const Surface& surface, bool is_turned, double behind) {
  const Place place = read_place(config, "roughness.place");
  const Grid& grid = surface.grid;
  const PointMap map = {.height = is_turned ? turned(surface.height) : surface.height,
                        .spacing_x = is_turned ? grid.dy() : grid.dx(),
                        .spacing_y = is_turned ? grid.dx() : grid.dy(),
                        .centre_x = place.x - behind,
                        .centre_y = place.y};
  return [config, key, problem, map](double moved) {
    PointMap now = map;
    now.centre_x += moved;
    return at_key(config, key, [&] { return point_map(problem, now); });
  };
}

Heights bump_heights(const io::Config& config, const PointProblem& problem) {
  const Place place = read_place(config, "roughness.bump.place");
  const double height = config.quantity("roughness.bump.height", dimension::length);
  const double wavelength =
      positive_quantity(config, "roughness.bump.wavelength", dimension::length);
  return [=](double moved) {
    return point_bump(problem, height, wavelength, place.x + moved, place.y);
  };
}

/// Contact and pressure depend on short waves, which a coarse grid averages away: a warning, or "".
std::string coarse_nodes(const PointProblem& problem, const Grid& surface) {
  const Grid nodes = point_grid(problem);
  const double spacing = std::max(nodes.dx(), nodes.dy());
  const double pixel = std::min(surface.dx(), surface.dy());
  if (spacing <= kCoarse * pixel) return "";
  return fmt::format(
      "nodes are {} apart, pixels {}: roughness shorter than {} is averaged away; give more nodes",
      si(spacing, "m"), si(pixel, "m"), si(2 * spacing, "m"));
}

bool read_is_turned(const io::Config& config) {
  const std::string word = text_or(config, "roughness.orientation", "longitudinal");
  const std::vector<std::string> words = {"longitudinal", "transverse"};
  if (word == words[0] || word == words[1]) return word == words[1];
  throw InputError(config.place("roughness.orientation"), "'" + word + "'",
                   "longitudinal or transverse" + suggestion(word, words), "");
}

Surface read_scan(const io::Config& config, const CaseSetting& setting) {
  NamedScan scan{.file = named_file(config, "roughness.file"),
                 .treatment = {"level=plane"},
                 .rejects_holes_at = config.place("roughness.file")};
  if (config.has("roughness.channel")) scan.channel = config.text("roughness.channel");
  if (config.has("roughness.treatment")) scan.treatment = config.texts("roughness.treatment");
  return with_source(config, "roughness.file", setting).read(scan, setting.observer);
}

std::string usual_rms() {
  std::string text;
  for (const Finish& finish : finishes()) {
    text += fmt::format("{} ({}), ", si(finish.rms_height, "m"), finish.name);
  }
  return text + fmt::format("{} ({})", si(kGroundRms, "m"), kGround);
}

/// Each once.
void add_warning(const std::string& text, std::vector<std::string>& warnings) {
  const bool is_new = std::find(warnings.begin(), warnings.end(), text) == warnings.end();
  if (is_new && !text.empty()) warnings.push_back(text);
}

}  // namespace

const std::vector<Finish>& finishes() {
  static const std::vector<Finish> all = {{"lapped-like", 0.15e-6, 8e-6},
                                          {"polished-like", 0.08e-6, 60e-6}};
  return all;
}

CaseKeys point_roughness_keys() {
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

namespace {

/// The sum of several.
Heights sum_of(const std::vector<Heights>& parts) {
  return [parts](double moved) {
    Field sum = parts.front()(moved);
    for (std::size_t k = 1; k < parts.size(); ++k) sum += parts[k](moved);
    return sum;
  };
}

/// Keys that say something about a surface that the case does not have.
void reject_lone_keys(const io::Config& config) {
  reject_without(config, "roughness.file", {"roughness.channel", "roughness.treatment"});
  reject_without(
      config, "roughness.kind",
      {"roughness.rms", "roughness.pixel", "roughness.seed", "roughness.groove_spacing"});
}

}  // namespace

PointRoughness read_point_roughness(const io::Config& config, const PointProblem& problem,
                                    double travel, const CaseSetting& setting) {
  reject_lone_keys(config);
  PointRoughness roughness;
  std::vector<Heights> parts;
  const bool is_turned = read_is_turned(config);
  const auto add_map = [&](const char* key, const Surface& surface, double behind) {
    for (const std::string& warning : surface.warnings) {
      add_warning(warning, roughness.notes.warnings);
    }
    parts.push_back(map_heights(config, key, problem, surface, is_turned, behind));
    add_warning(coarse_nodes(problem, surface.grid), roughness.notes.warnings);
  };
  if (config.has("roughness.file")) {
    const Surface scan = read_scan(config, setting);
    roughness.notes.scan_sha256 = scan.sha256;
    add_map("roughness.file", scan, 0);
  }
  if (config.has("roughness.kind")) {
    add_map("roughness.kind", generate(config, problem, is_turned, travel, setting), travel / 2);
  }
  if (config.has("roughness.bump.height") || config.has("roughness.bump.wavelength")) {
    parts.push_back(bump_heights(config, problem));
  }
  if (parts.empty()) {
    reject_without(config, "roughness.file", {"roughness.orientation", "roughness.place"});
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
