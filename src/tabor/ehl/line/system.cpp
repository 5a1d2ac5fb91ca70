#include "tabor/ehl/line/system.hpp"

namespace tabor::ehl {

Eigen::ArrayXd LineBands::product(const Eigen::ArrayXd& x) const {
  const Index n = x.size();
  Eigen::ArrayXd y = diagonal * x;
  y.tail(n - 1) += lower.tail(n - 1) * x.head(n - 1);
  y.head(n - 1) += upper.head(n - 1) * x.tail(n - 1);
  return y;
}

void LineSystem::hold(const std::vector<bool>& held) {
  for (Index i = 0; i < n(); ++i) {
    if (!held[static_cast<std::size_t>(i)]) continue;
    by_pressure.diagonal[i] = 1;
    for (auto* band : {&by_pressure.lower, &by_pressure.upper, &by_film.lower, &by_film.diagonal,
                       &by_film.upper}) {
      (*band)[i] = 0;
    }
  }
}

Eigen::VectorXd LineSystem::product(const Eigen::VectorXd& unknowns) const {
  const Eigen::ArrayXd fluid = unknowns.head(n());
  Eigen::ArrayXd total = fluid;
  if (has_asperities()) total += unknowns.segment(n(), n()).array();
  Eigen::ArrayXd film(n());
  const auto size_of_span = static_cast<std::size_t>(n());
  elastic->apply({total.data(), size_of_span}, {film.data(), size_of_span});
  film = units.pressure / units.film * film + unknowns[size() - 1];
  Eigen::VectorXd result(size());
  result.head(n()) = (by_pressure.product(fluid) + by_film.product(film)).matrix();
  if (has_asperities()) {
    result.segment(n(), n()) =
        touch.by_film * film + touch.by_pressure * unknowns.segment(n(), n()).array();
  }
  result[size() - 1] = elastic->load_weight() * units.pressure / units.load * total.sum();
  return result;
}

Eigen::MatrixXd LineSystem::dense() const {
  const Index h0 = size() - 1;
  const Eigen::MatrixXd compliance = units.pressure / units.film * elastic->matrix();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size(), size());
  const auto add_film = [&](Index row, double factor, Index node) {
    if (factor == 0) return;
    matrix.row(row).head(n()) += factor * compliance.row(node);
    if (has_asperities()) matrix.row(row).segment(n(), n()) += factor * compliance.row(node);
    matrix(row, h0) += factor;
  };
  for (Index i = 0; i < n(); ++i) {
    add_film(i, by_film.diagonal[i], i);
    matrix(i, i) += by_pressure.diagonal[i];
    if (i > 0) add_film(i, by_film.lower[i], i - 1);
    if (i > 0) matrix(i, i - 1) += by_pressure.lower[i];
    if (i + 1 < n()) add_film(i, by_film.upper[i], i + 1);
    if (i + 1 < n()) matrix(i, i + 1) += by_pressure.upper[i];
    if (!has_asperities()) continue;
    add_film(n() + i, touch.by_film[i], i);
    matrix(n() + i, n() + i) += touch.by_pressure[i];
  }
  matrix.row(h0).head(h0).setConstant(elastic->load_weight() * units.pressure / units.load);
  return matrix;
}

}  // namespace tabor::ehl
