#include "tabor/spectral/fft.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "support/folder.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::spectral {
namespace {

using Spectrum = std::vector<std::complex<double>>;

Spectrum transform(const Field& map) {
  Spectrum spectrum(static_cast<std::size_t>(map.rows() * (map.cols() / 2 + 1)));
  RealFft2d<double>(map.rows(), map.cols()).forward(map.data(), spectrum.data());
  return spectrum;
}

std::complex<double> naive_mode(const Field& map, Index ky, Index kx) {
  std::complex<double> sum = 0;
  for (Index y = 0; y < map.rows(); ++y) {
    for (Index x = 0; x < map.cols(); ++x) {
      const double phase = -2 * std::numbers::pi *
                           (static_cast<double>(ky * y) / static_cast<double>(map.rows()) +
                            static_cast<double>(kx * x) / static_cast<double>(map.cols()));
      sum += map(y, x) * std::polar(1.0, phase);
    }
  }
  return sum;
}

class Sizes : public testing::TestWithParam<std::pair<Index, Index>> {};

TEST_P(Sizes, ForwardIsTheDefiningSum) {
  const auto [ny, nx] = GetParam();
  const Field map = Field::Random(ny, nx);
  const Spectrum spectrum = transform(map);
  for (Index ky = 0; ky < ny; ++ky) {
    for (Index kx = 0; kx <= nx / 2; ++kx) {
      const auto got = spectrum[static_cast<std::size_t>(ky * (nx / 2 + 1) + kx)];
      EXPECT_NEAR(std::abs(got - naive_mode(map, ky, kx)), 0, 1e-12 * static_cast<double>(nx * ny));
    }
  }
}

TEST_P(Sizes, InverseUndoesForward) {
  const auto [ny, nx] = GetParam();
  const Field map = Field::Random(ny, nx);
  Spectrum spectrum = transform(map);
  Field back(ny, nx);
  RealFft2d<double>(ny, nx).inverse(spectrum.data(), back.data());
  EXPECT_LE((back - map).abs().maxCoeff(), 1e-14);
}

TEST_P(Sizes, PaddedConvolutionIsTheDirectSum) {
  const auto [ny, nx] = GetParam();
  const auto kernel = [](Index y, Index x) {
    return 1.0 / (1.0 + static_cast<double>(y * y + 2 * x * x));
  };
  const Field values = even_spectrum(2 * ny, 2 * nx, kernel);
  const Field map = Field::Random(ny, nx);
  Field result(ny, nx);
  Convolution<double>(ny, nx, Padding::zero)
      .apply(
          map.data(),
          [&](Index kx, std::span<double> out) {
            std::copy_n(&values(kx, 0), out.size(), out.begin());
          },
          result.data());
  for (Index y = 0; y < ny; ++y) {
    for (Index x = 0; x < nx; ++x) {
      double expected = 0;
      for (Index j = 0; j < ny; ++j) {
        for (Index i = 0; i < nx; ++i) {
          expected += map(j, i) * kernel(std::abs(y - j), std::abs(x - i));
        }
      }
      EXPECT_NEAR(result(y, x), expected, 1e-13 * static_cast<double>(nx * ny));
    }
  }
}

template <typename Real, typename Map>
void expect_mirrored_convolution_is_that_of_the_images(Index ny, Index nx, double tolerance) {
  const auto factor = [](Index kx, Index ky) {
    return 1 / (1 + 0.3 * static_cast<double>(kx * kx) + static_cast<double>(ky));
  };
  const auto multiplier = [&](Index kx, std::span<Real> out) {
    for (std::size_t ky = 0; ky < out.size(); ++ky) {
      out[ky] = static_cast<Real>(factor(kx, static_cast<Index>(ky)));
    }
  };
  const Map map = Map::Random(ny, nx);
  Map all = mirror_images(map);
  Convolution<Real>(2 * ny, 2 * nx).apply(all.data(), multiplier, all.data());
  Map one = map;
  Convolution<Real>(ny, nx, Padding::mirror).apply(one.data(), multiplier, one.data());
  EXPECT_LE((all - mirror_images(one)).abs().maxCoeff(), tolerance);
}

TEST_P(Sizes, MirroredConvolutionIsThatOfTheImages) {
  const auto [ny, nx] = GetParam();
  expect_mirrored_convolution_is_that_of_the_images<double, Field>(ny, nx, 1e-14);
  expect_mirrored_convolution_is_that_of_the_images<float, FieldF>(ny, nx, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    EvenOddPrimeAndThin, Sizes,
    testing::Values(std::pair<Index, Index>{8, 8}, std::pair<Index, Index>{7, 12},
                    std::pair<Index, Index>{13, 5}, std::pair<Index, Index>{1, 9},
                    std::pair<Index, Index>{9, 1}, std::pair<Index, Index>{1, 1},
                    std::pair<Index, Index>{21, 22}, std::pair<Index, Index>{1, 242},
                    std::pair<Index, Index>{226, 2}));

/// Libraries take other algorithms for long rows and columns, and for large prime factors.
TEST(RealFft2d, TransformsOneWaveOfLongRowsAndColumns) {
  for (const auto& [ny, nx] :
       {std::pair<Index, Index>{3, 10290}, {10290, 6}, {5, 1511}, {1511, 18}, {4096, 20}}) {
    const Index ky = ny - 1;
    const Index kx = std::min<Index>(2, nx / 2);
    Field map(ny, nx);
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) {
        map(y, x) = std::cos(2 * std::numbers::pi *
                             (static_cast<double>(ky * y % ny) / static_cast<double>(ny) +
                              static_cast<double>(kx * x % nx) / static_cast<double>(nx)));
      }
    }
    Spectrum spectrum = transform(map);
    const auto size = static_cast<double>(ny * nx);
    const Index width = nx / 2 + 1;
    spectrum[static_cast<std::size_t>(ky * width + kx)] -= size / 2;
    for (const std::complex<double> value : spectrum) ASSERT_LT(std::abs(value), 1e-12 * size);
    spectrum[static_cast<std::size_t>(ky * width + kx)] += size / 2;
    Field back(ny, nx);
    RealFft2d<double>(ny, nx).inverse(spectrum.data(), back.data());
    EXPECT_LE((back - map).abs().maxCoeff(), 1e-13);
  }
}

TEST(RealFft2d, NamesItsLibrary) {
  EXPECT_THAT(transform_library(), testing::MatchesRegex("(FFTW 3|ducc0 0)\\.[0-9]+\\.[0-9]+"));
}

TEST(RealFft2d, KeepsTheSumOfSquares) {
  const Field map = Field::Random(54, 40);
  const Spectrum spectrum = transform(map);
  double power = 0;
  for (Index ky = 0; ky < 54; ++ky) {
    for (Index kx = 0; kx <= 20; ++kx) {
      const double weight = (kx == 0 || kx == 20) ? 1 : 2;  // the other half of the spectrum
      power += weight * std::norm(spectrum[static_cast<std::size_t>(ky * 21 + kx)]);
    }
  }
  const double error = std::abs(power / (54 * 40) / map.square().sum() - 1);
  test::expect_within("Spectra", "Parseval, 54 x 40", "sum of squares, relative", "identity", error,
                      1e-14);
}

TEST(Convolution, HasTheSameBitsForAnyThreadCount) {
  const FieldF map = FieldF::Random(120, 90);
  const auto smooth = [](Index kx, std::span<float> values) {
    for (std::size_t ky = 0; ky < values.size(); ++ky) {
      values[ky] = 1.0F / (1.0F + static_cast<float>(kx) + static_cast<float>(ky));
    }
  };
  FieldF first(120, 90);
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    FieldF result(120, 90);
    Convolution<float>(120, 90).apply(map.data(), smooth, result.data());
    if (threads == 1) first = result;
    EXPECT_TRUE((result == first).all()) << threads;
  }
  set_thread_count(0);
}

TEST(Wisdom, MeasuredPlansTransformAlikeAndAbsentFilesAreRejected) {
  const test::Folder folder;
  EXPECT_THROW(load_wisdom(folder / "absent"), InputError);
  if (!transform_library().starts_with("FFTW")) {
    EXPECT_THROW(measure_wisdom(8, 8, folder / "wisdom"), InputError);
    return;
  }
  EXPECT_THROW(measure_wisdom(8, 8, folder / "no" / "folder"), OutputError);
  const Field map = Field::Random(24, 36);
  const Spectrum estimated = transform(map);
  measure_wisdom(24, 36, folder / "wisdom");
  load_wisdom(folder / "wisdom");
  const Spectrum measured = transform(map);
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    EXPECT_NEAR(std::abs(measured[k] - estimated[k]), 0, 1e-12);
  }
}

TEST(GoodFftSize, IsTheNextSmoothNumber) {
  EXPECT_EQ(good_fft_size(3456), 3456);
  EXPECT_EQ(good_fft_size(3401), 3402);  // 2 3^5 7
  EXPECT_EQ(good_fft_size(1), 1);
  EXPECT_EQ(largest_prime_factor(3400), 17);
  EXPECT_EQ(largest_prime_factor(97), 97);
}

TEST(Wavevector, IsNegativeAboveTheMiddle) {
  EXPECT_DOUBLE_EQ(wavevector(1, 8, 2.0), std::numbers::pi);
  EXPECT_DOUBLE_EQ(wavevector(7, 8, 2.0), -std::numbers::pi);
  EXPECT_DOUBLE_EQ(wavevector(4, 8, 2.0), 4 * std::numbers::pi);
}

}  // namespace
}  // namespace tabor::spectral
