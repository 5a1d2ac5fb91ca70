#include "tabor/cases/ehl/impact_parameters.hpp"

#include <algorithm>

#include "tabor/core/names.hpp"
#include "tabor/record/settings_file.hpp"

namespace tabor::ehl {

namespace {

constexpr double kGravity = 9.81;  // [m/s^2]
constexpr auto kStarts = names<ImpactStart>("rigid", "full");
const Bounds kNodes{.least = 10, .text = "10 or more"};

Parameters<ImpactSettings> ball_parameters() {
  using Settings = ImpactSettings;
  using One = Parameter<Settings>;
  return {One({.name = "ball.radius",
               .help = "R, radius of the ball",
               .example = "10 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::radius),
          One({.name = "ball.mass",
               .help = "m, its mass",
               .example = "32.5 g",
               .dimension = dimension::mass,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::mass),
          One({.name = "ball.speed",
               .help = "its speed of approach",
               .example = "0.2 m/s",
               .dimension = dimension::speed,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::speed)};
}

Parameters<ImpactSettings> own_parameters() {
  using Settings = ImpactSettings;
  using One = Parameter<Settings>;
  return {
      One({.name = "lubricant.layer",
           .help = "h00, thickness of the liquid on the flat",
           .example = "50 um",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .needed = Needed::yes},
          &Settings::layer),
      One({.name = "impact.gravity"}, &Settings::gravity),
      One({.name = "impact.start",
           .help = "rigid: bodies are rigid until a contact under the force would be deformed "
                   "by 1 % of the film; full: all equations from the first touch"},
          &Settings::start, kStarts),
      One({.name = "impact.profiles",
           .help = "list of times of the profiles in OUT.h5",
           .example = "[\"100 us\", \"200 us\"]",
           .dimension = dimension::time,
           .absent = "about 60 instants"},
          &Settings::profile_times),
      One({.name = "grid.nodes", .help = "along the radius", .bounds = kNodes}, &Settings::nodes),
      One({.name = "grid.domain",
           .help = "r_max, how much of the wet disc is computed; decides the rebound",
           .example = "1 mm",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .absent = "as far as the ball is wet after the rigid stage"},
          &Settings::domain),
      One({.name = "grid.time_step",
           .help = "nominal step",
           .example = "1 us",
           .dimension = dimension::time,
           .bounds = kAboveZero,
           .absent = "dry contact time over 400"},
          &Settings::time_step)};
}

}  // namespace

const Parameters<ImpactSettings>& impact_parameters() {
  static const Parameters<ImpactSettings> all =
      joined(ball_parameters(),
             {within(solid_parameters(), &ImpactSettings::solids),
              within(lubricant_parameters(), &ImpactSettings::lubricant), own_parameters()});
  return all;
}

ImpactSettings read_impact_settings(const io::Config& file) {
  ImpactSettings settings;
  read_settings(file, impact_parameters(), settings);
  return settings;
}

ImpactProblem read_impact(const io::Config& file) {
  const ImpactSettings settings = read_impact_settings(file);
  ImpactProblem problem;
  problem.radius = settings.radius;
  problem.mass = settings.mass;
  problem.speed = settings.speed;
  problem.effective_modulus = effective_modulus(settings.solids, file);
  problem.lubricant = lubricant_of(settings.lubricant, file);
  problem.layer = settings.layer;
  problem.gravity = settings.gravity ? kGravity : 0;
  problem.start = settings.start;
  problem.domain_radius = settings.domain.value_or(0);
  problem.time_step = settings.time_step.value_or(0);
  problem.nodes = static_cast<Index>(settings.nodes);
  problem.profile_times = settings.profile_times;
  std::sort(problem.profile_times.begin(), problem.profile_times.end());
  problem.keeps_all_profiles = problem.profile_times.empty();
  return problem;
}

}  // namespace tabor::ehl
