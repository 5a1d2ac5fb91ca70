#include "tabor/ehl/point/bordered.hpp"

#include "tabor/numerics/gmres.hpp"

namespace tabor::ehl {
namespace {

constexpr double kLinearAccuracy = 1e-2;  // of each Newton correction
constexpr int kMaxProducts = 80;

class Bordered {
 public:
  Bordered(const PointLinear& linear, const PointLevel& finest, const PointUnits& units,
           const PointInverse& inverse)
      : linear_(linear),
        elastic_(finest.elastic),
        inverse_(inverse),
        ny_(finest.grid.ny),
        nx_(finest.grid.nx),
        pressed_(linear.pressed()),
        load_weight_(finest.grid.pixel_area() * units.pressure / units.load) {
    Field by_separation = Field::Zero(ny_, nx_);
    linear.rows.by_film.add_product(Field::Ones(ny_, nx_), by_separation);
    answer_ = inverse(linear.held.select(0, by_separation));
    border_ = -carried(answer_);
  }

  /// The whole of the equations times a step.
  Eigen::VectorXd product(const Eigen::VectorXd& step) const {
    const auto given = nodes(step);
    const Field pressure = pressed_.select(given, 0);
    const Field film = elastic_(pressure) + step[last()] + linear_.deep.select(given, 0);
    Field result = Field::Zero(ny_, nx_);
    linear_.rows.by_pressure.add_product(pressure, result);
    linear_.rows.by_film.add_product(film, result);
    return joined(linear_.held.select(given, result), carried(pressure));
  }

  /// Their inverse, as nearly as that of the nodes.
  Eigen::VectorXd inverse(const Eigen::VectorXd& right) const {
    const Field part = inverse_(nodes(right));
    const double separation = (right[last()] - carried(part)) / border_;
    return joined(part - separation * answer_, separation);
  }

  Eigen::VectorXd right() const {
    return joined(linear_.held.select(0, -linear_.rows.residual), -linear_.load);
  }

 private:
  Index last() const { return ny_ * nx_; }
  Eigen::Map<const Field> nodes(const Eigen::VectorXd& all) const { return {all.data(), ny_, nx_}; }
  Eigen::VectorXd joined(const Field& nodes, double border) const {
    Eigen::VectorXd all(last() + 1);
    Eigen::Map<Field>(all.data(), ny_, nx_) = nodes;
    all[last()] = border;
    return all;
  }
  /// Load of the unknown pressures in its unit.
  double carried(const Field& unknown) const {
    return load_weight_ * pressed_.select(unknown, 0).sum();
  }

  const PointLinear& linear_;
  const PointElastic& elastic_;
  const PointInverse& inverse_;
  Index ny_, nx_;
  Mask pressed_;
  double load_weight_;
  Field answer_;  // of the nodes to a separation of one unit
  double border_ = 0;
};

}  // namespace

std::optional<Eigen::VectorXd> solve_bordered(const PointLinear& linear, const PointLevel& finest,
                                              const PointUnits& units, const PointInverse& inverse,
                                              int& n_products) {
  const Bordered equations(linear, finest, units, inverse);
  const auto multiply = [&](const Eigen::VectorXd& step) { return equations.product(step); };
  const auto precondition = [&](const Eigen::VectorXd& right) { return equations.inverse(right); };
  return numerics::gmres(multiply, precondition, equations.right(), kLinearAccuracy, kMaxProducts,
                         n_products);
}

}  // namespace tabor::ehl
