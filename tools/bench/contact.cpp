// Counts and times of the contact solvers on generated surfaces.
//
//   bench_contact [n] [--baseline] [--surface edt|self-affine|ground|cut-out] [--threads N]
//                 [--seed S] [--loads X,X...]   elastic only, at these P / (E* rms slope)
//
// cut-out: the mirror images of a quarter, solved as a whole map and on one image.
//
// Prints one row per case: solver iterations, operator applications and FFT pairs are
// deterministic; seconds and their ratios are not. s/pair: solver time over the time of one
// double-precision transform pair of the same size, measured in the same run. t/fft: solver time
// over that of its own pairs, as single-precision convolutions measured in the same run. B/px: peak
// memory of the process so far, the making of the surface included.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/material/solid.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace {

using namespace tabor;

struct Options {
  Index n = 1024;
  bool baseline = false;
  std::string surface = "all";
  std::uint64_t seed = 1;
  std::vector<double> loads;  // P / (E* rms slope)
};

struct Load {
  std::string name;
  double mean_pressure;
  double saturation_pressure;
};

struct Surface {
  Grid grid;
  contact::Problem problem;  // holds the heights
  std::vector<Load> loads;
};

/// Best times of one pair of transforms of an n x n map [s].
struct PairSeconds {
  double plain;  // double precision, forward and inverse
  double fused;  // single precision convolution by the elastic operator
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

/// A/A0 ~ 2 P / (E* rms slope) for light loads.
void add_elastic_loads(Surface& surface, const std::string& name, double unit,
                       const Options& options, const std::vector<double>& usual) {
  for (const double load : options.loads.empty() ? usual : options.loads) {
    surface.loads.push_back({name, load * unit, contact::kNoSaturation});
  }
}

Surface edt_surface(const Options& options) {
  synthesis::Edt recipe;
  recipe.grid = edt_grid(options.n);
  recipe.seed = options.seed;
  Surface surface{recipe.grid, {}, {}};
  surface.problem.height = synthesis::edt(recipe).height;
  for (const double pressure : {2e6, 5e6, 10e6, 15e6}) {
    if (options.loads.empty()) surface.loads.push_back({"edt saturated", pressure, 240e6});
  }
  const double unit = aluminium() * rms_slope(surface.problem.height, surface.grid);
  add_elastic_loads(surface, "edt elastic", unit, options, {0.0025, 0.01, 0.025});
  return surface;
}

/// A quarter of the edt surface, continued by its mirror images; `whole` moves all by a pixel, so
/// that the solver does not find the images and presses the whole map.
Surface cut_out(const Options& options, bool whole) {
  Surface surface = edt_surface(options);
  Field& height = surface.problem.height;
  const Field images = mirror_images(first_image(height));
  height = images;
  for (Index y = 0; whole && y < height.rows(); ++y) {
    for (Index x = 0; x < height.cols(); ++x) {
      height(y, x) = images((y + 1) % height.rows(), (x + 1) % height.cols());
    }
  }
  for (Load& load : surface.loads) load.name.replace(0, 3, whole ? "whole" : "image");
  return surface;
}

Surface self_affine_surface(const Options& options) {
  synthesis::SelfAffine recipe;
  recipe.grid = edt_grid(options.n);
  recipe.rms_slope = 1.0;
  recipe.roll_off_wavelength = recipe.grid.lx / 4;
  recipe.short_cutoff_wavelength = 4 * 2 * recipe.grid.dx();
  recipe.seed = options.seed;
  Surface surface{recipe.grid, {}, {}};
  surface.problem.height = synthesis::self_affine(recipe).height;
  add_elastic_loads(surface, "self-affine elastic", aluminium(), options,
                    {0.0025, 0.01, 0.025, 0.1});
  return surface;
}

Surface ground_surface(const Options& options) {
  synthesis::Ground recipe;
  recipe.grid = edt_grid(options.n);
  recipe.seed = options.seed;
  Surface surface{recipe.grid, {}, {}};
  surface.problem.height = synthesis::ground(recipe).height;
  const double unit = aluminium() * rms_slope(surface.problem.height, surface.grid);
  add_elastic_loads(surface, "ground elastic", unit, options, {0.0025, 0.01, 0.025, 0.1});
  return surface;
}

template <typename Work>
double best_seconds(const Work& work) {
  double best = 1e9;
  for (int repeat = 0; repeat < 4; ++repeat) {
    const Stopwatch watch;
    work();
    best = std::min(best, watch.seconds());
  }
  return best;
}

PairSeconds seconds_of_pairs(Index n) {
  PairSeconds seconds{};
  {
    const spectral::RealFft2d<double> fft(n, n);
    Field map = Field::Random(n, n);
    std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(n * (n / 2 + 1)));
    seconds.plain = best_seconds([&] {
      fft.forward(map.data(), spectrum.data());
      fft.inverse(spectrum.data(), map.data());
    });
  }
  const auto elasticity = elastic::make_periodic(edt_grid(n), aluminium());
  FieldF map = FieldF::Random(n, n);
  seconds.fused = best_seconds([&] { elasticity->apply(map, map); });
  return seconds;
}

void run(Surface& surface, const Load& load, contact::Solver solver, const PairSeconds& pair) {
  const auto elasticity = elastic::make_periodic(surface.grid, aluminium());
  surface.problem.control = contact::MeanPressure{load.mean_pressure};
  surface.problem.bounds.upper = load.saturation_pressure;
  const Stopwatch watch;
  const contact::State state = contact::solve(*elasticity, surface.problem, solver);
  const double seconds = watch.seconds();
  const Convergence& found = state.convergence;
  const double area = contact::contact_mask(state).cast<double>().mean();
  fmt::print(
      "{:<20} {:<13} {:>8.3g} {:>8.4f} {:>6} {:>6} {:>8.2f} {:>9.2e} {:>5} {:>8.3g} {:>8.1f} "
      "{:>6.2f} {:>7.1f}\n",
      load.name, solver == contact::Solver::fast ? "fast" : "polonsky-keer",
      load.mean_pressure / 1e6, 100 * area, found.iterations, found.operator_applications,
      found.fft_pairs, found.certificate, found.converged() ? "yes" : "NO", seconds,
      seconds / pair.plain, seconds / (found.fft_pairs * pair.fused),
      static_cast<double>(peak_memory_bytes()) / static_cast<double>(surface.grid.size()));
  std::fflush(stdout);
}

void run_all(Surface surface, bool with_baseline, const PairSeconds& pair) {
  for (const Load& load : surface.loads) {
    run(surface, load, contact::Solver::fast, pair);
    if (with_baseline) run(surface, load, contact::Solver::polonsky_keer, pair);
  }
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
    } else if (word == "--loads" && i + 1 < argc) {
      std::istringstream list(argv[++i]);
      for (std::string load; std::getline(list, load, ',');) {
        options.loads.push_back(std::stod(load));
      }
    } else {
      options.n = std::stol(word);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const PairSeconds pair = seconds_of_pairs(options.n);
  fmt::print("n = {}, {} threads, seed {}, double FFT pair {:.3f} s, fused float pair {:.3f} s\n",
             options.n, thread_count(), options.seed, pair.plain, pair.fused);
  fmt::print("{:<20} {:<13} {:>8} {:>8} {:>6} {:>6} {:>8} {:>9} {:>5} {:>8} {:>8} {:>6} {:>7}\n",
             "surface", "solver", "P [MPa]", "area [%]", "iter", "S p", "pairs", "certif.", "conv",
             "seconds", "s/pair", "t/fft", "B/px");
  const bool all = options.surface == "all";
  if (all || options.surface == "edt") run_all(edt_surface(options), options.baseline, pair);
  if (all || options.surface == "self-affine") {
    run_all(self_affine_surface(options), options.baseline, pair);
  }
  if (options.surface == "ground") {  // only when asked for
    run_all(ground_surface(options), options.baseline, pair);
  }
  if (options.surface == "cut-out") {
    run_all(cut_out(options, true), options.baseline, pair);
    run_all(cut_out(options, false), options.baseline, pair);
  }
  return 0;
}
