// From a scan of a sheet with oil on it to its friction: examples/05_scan_to_friction in C++.
// usage: scan_to_friction surfaces/edt_before.x3p
#include <cstdio>
#include <exception>

#include "tabor/tabor.hpp"

namespace {

constexpr double kSaturation = 240e6;    // [Pa] cap on the contact pressure
constexpr double kShearStrength = 70e6;  // [Pa] of the dry contact
constexpr double kTouch = 10e6;          // [Pa] mean pressure
constexpr double kDensity = 0.45e-3;     // [kg/m^2] oil as dosed
constexpr double kOilDensity = 900;      // [kg/m^3]

int run(const char* file) {
  tabor::io::isolate_hdf5_reading(true);  // files of unknown origin do no harm
  tabor::io::trap_lost_pages(true);
  const auto surface =
      tabor::topography::apply({"level=plane", "lowpass=hann:128/L"}, tabor::scan::read(file));
  const double modulus = tabor::material::effective_modulus({70e9, 0.33});
  const tabor::contact::Problem problem{
      .height = surface.height, .mean_pressure = kTouch, .saturation_pressure = kSaturation};
  const auto elasticity = tabor::elastic::make_periodic(surface.grid, modulus);
  const auto state = tabor::contact::solve(*elasticity, problem);
  const auto summary = tabor::contact::summarise(state, problem, surface.grid, true);

  const tabor::deposition::Dose dose{
      .mean_films = {tabor::deposition::mean_film(kDensity, kOilDensity)}};
  const auto film = tabor::deposition::deposit(surface.height, surface.grid, dose).front();
  const double wet =
      tabor::friction::lubricated_share(tabor::contact::contact_mask(state), film.thickness);
  const auto friction =
      tabor::friction::estimate({kTouch, summary.contact_area_fraction,
                                 summary.contact_area_fraction_pixels, kSaturation, wet},
                                kShearStrength);

  std::printf("contact %.3g %%, wet share %.3g %%, friction dry %.4f, wet %.4f\n",
              100 * friction.area_fraction, 100 * wet, friction.friction_dry,
              friction.friction_lubricated);
  std::printf("certificate %.1e\n", state.convergence.certificate);
  return state.convergence.certificate <= problem.tolerance ? 0 : 4;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return argc == 2 ? run(argv[1]) : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_to_friction: %s\n", error.what());
    return 3;
  }
}
