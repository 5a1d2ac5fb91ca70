#include "tabor/elastic/line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"

namespace tabor::elastic {
namespace {

/// From here on the mean logarithm is summed as a series in 1 / offset^2: the closed forms below
/// lose digits with every power of the offset.
constexpr Index kFar = 4;
constexpr int kTerms = 12;

/// -(coefficient of offset^(-2 m)), m = 1 .. kTerms, in the mean of ln|offset - s| over an element,
/// lengths in spacings.
constexpr std::array<double, kTerms> far_coefficients(PressureShape shape) {
  std::array<double, kTerms> result{};
  double quarter = 1;
  for (int i = 0; i < kTerms; ++i) {
    const double m = i + 1;
    quarter *= 0.25;
    result[static_cast<std::size_t>(i)] = shape == PressureShape::uniform
                                              ? quarter / (2 * m * (2 * m + 1))
                                              : 1 / (m * (2 * m + 1) * (2 * m + 2));
  }
  return result;
}

double far_series(PressureShape shape, double offset) {
  static constexpr auto kUniform = far_coefficients(PressureShape::uniform);
  static constexpr auto kLinear = far_coefficients(PressureShape::linear);
  const auto& coefficients = shape == PressureShape::uniform ? kUniform : kLinear;
  const double x = 1 / (offset * offset);
  double sum = 0;
  for (auto coefficient = coefficients.rbegin(); coefficient != coefficients.rend();
       ++coefficient) {
    sum = (sum + *coefficient) * x;
  }
  return sum;
}

double x_log(double x) { return x == 0 ? 0 : x * std::log(std::abs(x)); }

/// Twice integrated logarithm.
double x2_log(double x) { return 0.5 * x * x_log(x) - 0.75 * x * x; }

/// Integral of ln|offset - s| over the element of one node, lengths in spacings.
double mean_log(PressureShape shape, Index offset) {
  const auto k = static_cast<double>(std::abs(offset));
  if (k >= kFar) return std::log(k) - far_series(shape, k);
  return shape == PressureShape::uniform ? x_log(k + 0.5) - x_log(k - 0.5) - 1
                                         : x2_log(k + 1) - 2 * x2_log(k) + x2_log(k - 1);
}

/// mean_log(offset + 1) - 2 mean_log(offset) + mean_log(offset - 1) without its cancellation.
double mean_log_difference(PressureShape shape, Index offset) {
  const Index near = std::abs(offset);
  const auto k = static_cast<double>(near);
  if (near <= kFar) {
    return mean_log(shape, near + 1) - 2 * mean_log(shape, near) + mean_log(shape, near - 1);
  }
  return std::log1p(-1 / (k * k)) -
         (far_series(shape, k + 1) - 2 * far_series(shape, k) + far_series(shape, k - 1));
}

void check(Index n_nodes, double spacing, double effective_modulus) {
  if (!(effective_modulus > 0) || !std::isfinite(effective_modulus)) {
    throw InputError("effective modulus", fmt::format("{} Pa", effective_modulus),
                     "a positive number", "check Young's modulus and Poisson's ratio");
  }
  if (n_nodes < 3 || !(spacing > 0) || !std::isfinite(spacing)) {
    throw InputError("line of nodes", fmt::format("{} nodes {} m apart", n_nodes, spacing),
                     "at least 3 nodes and a positive spacing", "");
  }
}

/// Enough nodes that a convolution of n values with 2 n - 1 coefficients does not wrap round.
Index padded(Index n_nodes, double spacing, double effective_modulus) {
  check(n_nodes, spacing, effective_modulus);
  return spectral::good_fft_size(2 * n_nodes);
}

/// A map of one row seen by the contact solvers.
class LineOperator final : public ElasticOperator {
 public:
  explicit LineOperator(const Grid& grid, double effective_modulus)
      : grid_(grid), line_(grid.nx, grid.dx(), effective_modulus) {}

  const Grid& grid() const override { return grid_; }
  double effective_modulus() const override { return line_.effective_modulus(); }
  Border border() const override { return Border::ends; }
  double fft_seconds() const override { return fft_seconds_; }
  std::unique_ptr<ElasticOperator> on_grid(const Grid& grid) const override {
    return make_line(grid, effective_modulus());
  }
  bool apply_inverse(const Field&, Field&) override { return false; }

  void apply(const Field& pressure, Field& displacement) override {
    const Stopwatch watch;
    displacement.resize(grid_.ny, grid_.nx);
    const auto n = static_cast<std::size_t>(grid_.nx);
    line_.apply({pressure.data(), n}, {displacement.data(), n});
    fft_seconds_ += watch.seconds();
  }
  /// In double precision: one row is too short to gain from less.
  void apply(const FieldF& pressure, FieldF& displacement) override {
    Field result;
    apply(Field(pressure.cast<double>()), result);
    displacement = result.cast<float>();
  }

 private:
  Grid grid_;
  LineHalfSpace line_;
  double fft_seconds_ = 0;
};

}  // namespace

LineHalfSpace::LineHalfSpace(Index n_nodes, double spacing, double effective_modulus,
                             PressureShape shape)
    : n_nodes_(n_nodes),
      spacing_(spacing),
      effective_modulus_(effective_modulus),
      shape_(shape),
      transform_(1, padded(n_nodes, spacing, effective_modulus)),
      spectrum_(spectrum_of([this](Index k) { return influence(k); })),
      difference_spectrum_(spectrum_of([this](Index k) { return second_difference(k); })) {}

double LineHalfSpace::influence(Index offset) const {
  const double relative = mean_log(shape_, offset) - std::log(static_cast<double>(n_nodes_));
  return -2 * spacing_ / (std::numbers::pi * effective_modulus_) * relative;
}

double LineHalfSpace::second_difference(Index offset) const {
  return -2 * spacing_ / (std::numbers::pi * effective_modulus_) *
         mean_log_difference(shape_, offset);
}

Eigen::MatrixXd LineHalfSpace::matrix() const {
  Eigen::MatrixXd result(n_nodes_, n_nodes_);
  for (Index k = 0; k < n_nodes_; ++k) {
    const double value = influence(k);
    result.diagonal(k).setConstant(value);
    result.diagonal(-k).setConstant(value);
  }
  return result;
}

Eigen::MatrixXd LineHalfSpace::differential_matrix() const {
  Eigen::MatrixXd result(n_nodes_, n_nodes_);
  for (Index k = 0; k < n_nodes_; ++k) {
    const double value = second_difference(k);
    result.diagonal(k).setConstant(value);
    result.diagonal(-k).setConstant(value);
  }
  for (Index k = 0; k < n_nodes_; ++k) {
    result(0, k) = result(n_nodes_ - 1, n_nodes_ - 1 - k) = influence(k);
  }
  return result;
}

template <typename Coefficient>
Eigen::ArrayXd LineHalfSpace::spectrum_of(const Coefficient& coefficient) const {
  const Index m = transform_.nx();
  std::vector<double> row(static_cast<std::size_t>(m), 0.0);
  for (Index k = 0; k < n_nodes_; ++k) {
    row[static_cast<std::size_t>(k)] = coefficient(k);
    row[static_cast<std::size_t>((m - k) % m)] = coefficient(k);
  }
  std::vector<std::complex<double>> spectrum(
      static_cast<std::size_t>(transform_.spectrum_columns()));
  transform_.forward(row.data(), spectrum.data());
  Eigen::ArrayXd real(transform_.spectrum_columns());  // the row is even
  for (Index k = 0; k < real.size(); ++k) real[k] = spectrum[static_cast<std::size_t>(k)].real();
  return real;
}

void LineHalfSpace::convolve(std::span<const double> pressure, const Eigen::ArrayXd& spectrum,
                             std::span<double> result) const {
  const auto n = static_cast<std::size_t>(n_nodes_);
  assert(pressure.size() == n && result.size() == n);
  std::vector<double> row(static_cast<std::size_t>(transform_.nx()), 0.0);
  std::copy(pressure.begin(), pressure.end(), row.begin());
  Eigen::ArrayXcd modes(transform_.spectrum_columns());
  transform_.forward(row.data(), modes.data());
  modes *= spectrum;
  transform_.inverse(modes.data(), row.data());
  std::copy_n(row.begin(), n, result.begin());
}

void LineHalfSpace::apply(std::span<const double> pressure, std::span<double> displacement) const {
  convolve(pressure, spectrum_, displacement);
}

void LineHalfSpace::apply_differential(std::span<const double> pressure,
                                       std::span<double> differences) const {
  // The ends are summed before `differences` is written: both may be the same memory.
  double first = 0;
  double last = 0;
  for (Index k = 0; k < n_nodes_; ++k) {
    first += influence(k) * pressure[static_cast<std::size_t>(k)];
    last += influence(k) * pressure[static_cast<std::size_t>(n_nodes_ - 1 - k)];
  }
  convolve(pressure, difference_spectrum_, differences);
  differences.front() = first;
  differences.back() = last;
}

void displacement_from_differences(std::span<const double> differences,
                                   std::span<double> displacement) {
  const std::size_t n = differences.size();
  assert(n >= 3 && displacement.size() == n);
  const double first = differences.front();
  const double last = differences.back();
  // Sum up with u = slope = 0 at the first node, then turn the result until the last node fits.
  double slope = 0;
  double value = 0;
  double next = differences[1];
  displacement[0] = 0;
  for (std::size_t i = 1; i < n; ++i) {
    value += slope;
    slope += next;
    next = i + 1 < n ? differences[i + 1] : 0;
    displacement[i] = value;
  }
  const double turn = (last - first - value) / static_cast<double>(n - 1);
  for (std::size_t i = 0; i < n; ++i) displacement[i] += first + turn * static_cast<double>(i);
}

std::unique_ptr<ElasticOperator> make_line(const Grid& grid, double effective_modulus) {
  if (grid.ny != 1) {
    throw InputError("grid of a line contact", fmt::format("{} rows", grid.ny), "1 row", "");
  }
  return std::make_unique<LineOperator>(grid, effective_modulus);
}

}  // namespace tabor::elastic
