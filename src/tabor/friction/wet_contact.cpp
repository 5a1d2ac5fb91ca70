#include "tabor/friction/wet_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

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

double lubricated_share(const Mask& contact, const Field& film) {
  check_shapes(contact, film);
  check_sum(sum(film), "film");
  const bool* touches = contact.data();
  const double* thickness = film.data();
  const auto count_where = [&](auto selected) {
    return deterministic_sum(film.size(), [&](Index begin, Index end) {
      double count = 0;
      for (Index i = begin; i < end; ++i) count += selected(i) ? 1 : 0;
      return count;
    });
  };
  const double n_contact = count_where([&](Index i) { return touches[i]; });
  const double n_wet = count_where([&](Index i) { return touches[i] && thickness[i] > 0; });
  return n_contact > 0 ? n_wet / n_contact : 0;
}

double spill_over_fraction(const Field& film, const Field& gap) {
  check_shapes(gap, film);
  const double* thickness = film.data();
  const double* opening = gap.data();
  const double liquid = sum(film);
  const double spilled = deterministic_sum(film.size(), [&](Index begin, Index end) {
    double total = 0;
    for (Index i = begin; i < end; ++i) {
      const double space = opening[i] < 0 ? 0 : opening[i];  // keeps NaN, unlike std::max
      const double excess = thickness[i] - space;
      total += excess < 0 ? 0 : excess;
    }
    return total;
  });
  check_sum(liquid, "film");
  check_sum(spilled, "gap");
  return liquid > 0 ? spilled / liquid : 0;
}

}  // namespace tabor::friction
