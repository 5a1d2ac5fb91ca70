#include "tabor/cases/ehl/point_parameters.hpp"

#include <fmt/format.h>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/point/finish.hpp"
#include "tabor/record/settings_file.hpp"

namespace tabor::ehl {

namespace {

constexpr auto kOrientations = names<Orientation>("longitudinal", "transverse");
constexpr const char* kCentre = "[\"0 m\", \"0 m\"]";

const Bounds kLoadGroup{
    .least = 0, .most = 1e12, .least_is_out = true, .text = "a number above zero"};
const Bounds kViscosityGroup{.least = 0, .most = 1e12, .text = "zero or more"};
const Bounds kNodes{.least = 17, .most = 4097, .text = "17 to 4097"};
const Bounds kReach{.least = 1,
                    .most = kMostAxes,
                    .least_is_out = true,
                    .text = fmt::format("1 to {} half axes of the dry contact", kMostAxes)};
const Bounds kFactor{.least = 0,
                     .most = kMostAxes,
                     .least_is_out = true,
                     .text = fmt::format("a factor above 0, up to {}, or \"auto\"", kMostAxes)};

Parameters<PointSettings> body_parameters() {
  using Settings = PointSettings;
  using One = Parameter<Settings>;
  return {
      One({.name = "ball.radius",
           .help = "R, radius of a ball",
           .example = "10 mm",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .absent = "10 mm with [groups], else required"},
          &Settings::radius),
      One({.name = "ball.radius_x",
           .help = "reduced radius along the flow, instead of radius",
           .example = "10 mm",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .absent = "from radius"},
          &Settings::radius_x),
      One({.name = "ball.radius_y",
           .help = "reduced radius across the flow",
           .example = "12 mm",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .absent = "from radius"},
          &Settings::radius_y),
      One({.name = "ball.load",
           .help = "w, load",
           .example = "20 N",
           .dimension = dimension::force,
           .bounds = kAboveZero,
           .absent = "required, unless [groups]"},
          &Settings::load),
      One({.name = "groups.M",
           .help = "Moes' W (2U)^(-3/4), with L instead of load and speed; bodies and oil that are "
                   "not given are then steel and a mineral oil",
           .example = "20",
           .bounds = kLoadGroup,
           .absent = "from load and speed"},
          &Settings::moes_load),
      One({.name = "groups.L",
           .help = "Moes' G (2U)^(1/4); 0 for a constant viscosity",
           .example = "10",
           .bounds = kViscosityGroup,
           .absent = "from load and speed"},
          &Settings::moes_viscosity),
      One({.name = "solids.plastic_pressure",
           .help = "P_plast, at which the softer solid flows; bonds of a sixth of it rub there",
           .example = "4 GPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "elastic"},
          &Settings::plastic_pressure),
      One({.name = "motion.speed",
           .help = "of the ball over a flat at rest: u_s = speed, u_m = speed/2",
           .example = "0.1 m/s",
           .dimension = dimension::speed,
           .bounds = kAboveZero,
           .absent = "required, unless [groups] or the next two"},
          &Settings::speed),
      One({.name = "motion.entrainment_speed",
           .help = "u_m, mean speed, instead of speed",
           .example = "0.05 m/s",
           .dimension = dimension::speed,
           .bounds = kAboveZero,
           .absent = "from speed"},
          &Settings::entrainment_speed),
      One({.name = "motion.sliding_speed",
           .help = "u_s, difference of the speeds, beside entrainment_speed or [groups]",
           .example = "0.1 m/s",
           .dimension = dimension::speed,
           .absent = "0; over a roughness 2 u_m"},
          &Settings::sliding_speed),
      One({.name = "motion.duration",
           .help = "how long the rough surface moves with its body",
           .example = "1 ms",
           .dimension = dimension::time,
           .bounds = kAboveZero,
           .absent = "steady"},
          &Settings::duration)};
}

/// Returns the names of finishes(), and ground.
std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const Finish& finish : finishes()) names.push_back(finish.name);
  names.emplace_back(kGround);
  return names;
}

/// "150 nm (lapped-like), 80 nm (polished-like), 150 nm (ground)".
std::string usual_rms() {
  std::string text;
  for (const Finish& finish : finishes()) {
    text += fmt::format("{} ({}), ", si(finish.rms_height, "m"), finish.name);
  }
  return text + fmt::format("{} ({})", si(kGroundRms, "m"), kGround);
}

Parameters<PointRoughnessSettings> scan_parameters() {
  using Settings = PointRoughnessSettings;
  using One = Parameter<Settings>;
  return {One({.name = "roughness.file",
               .help = "a scan, larger than 1.25 times the contact, no holes",
               .example = "scan.x3p",
               .absent = "no scan"},
              &Settings::file),
          One({.name = "roughness.channel",
               .help = "its height channel",
               .example = "1",
               .absent = "as 'tabor info' picks it"},
              &Settings::channel),
          One({.name = "roughness.treatment",
               .help = "its treatment, a list as in a study",
               .example = "[\"level=plane\"]",
               .absent = fmt::format("[\"{}\"]", kUsualTreatment)},
              &Settings::treatment)};
}

Parameters<PointRoughnessSettings> finish_parameters() {
  using Settings = PointRoughnessSettings;
  using One = Parameter<Settings>;
  return {One({.name = "roughness.kind",
               .help = "a generated surface: " + one_of(kinds()),
               .example = "ground",
               .words = kinds(),
               .absent = "none"},
              &Settings::kind),
          One({.name = "roughness.rms",
               .help = "of the generated surface",
               .example = "150 nm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = usual_rms()},
              &Settings::rms),
          One({.name = "roughness.seed",
               .help = "of its random numbers",
               .example = "1",
               .absent = "that of --seed"},
              &Settings::seed),
          One({.name = "roughness.pixel",
               .help = "of the generated surface",
               .example = "1 um",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = si(kUsualPixel, "m")},
              &Settings::pixel),
          One({.name = "roughness.groove_spacing",
               .help = "of ground; grooves are 20 times as long",
               .example = "10 um",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = si(kGrooveSpacing, "m")},
              &Settings::groove_spacing)};
}

Parameters<PointRoughnessSettings> place_parameters() {
  using Settings = PointRoughnessSettings;
  using One = Parameter<Settings>;
  return {One({.name = "roughness.orientation",
               .help = "longitudinal: x of the scan and grooves along the flow; transverse: turned "
                       "by a quarter",
               .example = "transverse",
               .absent = "longitudinal"},
              &Settings::orientation, kOrientations),
          One({.name = "roughness.place",
               .help = "where the middle of the surface lies, along and across the flow",
               .example = "[\"10 um\", \"0 um\"]",
               .dimension = dimension::length,
               .absent = kCentre},
              &Settings::place),
          One({.name = "roughness.bump.height",
               .help = "of one bump in the middle of rings",
               .example = "100 nm",
               .dimension = dimension::length,
               .absent = "no bump"},
              &Settings::bump_height),
          One({.name = "roughness.bump.wavelength",
               .help = "of its rings",
               .example = "100 um",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "required beside height"},
              &Settings::bump_wavelength),
          One({.name = "roughness.bump.place",
               .help = "of its middle",
               .example = "[\"10 um\", \"0 um\"]",
               .dimension = dimension::length,
               .absent = kCentre},
              &Settings::bump_place)};
}

Parameters<PointSettings> grid_parameters() {
  using Settings = PointSettings;
  using One = Parameter<Settings>;
  const PointProblem usual;
  return {One({.name = "grid.nodes_x",
               .help = "along the flow",
               .example = "257",
               .bounds = kNodes,
               .absent = fmt::format("{}", usual.nodes_x)},
              &Settings::nodes_x),
          One({.name = "grid.nodes_y",
               .help = "across the flow",
               .example = "257",
               .bounds = kNodes,
               .absent = fmt::format("{}", usual.nodes_y)},
              &Settings::nodes_y),
          One({.name = "grid.nodes",
               .help = "along the flow; nodes_y changes in proportion; wins over nodes_x, for "
                       "sweeps",
               .example = "129",
               .bounds = kNodes,
               .absent = "from nodes_x"},
              &Settings::nodes),
          One({.name = "grid.inlet",
               .help = "domain before the centre, in half axes of the dry contact",
               .bounds = kReach},
              &Settings::inlet),
          One({.name = "grid.outlet", .help = "behind it", .bounds = kReach}, &Settings::outlet),
          One({.name = "grid.half_width", .help = "to either side", .bounds = kReach},
              &Settings::half_width),
          One({.name = "grid.domain",
               .help = "factor on inlet and half width, with as many more nodes, for sweeps; "
                       "\"auto\": as large, and with as many nodes where none are given, that the "
                       "film is within about 1 %",
               .bounds = kFactor,
               .none = "auto"},
              &Settings::domain),
          One({.name = "grid.time_step",
               .help = "longest step, beside motion.duration",
               .example = "1 us",
               .dimension = dimension::time,
               .bounds = kAboveZero,
               .absent = "spacing over the fastest speed"},
              &Settings::time_step)};
}

constexpr LoneKey kLonePointKeys[] = {
    {"roughness.channel", "roughness.file"}, {"roughness.treatment", "roughness.file"},
    {"roughness.rms", "roughness.kind"},     {"roughness.pixel", "roughness.kind"},
    {"roughness.seed", "roughness.kind"},    {"roughness.groove_spacing", "roughness.kind"},
    {"grid.time_step", "motion.duration"}};

}  // namespace

const Parameters<PointSettings>& point_parameters() {
  using Settings = PointSettings;
  static const Parameters<Settings> all = joined(
      body_parameters(), {within(solid_parameters(), &Settings::solids),
                          within(lubricant_parameters(), &Settings::lubricant),
                          within(shear_parameters(), &Settings::shear),
                          within(asperity_parameters(), &Settings::asperities),
                          within(scan_parameters(), &Settings::roughness),
                          within(finish_parameters(), &Settings::roughness),
                          within(place_parameters(), &Settings::roughness), grid_parameters()});
  return all;
}

PointSettings read_point_settings(const io::Config& file) {
  PointSettings settings;
  read_settings(file, point_parameters(), settings);
  reject_lone(file, kLonePointKeys);
  return settings;
}

}  // namespace tabor::ehl
