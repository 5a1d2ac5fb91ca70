// From a scan of a sheet with oil on it to its friction: examples/05_scan_to_friction in C++.
// usage: scan_to_friction surfaces/edt_before.x3p
#include <cstdio>
#include <exception>
#include <set>
#include <string>

#include "tabor/tabor.hpp"

namespace {

/// Sheet and oil of examples/05_scan_to_friction.
tabor::cases::CaseSettings sheet_with_oil() {
  return {.mean_pressures = {2e6, 10e6},  // [Pa]
          .contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33, .saturation_pressure = 240e6},
          .film = {.lubricant_densities = {0.45e-3, 0.9e-3}},  // [kg/m^2]
          .friction = {.shear_strength = 70e6}};
}

int run(const char* file) {
  tabor::io::isolate_hdf5_reading(true);  // files of unknown origin do no harm
  tabor::io::trap_lost_pages(true);
  const auto surface = tabor::topography::apply({"level=plane"}, tabor::scan::read(file));
  int code = 0;
  std::set<std::string> reasons;  // to doubt the numbers
  const auto show = [&](const tabor::study::FrictionState& state) {
    const tabor::cases::FrictionRecord& one = state.friction;
    std::printf(
        "%g MPa, %g g/m^2: contact %.3g %%, wet share %.3g %%, friction dry %.4f, wet %.4f\n",
        1e-6 * one.mean_pressure, 1e3 * one.lubricant_density, 100 * one.contact_area_fraction,
        100 * one.lubricated_share, one.friction_dry, one.friction_lubricated);
    for (const tabor::Warning& warning : one.warnings) reasons.insert(warning.text);
    if (!one.converged) code = 4;
  };
  tabor::study::friction_of(surface, sheet_with_oil(), show, tabor::study::ContactMaps::dropped);
  for (const std::string& reason : reasons) std::printf("warning: %s\n", reason.c_str());
  return code;
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
