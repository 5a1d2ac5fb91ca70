#include "tabor/metrology/spectra/mean_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor::metrology {
namespace {

void check(const std::vector<Spectrum>& spectra) {
  const char* const kWhat = "mean of spectra";
  if (spectra.empty()) throw InputError(kWhat, "none", "at least one", "");
  for (const Spectrum& one : spectra) {
    if (one.q.empty()) throw InputError(kWhat, "an empty spectrum", "densities over q", "");
    if (one.unit == spectra.front().unit) continue;
    throw InputError(kWhat, fmt::format("densities in {} and {}", spectra.front().unit, one.unit),
                     "one unit", "take one convention, and profiles or maps alone");
  }
}

bool have_one_axis(const std::vector<Spectrum>& spectra) {
  return std::all_of(spectra.begin(), spectra.end(),
                     [&](const Spectrum& one) { return one.q == spectra.front().q; });
}

/// The wavevectors of the spectrum whose first is the largest, up to the smallest last.
std::vector<double> common_axis(const std::vector<Spectrum>& spectra) {
  if (have_one_axis(spectra)) return spectra.front().q;
  const auto coarsest = std::max_element(
      spectra.begin(), spectra.end(),
      [](const Spectrum& a, const Spectrum& b) { return a.q.front() < b.q.front(); });
  double last = coarsest->q.back();
  for (const Spectrum& one : spectra) last = std::min(last, one.q.back());
  std::vector<double> axis;
  std::copy_if(coarsest->q.begin(), coarsest->q.end(), std::back_inserter(axis),
               [last](double q) { return q <= last; });
  if (!axis.empty()) return axis;
  throw InputError("mean of spectra", "wavevectors that no two scans share",
                   "scans whose ranges of wavelengths overlap", "");
}

/// The density at q, which lies within the spectrum's wavevectors.
double density_at(const Spectrum& spectrum, double q) {
  const auto above = std::lower_bound(spectrum.q.begin(), spectrum.q.end(), q);
  const auto i = static_cast<std::size_t>(above - spectrum.q.begin());
  if (*above == q || i == 0) return spectrum.density[i];
  const double a = spectrum.density[i - 1], b = spectrum.density[i];
  const double from = spectrum.q[i - 1], to = spectrum.q[i];
  if (!(a > 0) || !(b > 0)) return a + (b - a) * (q - from) / (to - from);
  return a * std::pow(b / a, std::log(q / from) / std::log(to / from));
}

}  // namespace

MeanSpectrum mean_spectrum(const std::vector<Spectrum>& spectra) {
  check(spectra);
  MeanSpectrum mean{.q = common_axis(spectra), .density = {}, .unit = spectra.front().unit};
  std::vector<double> values(spectra.size());
  for (const double q : mean.q) {
    for (std::size_t i = 0; i < spectra.size(); ++i) values[i] = density_at(spectra[i], q);
    mean.density.push_back(mean_of(values));
  }
  return mean;
}

}  // namespace tabor::metrology
