#include "tabor/cases/ehl/line_parameters.hpp"

#include <fmt/format.h>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/core/names.hpp"
#include "tabor/record/settings_file.hpp"

namespace tabor::ehl {

namespace {

constexpr auto kCavitations = names<LineCavitation>("reynolds", "penalty");
const Bounds kNodes{.least = 3, .text = "3 or more"};
const Bounds kOneOrMore{.least = 1, .text = "1 or more"};

Parameters<LineSettings> body_parameters() {
  using Settings = LineSettings;
  using One = Parameter<Settings>;
  return {One({.name = "cylinder.radius",
               .help = "R, radius of the cylinder",
               .example = "2.5 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::radius),
          One({.name = "cylinder.load_per_length",
               .help = "F, load over length",
               .example = "5000 N/m",
               .dimension = dimension::force_per_length,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::load),
          One({.name = "motion.entrainment_speed",
               .help = "u_m, mean speed of both surfaces",
               .example = "7.9 mm/s",
               .dimension = dimension::speed,
               .bounds = kAboveZero,
               .needed = Needed::yes},
              &Settings::entrainment_speed),
          One({.name = "motion.sliding_speed",
               .help = "u_s, their difference, for friction",
               .example = "15.8 mm/s",
               .dimension = dimension::speed,
               .absent = "0 m/s"},
              &Settings::sliding_speed),
          One({.name = "motion.slide_to_roll_ratio",
               .help = "u_s/u_m, instead of sliding_speed: follows u_m in a sweep; 2: one body "
                       "stands still",
               .example = "2",
               .absent = "from sliding_speed"},
              &Settings::slide_to_roll_ratio)};
}

Parameters<LineRoughnessSettings> roughness_parameters() {
  using Settings = LineRoughnessSettings;
  using One = Parameter<Settings>;
  return {One({.name = "roughness.height",
               .help = "of one asperity, height cos^2(pi (x - place)/width)",
               .example = "100 nm",
               .dimension = dimension::length,
               .absent = "no asperity"},
              &Settings::height),
          One({.name = "roughness.width",
               .help = "of the asperity",
               .example = "100 um",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "required beside height"},
              &Settings::width),
          One({.name = "roughness.place",
               .help = "of the asperity, from the centre",
               .dimension = dimension::length},
              &Settings::place),
          One({.name = "roughness.amplitude",
               .help = "of waves, amplitude sin(2 pi x/wavelength)",
               .example = "50 nm",
               .dimension = dimension::length,
               .absent = "no waves"},
              &Settings::amplitude),
          One({.name = "roughness.wavelength",
               .help = "of the waves",
               .example = "100 um",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "required beside amplitude"},
              &Settings::wavelength),
          One({.name = "roughness.file",
               .help = "a row of a scan, levelled over the domain, as long as that or longer, no "
                       "holes",
               .example = "scan.x3p",
               .absent = "no scan"},
              &Settings::file),
          One({.name = "roughness.row",
               .help = "of the scan, counted from 0",
               .example = "0",
               .absent = "the middle one"},
              &Settings::row)};
}

Parameters<WearSettings> wear_parameters() {
  using Settings = WearSettings;
  using One = Parameter<Settings>;
  return {One({.name = "wear.coefficient",
               .help = "kw, worn volume over load and distance",
               .example = "1e-15 m^2/N",
               .dimension = dimension::per_pressure,
               .unit = "m^2/N",
               .bounds = kAboveZero,
               .absent = "no wear"},
              &Settings::coefficient),
          One({.name = "wear.track_length",
               .help = "of a track that runs with the sliding speed",
               .example = "20 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "required, unless stroke is given"},
              &Settings::track_length),
          One({.name = "wear.stroke",
               .help = "the track goes to and fro as a sine with the speeds of [motion] in its "
                       "middle",
               .example = "1 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "runs one way"},
              &Settings::stroke),
          One({.name = "wear.steps", .help = "of time per cycle", .bounds = kOneOrMore},
              &Settings::steps),
          One({.name = "wear.cycles", .help = "computed cycles", .bounds = kOneOrMore},
              &Settings::cycles),
          One({.name = "wear.cycles_each",
               .help = "what each computed cycle stands for",
               .bounds = kOneOrMore},
              &Settings::cycles_each),
          One({.name = "wear.density",
               .help = "of the worn body; with width it gives the worn mass",
               .example = "950 kg/m^3",
               .dimension = dimension::density,
               .bounds = kAboveZero,
               .absent = "no mass"},
              &Settings::density),
          One({.name = "wear.width",
               .help = "of the track",
               .example = "1 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "no mass"},
              &Settings::width),
          One({.name = "wear.wave_amplitude",
               .help = "of waves of the unworn track",
               .example = "10 nm",
               .dimension = dimension::length,
               .absent = "smooth"},
              &Settings::wave_amplitude),
          One({.name = "wear.waves",
               .help = "a whole number of them",
               .example = "20",
               .absent = "required beside wave_amplitude"},
              &Settings::waves)};
}

Parameters<LineSettings> film_parameters() {
  using Settings = LineSettings;
  using One = Parameter<Settings>;
  return {One({.name = "film.cavitation",
               .help = "reynolds: p >= 0; penalty: a source -min(0, p)/eps in its place"},
              &Settings::cavitation, kCavitations),
          One({.name = "film.penalty",
               .help = "1/eps in units of u_m over the pressure of Hertz",
               .bounds = kAboveZero},
              &Settings::penalty),
          One({.name = "grid.nodes", .help = "along the flow", .bounds = kNodes}, &Settings::nodes),
          One({.name = "grid.inlet",
               .help = "before the centre",
               .example = "1 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "4 half widths and 10 sqrt(2 R h), at least 30 sqrt(2 R h), h by Moes"},
              &Settings::inlet),
          One({.name = "grid.outlet",
               .help = "behind it",
               .example = "0.5 mm",
               .dimension = dimension::length,
               .bounds = kAboveZero,
               .absent = "1.5 half widths and 3 sqrt(2 R h)"},
              &Settings::outlet)};
}

constexpr LoneKey kLoneLineKeys[] = {{"roughness.width", "roughness.height"},
                                     {"roughness.place", "roughness.height"},
                                     {"roughness.wavelength", "roughness.amplitude"},
                                     {"roughness.row", "roughness.file"},
                                     {"wear.track_length", "wear.coefficient"},
                                     {"wear.stroke", "wear.coefficient"},
                                     {"wear.steps", "wear.coefficient"},
                                     {"wear.cycles", "wear.coefficient"},
                                     {"wear.cycles_each", "wear.coefficient"},
                                     {"wear.density", "wear.coefficient"},
                                     {"wear.width", "wear.coefficient"},
                                     {"wear.wave_amplitude", "wear.coefficient"},
                                     {"wear.waves", "wear.wave_amplitude"},
                                     {"film.penalty", "film.cavitation"}};

}  // namespace

const Parameters<LineSettings>& line_parameters() {
  using Settings = LineSettings;
  static const Parameters<Settings> all =
      joined(body_parameters(), {within(solid_parameters(), &Settings::solids),
                                 within(lubricant_parameters(), &Settings::lubricant),
                                 within(asperity_parameters(), &Settings::asperities),
                                 within(roughness_parameters(), &Settings::roughness),
                                 within(wear_parameters(), &Settings::wear), film_parameters()});
  return all;
}

LineSettings read_line_settings(const io::Config& file) {
  LineSettings settings;
  read_settings(file, line_parameters(), settings);
  reject_lone(file, kLoneLineKeys);
  return settings;
}

namespace {

/// In a profile, without a boundary film nothing touches.
Asperities line_asperities(const AsperitySettings& settings, const io::Config& file) {
  const bool has_friction = settings.friction_coefficient || settings.shear_strength;
  if (has_friction && !settings.boundary_film) {
    throw InputError(
        file.place("asperities"), "no boundary_film", "how near the solids come, such as 10 nm",
        "in a profile, solids without a film between would stop the liquid, which lifts them");
  }
  return asperities_of(settings, file);
}

/// [m/s]: as given, or as a part of the mean speed, with which it then changes; 0 if neither.
double sliding_speed(const LineSettings& settings, const io::Config& file) {
  if (!settings.sliding_speed) {
    return settings.slide_to_roll_ratio.value_or(0) * settings.entrainment_speed;
  }
  if (settings.slide_to_roll_ratio) {
    reject_beside(file, "motion.slide_to_roll_ratio", "sliding_speed");
  }
  return *settings.sliding_speed;
}

LineProblem smooth_problem(const LineSettings& settings, const io::Config& file) {
  LineProblem problem;
  problem.radius = settings.radius;
  problem.load = settings.load;
  problem.effective_modulus = effective_modulus(settings.solids, file);
  problem.lubricant = lubricant_of(settings.lubricant, file);
  problem.entrainment_speed = settings.entrainment_speed;
  problem.sliding_speed = sliding_speed(settings, file);
  problem.cavitation = settings.cavitation;
  problem.penalty = settings.penalty;
  problem.nodes = static_cast<Index>(settings.nodes);
  problem.inlet = settings.inlet.value_or(0);
  problem.outlet = settings.outlet.value_or(0);
  problem.asperities = line_asperities(settings.asperities, file);
  check_line(problem);
  return problem;
}

/// One row of a scan [m]; the file's place is relative to the case's.
Eigen::ArrayXd row_of_scan(const LineRoughnessSettings& settings, const io::Config& file,
                           const LineProblem& problem, const CaseSetting& setting) {
  const Surface scan = with_source(file, "roughness.file", setting)
                           .read({.file = named_file(file, "roughness.file")}, setting.observer);
  const auto n_rows = static_cast<std::uint64_t>(scan.grid.ny);
  const std::uint64_t row = settings.row.value_or(n_rows / 2);
  if (row >= n_rows) {
    throw InputError(file.place("roughness.row"), fmt::format("{}", row),
                     fmt::format("0 to {}", n_rows - 1), "");
  }
  return at_key(file, "roughness.file", [&] {
    return line_profile(problem, scan.height.row(static_cast<Index>(row)).transpose(),
                        scan.grid.dx());
  });
}

std::optional<SingleAsperity> single_asperity(const LineRoughnessSettings& settings,
                                              const io::Config& file) {
  if (!settings.height) return std::nullopt;
  return SingleAsperity{.height = *settings.height,
                        .width = required(settings.width, file, "roughness.width"),
                        .place = settings.place};
}

Eigen::ArrayXd roughness_of(const LineRoughnessSettings& settings, const io::Config& file,
                            const LineProblem& problem, const CaseSetting& setting) {
  Eigen::ArrayXd roughness;
  const auto add = [&](const Eigen::ArrayXd& heights) {
    if (roughness.size() == 0) roughness.setZero(heights.size());
    roughness += heights;
  };
  if (const auto asperity = single_asperity(settings, file)) add(asperity->heights(problem));
  if (settings.amplitude) {
    add(line_waves(problem, *settings.amplitude,
                   required(settings.wavelength, file, "roughness.wavelength")));
  }
  if (settings.file) add(row_of_scan(settings, file, problem, setting));
  return roughness;
}

}  // namespace

Eigen::ArrayXd SingleAsperity::heights(const LineProblem& problem) const {
  return line_asperity(problem, height, width, place);
}

std::optional<SingleAsperity> read_single_asperity(const io::Config& file) {
  return single_asperity(read_line_settings(file).roughness, file);
}

LineProblem read_smooth_line(const io::Config& file) {
  return smooth_problem(read_line_settings(file), file);
}

LineProblem read_line(const io::Config& file, const CaseSetting& setting) {
  const LineSettings settings = read_line_settings(file);
  LineProblem problem = smooth_problem(settings, file);
  // The nodes of the roughness are those of a checked problem.
  problem.roughness = roughness_of(settings.roughness, file, problem, setting);
  return problem;
}

WearProblem read_wear(const io::Config& file, const LineProblem& contact) {
  const WearSettings settings = read_line_settings(file).wear;
  if (contact.roughness.size() > 0) {
    throw InputError(file.place("wear.coefficient"), "beside a roughness that stands still",
                     "one of the two", "wear.wave_amplitude makes the track rough");
  }
  if (settings.density && !settings.width) reject_without(file, "wear.density", "wear.width");
  if (settings.width && !settings.density) reject_without(file, "wear.width", "wear.density");
  WearProblem problem;
  problem.contact = contact;
  problem.wear_coefficient = required(settings.coefficient, file, "wear.coefficient");
  problem.stroke = settings.stroke.value_or(0);
  if (!settings.stroke || settings.track_length) {
    problem.track_length = required(settings.track_length, file, "wear.track_length");
  }
  problem.steps_per_cycle = static_cast<Index>(settings.steps);
  problem.cycles = static_cast<Index>(settings.cycles);
  problem.cycles_each = settings.cycles_each;
  if (settings.wave_amplitude) {
    problem.wave_amplitude = *settings.wave_amplitude;
    problem.n_waves = static_cast<Index>(required(settings.waves, file, "wear.waves"));
  }
  return problem;
}

}  // namespace tabor::ehl
