// Times of transforms and convolutions of a map, by the library of transforms that tabor is built
// with (TABOR_FFT).
//
//   bench_transforms [PIXELS]             (default 3456)
//
// One turn after a first one that is not counted; tools/bench/transforms runs the programs of two
// builds in turns.
#include <fmt/core.h>

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/spectral/fft.hpp"

namespace {

using namespace tabor;

template <typename Real>
std::vector<Real> map_of(Index n) {
  std::vector<Real> map(static_cast<std::size_t>(n * n));
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<Real>(i * 7919 % 1000) / 1000;
  return map;
}

/// Forward and back, through the whole spectrum.
template <typename Real>
double seconds_of_pair(Index n) {
  std::vector<Real> map = map_of<Real>(n);
  std::vector<std::complex<Real>> spectrum(static_cast<std::size_t>(n * (n / 2 + 1)));
  const spectral::RealFft2d<Real> transform(n, n);
  double seconds = 0;
  for (int turn = 0; turn < 2; ++turn) {
    const Stopwatch watch;
    transform.forward(map.data(), spectrum.data());
    transform.inverse(spectrum.data(), map.data());
    seconds = watch.seconds();
  }
  return seconds;
}

/// The same with a product in between, in one sweep over the columns: what contacts do.
template <typename Real>
double seconds_of_convolution(Index n) {
  std::vector<Real> map = map_of<Real>(n);
  spectral::Convolution<Real> convolution(n, n);
  const auto half = [](Index, std::span<Real> values) {
    for (Real& value : values) value = Real(0.5);
  };
  double seconds = 0;
  for (int turn = 0; turn < 2; ++turn) {
    const Stopwatch watch;
    convolution.apply(map.data(), half, map.data());
    seconds = watch.seconds();
  }
  return seconds;
}

template <typename Real>
void print_rows(const char* precision, Index n, int threads) {
  set_thread_count(threads);
  fmt::print("pair {} {} {:.6f}\n", precision, threads, seconds_of_pair<Real>(n));
  fmt::print("convolution {} {} {:.6f}\n", precision, threads, seconds_of_convolution<Real>(n));
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::stol(argv[1]) : 3456;
  fmt::print("{}\n", spectral::transform_library());
  for (const int threads : {1, 2}) {
    print_rows<double>("double", n, threads);
    print_rows<float>("single", n, threads);
  }
}
