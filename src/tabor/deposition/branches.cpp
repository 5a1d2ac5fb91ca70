#include "tabor/deposition/branches.hpp"

#include <utility>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

std::size_t place(PoolId id) { return static_cast<std::size_t>(id); }

/// Returns for each pool its child with the most leaves, kNoPool for a leaf.
std::vector<PoolId> largest_children(const PoolTree& tree) {
  std::vector<std::int32_t> n_leaves(tree.parent.size(), 0);
  std::vector<PoolId> largest(tree.parent.size(), kNoPool);
  for (std::size_t i = 0; i < tree.parent.size(); ++i) {
    go_on_or_throw(i);
    if (i < tree.n_leaves) n_leaves[i] = 1;
    if (tree.parent[i] == kNoPool) continue;
    const std::size_t parent = place(tree.parent[i]);
    n_leaves[parent] += n_leaves[i];
    PoolId& child = largest[parent];
    if (child == kNoPool || n_leaves[i] > n_leaves[place(child)]) child = static_cast<PoolId>(i);
  }
  return largest;
}

}  // namespace

Branches::Branches(PoolTree&& tree) : branches_(tree.n_leaves), branch_of_(largest_children(tree)) {
  const std::size_t n = tree.parent.size();
  number_along_branches(tree);
  bases_.resize(n);
  spills_to_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    go_on_or_throw(i);
    bases_[place(number_[i])] = tree.base[i];
    spills_to_[place(number_[i])] = leaf_of(tree.spills_to[i]);
  }
  release(tree.base);
  release(tree.spills_to);
  for (std::size_t i = 0; i < n; i += kStride) samples_.push_back(bases_[i]);
  find_joins(tree);
  last_ = number_.back();
  release(tree.parent);
  release(branch_of_);
  release(number_);
}

/// A pool is on the branch of its largest child.
void Branches::number_along_branches(const PoolTree& tree) {
  for (std::size_t i = 0; i < branch_of_.size(); ++i) {
    go_on_or_throw(i);
    const bool is_leaf = i < tree.n_leaves;
    branch_of_[i] = is_leaf ? static_cast<PoolId>(i) : branch_of_[place(branch_of_[i])];
    ++branches_[place(branch_of_[i])].end;  // how many there are, for now
  }
  PoolId begin = 0;
  for (Branch& each : branches_) {
    each.begin = begin;
    begin += std::exchange(each.end, begin);
  }
  number_.reserve(branch_of_.size());
  for (const PoolId branch : branch_of_) number_.push_back(branches_[place(branch)].end++);
}

void Branches::find_joins(const PoolTree& tree) {
  parents_.resize(number_.size(), kNoPool);
  for (std::size_t i = 0; i < number_.size(); ++i) {
    go_on_or_throw(i);
    if (tree.parent[i] == kNoPool) continue;
    const std::size_t parent = place(tree.parent[i]);
    parents_[place(number_[i])] = number_[parent];
    if (branch_of_[parent] == branch_of_[i]) continue;
    Branch& joining = branches_[place(branch_of_[i])];
    joining.joins = number_[parent];
    joining.joins_at = bases_[place(number_[parent])];
    joining.joined_branch = branch_of_[parent];
  }
}

}  // namespace tabor::deposition
