#include "tabor/topography/levelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/numerics/small_matrices.hpp"

namespace tabor::topography {
namespace {

constexpr int kMaxDegree = 4;
constexpr int kMaxTerms = FormFit::kMaxTerms;

/// P_0 ... P_4 at one coordinate.
using Legendre = Eigen::Array<double, kMaxDegree + 1, 1>;

Legendre legendre(double u) {
  Legendre p;
  p << 1, u, (3 * u * u - 1) / 2, (5 * u * u - 3) * u / 2, ((35 * u * u - 30) * u * u + 3) / 8;
  return p;
}

/// P_i at every pixel centre of an axis, the axis mapped to (-1, 1).
std::vector<Legendre> legendre_table(Index n) {
  std::vector<Legendre> table(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    table[static_cast<std::size_t>(i)] =
        legendre((2 * static_cast<double>(i) + 1) / static_cast<double>(n) - 1);
  }
  return table;
}

/// Exponents (i, j) of the terms P_i(u) P_j(v): by total degree, x first.
struct Term {
  int i, j;
};

std::vector<Term> terms_of(int degree) {
  std::vector<Term> terms;
  for (int total = 0; total <= degree; ++total) {
    for (int j = 0; j <= total; ++j) terms.push_back({total - j, j});
  }
  return terms;
}

/// The rows of a height field without a form, one at a time: no second field is needed.
class FormRows {
 public:
  FormRows(const Field& height, const FormFit& fit)
      : height_(height),
        fit_(fit),
        terms_(terms_of(fit.degree)),
        along_x_(legendre_table(height.cols())),
        along_y_(legendre_table(height.rows())) {}

  /// Writes z - form of row y to `rest`, which may be that row itself.
  void subtract(Index y, double* rest) const {
    const Legendre row = polynomial(along_y_[static_cast<std::size_t>(y)]);
    const double* z = &height_(y, 0);
    for (std::size_t x = 0; x < along_x_.size(); ++x) rest[x] = z[x] - (row * along_x_[x]).sum();
  }

  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<Legendre>& along_x() const { return along_x_; }
  const Legendre& along_y(Index y) const { return along_y_[static_cast<std::size_t>(y)]; }

 private:
  /// The form along one row: coefficients of P_i(u).
  Legendre polynomial(const Legendre& along_y) const {
    Legendre row = Legendre::Zero();
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      row[terms_[t].i] += fit_.coefficients[t] * along_y[terms_[t].j];
    }
    return row;
  }

  const Field& height_;
  const FormFit& fit_;
  std::vector<Term> terms_;
  std::vector<Legendre> along_x_, along_y_;
};

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxTerms, kMaxTerms>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxTerms, 1>;

/// Normal equations of the fit over some rows.
struct NormalEquations {
  explicit NormalEquations(Index n_terms = 0)
      : matrix(Matrix::Zero(n_terms, n_terms)), right(Vector::Zero(n_terms)) {}
  Matrix matrix;
  Vector right;
  Index n_valid = 0;
};

/// Sums of P_i(u) P_k(u) and P_i(u) z over the valid points of one row.
struct RowSums {
  Eigen::Matrix<double, kMaxDegree + 1, kMaxDegree + 1> products;
  Eigen::Matrix<double, kMaxDegree + 1, 1> heights;
  Index n_valid = 0;
};

RowSums row_sums(const double* z, const std::vector<Legendre>& along_x) {
  RowSums sums;
  sums.products.setZero();
  sums.heights.setZero();
  for (std::size_t x = 0; x < along_x.size(); ++x) {
    if (!std::isnan(z[x])) {
      const auto p = along_x[x].matrix();
      sums.products.noalias() += p * p.transpose();
      sums.heights += p * z[x];
      ++sums.n_valid;
    }
  }
  return sums;
}

void add_row(NormalEquations& equations, const RowSums& row, const Legendre& along_y,
             const std::vector<Term>& terms) {
  for (std::size_t a = 0; a < terms.size(); ++a) {
    const double weight = along_y[terms[a].j];
    equations.right[static_cast<Index>(a)] += weight * row.heights[terms[a].i];
    for (std::size_t b = 0; b < terms.size(); ++b) {
      equations.matrix(static_cast<Index>(a), static_cast<Index>(b)) +=
          weight * along_y[terms[b].j] * row.products(terms[a].i, terms[b].i);
    }
  }
  equations.n_valid += row.n_valid;
}

/// Terms that a map of one row or column cannot have get the coefficient zero: a line is fitted.
void leave_out(NormalEquations& equations, const Term& term, Index t, bool one_row,
               bool one_column) {
  if ((!one_row || term.j == 0) && (!one_column || term.i == 0)) return;
  equations.matrix.row(t).setZero();
  equations.matrix.col(t).setZero();
  equations.matrix(t, t) = equations.matrix(0, 0);  // of the mean: as large as any
  equations.right[t] = 0;
}

/// Normal equations for what `removed` leaves of the heights. Blocks of rows are summed in their
/// order, so that the result does not depend on the threads.
NormalEquations normal_equations(const Field& height, const FormFit& removed) {
  const FormRows rows(height, removed);
  const auto n_terms = static_cast<Index>(rows.terms().size());
  std::vector<NormalEquations> blocks(
      static_cast<std::size_t>((height.rows() + kRowsPerBlock - 1) / kRowsPerBlock),
      NormalEquations(n_terms));
  parallel_for(height.rows(), kRowsPerBlock, [&](Index begin, Index end) {
    auto& block = blocks[static_cast<std::size_t>(begin / kRowsPerBlock)];
    std::vector<double> rest(static_cast<std::size_t>(height.cols()));
    for (Index y = begin; y < end; ++y) {
      rows.subtract(y, rest.data());
      add_row(block, row_sums(rest.data(), rows.along_x()), rows.along_y(y), rows.terms());
    }
  });
  NormalEquations total(n_terms);
  for (const auto& block : blocks) {
    total.matrix += block.matrix;
    total.right += block.right;
    total.n_valid += block.n_valid;
  }
  for (Index t = 0; t < n_terms; ++t) {
    leave_out(total, rows.terms()[static_cast<std::size_t>(t)], t, height.rows() == 1,
              height.cols() == 1);
  }
  return total;
}

/// Rejects a fit that the valid points leave undetermined: too few, or all on one curve.
void check_determined(const NormalEquations& equations, int degree) {
  constexpr double smallest_ratio = 1e-12;
  const Eigen::VectorXd values = numerics::symmetric_eigenvalues(equations.matrix);
  if (equations.n_valid == 0 || values[0] <= smallest_ratio * values[values.size() - 1]) {
    throw InputError(fmt::format("levelling by a polynomial of degree {}", degree),
                     fmt::format("{} valid points that do not determine it", equations.n_valid),
                     fmt::format("at least {} points not on one curve", equations.right.size()),
                     degree > 1    ? "use a lower degree (<level=plane>)"
                     : degree == 1 ? "use a lower degree (<level=mean>)"
                                   : "the surface has no valid point");
  }
}

constexpr auto kForms = names<Form>("none", "mean", "plane", "poly2", "poly3", "poly4");

int degree_of(Form form) { return static_cast<int>(form) - static_cast<int>(Form::mean); }

std::string describe(const Topography& topography, const FormFit& fit, double rms_before) {
  std::string text = fmt::format("{} valid points", fit.n_valid);
  if (fit.degree >= 1) {
    const auto [along_x, along_y] = tilt_of(fit, topography.grid);
    text += fmt::format(", tilt x {:.6g}, y {:.6g}", along_x, along_y);
  } else {
    text += ", mean " + format_si(fit.coefficients[0], "m", 6);
  }
  return text + fmt::format(", Sq {} -> {}", format_si(rms_before, "m"),
                            format_si(numerics::rms_height(topography.height), "m"));
}

}  // namespace

std::optional<Form> form_from(std::string_view name) { return kForms.find(name); }
std::string_view name_of(Form form) { return kForms.of(form); }

FormFit fit_form(const Field& height, int degree) {
  FormFit fit;
  fit.degree = degree;
  // The second pass fits what rounding left behind: a tilt may be a thousand times the roughness.
  for (int pass = 0; pass < 2; ++pass) {
    const auto equations = normal_equations(height, fit);
    check_determined(equations, degree);
    const Vector correction = numerics::solve_symmetric(equations.matrix, equations.right);
    for (Index t = 0; t < correction.size(); ++t) {
      fit.coefficients[static_cast<std::size_t>(t)] += correction[t];
    }
    fit.n_valid = equations.n_valid;
  }
  return fit;
}

std::optional<FormFit> try_fit_form(const Field& height, int degree) {
  try {
    return fit_form(height, degree);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::array<double, 2> tilt_of(const FormFit& fit, const Grid& grid) {
  return {2 * fit.coefficients[1] / grid.lx, 2 * fit.coefficients[2] / grid.ly};
}

Field remove_form(Field height, const FormFit& fit) {
  const FormRows rows(height, fit);
  for_each_row(height.rows(), [&](Index y) { rows.subtract(y, &height(y, 0)); });
  return height;
}

double rms_without_form(const Field& height, const FormFit& fit) {
  const FormRows rows(height, fit);
  // n, sum and sum of squares; a fitted form leaves a mean near zero, so nothing is lost in
  // squares.
  const auto sums = sum_over_rows<3>(height.rows(), [&](Index y) {
    std::vector<double> rest(static_cast<std::size_t>(height.cols()));
    rows.subtract(y, rest.data());
    Eigen::Array3d row = Eigen::Array3d::Zero();
    for (const double z : rest) {
      if (!std::isnan(z)) row += Eigen::Array3d(1, z, z * z);
    }
    return row;
  });
  const double mean = sums[1] / sums[0];
  const double rms = std::sqrt(std::max(0.0, sums[2] / sums[0] - mean * mean));
  return rms > numerics::rounding_of(numerics::largest_magnitude(height)) ? rms : 0;
}

Topography level(Topography topography, Form form) {
  if (form == Form::none) {
    topography.history.push_back("level=none");
    return topography;
  }
  const auto fit = fit_form(topography.height, degree_of(form));
  const double rms_before = numerics::rms_height(topography.height);
  const double magnitude = numerics::largest_magnitude(topography.height);
  topography.height =
      numerics::without_rounding(remove_form(std::move(topography.height), fit), magnitude);
  topography.periodic = topography.periodic && form == Form::mean;  // a tilt does not tile
  topography.history.push_back(
      fmt::format("level={}: {}", name_of(form), describe(topography, fit, rms_before)));
  return topography;
}

}  // namespace tabor::topography
