#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace tabor::ehl {

/// y = A x, or x = M^-1 b.
using VectorMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// x with |b - A x| <= tolerance |b| in at most max_products products, else nullopt. Preconditioned
/// on the right, so that the residual it watches is the true one (Saad, Iterative Methods for
/// Sparse Linear Systems, 2nd edition 2003, algorithm 9.5). `n_products` is increased by those
/// done.
std::optional<Eigen::VectorXd> gmres(const VectorMap& product, const VectorMap& precondition,
                                     const Eigen::VectorXd& b, double tolerance, int max_products,
                                     int& n_products);

}  // namespace tabor::ehl
