// Counts and times of contacts with trapped liquid, beside those of the same contacts without.
//
//   bench_trapped [n...] [--density G_PER_M2] [--threads N]
//
// EDT surfaces of n x n pixels with p_sat = 240 MPa and oil that was rained on them. Prints one row
// per pressure: FFT pairs and pockets are deterministic; seconds and their ratio are not.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tabor/contact/trapped_liquid.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/material/solid.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace {

using namespace tabor;

constexpr double kOilDensity = 900;  // [kg/m^3]

struct Wetted {
  topography::Topography surface;
  Field film;
};

Wetted make_wetted(Index n, double density) {
  synthesis::Edt recipe;
  recipe.grid = {n, n, static_cast<double>(n) * 0.67e-6, static_cast<double>(n) * 0.67e-6};
  topography::Topography surface = synthesis::edt(recipe);
  deposition::Dose dose;
  dose.mean_films = {density / kOilDensity};
  Field film = deposition::deposit(surface.height, surface.grid, dose).front().thickness;
  return {std::move(surface), std::move(film)};
}

void run(const Wetted& wetted, double pressure) {
  const Grid& grid = wetted.surface.grid;
  const auto elasticity = elastic::make_periodic(grid, material::effective_modulus({70e9, 0.33}));
  const contact::Problem problem{.height = wetted.surface.height,
                                 .control = contact::MeanPressure{pressure},
                                 .bounds = {.upper = 240e6}};
  const Stopwatch dry_watch;
  const contact::State dry = contact::solve(*elasticity, problem);
  const double dry_seconds = dry_watch.seconds();
  const Stopwatch watch;
  const contact::TrappedState state =
      contact::solve_trapped(*elasticity, problem, {.film = wetted.film}, dry);
  const double seconds = watch.seconds();
  const Convergence& found = state.contact.convergence;
  fmt::print(
      "{:>5} {:>6.3g} {:>6.1f} {:>8.1f} {:>7} {:>8} {:>7} {:>8.4f} {:>8.1e} {:>5} {:>7.2f} "
      "{:>8.2f} {:>6.2f}\n",
      grid.nx, pressure / 1e6, dry.convergence.fft_pairs, found.fft_pairs, state.liquid.seal_rounds,
      state.liquid.n_pockets, state.liquid.n_squeezed, state.liquid.load_share, found.certificate,
      found.converged() ? "yes" : "NO", dry_seconds, seconds, seconds / dry_seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Index> sizes;
  double density = 0.45e-3;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--density" && i + 1 < argc) {
      density = 1e-3 * std::stod(argv[++i]);
    } else if (word == "--threads" && i + 1 < argc) {
      set_thread_count(std::stoi(argv[++i]));
    } else {
      sizes.push_back(std::stol(word));
    }
  }
  if (sizes.empty()) sizes = {512, 1024};
  fmt::print("{:>5} {:>6} {:>6} {:>8} {:>7} {:>8} {:>7} {:>8} {:>8} {:>5} {:>7} {:>8} {:>6}\n", "n",
             "P/MPa", "pairs", "trapped", "rounds", "pockets", "press.", "share", "cert", "conv",
             "s", "trapped", "ratio");
  for (const Index n : sizes) {
    const Wetted wetted = make_wetted(n, density);
    for (const double pressure : {2e6, 5e6, 10e6, 15e6}) run(wetted, pressure);
  }
}
