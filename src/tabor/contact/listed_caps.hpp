#pragma once

#include <vector>

#include "tabor/contact/caps.hpp"
#include "tabor/core/loops.hpp"

// Gathers the caps of some pixels of a map.
namespace tabor::contact {

/// The caps of a list of pixels, in its order.
class ListedCaps {
 public:
  ListedCaps(const Caps& of_map, const PixelList& pixels) : for_all_(of_map.for_all()) {
    if (of_map.are_one()) return;
    each_.resize(pixels.size());
    for_each(pixels.size(), [&](std::size_t k) { each_[k] = of_map(pixels[k]); });
  }
  operator Caps() const {  // NOLINT(google-explicit-constructor): read as those of a map are
    return each_.empty() ? Caps(for_all_) : Caps(each_.data());
  }

 private:
  double for_all_;
  std::vector<double> each_;
};

}  // namespace tabor::contact
