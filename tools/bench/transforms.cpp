// Times of the pair of transforms of a map, by FFTW as tabor runs it and by ducc0.
//
//   bench_transforms [PIXELS]             (default 3456)
//
// Both in turns, nine times after a first one that is not counted: medians and shortest times.
#include <ducc0/fft/fft.h>
#include <ducc0/infra/mav.h>
#include <fmt/core.h>

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/spectral/fft.hpp"

namespace {

using namespace tabor;

constexpr int kTurns = 9;

struct Times {
  std::vector<double> seconds;

  void add(double value) { seconds.push_back(value); }
  double shortest() const { return *std::min_element(seconds.begin(), seconds.end()); }
  double median() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

template <typename Real>
struct Maps {
  explicit Maps(std::size_t n) : map(n * n), spectrum(n * (n / 2 + 1)) {
    for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<Real>(i * 7919 % 1000) / 1000;
  }

  std::vector<Real> map;
  std::vector<std::complex<Real>> spectrum;
};

template <typename Real>
double seconds_of_fftw(const spectral::RealFft2d<Real>& transform, Maps<Real>& maps) {
  const Stopwatch watch;
  transform.forward(maps.map.data(), maps.spectrum.data());
  transform.inverse(maps.spectrum.data(), maps.map.data());
  return watch.seconds();
}

template <typename Real>
double seconds_of_ducc0(std::size_t n, std::size_t threads, Maps<Real>& maps) {
  const ducc0::vfmav<Real> map(maps.map.data(), {n, n});
  const ducc0::vfmav<std::complex<Real>> spectrum(maps.spectrum.data(), {n, n / 2 + 1});
  const Stopwatch watch;
  ducc0::r2c<Real>(map, spectrum, {0, 1}, true, Real(1), threads);
  ducc0::c2r_mut<Real>(spectrum, map, {0, 1}, false, Real(1.0 / static_cast<double>(n * n)),
                       threads);
  return watch.seconds();
}

template <typename Real>
void print_row(const char* precision, std::size_t n, int threads) {
  set_thread_count(threads);
  const spectral::RealFft2d<Real> transform(static_cast<Index>(n), static_cast<Index>(n));
  Maps<Real> of_fftw(n);
  Maps<Real> of_ducc0(n);
  Times fftw;
  Times ducc0;
  for (int turn = 0; turn <= kTurns; ++turn) {
    const double first = seconds_of_fftw(transform, of_fftw);
    const double other = seconds_of_ducc0(n, static_cast<std::size_t>(threads), of_ducc0);
    if (turn > 0) fftw.add(first);
    if (turn > 0) ducc0.add(other);
  }
  fmt::print("{:>9} {:>7} {:>7} {:>13.3f} {:>9.3f} {:>14.3f} {:>10.3f} {:>7.2f}\n", precision, n,
             threads, fftw.median(), fftw.shortest(), ducc0.median(), ducc0.shortest(),
             ducc0.median() / fftw.median());
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t n = argc > 1 ? std::stoul(argv[1]) : 3456;
  fmt::print("{:>9} {:>7} {:>7} {:>13} {:>9} {:>14} {:>10} {:>7}\n", "precision", "pixels",
             "threads", "FFTW median s", "least s", "ducc0 median s", "least s", "ratio");
  for (const int threads : {1, 2}) {
    print_row<double>("double", n, threads);
    print_row<float>("single", n, threads);
  }
}
