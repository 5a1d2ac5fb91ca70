// Times of calls of the library, which tools/bench/python_overhead sets beside the same calls from
// Python.
//
//   bench_calls FILE CALL COUNT            CALL: level, psd, rain or contact
//
// The surface is the one of the file without its plane. Prints the seconds that pass and those of
// the processors, a line for each of COUNT calls.
#include <fmt/core.h>

#include <ctime>
#include <functional>
#include <map>
#include <string>

#include "tabor/cases/states.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/treatment.hpp"

namespace {

using namespace tabor;
using topography::Topography;

cases::ContactSettings solid() {
  cases::ContactSettings settings;
  settings.youngs_modulus = 70e9;
  settings.poissons_ratio = 0.33;
  settings.saturation_pressure = 240e6;
  return settings;
}

cases::FilmSettings oil() {
  cases::FilmSettings settings;
  settings.lubricant_densities = {0.9e-3};
  return settings;
}

const std::map<std::string, std::function<void(const Topography&)>> kCalls = {
    {"level", [](const Topography& s) { topography::apply({"level=plane"}, s); }},
    {"psd", [](const Topography& s) { metrology::power_spectra(s, {}); }},
    {"rain", [](const Topography& s) { cases::film_state(s, oil()); }},
    {"contact",
     [](const Topography& s) { cases::contact_state(s, solid(), contact::MeanPressure{7e6}); }}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || !kCalls.contains(argv[2])) {
    fmt::print(stderr, "usage: bench_calls FILE level|psd|rain|contact COUNT\n");
    return 2;
  }
  const Topography surface = topography::apply({"level=plane"}, scan::read(argv[1]));
  for (int i = std::stoi(argv[3]); i > 0; --i) {
    const std::clock_t before = std::clock();
    const Stopwatch watch;
    kCalls.at(argv[2])(surface);
    const double seconds = watch.seconds();
    fmt::print("{:.9f} {:.6f}\n", seconds,
               static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
  }
}
