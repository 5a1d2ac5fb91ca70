#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tabor/cases/ehl/parameters.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/ehl/line/line.hpp"
#include "tabor/ehl/line/wear.hpp"

// What a case of `tabor ehl line` may say.
namespace tabor::ehl {

/// [roughness]: an asperity (height, width, place), waves (amplitude, wavelength), a row of a scan
/// (file, row), or their sum.
struct LineRoughnessSettings {
  std::optional<double> height = {};      ///< [m] of one asperity
  std::optional<double> width = {};       ///< [m] of it
  double place = 0;                       ///< [m] of it
  std::optional<double> amplitude = {};   ///< [m] of waves
  std::optional<double> wavelength = {};  ///< [m] of them
  std::optional<std::string> file = {};   ///< a scan, from where the case lies
  std::optional<std::uint64_t> row = {};  ///< of it; absent: the middle one
};

/// [wear]: a track that is worn, unless it has no coefficient.
struct WearSettings {
  std::optional<double> coefficient = {};     ///< kw [m^2/N]
  std::optional<double> track_length = {};    ///< [m]
  std::optional<double> stroke = {};          ///< [m]; absent: the track runs one way
  std::uint64_t steps = 600;                  ///< of time per cycle
  std::uint64_t cycles = 1;                   ///< computed
  double cycles_each = 1;                     ///< what each computed cycle stands for
  std::optional<double> density = {};         ///< [kg/m^3] of the worn body
  std::optional<double> width = {};           ///< [m] of the track
  std::optional<double> wave_amplitude = {};  ///< [m] of the unworn track
  std::optional<std::uint64_t> waves = {};    ///< on it
};

/// A cylinder on a flat with a film between.
struct LineSettings {
  double radius = 0;                               ///< R [m]
  double load = 0;                                 ///< F [N/m]
  double entrainment_speed = 0;                    ///< u_m [m/s]
  std::optional<double> sliding_speed = {};        ///< u_s [m/s], or by the ratio
  std::optional<double> slide_to_roll_ratio = {};  ///< u_s/u_m
  SolidSettings solids = {};
  LubricantSettings lubricant = {};  ///< under Barus' law unless it says otherwise
  AsperitySettings asperities = {};
  LineRoughnessSettings roughness = {};
  WearSettings wear = {};
  LineCavitation cavitation = LineCavitation::reynolds;
  double penalty = LineProblem{}.penalty;
  std::uint64_t nodes = static_cast<std::uint64_t>(LineProblem{}.nodes);
  std::optional<double> inlet = {};   ///< [m]
  std::optional<double> outlet = {};  ///< [m]
};

const Parameters<LineSettings>& line_parameters();

/// Reads the settings of a case. Throws InputError, with file, line and key, for invalid ones.
LineSettings read_line_settings(const io::Config& file);

/// Reads the problem without its roughness.
LineProblem read_smooth_line(const io::Config& file);
/// Reads the problem with its roughness.
LineProblem read_line(const io::Config& file, const CaseSetting& setting);

/// One asperity of [roughness].
struct SingleAsperity {
  double height = 0;  ///< [m]
  double width = 0;   ///< [m]
  double place = 0;   ///< [m]

  /// Heights [m] at the nodes of a problem.
  Eigen::ArrayXd heights(const LineProblem& problem) const;
};
/// The asperity, if the case has one.
std::optional<SingleAsperity> read_single_asperity(const io::Config& file);

/// [wear]: a track that runs under the cylinder, round and round or to and fro. Throws InputError
/// beside a roughness that stands still.
WearProblem read_wear(const io::Config& file, const LineProblem& contact);

}  // namespace tabor::ehl
