#include "tabor/elastic/half_space.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/padding.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::elastic {
namespace {

/// An operator that is a convolution with a known spectrum. Scratch memory is held for the
/// precision used last only: solvers change it a few times per solution.
class ConvolutionOperator : public ElasticOperator {
 public:
  ConvolutionOperator(const Grid& grid, double effective_modulus, Border border)
      : grid_(grid), effective_modulus_(effective_modulus), border_(border) {}

  const Grid& grid() const override { return grid_; }
  double effective_modulus() const override { return effective_modulus_; }
  Border border() const override { return border_; }
  double fft_seconds() const override { return fft_seconds_; }

  void apply(const Field& pressure, Field& displacement) override {
    convolve(
        pressure, [this](Index kx, std::span<double> values) { fill(kx, values); }, displacement);
  }
  void apply(const FieldF& pressure, FieldF& displacement) override {
    double_.reset();
    run<float>(
        single_, pressure, [this](Index kx, std::span<float> values) { fill(kx, values); },
        displacement);
  }
  bool apply_inverse(const Field&, Field&) override { return false; }
  void free_memory() override {
    single_.reset();
    double_.reset();
  }

 protected:
  /// out = F^-1 [ values F [in] ] in double precision.
  void convolve(const Field& in, const spectral::Multiplier<double>& values, Field& out) {
    const bool was_single = single_.has_value();
    single_.reset();
    run<double>(double_, in, values, out);
    if (was_single) double_.reset();
  }

  virtual void fill(Index kx, std::span<double> values) const = 0;
  virtual void fill(Index kx, std::span<float> values) const = 0;

 private:
  template <typename Real, typename Map>
  void run(std::optional<spectral::Convolution<Real>>& convolution, const Map& in,
           const spectral::Multiplier<Real>& values, Map& out) {
    const Stopwatch watch;
    if (!convolution) convolution.emplace(grid_.ny, grid_.nx, padding_of(border_));
    out.resize(grid_.ny, grid_.nx);
    convolution->apply(in.data(), values, out.data());
    fft_seconds_ += watch.seconds();
  }

  Grid grid_;
  double effective_modulus_;  // E* [Pa]
  Border border_;
  double fft_seconds_ = 0;
  std::optional<spectral::Convolution<double>> double_;
  std::optional<spectral::Convolution<float>> single_;
};

/// Half-space under a pressure that repeats with the map, or with 2 x 2 mirror images of it.
class PeriodicHalfSpace final : public ConvolutionOperator {
 public:
  PeriodicHalfSpace(const Grid& grid, double effective_modulus, Border border)
      : ConvolutionOperator(grid, effective_modulus, border),
        images_(border == Border::mirrors ? 2 : 1) {}

  std::unique_ptr<ElasticOperator> on_grid(const Grid& grid) const override {
    return std::make_unique<PeriodicHalfSpace>(grid, effective_modulus(), border());
  }
  ElasticOperator* of_image() override {
    if (border() == Border::mirrors || grid().nx % 2 != 0 || grid().ny % 2 != 0) return nullptr;
    if (!image_) {
      const Grid image{grid().nx / 2, grid().ny / 2, grid().lx / 2, grid().ly / 2};
      image_ = make_mirrored(image, effective_modulus());
    }
    return image_.get();
  }
  double fft_seconds() const override {
    return ConvolutionOperator::fft_seconds() + (image_ ? image_->fft_seconds() : 0);
  }
  void free_memory() override {
    ConvolutionOperator::free_memory();
    if (image_) image_->free_memory();
  }
  bool apply_inverse(const Field& displacement, Field& pressure) override {
    convolve(
        displacement, [this](Index kx, std::span<double> values) { stiffness(kx, values); },
        pressure);
    return true;
  }

 private:
  /// E* |q| / 2.
  void stiffness(Index kx, std::span<double> values) const {
    compliance(kx, values);
    for (double& value : values) value = value > 0 ? 1 / value : 0;
  }

  void fill(Index kx, std::span<double> values) const override { compliance(kx, values); }
  void fill(Index kx, std::span<float> values) const override { compliance(kx, values); }

  /// 2 / (E* |q|), 0 for q = 0.
  template <typename Real>
  void compliance(Index kx, std::span<Real> values) const {
    const double period = static_cast<double>(images_);
    const double qx = spectral::wavevector(kx, images_ * grid().nx, period * grid().lx);
    const double dqy = 2 * std::numbers::pi / (period * grid().ly);
    const auto qx2 = static_cast<Real>(qx * qx);
    const auto dqy2 = static_cast<Real>(dqy * dqy);
    const auto twice_compliance = static_cast<Real>(2 / effective_modulus());
    for (std::size_t ky = 0; ky < values.size(); ++ky) {
      const auto k = static_cast<Real>(ky);
      values[ky] = twice_compliance / std::sqrt(qx2 + dqy2 * k * k);
    }
    if (kx == 0) values[0] = 0;
  }

  Index images_;  // along each side of the cell that repeats
  std::unique_ptr<ElasticOperator> image_;
};

class FreeHalfSpace final : public ConvolutionOperator {
 public:
  FreeHalfSpace(const Grid& grid, double effective_modulus)
      : ConvolutionOperator(grid, effective_modulus, Border::ends),
        spectrum_(spectral::even_spectrum(2 * grid.ny, 2 * grid.nx, [&](Index y, Index x) {
          return love_coefficient(static_cast<double>(x) * grid.dx(),
                                  static_cast<double>(y) * grid.dy(), grid.dx(), grid.dy(),
                                  effective_modulus);
        })) {}
  std::unique_ptr<ElasticOperator> on_grid(const Grid& grid) const override {
    return make_free(grid, effective_modulus());
  }

 private:
  void fill(Index kx, std::span<double> values) const override { copy(kx, values); }
  void fill(Index kx, std::span<float> values) const override { copy(kx, values); }

  template <typename Real>
  void copy(Index kx, std::span<Real> values) const {
    for (std::size_t ky = 0; ky < values.size(); ++ky) {
      values[ky] = static_cast<Real>(spectrum_(kx, static_cast<Index>(ky)));
    }
  }

  Field spectrum_;  // [m/Pa], shape (nx + 1, ny + 1): one row per column of the map's spectrum
};

void check(const Grid& grid, double effective_modulus) {
  if (!(effective_modulus > 0) || !std::isfinite(effective_modulus)) {
    throw InputError("effective modulus", fmt::format("{} Pa", effective_modulus),
                     "a positive number", "check Young's modulus and Poisson's ratio");
  }
  if (grid.nx < 1 || grid.ny < 1 || !(grid.lx > 0) || !(grid.ly > 0)) {
    throw InputError(
        "grid", fmt::format("{} x {} pixels on {} m x {} m", grid.nx, grid.ny, grid.lx, grid.ly),
        "at least one pixel and a positive size", "");
  }
}

}  // namespace

double love_coefficient(double x, double y, double dx, double dy, double effective_modulus) {
  const double right = x + dx / 2;
  const double left = x - dx / 2;
  const double top = y + dy / 2;
  const double bottom = y - dy / 2;
  // Integral of a ln((b + hypot(a, b)) / (d + hypot(a, d))) terms; asinh keeps its digits where
  // b + hypot(a, b) would cancel.
  const auto edge = [](double a, double b, double d) {
    return a == 0 ? 0.0 : a * (std::asinh(b / std::abs(a)) - std::asinh(d / std::abs(a)));
  };
  const double sum = edge(right, top, bottom) - edge(left, top, bottom) + edge(top, right, left) -
                     edge(bottom, right, left);
  return sum / (std::numbers::pi * effective_modulus);
}

std::unique_ptr<ElasticOperator> make_periodic(const Grid& grid, double effective_modulus) {
  check(grid, effective_modulus);
  return std::make_unique<PeriodicHalfSpace>(grid, effective_modulus, Border::repeats);
}

std::unique_ptr<ElasticOperator> make_mirrored(const Grid& grid, double effective_modulus) {
  check(grid, effective_modulus);
  return std::make_unique<PeriodicHalfSpace>(grid, effective_modulus, Border::mirrors);
}

std::unique_ptr<ElasticOperator> make_free(const Grid& grid, double effective_modulus) {
  check(grid, effective_modulus);
  return std::make_unique<FreeHalfSpace>(grid, effective_modulus);
}

}  // namespace tabor::elastic
