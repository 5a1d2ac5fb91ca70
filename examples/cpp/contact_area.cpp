// The real contact area of a generated rough surface under a light load, between the two closed
// forms of A / A0 = kappa P / (E* rms slope): Persson's and that of asperity theory.
#include <cstdio>
#include <exception>

#include "tabor/tabor.hpp"

namespace {

int run() {
  tabor::synthesis::SelfAffine recipe;
  recipe.grid = {512, 512, 1e-3, 1e-3};  // pixels, and sides [m]
  recipe.rms_slope = 0.1;
  recipe.roll_off_wavelength = 125e-6;     // [m]: eight waves a side
  recipe.short_cutoff_wavelength = 31e-6;  // [m]: 16 pixels a wave resolve the contact
  const tabor::topography::Topography surface = tabor::synthesis::self_affine(recipe);

  const double modulus = tabor::material::effective_modulus({70e9, 0.33});  // aluminium: E, nu
  const double light = 0.02 * modulus * *recipe.rms_slope;                  // [Pa]
  const tabor::contact::Problem problem{.height = surface.height,
                                        .control = tabor::contact::MeanPressure{light}};
  const auto elasticity = tabor::elastic::make_periodic(surface.grid, modulus);
  const auto state = tabor::contact::solve(*elasticity, problem);
  const auto summary = tabor::contact::summarise(state, problem, surface.grid, surface.periodic);

  const double kappa = summary.contact_area_fraction / 0.02;
  std::printf("pressure      %.3g MPa\n", light * 1e-6);
  std::printf("contact area  %.3f %%\n", 100 * summary.contact_area_fraction);
  std::printf("kappa         %.2f, between %.2f and %.2f\n", kappa, tabor::reference::kKappaPersson,
              tabor::reference::kKappaBushGibsonThomas);
  std::printf("certificate   %.1e, asked for %.0e\n", state.convergence.certificate,
              problem.tolerance);
  const bool converged = state.convergence.certificate <= problem.tolerance;
  const bool agrees =
      tabor::reference::kKappaPersson < kappa && kappa < tabor::reference::kKappaBushGibsonThomas;
  return converged && agrees ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_area: %s\n", error.what());
    return 3;
  }
}
