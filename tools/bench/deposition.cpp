// Counts, times and memory of lubricant deposition, droplets also on all threads.
//
//   bench_deposition [SIDE...]        (default 64 256 1024)
//
// Surfaces: EDT-like as scanned, and the same low-passed as for the seed study (Hann, cutoff at
// 6.75 pixels). Model limit lays down both films in one pass, droplets rains 0.1 um droplets; its
// seconds include the tree of pools and count from the start. B/px: peak memory beyond the heights
// themselves; every row is a process of its own. All columns before "seconds" are the same on every
// machine.
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/naive.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/filters.hpp"

namespace {

using namespace tabor;

constexpr double kPixel = 0.67e-6;         // [m]
constexpr double kFilm = 1e-6;             // 0.9 g/m^2 of oil [m]
constexpr double kDroplet = 1e-7;          // [m]
constexpr double kCutoff = 6.75 * kPixel;  // 512/L of a scan of 3456 pixels [m]
constexpr Index kLargestNaive = 64;        // the naive rule grows like the fourth power

struct Surface {
  std::string name;
  Grid grid;
  Field height;
};

Surface as_scanned(Index side) {
  synthesis::Edt recipe;
  const double length = kPixel * static_cast<double>(side);
  recipe.grid = {side, side, length, length};
  return {"as scanned", recipe.grid, synthesis::edt(recipe).height};
}

Surface low_passed(const Surface& scan) {
  topography::Filter filter;
  filter.wavelength = kCutoff;
  return {"low-passed", scan.grid,
          topography::low_pass(scan.height, scan.grid, filter, scan.grid.lx, true)};
}

void print_head() {
  fmt::print("{:>6} {:<11} {:<9} {:>7} {:>8} {:>11} {:>8} {:>9} {:>8} {:>9} {:>6}\n", "side",
             "surface", "engine", "threads", "film um", "droplets", "pools", "wet", "seconds",
             "ns/drop", "B/px");
}

void print_row(const Surface& surface, const std::string& engine, double film, long long droplets,
               long long pools, double wet, double seconds, std::size_t memory_before) {
  const auto bytes = static_cast<double>(peak_memory_bytes() - memory_before);
  const std::string per_droplet =
      droplets > 0 ? fmt::format("{:.0f}", 1e9 * seconds / static_cast<double>(droplets)) : "";
  fmt::print("{:>6} {:<11} {:<9} {:>7} {:>8.2f} {:>11} {:>8} {:>9.6f} {:>8.2f} {:>9} {:>6.1f}\n",
             surface.grid.nx, surface.name, engine, thread_count(), film * 1e6, droplets, pools,
             wet, seconds, per_droplet, bytes / static_cast<double>(surface.height.size()));
}

void time_model(const Surface& surface, deposition::Model model, int n_threads) {
  set_thread_count(n_threads);
  const std::size_t before = peak_memory_bytes();
  deposition::Dose dose;
  dose.mean_films = {kFilm / 2, kFilm};
  dose.droplet_height = kDroplet;
  dose.model = model;
  const deposition::FilmSink print = [&](deposition::Film&& film) {
    print_row(surface, std::string(deposition::name(model)), film.mean_film, film.n_droplets,
              film.n_pools, film.wet_fraction, film.seconds, before);
  };
  deposition::deposit(surface.height, surface.grid, dose, print);
}

void time_naive(const Surface& surface) {
  const std::size_t before = peak_memory_bytes();
  const Stopwatch watch;
  const auto terrain = deposition::quantise(surface.height, deposition::Edge::closed);
  deposition::NaiveRain rain(terrain, deposition::Reading::conserving);
  const CounterRandom starts(1);
  const auto n = static_cast<std::uint64_t>(surface.height.size());
  const auto droplet = static_cast<deposition::Height>(std::lround(kDroplet / terrain.quantum));
  const auto n_droplets = static_cast<std::uint64_t>(std::llround(kFilm / kDroplet)) * n;
  for (std::uint64_t k = 0; k < n_droplets; ++k) {
    rain.drop(static_cast<deposition::Pixel>(starts.below(k, n)), droplet);
  }
  std::size_t n_wet = 0;
  for (std::size_t p = 0; p < n; ++p) n_wet += rain.levels()[p] > terrain.height[p] ? 1 : 0;
  print_row(surface, "naive", kFilm, static_cast<long long>(n_droplets), 0,
            static_cast<double>(n_wet) / static_cast<double>(n), watch.seconds(), before);
}

/// Its peak memory then is its own. Exits if the work fails.
template <class Work>
void in_own_process(Work work) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    work();
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
    fmt::print(stderr, "bench_deposition: a measurement failed\n");
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(0);
  const int n_threads = thread_count();
  set_thread_count(1);
  std::vector<Index> sides;
  for (int i = 1; i < argc; ++i) sides.push_back(std::atol(argv[i]));
  if (sides.empty()) sides = {kLargestNaive, 256, 1024};
  print_head();
  for (const Index side : sides) {
    const Surface scan = as_scanned(side);
    const Surface smooth = low_passed(scan);
    for (const Surface* surface : {&scan, &smooth}) {
      in_own_process([&] { time_model(*surface, deposition::Model::limit, 1); });
      in_own_process([&] { time_model(*surface, deposition::Model::droplets, 1); });
      in_own_process([&] { time_model(*surface, deposition::Model::droplets, n_threads); });
    }
    if (side <= kLargestNaive) in_own_process([&] { time_naive(scan); });
  }
  return 0;
}
