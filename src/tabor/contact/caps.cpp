#include "tabor/contact/caps.hpp"

#include "tabor/core/loops.hpp"

namespace tabor::contact {

double Caps::highest(Index n) const { return are_one() ? for_all_ : extent_over(n, each_).highest; }

double Caps::lowest(Index n) const { return are_one() ? for_all_ : extent_over(n, each_).lowest; }

double Caps::sum(Index n) const {
  if (are_one()) return for_all_ * static_cast<double>(n);
  return sum_over(n, [this](Index i) { return each_[i]; });
}

}  // namespace tabor::contact
