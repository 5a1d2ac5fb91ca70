#pragma once

#include <cstddef>
#include <vector>

namespace tabor::numerics {

/// Solves A x = b by preconditioned conjugate gradients for symmetric, positive (semi-)definite A
/// (Hestenes & Stiefel 1952, doi:10.6028/jres.049.044). The system defines the operations on
/// vectors of length n, so that the sums of its products have their own, reproducible order:
///
///   void apply(const std::vector<double>& x, std::vector<double>& image)     image = A x
///   const Vector& precondition(const std::vector<double>& residual)          approximate A^-1 r
///   double dot(const std::vector<double>& a, const Vector& b)                Vector of any number
///   type void for_each(std::size_t n, body)                                       body(i), in any
///   order
///
/// `residual` is b - A `solution` on entry and on return. `is_done(n_iterations)` is called before
/// each step and ends the solution; it may throw. Returns the number of steps.
template <typename System, typename IsDone>
int conjugate_gradients(System& system, std::vector<double>& residual,
                        std::vector<double>& solution, const IsDone& is_done) {
  const std::size_t n = residual.size();
  std::vector<double> direction(n, 0);
  std::vector<double> image(n, 0);
  double product = 0;
  int n_iterations = 0;
  for (; !is_done(n_iterations); ++n_iterations) {
    const auto& preconditioned = system.precondition(residual);
    const double before = product;
    product = system.dot(residual, preconditioned);
    const double beta = n_iterations == 0 ? 0 : product / before;
    system.for_each(n, [&](std::size_t i) {
      direction[i] = static_cast<double>(preconditioned[i]) + beta * direction[i];
    });
    system.apply(direction, image);
    const double alpha = product / system.dot(direction, image);
    system.for_each(n, [&](std::size_t i) {
      solution[i] += alpha * direction[i];
      residual[i] -= alpha * image[i];
    });
  }
  return n_iterations;
}

}  // namespace tabor::numerics
