// Times and counts of lubricant deposition: tabor_bench_deposition [SIDE...] (default 256 1024).
// The columns before "seconds" are the same on every machine.
#include <fmt/core.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/lubrication/deposition.hpp"
#include "tabor/lubrication/naive.hpp"
#include "tabor/topography/synthesis.hpp"

namespace {

using namespace tabor;

constexpr double kPixel = 0.67e-6;   // [m]
constexpr double kFilm = 1e-6;       // 0.9 g/m^2 of oil [m]
constexpr double kDroplet = 1e-7;    // [m]
constexpr Index kLargestNaive = 64;  // the naive rule grows like the fourth power

Field surface(Index side) {
  topography::Edt recipe;
  const double length = kPixel * static_cast<double>(side);
  recipe.grid = {side, side, length, length};
  return topography::edt(recipe).height;
}

void print_row(Index side, const char* engine, double film, long long droplets, long long pools,
               double wet, double seconds) {
  const double pixels = static_cast<double>(side) * static_cast<double>(side);
  fmt::print("{:>6} {:<11} {:>7.2f} {:>12} {:>9} {:>9.6f} {:>9.2f} {:>9.1f}\n", side, engine,
             film * 1e6, droplets, pools, wet, seconds,
             static_cast<double>(peak_memory_bytes()) / pixels);
}

void time_model(const Field& height, lubrication::Model model) {
  const Index side = height.rows();
  const double length = kPixel * static_cast<double>(side);
  lubrication::Dose dose;
  dose.mean_films = {kFilm / 2, kFilm};
  dose.droplet_height = kDroplet;
  dose.model = model;
  const lubrication::FilmSink print = [&](lubrication::Film&& film) {
    print_row(side, std::string(lubrication::name(model)).c_str(), film.mean_film, film.n_droplets,
              film.n_pools, film.wet_fraction, film.seconds);
  };
  lubrication::deposit(height, {side, side, length, length}, dose, print);
}

void time_naive(const Field& height) {
  const Stopwatch watch;
  const auto terrain = lubrication::quantise(height, lubrication::Edge::closed);
  lubrication::NaiveRain rain(terrain, lubrication::Reading::conserving);
  const CounterRandom starts(1);
  const auto n = static_cast<std::uint64_t>(height.size());
  const auto droplet = static_cast<lubrication::Height>(std::lround(kDroplet / terrain.quantum));
  const auto n_droplets = static_cast<std::uint64_t>(std::llround(kFilm / kDroplet)) * n;
  for (std::uint64_t k = 0; k < n_droplets; ++k) {
    rain.drop(static_cast<lubrication::Pixel>(starts.below(k, n)), droplet);
  }
  std::size_t n_wet = 0;
  for (std::size_t p = 0; p < n; ++p) {
    n_wet += rain.levels()[p] > terrain.height[p] ? 1 : 0;
  }
  print_row(height.rows(), "naive", kFilm, static_cast<long long>(n_droplets), 0,
            static_cast<double>(n_wet) / static_cast<double>(n), watch.seconds());
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  std::vector<Index> sides;
  for (int i = 1; i < argc; ++i) {
    sides.push_back(std::atol(argv[i]));
  }
  if (sides.empty()) {
    sides = {kLargestNaive, 256, 1024};
  }
  fmt::print("{:>6} {:<11} {:>7} {:>12} {:>9} {:>9} {:>9} {:>9}\n", "side", "engine", "film_um",
             "droplets", "pools", "wet", "seconds", "B/pixel");
  for (const Index side : sides) {
    const Field height = surface(side);
    time_model(height, lubrication::Model::limit);
    time_model(height, lubrication::Model::droplets);
    if (side <= kLargestNaive) {
      time_naive(height);
    }
  }
  return 0;
}
