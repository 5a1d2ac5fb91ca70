#include "tabor/deposition/saddles.hpp"

#include <algorithm>
#include <utility>

#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

/// Order of a heap with the lowest on top.
bool is_after(const Candidate& a, const Candidate& b) { return b.before(a); }

/// True for two places of one pixel, or wet by one pool: they rise together.
bool says_the_same(const Candidate& a, const Candidate& b) {
  return a.pixel == b.pixel || (a.wet_by == b.wet_by && a.wet_by != kNoPool);
}

/// Keeps the first of the candidates that one pool wets: it stays first.
void keep_one_a_pool(std::vector<Candidate>& candidates) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.wet_by != b.wet_by ? a.wet_by < b.wet_by : a.pixel < b.pixel;
  });
  candidates.erase(std::unique(candidates.begin(), candidates.end(), says_the_same),
                   candidates.end());
}

}  // namespace

Candidate candidate_at(Pools& pools, Pixel q) {
  if (q == kOutside) return {kDry, kOutside, kNoPool};
  const PoolId pool = pools.owner(pools.pool_at(q));
  const Height level = pools[pool].level;
  const Height solid = pools.height(q);
  return solid <= level ? Candidate{level, q, pool} : Candidate{solid, q, kNoPool};
}

Saddle::Saddle(Pools& pools, PoolId above, Children children, std::int64_t& n_looks)
    : pools_(pools),
      pixels_(pools.bottom(above)),
      height_(pools.height(pixels_.front())),
      children_(std::move(children)),
      regions_(pixels_.size()),
      heaps_(pixels_.size()),
      n_looks_(n_looks) {
  find_contacts();
  find_heaps();
  for (std::size_t i = 0; i < children_.count(); ++i) {
    if (pools_[children_[i]].level == height_) close(children_[i]);
  }
}

Saddle::Place Saddle::place_of(Pixel p) const {
  return static_cast<Place>(std::lower_bound(pixels_.begin(), pixels_.end(), p) - pixels_.begin());
}

/// Which pixels lie beside which child, and, on the way, which beside one another.
void Saddle::find_contacts() {
  std::vector<Contact> contacts;
  for (Place place = 0; place < static_cast<Place>(pixels_.size()); ++place) {
    const Pixel p = pixels_[static_cast<std::size_t>(place)];
    go_on_or_throw(static_cast<std::size_t>(place));
    for_each_neighbour(pools_.terrain(), p, [&](Pixel q) {
      ++n_looks_;
      if (q == kOutside || pools_.height(q) > height_) return;
      if (pools_.height(q) == height_) {
        regions_.join(place, place_of(q));
      } else {
        contacts.push_back({children_.holding(pools_.pool_at(q)), place});
      }
    });
  }
  first_contact_.assign(children_.count() + 1, 0);
  for (const Contact& contact : contacts) ++first_contact_[contact.child];
  std::int32_t begin = 0;
  for (std::int32_t& first : first_contact_) begin += std::exchange(first, begin);
  places_.resize(contacts.size());
  std::vector<std::int32_t> next(first_contact_);
  for (const Contact& contact : contacts) {
    places_[static_cast<std::size_t>(next[contact.child]++)] = contact.place;
  }
}

void Saddle::find_heaps() {
  for (Place place = 0; place < static_cast<Place>(pixels_.size()); ++place) {
    Heap& heap = heap_of(place);
    for_each_neighbour(pools_.terrain(), pixels_[static_cast<std::size_t>(place)], [&](Pixel q) {
      if (const Candidate next = candidate_at(pools_, q); next.height < height_) {
        heap.push_back(next);
      }
    });
  }
  for (Heap& heap : heaps_) {
    keep_one_a_pool(heap);
    std::make_heap(heap.begin(), heap.end(), is_after);
  }
}

void Saddle::close(PoolId child) {
  const std::size_t number = children_.holding(child);
  const auto begin = static_cast<std::size_t>(first_contact_[number]);
  const auto end = static_cast<std::size_t>(first_contact_[number + 1]);
  for (std::size_t i = begin; i < end; ++i) unite(places_[begin], places_[i]);
}

void Saddle::unite(Place a, Place b) {
  ++n_looks_;
  const Place root_a = regions_.root(a);
  const Place root_b = regions_.root(b);
  if (root_a == root_b) return;
  Heap& heap_a = heaps_[static_cast<std::size_t>(root_a)];
  Heap& heap_b = heaps_[static_cast<std::size_t>(root_b)];
  if (heap_a.size() < heap_b.size()) heap_a.swap(heap_b);
  for (const Candidate& each : heap_b) {
    ++n_looks_;
    heap_a.push_back(each);
    std::push_heap(heap_a.begin(), heap_a.end(), is_after);
  }
  Heap().swap(heap_b);
  regions_.join(root_a, root_b);
  heap_of(a).swap(heap_a);
}

Drain Saddle::drain_of_child(PoolId child) {
  const std::size_t number = children_.holding(child);
  const Place place = places_[static_cast<std::size_t>(first_contact_[number])];
  const Candidate lowest = lowest_beside(place);
  return {lowest, next_beside(place, lowest)};
}

/// Heights in the heap are those of before: none is lower now, and all wet by one pool are alike.
Candidate Saddle::lowest_beside(Place place) {
  Heap& heap = heap_of(place);
  Candidate lowest;
  risen_.clear();
  while (!heap.empty() && heap.front().before(lowest)) {
    ++n_looks_;
    const Candidate now = candidate_at(pools_, heap.front().pixel);
    if (now.height == heap.front().height) {
      lowest = now;
      break;
    }
    std::pop_heap(heap.begin(), heap.end(), is_after);
    heap.pop_back();
    if (now.height == height_) continue;  // part of the region
    risen_.push_back(now);
    if (now.before(lowest)) lowest = now;
  }
  if (risen_.size() > 1) keep_one_a_pool(risen_);
  for (const Candidate& each : risen_) {
    heap.push_back(each);
    std::push_heap(heap.begin(), heap.end(), is_after);
  }
  return lowest;
}

/// The height of the lowest place beside the region that is not wet by the same pool as the lowest
/// of all, which has just been found. Those that are say the same for ever and are removed.
Height Saddle::next_beside(Place place, const Candidate& lowest) {
  Heap& heap = heap_of(place);
  if (heap.empty()) return kNoRim;
  std::pop_heap(heap.begin(), heap.end(), is_after);
  heap.pop_back();
  Height next = kNoRim;
  while (!heap.empty()) {
    ++n_looks_;
    const Candidate now = candidate_at(pools_, heap.front().pixel);
    const bool is_another = !says_the_same(now, lowest);
    if (now.height == heap.front().height && is_another) {
      next = now.height;
      break;
    }
    std::pop_heap(heap.begin(), heap.end(), is_after);
    heap.pop_back();
    if (!is_another || now.height == height_) continue;  // the latter is part of the region
    heap.push_back(now);
    std::push_heap(heap.begin(), heap.end(), is_after);
  }
  heap.push_back(lowest);
  std::push_heap(heap.begin(), heap.end(), is_after);
  return next;
}

Saddle& Saddles::at(PoolId above) {
  for (const PoolId closed : pools_.take_closed()) {
    const auto known = saddles_.find(pools_[closed].parent);
    if (known != saddles_.end()) known->second.close(closed);
  }
  if (const auto known = saddles_.find(above); known != saddles_.end()) return known->second;
  Children children(descent_, above);
  n_looks_ += static_cast<std::int64_t>(children.count());
  return saddles_.try_emplace(above, pools_, above, std::move(children), n_looks_).first->second;
}

}  // namespace tabor::deposition
