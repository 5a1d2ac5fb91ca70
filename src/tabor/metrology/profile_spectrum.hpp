#pragma once

#include <functional>

#include "tabor/metrology/psd.hpp"

namespace tabor::metrology {

/// Returns `count` rows from row `first` on.
using RowsOf = std::function<Field(Index first, Index count)>;

/// Jacobs's C1D of `n_rows` rows of n pixels, `length` long, about each row's mean: mean over rows
/// of |dx FFT|^2 / L.
Spectrum profile_spectrum(Index n_rows, Index n, double length, PsdWindow window,
                          const RowsOf& rows_of);

}  // namespace tabor::metrology
