#include "tabor/spectral/fftw_library.hpp"

#include <pthread.h>

#include <filesystem>
#include <mutex>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::spectral {

namespace {

/// FFTW's planner is not thread-safe; its plans are.
std::mutex planner_mutex;
/// Makes fork() wait for the planner, so that a copy of the process finds it in a consistent state
/// and unlocked.
[[maybe_unused]] const int keeps_planner_free = ::pthread_atfork(
    [] { planner_mutex.lock(); }, [] { planner_mutex.unlock(); }, [] { planner_mutex.unlock(); });
bool wisdom_is_loaded = false;

std::filesystem::path single_precision_file(const std::filesystem::path& file) {
  return std::filesystem::path(file).concat(".float");
}

template <typename Real>
void measure(Index n) {
  Buffer<std::complex<Real>, Real> values(n + 2);
  auto* complex = as_fftw(values.data());
  auto* real = reinterpret_cast<Real*>(values.data());
  Buffer<Real, Real> other(2 * (n + 2));
  auto* other_complex = as_fftw(reinterpret_cast<std::complex<Real>*>(other.data()));
  const unsigned flags = FFTW_MEASURE | FFTW_DESTROY_INPUT;
  const int size = static_cast<int>(n);
  for (auto plan : {Fftw<Real>::plan_c2c(size, complex, complex, FFTW_FORWARD, flags),
                    Fftw<Real>::plan_c2c(size, complex, complex, FFTW_BACKWARD, flags),
                    Fftw<Real>::plan_r2c(size, real, other_complex, flags),
                    Fftw<Real>::plan_c2r(size, complex, other.data(), flags)}) {
    Fftw<Real>::destroy(plan);
  }
}

}  // namespace

template <typename Real>
Plan<Real>::Plan(const std::function<Handle(unsigned flags)>& make) {
  const std::lock_guard lock(planner_mutex);
  if (wisdom_is_loaded) plan_ = make(FFTW_MEASURE | FFTW_WISDOM_ONLY | FFTW_DESTROY_INPUT);
  if (plan_ == nullptr) plan_ = make(FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  if (plan_ == nullptr) throw Error("FFTW made no plan");
}

template <typename Real>
Plan<Real>::~Plan() {
  const std::lock_guard lock(planner_mutex);
  Fftw<Real>::destroy(plan_);
}

template class Plan<float>;
template class Plan<double>;

std::string transform_library() {
  // fftw_version reads like "fftw-3.3.10-sse2-avx".
  const std::string version = std::string(fftw_version).substr(5);
  return "FFTW " + version.substr(0, version.find('-'));
}

std::string transform_reference() { return "frigo2005"; }

void load_wisdom(const std::filesystem::path& file) {
  const std::lock_guard lock(planner_mutex);
  const bool loaded = fftw_import_wisdom_from_filename(file.c_str()) != 0 &&
                      fftwf_import_wisdom_from_filename(single_precision_file(file).c_str()) != 0;
  if (!loaded) {
    throw InputError("FFT wisdom " + file.string(), "no readable pair of FFTW wisdom files",
                     "files written by this version of FFTW", "measure them again");
  }
  wisdom_is_loaded = true;
}

void measure_wisdom(Index ny, Index nx, const std::filesystem::path& file) {
  const std::lock_guard lock(planner_mutex);
  for (const Index n : {nx, ny, 2 * nx, 2 * ny}) {
    measure<double>(n);
    measure<float>(n);
  }
  if (fftw_export_wisdom_to_filename(file.c_str()) == 0 ||
      fftwf_export_wisdom_to_filename(single_precision_file(file).c_str()) == 0) {
    throw OutputError("cannot write FFT wisdom to " + file.string());
  }
}

}  // namespace tabor::spectral
