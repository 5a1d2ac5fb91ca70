// Counts and times of the contact solvers on generated surfaces.
//
//   bench_contact [n] [--baseline] [--surface edt|self-affine] [--threads N] [--seed S]
//
// Prints one row per case: solver iterations, operator applications and FFT pairs are
// deterministic; seconds and their ratios are not. s/pair: solver time over the time of one
// double-precision transform pair of the same size, measured in the same run. B/px: peak memory of
// the process so far, which holds the heights twice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/material/solid.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/synthesis.hpp"

namespace {

using namespace tabor;

struct Options {
  Index n = 1024;
  bool baseline = false;
  std::string surface = "all";
  std::uint64_t seed = 1;
};

struct Case {
  std::string name;
  std::shared_ptr<const Field> height;
  Grid grid;
  double saturation_pressure;
  std::vector<double> mean_pressures;
};

double rms_slope(const Field& z, const Grid& grid) {
  const auto dx = (z.rightCols(grid.nx - 1) - z.leftCols(grid.nx - 1)) / grid.dx();
  const auto dy = (z.bottomRows(grid.ny - 1) - z.topRows(grid.ny - 1)) / grid.dy();
  return std::sqrt(dx.square().mean() + dy.square().mean());
}

Grid edt_grid(Index n) {
  const double side = static_cast<double>(n) * 0.67e-6;
  return {n, n, side, side};
}

/// Aluminium of the seed paper: E 70 GPa, nu 0.33.
double aluminium() { return material::effective_modulus({70e9, 0.33}); }

std::vector<Case> cases(const Options& options) {
  std::vector<Case> list;
  const Grid grid = edt_grid(options.n);
  if (options.surface != "self-affine") {
    topography::Edt recipe;
    recipe.grid = grid;
    recipe.seed = options.seed;
    const auto height = std::make_shared<const Field>(topography::edt(recipe).height);
    list.push_back({"edt saturated", height, grid, 240e6, {2e6, 5e6, 10e6, 15e6}});
    const double unit = aluminium() * rms_slope(*height, grid);  // A/A0 ~ 2 P / (E* rms slope)
    list.push_back({"edt elastic",
                    height,
                    grid,
                    contact::kNoSaturation,
                    {0.0025 * unit, 0.01 * unit, 0.025 * unit}});
  }
  if (options.surface != "edt") {
    topography::SelfAffine recipe;
    recipe.grid = grid;
    recipe.rms_slope = 1.0;
    recipe.roll_off_wavelength = grid.lx / 4;
    recipe.short_cutoff_wavelength = 4 * 2 * grid.dx();
    recipe.seed = options.seed;
    const auto height = std::make_shared<const Field>(topography::self_affine(recipe).height);
    const double unit = aluminium();
    list.push_back({"self-affine elastic",
                    height,
                    grid,
                    contact::kNoSaturation,
                    {0.0025 * unit, 0.01 * unit, 0.025 * unit, 0.1 * unit}});
  }
  return list;
}

double seconds_of_pair(Index n) {
  const spectral::RealFft2d<double> fft(n, n);
  Field map = Field::Random(n, n);
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(n * (n / 2 + 1)));
  double best = 1e9;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Stopwatch watch;
    fft.forward(map.data(), spectrum.data());
    fft.inverse(spectrum.data(), map.data());
    best = std::min(best, watch.seconds());
  }
  return best;
}

void run(const Case& item, double mean_pressure, contact::Solver solver, double pair_seconds) {
  const auto elasticity = elastic::make_periodic(item.grid, aluminium());
  contact::Problem problem;
  problem.height = *item.height;
  problem.mean_pressure = mean_pressure;
  problem.saturation_pressure = item.saturation_pressure;
  const Stopwatch watch;
  const contact::State state = contact::solve(*elasticity, problem, solver);
  const double seconds = watch.seconds();
  const double area = contact::contact_mask(state).cast<double>().mean();
  fmt::print(
      "{:<20} {:<13} {:>8.3g} {:>8.4f} {:>6} {:>6} {:>8.2f} {:>9.2e} {:>5} {:>8.2f} {:>8.1f} "
      "{:>7.1f}\n",
      item.name, solver == contact::Solver::fast ? "fast" : "polonsky-keer", mean_pressure / 1e6,
      100 * area, state.convergence.iterations, state.convergence.operator_applications,
      state.convergence.fft_pairs, state.convergence.certificate,
      state.convergence.converged ? "yes" : "NO", seconds, seconds / pair_seconds,
      static_cast<double>(peak_memory_bytes()) / static_cast<double>(item.grid.size()));
  std::fflush(stdout);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--baseline") {
      options.baseline = true;
    } else if (word == "--surface" && i + 1 < argc) {
      options.surface = argv[++i];
    } else if (word == "--threads" && i + 1 < argc) {
      set_thread_count(std::stoi(argv[++i]));
    } else if (word == "--seed" && i + 1 < argc) {
      options.seed = std::stoull(argv[++i]);
    } else {
      options.n = std::stol(word);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const double pair = seconds_of_pair(options.n);
  fmt::print("n = {}, {} threads, seed {}, double FFT pair {:.3f} s\n", options.n, thread_count(),
             options.seed, pair);
  fmt::print("{:<20} {:<13} {:>8} {:>8} {:>6} {:>6} {:>8} {:>9} {:>5} {:>8} {:>8} {:>7}\n",
             "surface", "solver", "P [MPa]", "area [%]", "iter", "S p", "pairs", "certif.", "conv",
             "seconds", "s/pair", "B/px");
  for (const Case& item : cases(options)) {
    for (const double mean_pressure : item.mean_pressures) {
      run(item, mean_pressure, contact::Solver::fast, pair);
      if (options.baseline) {
        run(item, mean_pressure, contact::Solver::polonsky_keer, pair);
      }
    }
  }
  return 0;
}
