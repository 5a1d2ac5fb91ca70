// Chooses the library of transforms (TABOR_FFT) and runs it over the rows and columns of maps.
#pragma once

#include <algorithm>
#include <complex>

#include "tabor/core/parallel.hpp"
#if defined(TABOR_FFT_DUCC0)
#include "tabor/spectral/ducc0_library.hpp"
#else
#include "tabor/spectral/fftw_library.hpp"
#endif

// Each library has the same classes:
//
//   RowTransform, ColumnTransform   plans for one length; safe to use from several threads
//   RowBundle                       memory of one thread for the rows that are transformed together
//   ColumnBlock                     memory of one thread for a block of columns, in bundles of
//   those
//                                   that are transformed together
//
// Rows and columns meet in the same bundles whatever the number of threads.
namespace tabor::spectral {

inline constexpr Index kRowsPerBlock = 16;
inline constexpr Index kColumnsPerBlock =
    16;  // whole cache lines of a row, and the block stays in L2

/// Calls work(rows, y, count) for the rows y .. y + count - 1, with the memory for them.
template <typename Real, typename Work>
void for_each_row_bundle(const RowTransform<Real>& transform, Index n_rows, const Work& work) {
  parallel_for(n_rows, kRowsPerBlock, [&](Index begin, Index end) {
    RowBundle<Real> rows(transform);
    for (Index y = begin; y < end; y += RowBundle<Real>::kTogether) {
      work(rows, y, std::min(RowBundle<Real>::kTogether, end - y));
    }
  });
}

/// Transforms the n_rows rows of `map` (length row_length, zero-padded to the plan's length).
template <typename Real>
void rows_forward(const RowTransform<Real>& transform, const Real* map, Index n_rows,
                  Index row_length, std::complex<Real>* spectrum) {
  const Index n_frequencies = transform.n_frequencies();
  for_each_row_bundle(transform, n_rows, [&](RowBundle<Real>& rows, Index y, Index count) {
    for (Index i = 0; i < count; ++i) {
      std::copy_n(map + (y + i) * row_length, row_length, rows.row(i));
      std::fill(rows.row(i) + row_length, rows.row(i) + transform.n(), Real(0));
    }
    rows.forward(count);
    for (Index i = 0; i < count; ++i) {
      std::copy_n(rows.spectrum(i), n_frequencies, spectrum + (y + i) * n_frequencies);
    }
  });
}

/// Inverse of rows_forward, times `scale`; only the first row_length values of each row are stored.
template <typename Real>
void rows_inverse(const RowTransform<Real>& transform, const std::complex<Real>* spectrum,
                  Index n_rows, Index row_length, Real scale, Real* map) {
  const Index n_frequencies = transform.n_frequencies();
  for_each_row_bundle(transform, n_rows, [&](RowBundle<Real>& rows, Index y, Index count) {
    for (Index i = 0; i < count; ++i) {
      std::copy_n(spectrum + (y + i) * n_frequencies, n_frequencies, rows.spectrum(i));
    }
    rows.inverse(count);
    for (Index i = 0; i < count; ++i) {
      std::transform(rows.row(i), rows.row(i) + row_length, map + (y + i) * row_length,
                     [scale](Real value) { return value * scale; });
    }
  });
}

/// Calls work(block, bundle, x, count) for every bundle of columns x .. x + count - 1 of the
/// spectrum: the first n_rows values of each come from the spectrum and go back to it; the rest
/// starts as zero.
template <typename Real, typename Work>
void for_each_column_bundle(const ColumnTransform<Real>& transform, std::complex<Real>* spectrum,
                            Index n_rows, Index n_columns, const Work& work) {
  parallel_for(n_columns, kColumnsPerBlock, [&](Index begin, Index end) {
    ColumnBlock<Real> block(transform, end - begin);
    block.load(spectrum + begin, n_columns, n_rows);
    constexpr Index together = ColumnBlock<Real>::kTogether;
    for (Index x = begin; x < end; x += together) {
      work(block, (x - begin) / together, x, std::min(together, end - x));
    }
    block.store(spectrum + begin, n_columns, n_rows);
  });
}

}  // namespace tabor::spectral
