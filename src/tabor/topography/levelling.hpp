#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "tabor/topography/topography.hpp"

// Fits polynomial forms to heights and removes them.
namespace tabor::topography {

/// Form that levelling removes: a polynomial of total degree 0 to 4 in x and y (poly2 has the six
/// terms 1, x, y, x^2, xy, y^2). `none` removes nothing.
enum class Form { none, mean, plane, poly2, poly3, poly4 };

/// Returns the form of a name: "plane" -> Form::plane; nullopt if there is none.
std::optional<Form> form_from(std::string_view name);
std::string_view name_of(Form form);

/// Least-squares polynomial in products of Legendre polynomials P_i(u) P_j(v), i + j <= degree,
/// with u, v in [-1, 1] over the scan. That basis is nearly orthogonal, so that the normal
/// equations are well conditioned at any scan size and unit.
struct FormFit {
  static constexpr int kMaxTerms = 15;
  int degree = 0;
  std::array<double, kMaxTerms> coefficients{};  ///< [m], by rising degree, x first
  Index n_valid = 0;                             ///< points the fit used

  /// Returns the number of coefficients in use.
  int n_terms() const { return (degree + 1) * (degree + 2) / 2; }
};

/// Fits the form to all valid points; to a map of one row or column, a curve along it. Throws
/// InputError when they do not determine it.
FormFit fit_form(const Field& height, int degree);
/// Fits the form, or returns nullopt when the valid points do not determine it.
std::optional<FormFit> try_fit_form(const Field& height, int degree);

/// Returns the mean slopes along x and y that a form of degree 1 or more has over the scan.
std::array<double, 2> tilt_of(const FormFit& fit, const Grid& grid);

/// Returns height minus the fitted form; holes stay holes. Pass heights that are no longer needed
/// by std::move.
Field remove_form(Field height, const FormFit& fit);

/// Returns the root mean square [m] of height minus form, about its mean, over the valid points: Sq
/// of remove_form() without that field. NaN if all are holes.
double rms_without_form(const Field& height, const FormFit& fit);

/// Removes the form (F-operator of ISO 25178-3), with a line in the history.
Topography level(Topography topography, Form form);

}  // namespace tabor::topography
