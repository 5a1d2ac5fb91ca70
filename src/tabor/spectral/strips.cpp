#include "tabor/spectral/strips.hpp"

#include <algorithm>

#include "tabor/spectral/transform_library.hpp"

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
  for_each_row_bundle(p.rows, p.ny, [&](RowBundle<Real>& rows, Index y, Index count) {
    for (Index i = 0; i < count; ++i) {
      map(y + i, {rows.row(i), static_cast<std::size_t>(p.nx)});
      std::fill(rows.row(i) + p.nx, rows.row(i) + p.rows.n(), Real(0));
    }
    rows.forward(count);
    for (Index i = 0; i < count; ++i) {
      std::copy_n(rows.spectrum(i) + range.begin, range.size(),
                  strip.data() + (y + i) * range.size());
    }
  });
}

template <typename Real>
void StripTransform<Real>::for_columns(std::span<Strip* const> strips, ColumnRange range,
                                       const ColumnWork& work, bool back) const {
  const Plans& p = *plans_;
  const Index width = range.size();
  constexpr Index together = ColumnBlock<Real>::kTogether;
  parallel_for(width, kColumnsPerStripBlock, [&](Index begin, Index end) {
    std::vector<ColumnBlock<Real>> blocks;
    blocks.reserve(strips.size());
    for (const Strip* const strip : strips) {
      blocks.emplace_back(p.columns, end - begin);
      blocks.back().load(strip->data() + begin, width, p.ny);
    }
    std::vector<Complex*> columns(strips.size());
    for (Index first = begin; first < end; first += together) {
      const Index bundle = (first - begin) / together;
      for (ColumnBlock<Real>& block : blocks) {
        block.forward(bundle);
        block.unpack(bundle);
      }
      for (Index x = first; x < std::min(first + together, end); ++x) {
        for (std::size_t map = 0; map < blocks.size(); ++map) {
          columns[map] = blocks[map].column(x - begin);
        }
        work(range.begin + x, columns);
      }
      for (std::size_t map = 0; back && map < blocks.size(); ++map) {
        blocks[map].pack(bundle);
        blocks[map].inverse(bundle);
      }
    }
    for (std::size_t map = 0; back && map < blocks.size(); ++map) {
      blocks[map].store(strips[map]->data() + begin, width, p.ny);
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
  for_each_row_bundle(p.rows, p.ny, [&](RowBundle<Real>& rows, Index y, Index count) {
    for (Index i = 0; i < count; ++i) {
      // The inverse destroys its input: zeros are written anew for every row.
      Complex* const frequencies = rows.spectrum(i);
      std::fill(frequencies, frequencies + p.rows.n_frequencies(), Complex(0));
      std::copy_n(strip.data() + (y + i) * range.size(), range.size(), frequencies + range.begin);
    }
    rows.inverse(count);
    for (Index i = 0; i < count; ++i) {
      sink(y + i, {rows.row(i), static_cast<std::size_t>(p.rows.n())});
    }
  });
}

template class StripTransform<float>;
template class StripTransform<double>;

}  // namespace tabor::spectral
