#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/ehl/friction.hpp"
#include "tabor/ehl/line/wear_case.hpp"
#include "tabor/ehl/program.hpp"

namespace tabor::ehl {

namespace {

constexpr Dimension kForcePerLength{0, 1, -2, 0};
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

LineCavitation read_cavitation(const io::Config& config) {
  const std::string word = text_or(config, "film.cavitation", "reynolds");
  if (word != "reynolds" && word != "penalty") {
    throw InputError(config.place("film.cavitation"), "'" + word + "'",
                     "reynolds or penalty" + suggestion(word, {"reynolds", "penalty"}), "");
  }
  return word == "reynolds" ? LineCavitation::reynolds : LineCavitation::penalty;
}

/// One row of a scan [m]; the file's place is relative to the case's.
Eigen::ArrayXd read_profile(const io::Config& config, const LineProblem& problem,
                            const CaseSetting& setting) {
  const Surface scan = with_source(config, "roughness.file", setting)
                           .read({.file = named_file(config, "roughness.file")}, setting.observer);
  const std::int64_t row = integer_or(config, "roughness.row", scan.grid.ny / 2);
  if (row < 0 || row >= scan.grid.ny) {
    throw InputError(config.place("roughness.row"), fmt::format("{}", row),
                     fmt::format("0 to {}", scan.grid.ny - 1), "");
  }
  return line_profile(problem, scan.height.row(row).transpose(), scan.grid.dx());
}

/// One asperity of [roughness].
struct SingleAsperity {
  double height = 0;  ///< [m]
  double width = 0;   ///< [m]
  double place = 0;   ///< [m]
};

std::optional<SingleAsperity> read_single_asperity(const io::Config& config) {
  if (!config.has("roughness.height")) return std::nullopt;
  return SingleAsperity{.height = config.quantity("roughness.height", dimension::length),
                        .width = positive_quantity(config, "roughness.width", dimension::length),
                        .place = config.has("roughness.place")
                                     ? config.quantity("roughness.place", dimension::length)
                                     : 0.0};
}

Eigen::ArrayXd heights_of(const SingleAsperity& asperity, const LineProblem& problem) {
  return line_asperity(problem, asperity.height, asperity.width, asperity.place);
}

/// [roughness]: an asperity (height, width, place), waves (amplitude, wavelength), a row of a scan
/// (file, row), or their sum.
Eigen::ArrayXd read_roughness(const io::Config& config, const LineProblem& problem,
                              const CaseSetting& setting) {
  Eigen::ArrayXd roughness;
  const auto add = [&](const Eigen::ArrayXd& heights) {
    if (roughness.size() == 0) roughness.setZero(heights.size());
    roughness += heights;
  };
  if (const auto asperity = read_single_asperity(config)) add(heights_of(*asperity, problem));
  if (config.has("roughness.amplitude")) {
    add(line_waves(problem, config.quantity("roughness.amplitude", dimension::length),
                   positive_quantity(config, "roughness.wavelength", dimension::length)));
  }
  if (config.has("roughness.file")) add(read_profile(config, problem, setting));
  return roughness;
}

CaseKeys line_roughness_keys() {
  return {{"roughness.height", "m", "no asperity",
           "of one asperity, height cos^2(pi (x - place)/width)"},
          {"roughness.width", "m", "required beside height", "of the asperity"},
          {"roughness.place", "m", "0 m", "of the asperity, from the centre"},
          {"roughness.amplitude", "m", "no waves", "of waves, amplitude sin(2 pi x/wavelength)"},
          {"roughness.wavelength", "m", "required beside amplitude", "of the waves"},
          {"roughness.file", "", "no scan",
           "a row of a scan, levelled over the domain, as long as that or longer, no holes"},
          {"roughness.row", "", "the middle one", "of the scan, counted from 0"}};
}

/// [asperities]; without it nothing touches.
Asperities read_line_asperities(const io::Config& config) {
  const Asperities asperities = read_asperities(config, 0);
  if (asperities.boundary_film == 0 && config.has("asperities")) {
    throw InputError(
        config.place("asperities"), "no boundary_film", "how near the solids come, such as 10 nm",
        "in a profile, solids without a film between would stop the liquid, which lifts them");
  }
  return asperities;
}

/// [m/s]: as given, or as a part of the mean speed, with which it then changes; 0 if neither.
double read_sliding_speed(const io::Config& config, double entrainment_speed) {
  const bool has_ratio = config.has("motion.slide_to_roll_ratio");
  if (!config.has("motion.sliding_speed")) {
    return has_ratio ? config.number("motion.slide_to_roll_ratio") * entrainment_speed : 0;
  }
  if (has_ratio) {
    throw InputError(config.place("motion.slide_to_roll_ratio"), "beside sliding_speed",
                     "one of the two", "");
  }
  return config.quantity("motion.sliding_speed", dimension::speed);
}

LineProblem read_problem(const io::Config& config, const CaseSetting& setting) {
  LineProblem problem;
  problem.radius = positive_quantity(config, "cylinder.radius", dimension::length);
  problem.load = positive_quantity(config, "cylinder.load_per_length", kForcePerLength);
  problem.effective_modulus = read_effective_modulus(config);
  problem.lubricant = read_lubricant(config, "barus");
  problem.entrainment_speed =
      positive_quantity(config, "motion.entrainment_speed", dimension::speed);
  problem.sliding_speed = read_sliding_speed(config, problem.entrainment_speed);
  problem.cavitation = read_cavitation(config);
  if (config.has("film.penalty")) problem.penalty = config.number("film.penalty");
  if (config.has("grid.nodes")) problem.nodes = config.integer("grid.nodes");
  problem.inlet = positive_quantity_or(config, "grid.inlet", dimension::length, 0);
  problem.outlet = positive_quantity_or(config, "grid.outlet", dimension::length, 0);
  problem.asperities = read_line_asperities(config);
  // The nodes of the roughness are those of a checked problem.
  check_line(problem);
  problem.roughness = read_roughness(config, problem, setting);
  return problem;
}

/// What asperities do, where there are any.
io::Json asperity_scalars(const LineProblem& problem, const LineResult& result) {
  if (result.asperity_pressure.size() == 0) return io::Json::object();
  const double width = 2 * hertz_of(problem).half_width;
  return {{"boundary_film_m", problem.asperities.boundary_film},
          {"asperity_load_share", io::number(result.asperity_load_share)},
          {"solid_contact_fraction", io::number(result.contact_width / width)},
          {"contact_width_m", io::number(result.contact_width)},
          {"max_asperity_pressure_Pa", io::number(result.asperity_pressure.maxCoeff())},
          {"max_fluid_pressure_Pa", io::number(result.pressure.maxCoeff())},
          {"friction_fluid", io::number(result.friction_fluid)},
          {"friction_solid", io::number(result.friction_solid)},
          {"contact_error", io::number(result.contact_error)}};
}

io::Json scalars_of(const LineProblem& problem, const LineResult& result) {
  const reference::HertzLineContact hertz = hertz_of(problem);
  const reference::LineContactFilm groups = film_groups_of(problem);
  return {{"min_film_m", io::number(result.min_film)},
          {"central_film_m", io::number(result.central_film)},
          {"max_pressure_Pa", io::number(result.max_pressure)},
          {"rupture_m", io::number(result.rupture)},
          {"hertz_half_width_m", hertz.half_width},
          {"hertz_pressure_Pa", hertz.max_pressure},
          {"friction_force_N_per_m", io::number(result.friction_force)},
          {"friction_coefficient", io::number(result.friction_coefficient)},
          {"max_shear_stress_Pa", io::number(result.max_shear_stress)},
          {"groups",
           {{"U", groups.speed_group()},
            {"W", groups.load_group()},
            {"G", groups.material_group()},
            {"M", groups.moes_load()},
            {"L", groups.moes_viscosity()}}},
          {"moes_min_film_m", groups.moes_min_film()},
          {"nodes", problem.nodes},
          {"inlet_m", -result.x[0]},
          {"outlet_m", result.x[result.x.size() - 1]},
          {"newton_iterations", result.convergence.iterations},
          {"n_products", result.convergence.operator_applications},
          {"load_error", io::number(result.load_error)},
          {"mass_error", io::number(result.mass_error)},
          {"converged", result.convergence.converged()},
          {"status", name_of(result.convergence.status)}};
}

Facts facts_of(const LineProblem& problem, const LineResult& result) {
  const reference::HertzLineContact hertz = hertz_of(problem);
  Facts facts;
  facts.push_back({"smallest film", si(result.min_film, "m")});
  facts.push_back({"film in the centre", si(result.central_film, "m")});
  facts.push_back({"largest pressure", si(result.max_pressure, "Pa")});
  facts.push_back({"film ends at", si(result.rupture, "m")});
  facts.push_back({"friction coefficient", plain(result.friction_coefficient)});
  if (result.asperity_pressure.size() > 0) {
    facts.push_back(
        {"asperities", fmt::format("{} of the load on {}, friction {} beside {} of the liquid",
                                   plain(result.asperity_load_share), si(result.contact_width, "m"),
                                   plain(result.friction_solid), plain(result.friction_fluid))});
  }
  facts.push_back({"dry contact", fmt::format("half width {}, {}", si(hertz.half_width, "m"),
                                              si(hertz.max_pressure, "Pa"))});
  facts.push_back(
      {"Moes' chart", fmt::format("M = {}, L = {}: {}", plain(film_groups_of(problem).moes_load()),
                                  plain(film_groups_of(problem).moes_viscosity()),
                                  si(film_groups_of(problem).moes_min_film(), "m"))});
  facts.push_back(
      {"solved", fmt::format("{} iterations; load balanced to {:.1g}, mass to {:.1g}",
                             result.convergence.iterations, result.load_error, result.mass_error)});
  return facts;
}

void write_profile(io::Hdf5Writer& writer, const LineProblem& problem, const LineResult& result) {
  const reference::HertzLineContact hertz = hertz_of(problem);
  const Eigen::ArrayXd dry = result.x.unaryExpr([&](double x) { return hertz.pressure(x); });
  struct Curve {
    const char* path;
    const char* unit;
    const char* long_name;
    const Eigen::ArrayXd& values;
  };
  writer.group("/profile");
  for (const Curve& curve :
       {Curve{"/profile/x", "m", "position along the flow, from the line of closest approach",
              result.x},
        Curve{"/profile/pressure", "Pa", "pressure", result.pressure},
        Curve{"/profile/asperity_pressure", "Pa", "pressure of asperities",
              result.asperity_pressure},
        Curve{"/profile/film", "m", "film thickness", result.film},
        Curve{"/profile/shear_stress", "Pa", "shear stress of film and solids",
              result.shear_stress},
        Curve{"/profile/local_friction", "", "shear stress over pressure", result.local_friction},
        Curve{"/profile/hertz_pressure", "Pa", "pressure of the dry contact", dry}}) {
    if (curve.values.size() == 0) continue;  // no asperities
    const double* const begin = curve.values.data();
    writer.write(curve.path, std::vector<double>(begin, begin + curve.values.size()));
    writer.describe(curve.path, curve.unit, curve.long_name);
  }
  writer.nxdata("/profile", "film", {"x"});
  writer.attribute("/", "default", "profile");
}

/// Takes away the friction that nobody can know, and says why.
std::vector<std::string> void_friction(const LineProblem& problem, LineResult& result) {
  std::vector<std::string> warnings =
      ehl::void_friction(problem.lubricant.shear, problem.asperities,
                         {.max_pressure = result.pressure.maxCoeff(),
                          .solid_load_share = result.asperity_load_share,
                          .max_shear_stress = result.max_shear_stress,
                          .fluid = result.friction_fluid,
                          .solid = result.friction_solid,
                          .coefficient = result.friction_coefficient});
  if (!warnings.empty()) result.friction_force = result.friction_coefficient * problem.load;
  if (std::isnan(result.max_shear_stress)) {
    result.shear_stress.setConstant(kNone);
    result.local_friction.setConstant(kNone);
  }
  return warnings;
}

/// What one asperity changes, where the case has one: the film is solved without it, too.
std::optional<AsperityEffect> effect_of(const io::Config& config, const LineProblem& problem,
                                        const LineResult& result, const CaseSetting& setting) {
  const auto asperity = read_single_asperity(config);
  if (!asperity) return std::nullopt;
  LineProblem without = problem;
  without.roughness -= heights_of(*asperity, problem);
  LineResult smooth = solve_line(without, setting.observer);
  throw_if_stopped(smooth.convergence);
  void_friction(without, smooth);
  if (!smooth.convergence.converged()) {
    smooth.pressure.setConstant(kNone);
    smooth.local_friction.setConstant(kNone);
  }
  return asperity_effect(result, smooth, asperity->width, asperity->place);
}

io::Json effect_scalars(const AsperityEffect& effect) {
  return {{"local_friction", io::number(effect.local_friction)},
          {"local_friction_ratio", io::number(effect.friction_ratio())},
          {"max_pressure_Pa", io::number(effect.max_pressure)},
          {"pressure_ratio", io::number(effect.pressure_ratio())}};
}

Facts effect_facts(const AsperityEffect& effect) {
  return {{"on the asperity",
           fmt::format("local friction {}, {} times that without it", plain(effect.local_friction),
                       plain(effect.friction_ratio(), 3))},
          {"", fmt::format("pressure {}, {} times that without it", si(effect.max_pressure, "Pa"),
                           plain(effect.pressure_ratio(), 3))}};
}

void void_friction(WearResult& wear) {
  for (WearInstant& at : wear.history) at.friction_coefficient = kNone;
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  const LineProblem problem = read_problem(config, setting);
  LineResult result = solve_line(problem, setting.observer);
  throw_if_stopped(result.convergence);
  const std::vector<std::string> voids = void_friction(problem, result);
  CaseResult answer;
  answer.scalars = scalars_of(problem, result);
  answer.scalars.update(asperity_scalars(problem, result));
  answer.facts = {facts_of(problem, result)};
  if (const auto effect = effect_of(config, problem, result, setting)) {
    answer.scalars["single_asperity"] = effect_scalars(*effect);
    answer.facts.push_back(effect_facts(*effect));
  }
  answer.converged = result.convergence.converged();
  answer.warnings = result.warnings;
  answer.warnings.insert(answer.warnings.end(), voids.begin(), voids.end());
  if (!result.convergence.converged()) {
    answer.warnings.push_back(
        fmt::format("the film was not found ({}): more nodes, a lower load or less viscosity",
                    name_of(result.convergence.status)));
  }
  std::optional<WearResult> wear;
  if (config.has("wear.coefficient")) {
    wear = solve_wear(read_wear(config, problem), setting.observer);
    throw_if_stopped(wear->convergence);
    if (!voids.empty()) void_friction(*wear);
    answer.scalars["wear"] = wear_json(config, *wear);
    answer.facts.push_back(wear_facts(*wear));
    answer.warnings.insert(answer.warnings.end(), wear->warnings.begin(), wear->warnings.end());
    if (answer.converged) answer.scalars["status"] = name_of(wear->convergence.status);
    answer.converged = answer.converged && wear->convergence.converged();
    answer.scalars["converged"] = answer.converged;
    if (!wear->convergence.converged()) {
      answer.warnings.emplace_back("the film was lost while the track wore");
    }
  }
  answer.write = [problem, wear, result = std::move(result)](io::Hdf5Writer& writer) {
    write_profile(writer, problem, result);
    if (wear) write_wear(writer, *wear);
  };
  return answer;
}

/// By how much the peak of `tabor ehl line` grows.
std::size_t memory_of(const io::Config& config) {
  const auto n = static_cast<std::size_t>(integer_or(config, "grid.nodes", LineProblem{}.nodes));
  return sizeof(double) * n * n;
}

CaseKeys line_keys() {
  const LineProblem usual;
  const CaseKeys bodies = {
      {"cylinder.radius", "m", kRequired, "R, radius of the cylinder"},
      {"cylinder.load_per_length", "N/m", kRequired, "F, load over length"},
      {"motion.entrainment_speed", "m/s", kRequired, "u_m, mean speed of both surfaces"},
      {"motion.sliding_speed", "m/s", "0 m/s", "u_s, their difference, for friction"},
      {"motion.slide_to_roll_ratio", "", "of sliding_speed",
       "u_s/u_m, instead of sliding_speed: follows u_m in a sweep; 2: one body stands still"}};
  const CaseKeys film = {
      {"film.cavitation", "", "reynolds",
       "reynolds: p >= 0; penalty: a source -min(0, p)/eps in its place"},
      {"film.penalty", "", fmt::format("{}", usual.penalty),
       "1/eps in units of u_m over the pressure of Hertz"},
      {"grid.nodes", "", fmt::format("{}", usual.nodes), "along the flow"},
      {"grid.inlet", "m", "4 half widths and 10 sqrt(2 R h), h by Moes", "before the centre"},
      {"grid.outlet", "m", "1.5 half widths and 3 sqrt(2 R h)", "behind it"}};
  return joined(bodies, {solids_keys(), lubricant_keys("barus"), asperity_keys("nothing touches"),
                         line_roughness_keys(), wear_keys(), film});
}

}  // namespace

Program line_program() {
  return {.name = "line",
          .summary = "a film between a cylinder and a flat, smooth, rough, touching or worn",
          .keys = line_keys(),
          .example = {{"cylinder.radius", "\"2.5 mm\""},
                      {"cylinder.load_per_length", "\"5000 N/m\""},
                      {"motion.entrainment_speed", "\"7.9 mm/s\""},
                      {"motion.sliding_speed", "\"15.8 mm/s\""},
                      {"solids.youngs_modulus", "\"1.05 GPa\""},
                      {"solids.poissons_ratio", "0.35"},
                      {"lubricant.viscosity", "\"0.3638 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"5.9e-9 1/Pa\""}},
          .files = {"roughness.file"},
          .columns = {{"min_film_m", "smallest film", "m"},
                      {"central_film_m", "central film", "m"},
                      {"max_pressure_Pa", "largest pressure", "Pa"},
                      {"max_shear_stress_Pa", "largest stress", "Pa"},
                      {"friction_coefficient", "friction", ""},
                      {"friction_fluid", "of the film", "", true},
                      {"friction_solid", "of solids", "", true},
                      {"asperity_load_share", "asperities", "", true},
                      {"solid_contact_fraction", "contact", "", true},
                      {"single_asperity.local_friction", "local friction", "", true},
                      {"single_asperity.local_friction_ratio", "times smooth friction", "", true},
                      {"single_asperity.max_pressure_Pa", "pressure on it", "Pa", true},
                      {"single_asperity.pressure_ratio", "times smooth pressure", "", true},
                      {"newton_iterations", "iterations", ""},
                      {"wear.mean_depth_m", "mean wear", "m", true},
                      {"wear.max_depth_m", "deepest wear", "m", true},
                      {"wear.mass_kg", "worn mass [kg]", "", true},
                      {"wear.thinnest_film_m", "thinnest film", "m", true}},
          .studies = {{"grid", "grid.nodes", "nodes", "", {0.5, 1, 2}},
                      {"domain", "grid.inlet", "inlet_m", "m", {0.7, 1, 1.4, 2}, false}},
          .methods = {"moes1992", "evans2000", "johnson1985"},
          .solve = solve,
          .memory = memory_of};
}

}  // namespace tabor::ehl
