#include "tabor/contact/stiffness.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tabor/contact/images.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/numerics/conjugate_gradients.hpp"

namespace tabor::contact {
namespace {

constexpr int kMostIterations = 2000;

PixelList free_pixels(const State& state, double saturation_pressure) {
  return list_where(state.pressure.size(), [&](Index i) {
    return touches(state.pressure(i)) && !at_cap(state.pressure(i), saturation_pressure);
  });
}

/// S and M restricted to a set of pixels, as a system of conjugate gradients.
class Restricted {
 public:
  Restricted(elastic::ElasticOperator& elasticity, const PixelList& set)
      : elasticity_(elasticity),
        set_(set),
        preconditioner_(elasticity.grid(), elasticity.effective_modulus(), elasticity.border()),
        pressure_(Field::Zero(elasticity.grid().ny, elasticity.grid().nx)),
        residual_(FieldF::Zero(elasticity.grid().ny, elasticity.grid().nx)) {}

  void apply(const std::vector<double>& pressure, std::vector<double>& displacement) {
    tabor::for_each(set_.size(), [&](std::size_t k) { pressure_(set_[k]) = pressure[k]; });
    elasticity_.apply(pressure_, displacement_);
    tabor::for_each(set_.size(), [&](std::size_t k) { displacement[k] = displacement_(set_[k]); });
  }

  const std::vector<float>& precondition(const std::vector<double>& residual) {
    tabor::for_each(set_.size(),
                    [&](std::size_t k) { residual_(set_[k]) = static_cast<float>(residual[k]); });
    std::vector<float> row_sums;
    preconditioner_.apply(set_, residual_, preconditioned_, row_sums);
    return preconditioned_;
  }

  template <typename Number>
  static double dot(const std::vector<double>& a, const std::vector<Number>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {  // raw loop: blocks would change the last digits
      sum += a[k] * static_cast<double>(b[k]);
    }
    return sum;
  }

  template <typename Body>
  static void for_each(std::size_t n, const Body& body) {
    tabor::for_each(n, body);
  }

 private:
  elastic::ElasticOperator& elasticity_;
  const PixelList& set_;
  Preconditioner preconditioner_;
  Field pressure_;
  Field displacement_;
  FieldF residual_;
  std::vector<float> preconditioned_;
};

}  // namespace

Stiffness contact_stiffness(elastic::ElasticOperator& elasticity, const State& state,
                            double saturation_pressure, double tolerance) {
  if (elastic::ElasticOperator* const of_image = elasticity.of_image()) {
    if (const auto image = state_of_image(state)) {
      return contact_stiffness(*of_image, *image, saturation_pressure, tolerance);
    }
  }
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
  const auto norm = static_cast<double>(set.size());
  Convergence& convergence = stiffness.convergence;
  convergence.iterations =
      numerics::conjugate_gradients(restricted, residual, solution, [&](int n_iterations) {
        convergence.certificate = std::sqrt(Restricted::dot(residual, residual) / norm);
        return convergence.certificate <= tolerance || n_iterations == kMostIterations;
      });
  convergence.operator_applications = convergence.iterations;
  convergence.status =
      convergence.certificate <= tolerance ? Status::converged : Status::iteration_limit;
  const std::vector<double> ones(set.size(), 1.0);
  stiffness.value = Restricted::dot(solution, ones) / static_cast<double>(n_pixels);
  return stiffness;
}

}  // namespace tabor::contact
