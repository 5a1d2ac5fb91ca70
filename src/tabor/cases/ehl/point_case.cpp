#include "tabor/cases/ehl/point_case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/cases/ehl/point_parameters.hpp"
#include "tabor/core/error.hpp"
#include "tabor/ehl/point/accuracy.hpp"

namespace tabor::ehl {

namespace {

// Steel on steel (206 GPa, 0.3) and an oil with z = 0.6 in Roelands' law: what [groups] leaves
// open. M, L and these decide all of a film but its scale, which the radius decides.
constexpr double kUsualRadius = 10e-3;              // [m]
constexpr double kUsualEPrime = 226.4e9;            // [Pa]
constexpr double kUsualViscosity = 0.0837;          // [Pa s]
constexpr double kUsualPressureViscosity = 2.2e-8;  // [1/Pa]
constexpr double kIsoviscousSpeed = 1e-11;  // U, for L = 0, where any speed has the same film

/// What [groups] leaves open, filled in.
void take_usual_materials(PointSettings& settings) {
  if (!settings.radius && !settings.radius_x) settings.radius = kUsualRadius;
  SolidSettings& solids = settings.solids;
  if (!solids.e_prime && !solids.youngs_modulus) solids.e_prime = kUsualEPrime;
  LubricantSettings& oil = settings.lubricant;
  if (!oil.viscosity && !oil.glycerol_fraction) oil.viscosity = kUsualViscosity;
  if (!oil.pressure_viscosity) oil.pressure_viscosity = kUsualPressureViscosity;
  if (settings.moes_viscosity == 0.0) oil.viscosity_law = material::ViscosityLaw::constant;
  if (!oil.density_law) oil.density_law = material::DensityLaw::dowson_higginson;
}

void set_radii(const PointSettings& settings, const io::Config& file, PointProblem& problem) {
  if (settings.radius || (!settings.radius_x && !settings.radius_y)) {
    if (settings.radius_x || settings.radius_y) {
      reject_beside(file, "ball.radius", "radius_x or radius_y",
                    "radius is of a ball, radius_x and radius_y of an ellipsoid");
    }
    problem.radius_x = problem.radius_y = required(settings.radius, file, "ball.radius");
    return;
  }
  problem.radius_x = required(settings.radius_x, file, "ball.radius_x");
  problem.radius_y = required(settings.radius_y, file, "ball.radius_y");
}

/// What is not said: bodies roll, but a rough one is at rest and the other slides over it.
double sliding_speed(const PointSettings& settings, double entrainment_speed) {
  return settings.sliding_speed.value_or(settings.roughness.is_rough() ? 2 * entrainment_speed : 0);
}

void reject_beside_speed(const PointSettings& settings, const io::Config& file) {
  const auto reject = [&](const char* key) {
    reject_beside(file, key, "motion.speed",
                  "speed is the ball's over a flat at rest: entrainment is half of it");
  };
  if (settings.entrainment_speed) reject("motion.entrainment_speed");
  if (settings.sliding_speed) reject("motion.sliding_speed");
}

/// speed: the ball slides over a flat at rest; or entrainment_speed with sliding_speed.
void set_motion(const PointSettings& settings, const io::Config& file, PointProblem& problem) {
  if (settings.speed || !settings.entrainment_speed) {
    problem.sliding_speed = required(settings.speed, file, "motion.speed");
    problem.entrainment_speed = problem.sliding_speed / 2;
    reject_beside_speed(settings, file);
    return;
  }
  problem.entrainment_speed = *settings.entrainment_speed;
  problem.sliding_speed = sliding_speed(settings, problem.entrainment_speed);
}

void reject_beside_groups(const PointSettings& settings, const io::Config& file) {
  const auto reject = [&](const char* key) {
    reject_beside(file, key, "[groups]", "M and L say what load and speed are");
  };
  if (settings.load) reject("ball.load");
  if (settings.speed) reject("motion.speed");
  if (settings.entrainment_speed) reject("motion.entrainment_speed");
}

/// Load and speed with Moes' M = W (2U)^(-3/4) and L = G (2U)^(1/4), U = eta0 u_m / (E' Rx),
/// W = w / (E' Rx^2), G = alpha E'.
void set_groups(const PointSettings& settings, const io::Config& file, PointProblem& problem) {
  reject_beside_groups(settings, file);
  const double moes_load = required(settings.moes_load, file, "groups.M");
  const double moes_viscosity = required(settings.moes_viscosity, file, "groups.L");
  const double e_prime = 2 * problem.effective_modulus;
  double doubled_speed = 2 * kIsoviscousSpeed;
  if (moes_viscosity > 0) {
    const double material = material::pressure_coefficient(problem.lubricant.viscosity) * e_prime;
    if (!(material > 0)) {
      throw InputError(file.place("groups.L"), fmt::format("{}", moes_viscosity),
                       "0 for a viscosity that does not depend on pressure",
                       "or give lubricant.pressure_viscosity");
    }
    doubled_speed = std::pow(moes_viscosity / material, 4);
  }
  const double eta = material::ambient_viscosity(problem.lubricant.viscosity);
  problem.entrainment_speed = doubled_speed / 2 * e_prime * problem.radius_x / eta;
  problem.sliding_speed = sliding_speed(settings, problem.entrainment_speed);
  problem.load =
      moes_load * std::pow(doubled_speed, 0.75) * e_prime * problem.radius_x * problem.radius_x;
}

/// As many more cells as the domain is longer.
Index stretched(Index nodes, double factor) {
  return 1 + std::llround(static_cast<double>(nodes - 1) * factor);
}

void set_nodes(const PointSettings& settings, PointProblem& problem) {
  if (settings.nodes_x) problem.nodes_x = static_cast<Index>(*settings.nodes_x);
  if (settings.nodes_y) problem.nodes_y = static_cast<Index>(*settings.nodes_y);
  if (!settings.nodes) return;
  const auto nodes = static_cast<Index>(*settings.nodes);
  problem.nodes_y = stretched(
      problem.nodes_y, static_cast<double>(nodes - 1) / static_cast<double>(problem.nodes_x - 1));
  problem.nodes_x = nodes;
}

/// By this factor, with as many more nodes.
void lengthen(double factor, PointProblem& problem) {
  const double length = problem.inlet + problem.outlet;
  problem.inlet *= factor;
  problem.half_width *= factor;
  problem.nodes_x = stretched(problem.nodes_x, (problem.inlet + problem.outlet) / length);
  problem.nodes_y = stretched(problem.nodes_y, factor);
}

void set_grid(const PointSettings& settings, PointProblem& problem) {
  problem.inlet = settings.inlet;
  problem.outlet = settings.outlet;
  problem.half_width = settings.half_width;
  set_nodes(settings, problem);
  if (settings.domain) {
    lengthen(*settings.domain, problem);
  } else {
    const bool has_nodes = settings.nodes || settings.nodes_x || settings.nodes_y;
    problem = with_domain_chosen(problem, !has_nodes, kMostAxes);
  }
}

}  // namespace

PointProblem read_point(const io::Config& config) {
  PointSettings settings = read_point_settings(config);
  if (settings.has_groups()) take_usual_materials(settings);
  PointProblem problem;
  set_radii(settings, config, problem);
  problem.effective_modulus = effective_modulus(settings.solids, config);
  problem.plastic_pressure = settings.plastic_pressure.value_or(kNoPlasticLimit);
  problem.asperities = asperities_of(settings.asperities, config);
  problem.lubricant = lubricant_of(settings.lubricant, config);
  problem.lubricant.shear = shear_of(settings.shear, config);
  if (settings.has_groups()) {
    set_groups(settings, config, problem);
  } else {
    problem.load = required(settings.load, config, "ball.load");
    set_motion(settings, config, problem);
  }
  set_grid(settings, problem);
  check_point(problem);
  return problem;
}

}  // namespace tabor::ehl
