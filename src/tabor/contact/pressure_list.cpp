#include "tabor/contact/pressure_list.hpp"

#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::contact {

PressureList::PressureList(const Field& pressure) : rows_(pressure.rows()), cols_(pressure.cols()) {
  const double* p = pressure.data();
  pixels_ = list_where(pressure.size(), [p](Index i) { return p[i] != 0; });
  values_.resize(pixels_.size());
  for_each(values_.size(), [&](std::size_t k) { values_[k] = p[pixels_[k]]; });
}

Field PressureList::map() const {
  auto pressure = uninitialised_map<Field>(rows_, cols_);
  double* p = pressure.data();
  for_each(pressure.size(), [=](Index i) { p[i] = 0; });
  for_each(values_.size(), [&](std::size_t k) { p[pixels_[k]] = values_[k]; });
  return pressure;
}

}  // namespace tabor::contact
