#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/ehl/parameters.hpp"
#include "tabor/ehl/point/point.hpp"

// What a case of `tabor ehl point` may say.
namespace tabor::ehl {

inline constexpr double kMostAxes = 100;  ///< of the domain, in half axes of the dry contact

/// The finish that is no row of finishes(): grooves along one direction.
inline constexpr const char* kGround = "ground";
inline constexpr double kGroundRms = 0.15e-6;    ///< [m]
inline constexpr double kGrooveSpacing = 10e-6;  ///< [m]
inline constexpr double kUsualPixel = 784.3e-9;  ///< [m], of the surfaces of Redlich et al.
inline constexpr const char* kUsualTreatment = "level=plane";

/// How a surface lies.
enum class Orientation {
  longitudinal,  ///< x of a scan and grooves along the flow
  transverse     ///< turned by a quarter
};

/// [roughness]: a scan, a generated finish, a bump, or their sum.
struct PointRoughnessSettings {
  std::optional<std::string> file = {};     ///< a scan, from where the case lies
  std::optional<std::string> channel = {};  ///< of its heights
  std::optional<std::vector<std::string>> treatment = {};
  std::optional<std::string> kind = {};         ///< of a generated surface
  std::optional<double> rms = {};               ///< [m] of it
  std::optional<std::uint64_t> seed = {};       ///< of its random numbers
  std::optional<double> pixel = {};             ///< [m] of it
  std::optional<double> groove_spacing = {};    ///< [m] of a ground one
  std::optional<Orientation> orientation = {};  ///< absent: longitudinal
  std::vector<double> place = {};  ///< [m] of the middle, along and across; empty: the centre
  std::optional<double> bump_height = {};      ///< [m]
  std::optional<double> bump_wavelength = {};  ///< [m] of its rings
  std::vector<double> bump_place = {};         ///< [m] as `place`

  /// True where a surface is rough.
  bool is_rough() const { return file || kind || bump_height; }
};

/// A ball or an ellipsoid on a flat with a film between.
struct PointSettings {
  std::optional<double> radius = {};             ///< R [m] of a ball
  std::optional<double> radius_x = {};           ///< [m] along the flow, instead
  std::optional<double> radius_y = {};           ///< [m] across it
  std::optional<double> load = {};               ///< w [N]
  std::optional<double> moes_load = {};          ///< M, with L in place of load and speed
  std::optional<double> moes_viscosity = {};     ///< L
  std::optional<double> plastic_pressure = {};   ///< P_plast [Pa]; absent: elastic
  std::optional<double> speed = {};              ///< [m/s] of the ball over a flat at rest
  std::optional<double> entrainment_speed = {};  ///< u_m [m/s], instead
  std::optional<double> sliding_speed = {};      ///< u_s [m/s]
  std::optional<double> duration = {};           ///< [s] of a moving roughness; absent: steady
  SolidSettings solids = {};
  LubricantSettings lubricant = {.viscosity_law = material::ViscosityLaw::roelands};
  ShearSettings shear = {};
  AsperitySettings asperities = {.boundary_film = PointProblem{}.asperities.boundary_film};
  PointRoughnessSettings roughness = {};
  std::optional<std::uint64_t> nodes_x = {};  ///< along the flow
  std::optional<std::uint64_t> nodes_y = {};  ///< across it
  std::optional<std::uint64_t> nodes = {};    ///< along the flow; those across in proportion
  double inlet = PointProblem{}.inlet;        ///< [half axes of the dry contact]
  double outlet = PointProblem{}.outlet;
  double half_width = PointProblem{}.half_width;
  std::optional<double> domain = {1.0};  ///< factor on inlet and half width; none: automatic
  std::optional<double> time_step = {};  ///< [s], the longest under a moving roughness

  /// True where [groups] stands in place of load and speed.
  bool has_groups() const { return moes_load || moes_viscosity; }
};

const Parameters<PointSettings>& point_parameters();

/// Reads the settings of a case. Throws InputError, with file, line and key, for invalid ones.
PointSettings read_point_settings(const io::Config& file);

}  // namespace tabor::ehl
