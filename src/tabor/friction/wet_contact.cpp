#include "tabor/friction/wet_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::friction {
namespace {

template <typename Map>
void check_shapes(const Map& other, const Field& film) {
  if (other.rows() != film.rows() || other.cols() != film.cols()) {
    throw InputError("film and contact",
                     fmt::format("{} x {} and {} x {} pixels", film.cols(), film.rows(),
                                 other.cols(), other.rows()),
                     "the same grid", "");
  }
}

void check_sum(double total, const char* what) {
  if (!std::isfinite(total)) throw InputError(std::string(what) + " has NaN or infinite values");
}

}  // namespace

Mask wet_contact(const Mask& contact, const Field& film, double dry_below) {
  check_shapes(contact, film);
  return contact && film > dry_below;
}

double lubricated_share(const Mask& contact, const Field& film, double dry_below) {
  check_shapes(contact, film);
  check_sum(sum(film), "film");
  const bool* touches = contact.data();
  const double* thickness = film.data();
  const Index n_contact = count_where(film.size(), [=](Index i) { return touches[i]; });
  const Index n_wet =
      count_where(film.size(), [=](Index i) { return touches[i] && thickness[i] > dry_below; });
  return n_contact > 0 ? static_cast<double>(n_wet) / static_cast<double>(n_contact) : 0;
}

double spill_over_fraction(const Field& film, const Field& gap) {
  check_shapes(gap, film);
  const double* thickness = film.data();
  const double* opening = gap.data();
  const double liquid = sum(film);
  const double spilled = sum_over(film.size(), [=](Index i) {
    const double gap_there = opening[i] < 0 ? 0 : opening[i];  // keeps NaN, unlike std::max
    const double excess = thickness[i] - gap_there;
    return excess < 0 ? 0 : excess;
  });
  check_sum(liquid, "film");
  check_sum(spilled, "gap");
  return liquid > 0 ? spilled / liquid : 0;
}

}  // namespace tabor::friction
