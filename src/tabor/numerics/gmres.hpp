#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

// Solves linear systems by generalised minimal residuals with a right preconditioner.
namespace tabor::numerics {

/// Linear map y = A x, or x = M^-1 b.
using VectorMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Solves A x = b by generalised minimal residuals without restart: returns x with |b - A x| <=
/// tolerance |b| in at most max_products products, else nullopt. A and M are square, of the size of
/// b; M^-1 may be any fixed linear map. Preconditioned on the right, so that the monitored residual
/// is the true one (Saad, Iterative Methods for Sparse Linear Systems, 2nd edition 2003, algorithm
/// 9.5). `n_products` is increased by those done. Memory: max_products + 1 vectors. Throws
/// Interrupted when the observer of the innermost Watch asks to stop.
std::optional<Eigen::VectorXd> gmres(const VectorMap& product, const VectorMap& precondition,
                                     const Eigen::VectorXd& b, double tolerance, int max_products,
                                     int& n_products);

}  // namespace tabor::numerics
