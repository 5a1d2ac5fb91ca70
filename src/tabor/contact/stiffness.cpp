#include "tabor/contact/stiffness.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tabor/contact/preconditioner.hpp"

namespace tabor::contact {
namespace {

constexpr int kMostIterations = 2000;

PixelList free_pixels(const State& state, double saturation_pressure) {
  PixelList pixels;
  for (Index i = 0; i < state.pressure.size(); ++i) {
    if (state.pressure(i) > 0 && state.pressure(i) < saturation_pressure) {
      pixels.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return pixels;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// S and M restricted to a set of pixels, as maps of vectors.
class Restricted {
 public:
  Restricted(elastic::ElasticOperator& elasticity, const PixelList& set)
      : elasticity_(elasticity),
        set_(set),
        preconditioner_(elasticity.grid(), elasticity.effective_modulus(), elasticity.drops_mean()),
        pressure_(Field::Zero(elasticity.grid().ny, elasticity.grid().nx)),
        residual_(FieldF::Zero(elasticity.grid().ny, elasticity.grid().nx)) {}

  std::vector<double> displacement(const std::vector<double>& pressure) {
    for (std::size_t k = 0; k < set_.size(); ++k) pressure_(set_[k]) = pressure[k];
    elasticity_.apply(pressure_, displacement_);
    std::vector<double> values(set_.size());
    for (std::size_t k = 0; k < set_.size(); ++k) values[k] = displacement_(set_[k]);
    return values;
  }

  std::vector<double> preconditioned(const std::vector<double>& residual) {
    for (std::size_t k = 0; k < set_.size(); ++k) {
      residual_(set_[k]) = static_cast<float>(residual[k]);
    }
    std::vector<float> values;
    std::vector<float> row_sums;
    preconditioner_.apply(set_, residual_, values, row_sums);
    return {values.begin(), values.end()};
  }

 private:
  elastic::ElasticOperator& elasticity_;
  const PixelList& set_;
  Preconditioner preconditioner_;
  Field pressure_;
  Field displacement_;
  FieldF residual_;
};

}  // namespace

Stiffness contact_stiffness(elastic::ElasticOperator& elasticity, const State& state,
                            double saturation_pressure, double tolerance) {
  const PixelList set = free_pixels(state, saturation_pressure);
  Stiffness stiffness;
  stiffness.convergence = exact(tolerance);
  const Index n_pixels = state.pressure.size();
  if (set.empty()) return stiffness;
  if (elasticity.drops_mean() && static_cast<Index>(set.size()) == n_pixels) {
    stiffness.value = std::numeric_limits<double>::infinity();
    return stiffness;
  }
  Restricted restricted(elasticity, set);
  std::vector<double> solution(set.size(), 0.0);
  std::vector<double> residual(set.size(), 1.0);  // of S x = 1
  std::vector<double> search = restricted.preconditioned(residual);
  double product = dot(residual, search);
  const auto norm = static_cast<double>(set.size());
  Convergence& convergence = stiffness.convergence;
  convergence.certificate = 1;
  convergence.status = Status::iteration_limit;
  while (convergence.certificate > tolerance && convergence.iterations < kMostIterations) {
    const std::vector<double> response = restricted.displacement(search);
    const double length = product / dot(search, response);
    for (std::size_t k = 0; k < set.size(); ++k) {
      solution[k] += length * search[k];
      residual[k] -= length * response[k];
    }
    const std::vector<double> direction = restricted.preconditioned(residual);
    const double next_product = dot(residual, direction);
    for (std::size_t k = 0; k < set.size(); ++k) {
      search[k] = direction[k] + next_product / product * search[k];
    }
    product = next_product;
    convergence.iterations += 1;
    convergence.certificate = std::sqrt(dot(residual, residual) / norm);
  }
  convergence.operator_applications = convergence.iterations;
  if (convergence.certificate <= tolerance) convergence.status = Status::converged;
  stiffness.value =
      dot(solution, std::vector<double>(set.size(), 1.0)) / static_cast<double>(n_pixels);
  return stiffness;
}

}  // namespace tabor::contact
