#include "tabor/spectral/mirrored.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/core/parallel.hpp"

namespace tabor::spectral {
namespace {

constexpr Index kPairsPerBlock = 8;

/// Product without the standard's care for infinite factors.
template <typename Real>
std::complex<Real> times(std::complex<Real> a, std::complex<Real> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// exp(-i pi k / (2 n)), k = 0 .. n/2.
template <typename Real>
std::vector<std::complex<Real>> turns(Index n) {
  std::vector<std::complex<Real>> list(static_cast<std::size_t>(n / 2 + 1));
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double angle = -std::numbers::pi * static_cast<double>(k) / static_cast<double>(2 * n);
    list[k] = {static_cast<Real>(std::cos(angle)), static_cast<Real>(std::sin(angle))};
  }
  return list;
}

/// Values at the frequencies k and n - k.
template <typename Real>
struct FrequencyPair {
  std::complex<Real> low;
  std::complex<Real> high;
};

/// Makes cosine transforms from the complex transform of the reordered values; turn: that of k.
constexpr auto to_cosines = []<typename Real>(const FrequencyPair<Real>& z, std::complex<Real> turn,
                                              Index = 0) -> FrequencyPair<Real> {
  const std::complex<Real> u = times(turn, z.low);
  const std::complex<Real> w = times(std::conj(turn), z.high);
  const std::complex<Real> difference = u - w;
  return {(u + w) * Real(0.5), {Real(-0.5) * difference.imag(), Real(0.5) * difference.real()}};
};

/// Inverse of to_cosines.
constexpr auto from_cosines = []<typename Real>(const FrequencyPair<Real>& c,
                                                std::complex<Real> turn,
                                                Index = 0) -> FrequencyPair<Real> {
  const std::complex<Real> turned(-c.high.imag(), c.high.real());
  return {times(std::conj(turn), c.low - turned), times(turn, c.low + turned)};
};

/// Replaces the values at each pair of frequencies by change(pair, turn, k). The value at 0 stays;
/// that at n / 2 is its own partner.
template <typename Real, typename Change>
void change_pairs(const std::vector<std::complex<Real>>& turns, Index n, std::complex<Real>* z,
                  const Change& change) {
  for (Index k = 1; k <= n - k; ++k) {
    const FrequencyPair<Real> changed =
        change(FrequencyPair<Real>{z[k], z[n - k]}, turns[static_cast<std::size_t>(k)], k);
    z[k] = changed.low;
    z[n - k] = changed.high;
  }
}

/// Goes to cosines, multiplies the real parts by first[k] and the imaginary ones by second[k], and
/// back.
template <typename Real>
void multiply_cosines(const std::vector<std::complex<Real>>& turns, Index n, const Real* first,
                      const Real* second, std::complex<Real>* z) {
  const auto times_factors = [=](std::complex<Real> value, Index k) {
    return std::complex<Real>(value.real() * first[k], value.imag() * second[k]);
  };
  z[0] = times_factors(z[0], 0);
  change_pairs(
      turns, n, z, [=](const FrequencyPair<Real>& values, std::complex<Real> turn, Index k) {
        const FrequencyPair<Real> cosines = to_cosines(values, turn);
        return from_cosines(
            FrequencyPair<Real>{times_factors(cosines.low, k), times_factors(cosines.high, n - k)},
            turn);
      });
}

/// Puts two rows into the order of the transform, as real and imaginary part: values at even places
/// rise from the front, the others from the back.
template <typename Real>
void join(const Real* a, const Real* b, Index n, std::complex<Real>* z) {
  for (Index j = 0; j < (n + 1) / 2; ++j) z[j] = {a[2 * j], b[2 * j]};
  for (Index j = 0; j < n / 2; ++j) z[n - 1 - j] = {a[2 * j + 1], b[2 * j + 1]};
}

/// Inverse of join(), times `scale`.
template <typename Real>
void part(const std::complex<Real>* z, Index n, Real scale, Real* a, Real* b) {
  for (Index j = 0; j < (n + 1) / 2; ++j) {
    a[2 * j] = z[j].real() * scale;
    b[2 * j] = z[j].imag() * scale;
  }
  for (Index j = 0; j < n / 2; ++j) {
    a[2 * j + 1] = z[n - 1 - j].real() * scale;
    b[2 * j + 1] = z[n - 1 - j].imag() * scale;
  }
}

/// Bundles of a block of `count` columns.
template <typename Real>
Index bundles(Index count) {
  return (count + ColumnBlock<Real>::kTogether - 1) / ColumnBlock<Real>::kTogether;
}

}  // namespace

template <typename Real>
MirroredConvolution<Real>::MirroredConvolution(Index ny, Index nx)
    : ny_(ny),
      nx_(nx),
      along_x_(nx),
      along_y_(ny),
      turns_x_(turns<Real>(nx)),
      turns_y_(turns<Real>(ny)),
      spectrum_(row_pairs() * nx) {}

template <typename Real>
void MirroredConvolution<Real>::apply(const Real* in, const Multiplier<Real>& multiplier,
                                      Real* out) {
  rows_forward(in);
  columns(multiplier);
  rows_inverse(out);
}

/// The last row of an odd number of them is its own partner.
template <typename Real>
void MirroredConvolution<Real>::rows_forward(const Real* map) {
  constexpr Index together = ColumnBlock<Real>::kTogether;
  parallel_for(row_pairs(), kPairsPerBlock, [&](Index begin, Index end) {
    ColumnBlock<Real> block(along_x_, together);
    block.begin_whole();
    for (Index pair = begin; pair < end; pair += together) {
      const Index count = std::min(together, end - pair);
      for (Index i = 0; i < count; ++i) {
        const Index y = 2 * (pair + i);
        const Real* const a = map + y * nx_;
        join(a, y + 1 < ny_ ? a + nx_ : a, nx_, block.column(i));
      }
      block.pack(0);
      block.forward(0);
      block.unpack(0);
      for (Index i = 0; i < count; ++i) {
        change_pairs(turns_x_, nx_, block.column(i), to_cosines);
        std::copy_n(block.column(i), nx_, spectrum_.data() + (pair + i) * nx_);
      }
    }
  });
}

/// Column pair p of the block holds columns 2 p and 2 p + 1 of the map, in the order of the
/// transform.
template <typename Real>
void MirroredConvolution<Real>::load_columns(Index begin, Index end,
                                             ColumnBlock<Real>& block) const {
  for (Index r = 0; r < row_pairs(); ++r) {
    const Complex* const row = spectrum_.data() + r * nx_;
    const bool has_two = 2 * r + 1 < ny_;
    for (Index pair = begin; pair < end; ++pair) {
      const Complex first = row[2 * pair];
      const Complex second = 2 * pair + 1 < nx_ ? row[2 * pair + 1] : Complex(0);
      Complex* const z = block.column(pair - begin);
      z[r] = {first.real(), second.real()};
      if (has_two) z[ny_ - 1 - r] = {first.imag(), second.imag()};
    }
  }
}

template <typename Real>
void MirroredConvolution<Real>::store_columns(Index begin, Index end, ColumnBlock<Real>& block) {
  for (Index r = 0; r < row_pairs(); ++r) {
    Complex* const row = spectrum_.data() + r * nx_;
    const bool has_two = 2 * r + 1 < ny_;
    for (Index pair = begin; pair < end; ++pair) {
      const Complex* const z = block.column(pair - begin);
      const Complex even = z[r];
      const Complex odd = has_two ? z[ny_ - 1 - r] : even;
      row[2 * pair] = {even.real(), odd.real()};
      if (2 * pair + 1 < nx_) row[2 * pair + 1] = {even.imag(), odd.imag()};
    }
  }
}

template <typename Real>
void MirroredConvolution<Real>::columns(const Multiplier<Real>& multiplier) {
  parallel_for((nx_ + 1) / 2, kPairsPerBlock, [&](Index begin, Index end) {
    const auto n = static_cast<std::size_t>(ny_);
    std::vector<Real> factors(2 * n);
    ColumnBlock<Real> block(along_y_, end - begin);
    block.begin_whole();
    load_columns(begin, end, block);
    for (Index bundle = 0; bundle < bundles<Real>(end - begin); ++bundle) {
      block.pack(bundle);
      block.forward(bundle);
      block.unpack(bundle);
      const Index first = bundle * ColumnBlock<Real>::kTogether;
      const Index last = std::min(first + ColumnBlock<Real>::kTogether, end - begin);
      for (Index i = first; i < last; ++i) {
        const Index kx = 2 * (begin + i);
        multiplier(kx, {factors.data(), n});
        if (kx + 1 < nx_) multiplier(kx + 1, {factors.data() + n, n});
        multiply_cosines(turns_y_, ny_, factors.data(), factors.data() + n, block.column(i));
      }
      block.pack(bundle);
      block.inverse(bundle);
      block.unpack(bundle);
    }
    store_columns(begin, end, block);
  });
}

template <typename Real>
void MirroredConvolution<Real>::rows_inverse(Real* map) {
  constexpr Index together = ColumnBlock<Real>::kTogether;
  const Real scale = Real(1) / static_cast<Real>(nx_ * ny_);
  parallel_for(row_pairs(), kPairsPerBlock, [&](Index begin, Index end) {
    ColumnBlock<Real> block(along_x_, together);
    block.begin_whole();
    for (Index pair = begin; pair < end; pair += together) {
      const Index count = std::min(together, end - pair);
      for (Index i = 0; i < count; ++i) {
        std::copy_n(spectrum_.data() + (pair + i) * nx_, nx_, block.column(i));
        change_pairs(turns_x_, nx_, block.column(i), from_cosines);
      }
      block.pack(0);
      block.inverse(0);
      block.unpack(0);
      for (Index i = 0; i < count; ++i) {
        const Index y = 2 * (pair + i);
        Real* const a = map + y * nx_;
        part(block.column(i), nx_, scale, a, y + 1 < ny_ ? a + nx_ : a);
      }
    }
  });
}

template class MirroredConvolution<float>;
template class MirroredConvolution<double>;

}  // namespace tabor::spectral
