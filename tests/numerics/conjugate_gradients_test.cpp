#include "tabor/numerics/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "tabor/core/random.hpp"

namespace tabor::numerics {
namespace {

/// A dense matrix with a diagonal preconditioner, or none.
class Dense {
 public:
  Dense(Eigen::MatrixXd matrix, bool preconditioned)
      : matrix_(std::move(matrix)),
        diagonal_(preconditioned ? matrix_.diagonal().eval()
                                 : Eigen::VectorXd::Ones(matrix_.rows()).eval()) {}

  void apply(const std::vector<double>& x, std::vector<double>& image) {
    ++n_applied;
    Eigen::Map<Eigen::VectorXd>(image.data(), matrix_.rows()) =
        matrix_ * Eigen::Map<const Eigen::VectorXd>(x.data(), matrix_.rows());
  }
  const std::vector<double>& precondition(const std::vector<double>& residual) {
    scaled_.resize(residual.size());
    for (std::size_t i = 0; i < residual.size(); ++i) {
      scaled_[i] = residual[i] / diagonal_(static_cast<Eigen::Index>(i));
    }
    return scaled_;
  }
  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  template <typename Body>
  static void for_each(std::size_t n, const Body& body) {
    for (std::size_t i = 0; i < n; ++i) body(i);
  }

  int n_applied = 0;

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd diagonal_;
  std::vector<double> scaled_;
};

/// Symmetric and positive definite; rows of very different size.
Eigen::MatrixXd matrix_of(Eigen::Index n) {
  const CounterRandom random(3);
  Eigen::MatrixXd factor(n, n);
  for (Eigen::Index i = 0; i < n * n; ++i) {
    factor(i / n, i % n) = random.normal(static_cast<std::uint64_t>(i));
  }
  const Eigen::MatrixXd scale =
      Eigen::VectorXd::LinSpaced(n, 0, 3).array().exp().matrix().asDiagonal();
  return scale * (factor * factor.transpose() + 5 * Eigen::MatrixXd::Identity(n, n)) * scale;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST(ConjugateGradients, FindWhatADirectSolverFinds) {
  constexpr Eigen::Index kN = 20;
  const Eigen::MatrixXd matrix = matrix_of(kN);
  for (const bool preconditioned : {false, true}) {
    Dense system(matrix, preconditioned);
    std::vector<double> residual(kN, 1.0);
    std::vector<double> solution(kN, 0.0);
    const int n_iterations = conjugate_gradients(system, residual, solution, [&](int iterations) {
      return largest(residual) < 1e-10 || iterations == 1000;
    });
    const Eigen::VectorXd expected = matrix.llt().solve(Eigen::VectorXd::Ones(kN));
    for (Eigen::Index i = 0; i < kN; ++i) {
      EXPECT_NEAR(solution[static_cast<std::size_t>(i)], expected(i), 1e-9 * expected.norm());
    }
    EXPECT_EQ(system.n_applied, n_iterations);
  }
}

TEST(ConjugateGradients, EndInAsManyStepsAsThereAreDifferentEigenvalues) {
  Eigen::VectorXd eigenvalues(6);
  eigenvalues << 2, 2, 5, 5, 5, 9;
  Dense system(eigenvalues.asDiagonal(), false);
  std::vector<double> residual(6, 1.0);
  std::vector<double> solution(6, 0.0);
  conjugate_gradients(system, residual, solution, [](int iterations) { return iterations == 3; });
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(solution[i], 1 / eigenvalues(static_cast<Eigen::Index>(i)), 1e-14);
  }
}

TEST(ConjugateGradients, LeaveASolutionAlone) {
  Dense system(matrix_of(4), true);
  std::vector<double> residual(4, 0.0);
  std::vector<double> solution(4, 7.0);
  const auto is_done = [&](int) { return largest(residual) == 0; };
  EXPECT_EQ(conjugate_gradients(system, residual, solution, is_done), 0);
  EXPECT_EQ(solution, std::vector<double>(4, 7.0));
  EXPECT_EQ(system.n_applied, 0);
}

TEST(ConjugateGradients, PassOnWhatStopsThem) {
  Dense system(matrix_of(8), true);
  std::vector<double> residual(8, 1.0);
  std::vector<double> solution(8, 0.0);
  const auto stop = [](int iterations) -> bool {
    if (iterations == 2) throw std::runtime_error("enough");
    return false;
  };
  EXPECT_THROW(conjugate_gradients(system, residual, solution, stop), std::runtime_error);
  EXPECT_EQ(system.n_applied, 2);
}

}  // namespace
}  // namespace tabor::numerics
