#include "tabor/spectral/strips.hpp"

#include <algorithm>

#include "tabor/core/parallel.hpp"
#include "tabor/spectral/fftw_library.hpp"

namespace tabor::spectral {

template <typename Real>
struct StripTransform<Real>::Plans {
  Index ny;
  Index nx;
  RowTransform<Real> rows;
  ColumnTransform<Real> columns;
};

template <typename Real>
StripTransform<Real>::StripTransform(Index ny, Index nx, Index padded_ny, Index padded_nx)
    : plans_(new Plans{ny, nx, RowTransform<Real>(padded_nx), ColumnTransform<Real>(padded_ny)}) {}
template <typename Real>
StripTransform<Real>::~StripTransform() = default;
template <typename Real>
StripTransform<Real>::StripTransform(StripTransform&&) noexcept = default;
template <typename Real>
StripTransform<Real>& StripTransform<Real>::operator=(StripTransform&&) noexcept = default;
template <typename Real>
Index StripTransform<Real>::padded_ny() const {
  return plans_->columns.n();
}
template <typename Real>
Index StripTransform<Real>::padded_nx() const {
  return plans_->rows.n();
}

template <typename Real>
void StripTransform<Real>::rows_forward(const RowSource<Real>& map, ColumnRange range,
                                        Strip& strip) const {
  const Plans& p = *plans_;
  strip.resize(static_cast<std::size_t>(p.ny * range.size()));
  parallel_for(p.ny, kRowsPerStripBlock, [&](Index begin, Index end) {
    Buffer<Real, Real> row(p.rows.n());
    Buffer<Complex, Real> frequencies(p.rows.n_frequencies());
    for (Index y = begin; y < end; ++y) {
      map(y, {row.data(), static_cast<std::size_t>(p.nx)});
      std::fill(row.data() + p.nx, row.data() + p.rows.n(), Real(0));
      p.rows.forward(row.data(), frequencies.data());
      std::copy_n(frequencies.data() + range.begin, range.size(), strip.data() + y * range.size());
    }
  });
}

template <typename Real>
void StripTransform<Real>::for_columns(std::span<Strip* const> strips, ColumnRange range,
                                       const ColumnWork& work, bool back) const {
  const Plans& p = *plans_;
  const Index n = p.columns.n(), width = range.size(), n_maps = std::ssize(strips);
  const Index stride = column_stride<Real>(n);
  parallel_for(width, kColumnsPerStripBlock, [&](Index begin, Index end) {
    const Index n_columns = end - begin;
    Buffer<Complex, Real> block(stride * n_columns * n_maps);
    const auto column = [&](Index map, Index x) {
      return block.data() + (map * n_columns + x - begin) * stride;
    };
    for (Index map = 0; map < n_maps; ++map) {
      const Strip& strip = *strips[static_cast<std::size_t>(map)];
      for (Index y = 0; y < p.ny; ++y) {
        for (Index x = begin; x < end; ++x) {
          column(map, x)[y] = strip[static_cast<std::size_t>(y * width + x)];
        }
      }
    }
    std::vector<Complex*> columns(strips.size());
    for (Index x = begin; x < end; ++x) {
      for (Index map = 0; map < n_maps; ++map) {
        Complex* values = columns[static_cast<std::size_t>(map)] = column(map, x);
        std::fill(values + p.ny, values + n, Complex(0));
        p.columns.forward(values);
      }
      work(range.begin + x, columns);
      for (Index map = 0; back && map < n_maps; ++map) p.columns.inverse(column(map, x));
    }
    for (Index map = 0; back && map < n_maps; ++map) {
      Strip& strip = *strips[static_cast<std::size_t>(map)];
      for (Index y = 0; y < p.ny; ++y) {
        for (Index x = begin; x < end; ++x) {
          strip[static_cast<std::size_t>(y * width + x)] = column(map, x)[y];
        }
      }
    }
  });
}

template <typename Real>
void StripTransform<Real>::read_columns(std::span<Strip* const> strips, ColumnRange range,
                                        const ColumnWork& work) const {
  for_columns(strips, range, work, false);
}

template <typename Real>
void StripTransform<Real>::change_columns(std::span<Strip* const> strips, ColumnRange range,
                                          const ColumnWork& work) const {
  for_columns(strips, range, work, true);
}

template <typename Real>
void StripTransform<Real>::rows_inverse(const Strip& strip, ColumnRange range,
                                        const RowSink& sink) const {
  const Plans& p = *plans_;
  parallel_for(p.ny, kRowsPerStripBlock, [&](Index begin, Index end) {
    Buffer<Real, Real> row(p.rows.n());
    Buffer<Complex, Real> frequencies(p.rows.n_frequencies());
    for (Index y = begin; y < end; ++y) {
      // The inverse destroys its input: zeros are written anew for every row.
      std::fill(frequencies.data(), frequencies.data() + p.rows.n_frequencies(), Complex(0));
      std::copy_n(strip.data() + y * range.size(), range.size(), frequencies.data() + range.begin);
      p.rows.inverse(frequencies.data(), row.data());
      sink(y, {row.data(), static_cast<std::size_t>(p.rows.n())});
    }
  });
}

template class StripTransform<float>;
template class StripTransform<double>;

}  // namespace tabor::spectral
