// Counts and times of the film on a periodic rough patch on one thread.
//
//   bench_fluid [PIXELS...]             (default 128 256 512)
//
// The gap of a self-affine surface that its plane is one rms height away from, filled by one half:
// changes of the sets of full and starved cells, products with the matrices of the full cells.
#include <fmt/core.h>

#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/reynolds/patch/patch_flow.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace {

using namespace tabor;

void print_row(Index pixels) {
  synthesis::SelfAffine recipe;
  recipe.grid = {pixels, pixels, 100e-6, 100e-6};
  recipe.rms_height = 0.5e-6;
  const Field height = synthesis::self_affine(recipe).height;
  reynolds::PatchProblem problem;
  problem.grid = recipe.grid;
  problem.gap = (0.5e-6 - height).max(0.0);
  problem.viscosity = 0.225;
  problem.entrainment_speed = 2.5e-3;
  problem.pressure_resolution = 100;
  const Stopwatch watch;
  const reynolds::PatchFilm film = reynolds::steady_film(problem, 0.5 * problem.gap);
  fmt::print("{:>6} {:>12.4g} {:>6} {:>10} {:>9} {:>8.2f}{}\n", pixels, film.mean_pressure,
             film.steps, film.convergence.iterations, film.convergence.operator_applications,
             watch.seconds(), film.convergence.converged() ? "" : " not converged");
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  std::vector<Index> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::stol(argv[i]));
  if (sizes.empty()) sizes = {128, 256, 512};
  fmt::print("{:>6} {:>12} {:>6} {:>10} {:>9} {:>8}\n", "pixels", "pressure Pa", "steps",
             "iterations", "products", "seconds");
  for (const Index pixels : sizes) print_row(pixels);
}
