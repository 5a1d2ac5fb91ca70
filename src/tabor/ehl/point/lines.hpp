#pragma once

#include <Eigen/SparseLU>
#include <array>
#include <memory>
#include <vector>

#include "tabor/ehl/point/local.hpp"
#include "tabor/numerics/banded_lanes.hpp"

// Smooths the errors of a point contact along lines of nodes.
namespace tabor::ehl {

/// Smooths the error of the local equations: lines of nodes along the flow, each solved exactly
/// (line relaxation, Venner & Lubrecht 2000). Every third line is solved at the same time, on all
/// threads and in all lanes of a register, as a balance depends on two lines to either side; then
/// the lines beside these, the others, and back. Results are the same for any number of threads.
class PointLines {
 public:
  explicit PointLines(PointLocal local);

  bool ok() const { return ok_; }  ///< false: a line is singular
  /// Pressures that nearly balance `right`; zero at held nodes.
  Field operator()(const Field& right) const;

 private:
  static constexpr Index kColours = PointLocal::kSide + 1;
  using LineFactors = numerics::BandedLanes<PointLocal::kUpstream, PointLocal::kDownstream>;

  /// Coefficients of a balance that other lines' unknowns have.
  static constexpr Index kOfOthers =
      PointLocal::kCoefficients -
      PointLocal::kReaches[static_cast<std::size_t>(PointLocal::kSide)].size();

  /// kLanes lines of one colour.
  struct Batch {
    explicit Batch(Index nx)
        : factors(nx), of_others(static_cast<std::size_t>(nx * kOfOthers), Lanes{}) {}

    LineFactors factors;
    std::vector<Lanes> of_others;  ///< kOfOthers coefficients of each node
  };
  /// Unknowns or balances of the lines of one colour: the lines' values at one node lie together.
  class Plane;
  using Planes = std::array<Plane, kColours>;

  Index line_of(Index colour, Index batch, int lane) const {
    return (batch * kLanes + lane) * kColours + colour;
  }
  Index batches_of_block() const;
  template <typename Body>
  void for_each_batch(const Body& body) const;
  bool fill(Index colour, Index batch);
  void solve_lines(Index colour, Index batch, const Planes& right, Planes& q) const;

  PointLocal local_;
  Index n_batches_;  // of each colour
  std::array<std::vector<Batch>, kColours> batches_;
  bool ok_ = true;
};

/// Solves the local equations by sparse factors: for coarse grids.
class PointDirect {
 public:
  explicit PointDirect(PointLocal local);

  bool ok() const { return factors_->info() == Eigen::Success; }
  Field operator()(const Field& right) const;

 private:
  PointLocal local_;
  std::unique_ptr<Eigen::SparseLU<Eigen::SparseMatrix<double>>> factors_;
};

}  // namespace tabor::ehl
