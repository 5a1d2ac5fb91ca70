#include "tabor/cases/ehl/squeeze_parameters.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/core/names.hpp"
#include "tabor/record/settings_file.hpp"

namespace tabor::ehl {

namespace {

constexpr auto kModels = names<SqueezeModel>("hydrodynamic", "linear");

Parameters<SqueezeSettings> roller_parameters() {
  using Settings = SqueezeSettings;
  using One = Parameter<Settings>;
  return {One({.name = "roller.mass_per_length",
               .help = "m, per width",
               .example = "30.2 kg/m",
               .dimension = dimension::mass_per_length,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::mass),
          One({.name = "roller.effective_radius",
               .help = "R of roller and flat together",
               .example = "9.2 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "required by hydrodynamic"},
              &Settings::radius),
          One({.name = "roller.spring",
               .help = "k_e, between roller and film, per width",
               .example = "2.2e10 N/m^2",
               .dimension = dimension::pressure,
               .unit = "N/m^2",
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::spring),
          One({.name = "roller.damping",
               .help = "c, per width",
               .example = "1e5 N s/m^2",
               .dimension = dimension::viscosity,
               .unit = "N s/m^2",
               .bounds = kAboveZero,
               .absent = "required by linear"},
              &Settings::damping),
          One({.name = "roller.speed",
               .help = "of approach",
               .example = "0.25 m/s",
               .dimension = dimension::speed,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::speed)};
}

Parameters<SqueezeSettings> own_parameters() {
  using Settings = SqueezeSettings;
  using One = Parameter<Settings>;
  return {One({.name = "lubricant.layer",
               .help = "h00, where the film begins",
               .example = "0.4 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::layer),
          One({.name = "motion.sliding_speed",
               .help = "Vs",
               .dimension = dimension::speed,
               .bounds = bounds::zero_or_more},
              &Settings::sliding_speed),
          One({.name = "motion.gravity"}, &Settings::gravity),
          One({.name = "grid.time_step",
               .help = "nominal step",
               .example = "1 us",
               .dimension = dimension::time,
               .bounds = kAboveZero,
               .absent = "layer over 2000 times the speed"},
              &Settings::time_step),
          One({.name = "squeeze.model",
               .help = "hydrodynamic, or linear: m x'' + c x' + k x = 0 in closed form"},
              &Settings::model, kModels)};
}

}  // namespace

const Parameters<SqueezeSettings>& squeeze_parameters() {
  static const Parameters<SqueezeSettings> all =
      joined(roller_parameters(),
             {within(closed_form_parameters(), &SqueezeSettings::lubricant), own_parameters()});
  return all;
}

SqueezeSettings read_squeeze_settings(const io::Config& file) {
  SqueezeSettings settings;
  read_settings(file, squeeze_parameters(), settings);
  return settings;
}

SqueezeProblem squeeze_problem(const SqueezeSettings& settings, const io::Config& file) {
  SqueezeProblem problem;
  problem.mass = settings.mass;
  problem.radius = required(settings.radius, file, "roller.effective_radius");
  problem.spring = settings.spring;
  problem.speed = settings.speed;
  const material::Lubricant lubricant = lubricant_of(settings.lubricant, file);
  problem.viscosity = material::ambient_viscosity(lubricant.viscosity);
  problem.pressure_coefficient = material::pressure_coefficient(lubricant.viscosity);
  problem.layer = settings.layer;
  problem.sliding_speed = settings.sliding_speed;
  if (!settings.gravity) problem.gravity = 0;
  problem.time_step = settings.time_step.value_or(0);
  return problem;
}

LinearSqueeze linear_squeeze(const SqueezeSettings& settings, const io::Config& file) {
  const LinearSqueeze linear{.mass = settings.mass,
                             .stiffness = settings.spring,
                             .damping = required(settings.damping, file, "roller.damping"),
                             .speed = settings.speed};
  const double critical = 2 * std::sqrt(linear.stiffness * linear.mass);
  if (linear.damping < critical) return linear;
  throw InputError(file.place("roller.damping"), fmt::format("{} N s/m^2", linear.damping),
                   fmt::format("less than the critical damping, {:.4g} N s/m^2", critical), "");
}

}  // namespace tabor::ehl
