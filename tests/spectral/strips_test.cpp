// Transforms in strips and even spectra, against their defining sums.
#include "tabor/spectral/strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/spectral/fft.hpp"

namespace tabor::spectral {
namespace {

using Transform = StripTransform<double>;
using Complex = std::complex<double>;

/// A map, the zero map in whose corner it stands, and the columns of each strip of its spectrum.
struct Case {
  Index ny, nx, padded_ny, padded_nx;
  std::vector<Index> cuts;
};

std::vector<Case> cases() {
  return {{5, 7, 8, 12, {0, 7}}, {20, 35, 24, 40, {0, 1, 18, 21}}, {1, 6, 1, 6, {0, 2, 4}}};
}

RowSource<double> rows_of(const Field& map) {
  return
      [&map](Index y, std::span<double> row) { std::copy_n(&map(y, 0), row.size(), row.data()); };
}

Complex turn(Index k, Index n, Index position) {
  return std::polar(
      1.0, -2 * std::numbers::pi * static_cast<double>(k * position % n) / static_cast<double>(n));
}

Complex mode(const Field& map, const Case& at, Index ky, Index kx) {
  Complex sum = 0;
  for (Index y = 0; y < map.rows(); ++y) {
    for (Index x = 0; x < map.cols(); ++x) {
      sum += map(y, x) * turn(ky, at.padded_ny, y) * turn(kx, at.padded_nx, x);
    }
  }
  return sum;
}

TEST(StripTransform, ShowsEveryColumnOfTheSpectraOfAllMaps) {
  for (const Case& at : cases()) {
    const Field first = Field::Random(at.ny, at.nx);
    const Field second = Field::Random(at.ny, at.nx);
    const Transform transform(at.ny, at.nx, at.padded_ny, at.padded_nx);
    EXPECT_EQ(transform.padded_ny(), at.padded_ny);
    EXPECT_EQ(transform.padded_nx(), at.padded_nx);
    EXPECT_EQ(transform.n_frequencies(), at.cuts.back());
    std::vector<int> shown(static_cast<std::size_t>(at.cuts.back()), 0);
    for (std::size_t part = 1; part < at.cuts.size(); ++part) {
      const ColumnRange range{at.cuts[part - 1], at.cuts[part]};
      Transform::Strip one;
      Transform::Strip two;
      transform.rows_forward(rows_of(first), range, one);
      transform.rows_forward(rows_of(second), range, two);
      Transform::Strip* strips[]{&one, &two};
      transform.read_columns(strips, range, [&](Index kx, std::span<Complex* const> columns) {
        ++shown[static_cast<std::size_t>(kx)];
        for (Index ky = 0; ky < at.padded_ny; ++ky) {
          EXPECT_LT(std::abs(columns[0][ky] - mode(first, at, ky, kx)), 1e-11);
          EXPECT_LT(std::abs(columns[1][ky] - mode(second, at, ky, kx)), 1e-11);
        }
      });
    }
    EXPECT_EQ(shown, std::vector<int>(shown.size(), 1));
  }
}

/// The map moved by one row and two columns round the padded one, times its size: what the inverse
/// gives where each mode is turned accordingly.
TEST(StripTransform, SumsOfInverseStripsAreTheInverseOfTheWhole) {
  for (const Case& at : cases()) {
    const Field map = Field::Random(at.ny, at.nx);
    const Transform transform(at.ny, at.nx, at.padded_ny, at.padded_nx);
    Field sum = Field::Zero(at.ny, at.padded_nx);
    for (std::size_t part = 1; part < at.cuts.size(); ++part) {
      const ColumnRange range{at.cuts[part - 1], at.cuts[part]};
      Transform::Strip strip;
      transform.rows_forward(rows_of(map), range, strip);
      Transform::Strip* strips[]{&strip};
      transform.change_columns(strips, range, [&](Index kx, std::span<Complex* const> columns) {
        for (Index ky = 0; ky < at.padded_ny; ++ky) {
          columns[0][ky] *= turn(ky, at.padded_ny, 1) * turn(kx, at.padded_nx, 2);
        }
      });
      transform.rows_inverse(strip, range, [&](Index y, std::span<const double> row) {
        ASSERT_EQ(std::ssize(row), at.padded_nx);
        for (Index x = 0; x < at.padded_nx; ++x) sum(y, x) += row[static_cast<std::size_t>(x)];
      });
    }
    const double size = static_cast<double>(at.padded_ny * at.padded_nx);
    for (Index y = 0; y < at.ny; ++y) {
      for (Index x = 0; x < at.padded_nx; ++x) {
        const Index from_y = (y - 1 + at.padded_ny) % at.padded_ny;
        const Index from_x = (x - 2 + at.padded_nx) % at.padded_nx;
        const double expected = from_y < at.ny && from_x < at.nx ? map(from_y, from_x) : 0;
        EXPECT_NEAR(sum(y, x) / size, expected, 1e-13);
      }
    }
  }
}

TEST(StripTransform, IsTheSameBitsHoweverItIsCut) {
  const Field map = Field::Random(20, 35);
  const Transform transform(20, 35, 24, 40);
  Transform::Strip whole;
  transform.rows_forward(rows_of(map), {0, 21}, whole);
  Transform::Strip part;
  transform.rows_forward(rows_of(map), {4, 9}, part);
  for (Index y = 0; y < 20; ++y) {
    for (Index x = 4; x < 9; ++x) {
      EXPECT_EQ(part[static_cast<std::size_t>(5 * y + x - 4)],
                whole[static_cast<std::size_t>(21 * y + x)]);
    }
  }
}

TEST(EvenSpectrum, IsTheSumOverTheEvenMap) {
  for (const auto& [ny, nx] :
       {std::pair<Index, Index>{6, 8}, {7, 5}, {1, 6}, {6, 1}, {2, 2}, {34, 20}}) {
    const auto value = [](Index y, Index x) {
      return 1 / (1 + static_cast<double>(y + 3 * x)) - 0.1 * static_cast<double>(x);
    };
    Field even(ny, nx);
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) even(y, x) = value(std::min(y, ny - y), std::min(x, nx - x));
    }
    const Field spectrum = even_spectrum(ny, nx, value);
    ASSERT_EQ(spectrum.rows(), nx / 2 + 1);
    ASSERT_EQ(spectrum.cols(), ny / 2 + 1);
    const Case at{ny, nx, ny, nx, {}};
    for (Index kx = 0; kx <= nx / 2; ++kx) {
      for (Index ky = 0; ky <= ny / 2; ++ky) {
        EXPECT_NEAR(spectrum(kx, ky), mode(even, at, ky, kx).real(), 1e-11);
      }
    }
  }
}

}  // namespace
}  // namespace tabor::spectral
