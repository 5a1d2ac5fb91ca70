#include "tabor/ehl/point/case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"

namespace tabor::ehl {

namespace {

constexpr Index kFewestNodes = 17, kMostNodes = 4097;  // along either axis
constexpr double kMostAxes = 100;                      // of the domain, in half axes
constexpr double kLargestGroup = 1e12;

/// Steel on steel (206 GPa, 0.3) and an oil with z = 0.6 in Roelands' law: what [groups] leaves
/// open. M, L and these decide all of a film but its scale, which the radius decides.
struct Usual {
  const char* key;
  const char* value;
};
constexpr Usual kUsualBodies[] = {{"ball.radius", "10 mm"}, {"solids.e_prime", "226.4 GPa"}};
constexpr Usual kUsualOil[] = {{"lubricant.viscosity", "0.0837 Pa s"},
                               {"lubricant.viscosity_law", "roelands"},
                               {"lubricant.pressure_viscosity", "2.2e-8 1/Pa"},
                               {"lubricant.density_law", "dowson-higginson"}};
constexpr double kIsoviscousSpeed = 1e-11;  // U, for L = 0, where any speed has the same film

[[noreturn]] void reject_beside(const io::Config& config, const char* key, const char* other,
                                const char* remedy) {
  throw InputError(config.place(key), std::string("beside ") + other, "one of the two", remedy);
}

bool has_roughness(const io::Config& config) {
  return config.has("roughness.file") || config.has("roughness.kind") ||
         config.has("roughness.bump.height");
}

io::Config with_usual(const io::Config& config, const Usual& usual) {
  return config.has(usual.key) ? config : config.with(usual.key, usual.value);
}

/// What [groups] leaves open, filled in.
io::Config with_usual_materials(io::Config config) {
  if (!config.has("ball.radius_x")) config = with_usual(config, kUsualBodies[0]);
  if (!config.has("solids.youngs_modulus")) config = with_usual(config, kUsualBodies[1]);
  for (const Usual& usual : kUsualOil) {
    const bool is_mixture = config.has("lubricant.glycerol_fraction");
    if (!(is_mixture && usual.key == kUsualOil[0].key)) config = with_usual(config, usual);
  }
  return config;
}

void read_radii(const io::Config& config, PointProblem& problem) {
  if (config.has("ball.radius")) {
    if (config.has("ball.radius_x") || config.has("ball.radius_y")) {
      reject_beside(config, "ball.radius", "radius_x or radius_y",
                    "radius is of a ball, radius_x and radius_y of an ellipsoid");
    }
    problem.radius_x = positive_quantity(config, "ball.radius", dimension::length);
    problem.radius_y = problem.radius_x;
    return;
  }
  if (!config.has("ball.radius_x") && !config.has("ball.radius_y")) {
    positive_quantity(config, "ball.radius", dimension::length);  // says that it is missing
  }
  problem.radius_x = positive_quantity(config, "ball.radius_x", dimension::length);
  problem.radius_y = positive_quantity(config, "ball.radius_y", dimension::length);
}

/// What is not said: bodies roll, but a rough one is at rest and the other slides over it.
double read_sliding(const io::Config& config, double entrainment_speed) {
  if (config.has("motion.sliding_speed")) {
    return config.quantity("motion.sliding_speed", dimension::speed);
  }
  return has_roughness(config) ? 2 * entrainment_speed : 0;
}

/// speed: the ball slides over a flat at rest; or entrainment_speed with sliding_speed.
void read_motion(const io::Config& config, PointProblem& problem) {
  if (config.has("motion.speed")) {
    for (const char* other : {"motion.entrainment_speed", "motion.sliding_speed"}) {
      if (config.has(other)) {
        reject_beside(config, other, "motion.speed",
                      "speed is the ball's over a flat at rest: entrainment is half of it");
      }
    }
    problem.sliding_speed = positive_quantity(config, "motion.speed", dimension::speed);
    problem.entrainment_speed = problem.sliding_speed / 2;
    return;
  }
  if (!config.has("motion.entrainment_speed")) {
    positive_quantity(config, "motion.speed", dimension::speed);  // says that it is missing
  }
  problem.entrainment_speed =
      positive_quantity(config, "motion.entrainment_speed", dimension::speed);
  problem.sliding_speed = read_sliding(config, problem.entrainment_speed);
}

double group(const io::Config& config, const char* key, bool may_vanish) {
  const double value = config.number(key);
  if (!(value > 0 || (may_vanish && value == 0)) || !(value < kLargestGroup)) {
    throw InputError(config.place(key), fmt::format("{}", value),
                     may_vanish ? "zero or more" : "a number above zero", "");
  }
  return value;
}

/// Load and speed with Moes' M = W (2U)^(-3/4) and L = G (2U)^(1/4), U = eta0 u_m / (E' Rx),
/// W = w / (E' Rx^2), G = alpha E'.
void read_groups(const io::Config& config, PointProblem& problem) {
  for (const char* other : {"ball.load", "motion.speed", "motion.entrainment_speed"}) {
    if (config.has(other)) {
      reject_beside(config, other, "[groups]", "M and L say what load and speed are");
    }
  }
  const double moes_load = group(config, "groups.M", false);
  const double moes_viscosity = group(config, "groups.L", true);
  const double e_prime = 2 * problem.effective_modulus;
  double doubled_speed = 2 * kIsoviscousSpeed;
  if (moes_viscosity > 0) {
    const double material = material::pressure_coefficient(problem.lubricant.viscosity) * e_prime;
    if (!(material > 0)) {
      throw InputError(config.place("groups.L"), fmt::format("{}", moes_viscosity),
                       "0 for a viscosity that does not depend on pressure",
                       "or give lubricant.pressure_viscosity");
    }
    doubled_speed = std::pow(moes_viscosity / material, 4);
  }
  const double eta = material::ambient_viscosity(problem.lubricant.viscosity);
  problem.entrainment_speed = doubled_speed / 2 * e_prime * problem.radius_x / eta;
  problem.sliding_speed = read_sliding(config, problem.entrainment_speed);
  problem.load =
      moes_load * std::pow(doubled_speed, 0.75) * e_prime * problem.radius_x * problem.radius_x;
}

Index read_nodes(const io::Config& config, const char* key, Index usual) {
  const std::int64_t nodes = integer_or(config, key, usual);
  if (nodes < kFewestNodes || nodes > kMostNodes) {
    throw InputError(config.place(key), fmt::format("{}", nodes),
                     fmt::format("{} to {}", kFewestNodes, kMostNodes), "");
  }
  return nodes;
}

/// A length of the domain in half axes of the dry contact.
double read_reach(const io::Config& config, const char* key, double usual) {
  if (!config.has(key)) return usual;
  const double value = config.number(key);
  if (!(value > 1 && value <= kMostAxes)) {
    throw InputError(config.place(key), fmt::format("{}", value),
                     fmt::format("1 to {} half axes of the dry contact", kMostAxes), "");
  }
  return value;
}

/// As many more cells as the domain is longer.
Index stretched(Index nodes, double factor) {
  return 1 + std::llround(static_cast<double>(nodes - 1) * factor);
}

void read_grid(const io::Config& config, PointProblem& problem) {
  problem.nodes_x = read_nodes(config, "grid.nodes_x", problem.nodes_x);
  problem.nodes_y = read_nodes(config, "grid.nodes_y", problem.nodes_y);
  problem.inlet = read_reach(config, "grid.inlet", problem.inlet);
  problem.outlet = read_reach(config, "grid.outlet", problem.outlet);
  problem.half_width = read_reach(config, "grid.half_width", problem.half_width);
  if (config.has("grid.nodes")) {
    const Index nodes = read_nodes(config, "grid.nodes", 0);
    problem.nodes_y = stretched(
        problem.nodes_y, static_cast<double>(nodes - 1) / static_cast<double>(problem.nodes_x - 1));
    problem.nodes_x = nodes;
  }
  if (config.has("grid.domain")) {
    const double factor = config.number("grid.domain");
    if (!(factor > 0 && factor <= kMostAxes)) {
      throw InputError(config.place("grid.domain"), fmt::format("{}", factor),
                       fmt::format("a factor above 0, up to {}", kMostAxes), "");
    }
    const double length = problem.inlet + problem.outlet;
    problem.inlet *= factor;
    problem.half_width *= factor;
    problem.nodes_x = stretched(problem.nodes_x, (problem.inlet + problem.outlet) / length);
    problem.nodes_y = stretched(problem.nodes_y, factor);
  }
}

}  // namespace

PointProblem read_point(const io::Config& given) {
  const bool has_groups = given.has("groups.M") || given.has("groups.L");
  const io::Config config = has_groups ? with_usual_materials(given) : given;
  PointProblem problem;
  read_radii(config, problem);
  problem.effective_modulus = read_effective_modulus(config);
  problem.plastic_pressure =
      positive_quantity_or(config, "solids.plastic_pressure", dimension::pressure, kNoPlasticLimit);
  problem.asperities = read_asperities(config, problem.asperities.boundary_film);
  problem.lubricant = read_lubricant(config, "roelands");
  problem.lubricant.shear = read_shear(config);
  if (has_groups) {
    read_groups(config, problem);
  } else {
    problem.load = positive_quantity(config, "ball.load", dimension::force);
    read_motion(config, problem);
  }
  read_grid(config, problem);
  check_point(problem);
  return problem;
}

namespace {

CaseKeys body_keys() {
  return {{"ball.radius", "m", "10 mm with [groups], else required", "R, radius of a ball"},
          {"ball.radius_x", "m", "of radius", "reduced radius along the flow, instead of radius"},
          {"ball.radius_y", "m", "of radius", "reduced radius across the flow"},
          {"ball.load", "N", "required, unless [groups]", "w, load"},
          {"groups.M", "", "of load and speed",
           "Moes' W (2U)^(-3/4), with L instead of load and speed; bodies and oil that are not "
           "given are then steel and a mineral oil"},
          {"groups.L", "", "of load and speed", "Moes' G (2U)^(1/4); 0 for a constant viscosity"},
          {"solids.plastic_pressure", "Pa", "elastic",
           "P_plast, at which the softer solid flows; bonds of a sixth of it rub there"},
          {"motion.speed", "m/s", "required, unless [groups] or the next two",
           "of the ball over a flat at rest: u_s = speed, u_m = speed/2"},
          {"motion.entrainment_speed", "m/s", "of speed", "u_m, mean speed, instead of speed"},
          {"motion.sliding_speed", "m/s", "0; over a roughness 2 u_m",
           "u_s, difference of the speeds, beside entrainment_speed or [groups]"},
          {"motion.duration", "s", "steady", "how long the rough surface moves with its body"}};
}

CaseKeys grid_keys() {
  const PointProblem usual;
  return {{"grid.nodes_x", "", fmt::format("{}", usual.nodes_x), "along the flow"},
          {"grid.nodes_y", "", fmt::format("{}", usual.nodes_y), "across the flow"},
          {"grid.nodes", "", "of nodes_x",
           "along the flow; nodes_y changes in proportion; wins over nodes_x, for sweeps"},
          {"grid.inlet", "", fmt::format("{}", usual.inlet),
           "domain before the centre, in half axes of the dry contact"},
          {"grid.outlet", "", fmt::format("{}", usual.outlet), "behind it"},
          {"grid.half_width", "", fmt::format("{}", usual.half_width), "to either side"},
          {"grid.domain", "", "1",
           "factor on inlet and half width, with as many more nodes, for sweeps"},
          {"grid.time_step", "s", "spacing over the fastest speed",
           "longest step, beside motion.duration"}};
}

}  // namespace

CaseKeys point_keys() {
  const double film = PointProblem{}.asperities.boundary_film;
  return joined(body_keys(), {solids_keys(), lubricant_keys("roelands"), shear_keys(),
                              asperity_keys(si(film, "m")), point_roughness_keys(), grid_keys()});
}

}  // namespace tabor::ehl
