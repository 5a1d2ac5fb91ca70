#include "tabor/contact/patches.hpp"

#include <cstdint>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

namespace tabor::contact {

Patches find_patches(const Mask& contact, bool periodic) {
  const Index ny = contact.rows();
  const Index nx = contact.cols();
  numerics::DisjointSets<std::uint32_t> components(static_cast<std::size_t>(contact.size()));
  const auto join = [&](Index y, Index x, Index other_y, Index other_x) {
    if (contact(y, x) && contact(other_y, other_x)) {
      components.join(static_cast<std::uint32_t>(y * nx + x),
                      static_cast<std::uint32_t>(other_y * nx + other_x));
    }
  };
  for (Index y = 0; y < ny; ++y) {    // raw loop: joins depend on those before
    for (Index x = 0; x < nx; ++x) {  // raw loop: as above
      if (x + 1 < nx || periodic) join(y, x, y, (x + 1) % nx);
      if (y + 1 < ny || periodic) join(y, x, (y + 1) % ny, x);
    }
  }
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(contact.size()), 0);
  for (Index i = 0; i < contact.size(); ++i) {  // raw loop: many pixels add to one count
    if (contact(i)) counts[components.root(static_cast<std::uint32_t>(i))] += 1;
  }
  Patches patches;
  for (const std::uint32_t count : counts) {
    if (count > 0) patches.pixel_counts.push_back(count);
  }
  return patches;
}

Transitions count_transitions(const Mask& contact, bool periodic) {
  const Index ny = contact.rows();
  const Index nx = contact.cols();
  const auto count = [&](auto&& differs) {
    return count_where(contact.size(), [&](Index i) { return differs(i / nx, i % nx); });
  };
  Transitions transitions;
  transitions.along_rows = count([&](Index y, Index x) {
    return (periodic || x + 1 < nx) && contact(y, x) != contact(y, (x + 1) % nx);
  });
  transitions.along_columns = count([&](Index y, Index x) {
    return (periodic || y + 1 < ny) && contact(y, x) != contact((y + 1) % ny, x);
  });
  return transitions;
}

Index count_corners(const Mask& contact, bool periodic) {
  const Index ny = periodic ? contact.rows() : contact.rows() - 1;
  const Index nx = periodic ? contact.cols() : contact.cols() - 1;
  const auto corners_at = [&](Index y, Index x) {
    const Index below = (y + 1) % contact.rows(), right = (x + 1) % contact.cols();
    const bool a = contact(y, x), b = contact(y, right), c = contact(below, x),
               d = contact(below, right);
    const int n = int{a} + int{b} + int{c} + int{d};
    if (n == 2) return a == d ? 2 : 0;  // two pixels that touch at the corner only
    return n % 2;
  };
  return static_cast<Index>(sum_over(ny * nx, [&](Index i) { return corners_at(i / nx, i % nx); }));
}

}  // namespace tabor::contact
