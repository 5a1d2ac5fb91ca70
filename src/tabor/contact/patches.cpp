#include "tabor/contact/patches.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/numerics/disjoint_sets.hpp"
#include "tabor/numerics/runs.hpp"

namespace tabor::contact {

namespace {

using Components = numerics::DisjointSets<std::uint32_t>;

numerics::Runs runs_of(const Mask& contact) {
  const bool* touching = contact.data();
  return {contact.rows(), contact.cols(), [touching](Index i) { return touching[i]; }};
}

const bool* row_of(const Mask& contact, Index y) { return contact.data() + y * contact.cols(); }

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
  const auto sums = sum_over_rows<2>(ny, [&](Index y) {
    const bool* row = row_of(contact, y);
    int along_row = periodic && row[nx - 1] != row[0] ? 1 : 0;
    for (Index x = 0; x + 1 < nx; ++x) {  // raw loop: one row
      along_row += row[x] != row[x + 1] ? 1 : 0;
    }
    int along_columns = 0;
    if (periodic || y + 1 < ny) {
      const bool* below = row_of(contact, (y + 1) % ny);
      for (Index x = 0; x < nx; ++x) {  // raw loop: one row
        along_columns += row[x] != below[x] ? 1 : 0;
      }
    }
    return Eigen::Array2d(along_row, along_columns);
  });
  return {static_cast<Index>(sums(0)), static_cast<Index>(sums(1))};
}

Index count_corners(const Mask& contact, bool periodic) {
  const Index nx = contact.cols();
  const auto sum = sum_over_rows<1>(periodic ? contact.rows() : contact.rows() - 1, [&](Index y) {
    const bool* row = row_of(contact, y);
    const bool* below = row_of(contact, (y + 1) % contact.rows());
    const auto corners = [&](Index x, Index right) {
      const int a = row[x], b = row[right], c = below[x], d = below[right];
      const int touch_at_the_corner_only = (a ^ b) & (b ^ d) & (a ^ c);
      return (a ^ b ^ c ^ d) + 2 * touch_at_the_corner_only;
    };
    int n = periodic ? corners(nx - 1, 0) : 0;
    for (Index x = 0; x + 1 < nx; ++x) n += corners(x, x + 1);  // raw loop: one row
    return Eigen::Array<double, 1, 1>(n);
  });
  return static_cast<Index>(sum(0));
}

}  // namespace tabor::contact
