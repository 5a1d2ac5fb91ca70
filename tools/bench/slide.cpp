// Counts and times of sliding, beside those of one contact.
//
//   bench_slide [n...] [--steps N] [--threads N]
//
// An EDT surface of n x n pixels with p_sat = 240 MPa under a ground tool of Sa 0.1 um and 10 MPa,
// in steps of 4 pixels. Prints one row per size: FFT pairs and volumes are deterministic; seconds,
// their ratio and memory are not.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/material/solid.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace {

using namespace tabor;

constexpr double kPixel = 0.67e-6;  // [m]
constexpr double kPressure = 10e6;  // [Pa]
constexpr double kCap = 240e6;      // [Pa]
constexpr Index kStep = 4;          // [pixels]

Grid grid_of(Index n) {
  const double side = static_cast<double>(n) * kPixel;
  return {n, n, side, side};
}

Field make_tool(Index n) {
  synthesis::Ground tool;
  tool.grid = grid_of(n);
  tool.rms_height = 0.125e-6;  // Sa 0.1 um
  return synthesis::ground(tool).height;
}

sliding::Problem make_problem(Index n) {
  synthesis::Edt sheet;
  sheet.grid = grid_of(n);
  return {.sheet = synthesis::edt(sheet).height,
          .tool = make_tool(n),
          .mean_pressure = kPressure,
          .saturation_pressure = kCap};
}

void run(Index n, int n_steps) {
  const auto elasticity =
      elastic::make_periodic(grid_of(n), material::effective_modulus({70e9, 0.33}));
  sliding::Slider slider(*elasticity, make_problem(n));
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak of memory counts from here
  sliding::Ploughing all = slider.press();
  const Stopwatch watch;
  double pairs = 0;
  for (int i = 0; i < n_steps; ++i) {
    all += slider.advance(kStep);
    pairs += slider.state().convergence.fft_pairs;
  }
  const double seconds = watch.seconds() / n_steps;
  const double memory = static_cast<double>(peak_memory_bytes()) / static_cast<double>(n * n);
  const contact::Problem last{
      .height = slider.sheet() + sliding::tool_at(make_tool(n), slider.place(), n),
      .control = contact::MeanPressure{kPressure},
      .bounds = {.upper = kCap}};
  contact::solve(*elasticity, last);  // without what a first solution alone does
  const Stopwatch contact_watch;
  contact::solve(*elasticity, last);
  const double contact_seconds = contact_watch.seconds();
  fmt::print("{:>5} {:>6} {:>7.2f} {:>10.4g} {:>10.4g} {:>8.3f} {:>8.3f} {:>6.2f} {:>6.0f}\n", n,
             n_steps, pairs / n_steps, 1e9 * all.moved, all.friction(all.work, kPressure),
             contact_seconds, seconds, seconds / contact_seconds, memory);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Index> sizes;
  int n_steps = 20;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--steps" && i + 1 < argc) {
      n_steps = std::stoi(argv[++i]);
    } else if (word == "--threads" && i + 1 < argc) {
      set_thread_count(std::stoi(argv[++i]));
    } else {
      sizes.push_back(std::stol(word));
    }
  }
  if (sizes.empty()) sizes = {512, 1024};
  fmt::print("{:>5} {:>6} {:>7} {:>10} {:>10} {:>8} {:>8} {:>6} {:>6}\n", "n", "steps", "pairs",
             "moved/nm", "ploughing", "s", "s/step", "ratio", "B/px");
  for (const Index n : sizes) run(n, n_steps);
}
