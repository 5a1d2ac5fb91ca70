#include "tabor/contact/candidate_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/contact/contact.hpp"
#include "tabor/contact/listed_caps.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

constexpr Index kChunk = 64;  // pixels looked at together: hardly any chunk holds a candidate

/// First place in the set whose pixel is not before this one.
std::size_t place_of(const CandidateSet& set, Index pixel) {
  return static_cast<std::size_t>(
      std::lower_bound(set.pixels.begin(), set.pixels.end(), static_cast<std::uint32_t>(pixel)) -
      set.pixels.begin());
}

/// The new candidates among the pixels of a block.
PixelList candidates_in(const CandidateSet& old, const double* v, double threshold, Index begin,
                        Index end) {
  PixelList pixels;
  std::size_t k = place_of(old, begin);
  for (Index chunk = begin; chunk < end; chunk += kChunk) {  // raw loop: skips most chunks
    const Index n = std::min(kChunk, end - chunk);
    const bool has_old = k < old.size() && old.pixels[k] < chunk + n;
    if (!has_old && Eigen::Map<const Eigen::ArrayXd>(v + chunk, n).minCoeff() > threshold) continue;
    for (Index i = chunk; i < chunk + n; ++i) {  // raw loop: of a chunk
      const bool is_old = k < old.size() && old.pixels[k] == i;
      if (v[i] <= threshold || (is_old && touches(old.values.pressure[k]))) {
        pixels.push_back(static_cast<std::uint32_t>(i));
      }
      k += is_old ? 1 : 0;
    }
  }
  return pixels;
}

void resize(CandidateSet& set, std::size_t n) {
  set.pixels.resize(n);
  set.values.pressure.resize(n);
  set.values.residual.resize(n);
  set.response.resize(n);
  set.direction.resize(n);
}

/// Writes pixels into the set from place k on, with what the old set knows of them.
void join(const PixelList& pixels, const CandidateSet& old, const double* v, const float* change,
          std::size_t k, CandidateSet& set) {
  std::size_t before = pixels.empty() ? 0 : place_of(old, pixels.front());
  for (const std::uint32_t pixel : pixels) {
    while (before < old.size() && old.pixels[before] < pixel) ++before;
    const bool is_old = before < old.size() && old.pixels[before] == pixel;
    set.pixels[k] = pixel;
    set.values.residual[k] = v[pixel];
    set.values.pressure[k] = is_old ? old.values.pressure[before] : 0.0;
    set.direction[k] = is_old ? old.direction[before] : 0.0F;
    set.response[k] = change != nullptr ? change[pixel] : (is_old ? old.response[before] : 0.0F);
    ++k;
  }
}

double mean_residual_under_pressure(const Candidates& values) {
  const std::size_t n = values.pressure.size();
  const auto is_pressed = [&](std::size_t k) { return touches(values.pressure[k]); };
  return sum_over(n, [&](std::size_t k) { return is_pressed(k) ? values.residual[k] : 0.0; }) /
         static_cast<double>(count_where(n, is_pressed));
}

}  // namespace

CandidateSet pressed_pixels(const Field& pressure) {
  const double* p = pressure.data();
  CandidateSet set;
  set.pixels = list_where(pressure.size(), [p](Index i) { return touches(p[i]); });
  resize(set, set.size());
  for_each(set.size(), [&](std::size_t k) { set.values.pressure[k] = p[set.pixels[k]]; });
  return set;
}

void spread_pressure(const CandidateSet& set, Field& map) {
  double* p = map.data();
  for_each(map.size(), [=](Index i) { p[i] = 0; });
  for_each(set.size(), [&](std::size_t k) { p[set.pixels[k]] = set.values.pressure[k]; });
}

double candidate_threshold(const CandidateSet& set, double load, const Caps& caps,
                           double diagonal_step) {
  const std::vector<double>& pressure = set.values.pressure;
  const std::vector<double>& residual = set.values.residual;
  if (std::none_of(pressure.begin(), pressure.end(), &touches)) {
    return std::numeric_limits<double>::infinity();
  }
  if (!caps.bound()) return mean_residual_under_pressure(set.values);
  const PixelList pressed =
      list_where(std::ssize(pressure), [p = pressure.data()](Index k) { return touches(p[k]); });
  std::vector<double> v(pressed.size());
  for_each(v.size(), [&](std::size_t k) { v[k] = residual[pressed[k]]; });
  const double highest = *std::max_element(v.begin(), v.end());
  PixelList pixels(pressed.size());
  for_each(pixels.size(), [&](std::size_t k) { pixels[k] = set.pixels[pressed[k]]; });
  const ListedCaps listed(caps, pixels);
  if (Caps(listed).sum(std::ssize(v)) <= load) return highest;
  const double threshold = knapsack_threshold(v, load, listed);
  std::vector<double>& wanted = v;
  for_each(wanted.size(), [&](std::size_t k) {
    wanted[k] = pressure[pressed[k]] - diagonal_step * residual[pressed[k]];
  });
  const double separation = -shift_for_load(wanted, load, listed) / diagonal_step;
  return std::min(highest, std::max(separation, threshold));
}

void collect_in_blocks(const Field& residual, FieldF* change, double threshold,
                       const std::function<void(Index, Index)>& update, CandidateSet& set) {
  const double* v = residual.data();
  const Index n_blocks = (residual.size() + kBlock - 1) / kBlock;
  std::vector<PixelList> lists(static_cast<std::size_t>(n_blocks));
  parallel_for(residual.size(), kBlock, [&](Index begin, Index end) {
    update(begin, end);
    lists[static_cast<std::size_t>(begin / kBlock)] = candidates_in(set, v, threshold, begin, end);
  });
  std::vector<std::size_t> starts{0};
  for (const PixelList& list : lists) starts.push_back(starts.back() + list.size());
  release(set.values.residual);
  float* s = change == nullptr ? nullptr : change->data();
  if (s != nullptr) release(set.response);
  CandidateSet next;
  resize(next, starts.back());
  parallel_for(residual.size(), kBlock, [&](Index begin, Index end) {
    const auto b = static_cast<std::size_t>(begin / kBlock);
    join(lists[b], set, v, s, starts[b], next);
    release(lists[b]);
    if (s != nullptr) std::fill(s + begin, s + end, 0.0F);
  });
  set = std::move(next);
}

}  // namespace tabor::contact
