#include "tabor/contact/patches.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/numerics/disjoint_sets.hpp"
#include "tabor/numerics/runs.hpp"

namespace tabor::contact {

namespace {

using Components = numerics::DisjointSets<std::uint32_t>;

numerics::Runs runs_of(const Mask& contact) {
  const bool* touching = contact.data();
  return {contact.rows(), contact.cols(), [touching](Index i) { return touching[i]; }};
}

/// Joins the runs of each patch.
Components components_of(const numerics::Runs& runs, bool periodic) {
  Components components(runs.size());
  runs.join_neighbours(periodic, [&components](std::size_t a, std::size_t b, int, int) {
    components.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  });
  return components;
}

}  // namespace

Patches find_patches(const Mask& contact, bool periodic) {
  const numerics::Runs runs = runs_of(contact);
  Components components = components_of(runs, periodic);
  std::vector<Index> counts(runs.size(), 0);
  for (std::size_t run = 0; run < runs.size(); ++run) {  // raw loop: many runs add to one count
    counts[components.root(static_cast<std::uint32_t>(run))] += runs[run].end - runs[run].begin;
  }
  Patches patches;
  for (const Index count : counts) {
    if (count > 0) patches.pixel_counts.push_back(count);
  }
  return patches;
}

LabelMap label_patches(const Mask& contact, bool periodic) {
  const numerics::Runs runs = runs_of(contact);
  Components components = components_of(runs, periodic);
  std::vector<std::int32_t> label_of_root(runs.size(), 0);
  for (std::size_t run = 0; run < runs.size(); ++run) {  // raw loop: many runs have one root
    label_of_root[components.root(static_cast<std::uint32_t>(run))] = 1;
  }
  std::int32_t last = 0;
  for (std::int32_t& label : label_of_root) {
    if (label > 0) label = ++last;
  }
  LabelMap labels = LabelMap::Zero(contact.rows(), contact.cols());
  for (std::size_t run = 0; run < runs.size(); ++run) {  // raw loop: roots move as they are found
    const std::int32_t label = label_of_root[components.root(static_cast<std::uint32_t>(run))];
    std::fill(labels.data() + runs[run].begin, labels.data() + runs[run].end, label);
  }
  return labels;
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
