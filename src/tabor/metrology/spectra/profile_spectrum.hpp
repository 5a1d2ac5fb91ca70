#pragma once

#include <functional>
#include <span>

#include "tabor/metrology/spectra/psd.hpp"

// Computes the power spectrum of profiles, averaged over the rows of a map.
namespace tabor::metrology {

/// Writes a row; called from several threads.
using RowOf = std::function<void(Index y, std::span<double> row)>;

/// Computes C1D (Jacobs, Junge & Pastewka 2017) of `n_rows` rows of n pixels, `length` long, about
/// each row's mean: mean over rows of |dx FFT|^2 / L.
Spectrum profile_spectrum(Index n_rows, Index n, double length, PsdWindow window,
                          const RowOf& row_of);

}  // namespace tabor::metrology
