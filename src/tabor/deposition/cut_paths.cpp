#include "tabor/deposition/cut_paths.hpp"

namespace tabor::deposition {

void CutPaths::cut(PoolId full) {
  if (number_.empty()) number_.resize(pools_.count(), kNone);
  std::int32_t& number = number_[static_cast<std::size_t>(full)];
  if (number != kNone) return;
  number = static_cast<std::int32_t>(cuts_.size());
  std::int32_t& first = first_at_saddle_.try_emplace(pools_[full].parent, kNone).first->second;
  cuts_.push_back({.pool = full, .whole = {}, .next_at_saddle = first});
  first = number;
}

void CutPaths::join(const std::vector<PoolId>& passed) {
  for (std::size_t i = passed.size(); i-- > 0;) {
    const auto number_here = static_cast<std::int32_t>(number(passed[i]));
    Cut& here = cuts_[static_cast<std::size_t>(number_here)];
    const FlowPath path = pools_[here.pool].overflow;
    const bool leads_to_cut = has(path.end) && pools_[path.end].owner == path.end;
    if (!leads_to_cut) {
      here.whole = path;
      continue;
    }
    const auto number_ahead = static_cast<std::int32_t>(number(path.end));
    Cut& ahead = cuts_[static_cast<std::size_t>(number_ahead)];
    here.whole = ahead.whole;
    if (here.next == number_ahead) continue;
    here.next = number_ahead;
    before_.push_back({number_here, ahead.first_before});
    ahead.first_before = static_cast<std::int32_t>(before_.size()) - 1;
  }
}

void CutPaths::forget_changed() {
  for (const PoolId above : pools_.take_changed()) {
    const auto first = first_at_saddle_.find(above);
    if (first == first_at_saddle_.end()) continue;
    for (std::int32_t cut = first->second; cut != kNone;
         cut = cuts_[static_cast<std::size_t>(cut)].next_at_saddle) {
      pools_.remember_overflow(cuts_[static_cast<std::size_t>(cut)].pool, {});
      forget_chains_through(cut);
    }
  }
}

void CutPaths::forget_chains_through(std::int32_t cut) {
  open_.assign(1, cut);
  while (!open_.empty()) {
    Cut& here = cuts_[static_cast<std::size_t>(open_.back())];
    const std::int32_t number_here = open_.back();
    open_.pop_back();
    here.whole = {};
    here.next = kNone;
    for (std::int32_t i = here.first_before; i != kNone;
         i = before_[static_cast<std::size_t>(i)].next) {
      const std::int32_t before = before_[static_cast<std::size_t>(i)].cut;
      if (cuts_[static_cast<std::size_t>(before)].next == number_here) open_.push_back(before);
    }
    here.first_before = kNone;
  }
}

void CutPaths::forget() {
  for (const Cut& cut : cuts_) pools_.remember_overflow(cut.pool, {});
  number_ = {};
  cuts_ = {};
  before_ = {};
  first_at_saddle_ = {};
}

}  // namespace tabor::deposition
