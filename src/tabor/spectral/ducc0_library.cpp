#include "tabor/spectral/ducc0_library.hpp"

#include <ducc0/fft/fft1d_impl.h>
#include <ducc0/infra/threading.cc>  // what fft1d_impl.h calls of it, for one thread

#include <filesystem>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/spectral/fft.hpp"

template class tabor_ducc0::detail_fft::cfftpass<float>;
template class tabor_ducc0::detail_fft::cfftpass<double>;
template class tabor_ducc0::detail_fft::rfftpass<float>;
template class tabor_ducc0::detail_fft::rfftpass<double>;

namespace tabor::spectral {

std::string transform_library() { return "ducc0 " TABOR_DUCC0_VERSION; }

std::string transform_reference() { return "ducc0"; }

void load_wisdom(const std::filesystem::path& file) {
  throw InputError("FFT wisdom " + file.string(), "a tabor that is built with ducc0",
                   "one built with FFTW", "leave it out: plans of ducc0 are not measured");
}

void measure_wisdom(Index, Index, const std::filesystem::path& file) { load_wisdom(file); }

}  // namespace tabor::spectral
