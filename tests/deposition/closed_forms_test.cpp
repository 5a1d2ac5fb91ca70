// Levels of liquid whose volume is known in closed form, and those of nested pools from a
// simulation that shares nothing with the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "support/pockets.hpp"
#include "support/validation.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"

namespace tabor::deposition {
namespace {

using test::expect_within;
using test::kPocketDepth;
using test::Pocket;

constexpr double kDepths[] = {0.75, 0.6, 0.45, 0.3, 0.15};  // of a level, over that of the pocket

std::vector<double> mean_films(const Pocket& pocket) {
  std::vector<double> films;
  films.reserve(std::size(kDepths));
  for (const double depth : kDepths) {
    films.push_back(pocket.volume_below(depth * kPocketDepth) /
                    (test::kPocketMap * test::kPocketMap));
  }
  return films;
}

/// Largest distance of a level from that of the closed form, over the depth of the pocket.
double level_error(const Pocket& pocket, Index n, Model model) {
  const Field height = test::heights_of(pocket, n);
  Dose dose;
  dose.mean_films = mean_films(pocket);
  dose.model = model;
  dose.droplet_height = 1e-9;
  const std::vector<Film> films = deposit(height, test::pocket_grid(n), dose);
  double error = 0;
  for (std::size_t i = 0; i < films.size(); ++i) {
    const Field& film = films[i].thickness;
    const double level = (film > 0).select(height + film, -kPocketDepth).maxCoeff();
    error = std::max(error, std::abs(level / kPocketDepth + kDepths[i]));
  }
  return error;
}

TEST(PocketLevels, FollowFromTheDoseInClosedForm) {
  const double tolerances[] = {6e-7, 5e-5, 3e-5, 7e-5, 7e-5};
  const std::vector<Pocket> pockets = test::all_pockets();
  for (std::size_t i = 0; i < pockets.size(); ++i) {
    const double coarse = level_error(pockets[i], 64, Model::limit);
    const double fine = level_error(pockets[i], 256, Model::limit);
    EXPECT_LT(fine, coarse / 2) << pockets[i].name;
    expect_within("Deposition", pockets[i].name + ", 256 x 256",
                  "level at five doses over its depth", "volume of the solid in closed form", fine,
                  tolerances[i]);
  }
}

TEST(PocketLevels, OfSmallDropletsAreTheSame) {
  for (const auto& [pocket, tolerance] :
       {std::pair{test::spherical_pit(), 1e-5}, std::pair{test::tilted_groove(), 4e-4}}) {
    expect_within("Deposition", pocket.name + ", 128 x 128, droplets of 1 nm",
                  "level at five doses over its depth", "volume of the solid in closed form",
                  level_error(pocket, 128, Model::droplets), tolerance);
  }
}

/// Fill, spill, merge along a line, by events: pools between summits take the rain of their pixels,
/// spill over the lower summit when full and merge with a full neighbour.
class LineOfPools {
 public:
  explicit LineOfPools(std::vector<double> height) : height_(std::move(height)) {
    const int n = static_cast<int>(height_.size());
    int first = 0;
    for (int i = 1; i + 1 < n; ++i) {
      if (height_[at(i)] > height_[at(i - 1)] && height_[at(i)] > height_[at(i + 1)]) {
        pools_.push_back({first, i - 1});
        first = i + 1;
      }
    }
    pools_.push_back({first, n - 1});
  }

  /// Rains [m] on each pixel.
  void rain(double amount) {
    for (double left = amount; left > 0;) {
      const std::vector<double> rates = inflows();
      double time = left;
      for (std::size_t k = 0; k < pools_.size(); ++k) {
        if (rates[k] > 0) time = std::min(time, room(pools_[k]) / rates[k]);
      }
      for (std::size_t k = 0; k < pools_.size(); ++k) pools_[k].volume += time * rates[k];
      left -= time;
      merge_full_neighbours();
    }
  }

  /// Solid and liquid of each pixel; a summit is under liquid where its pools have merged.
  std::vector<double> levels() const {
    std::vector<double> levels = height_;
    for (const Pool& pool : pools_) {
      const double level = level_of(pool);
      for (int i = pool.first; i <= pool.last; ++i) levels[at(i)] = std::max(levels[at(i)], level);
    }
    return levels;
  }

 private:
  struct Pool {
    int first, last;
    double volume = 0;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  double summit(int i) const {  // a wall at either end
    const bool is_inside = i >= 0 && i < static_cast<int>(height_.size());
    return is_inside ? height_[at(i)] : std::numeric_limits<double>::infinity();
  }
  double rim(const Pool& pool) const {
    return std::min(summit(pool.first - 1), summit(pool.last + 1));
  }
  double content(const Pool& pool, double level) const {
    double sum = 0;
    for (int i = pool.first; i <= pool.last; ++i) sum += std::max(level - height_[at(i)], 0.0);
    return sum;
  }
  double room(const Pool& pool) const { return content(pool, rim(pool)) - pool.volume; }
  bool is_full(const Pool& pool) const {
    return std::isfinite(rim(pool)) && room(pool) <= 1e-12 * content(pool, rim(pool));
  }
  bool spills_left(const Pool& pool) const {
    return summit(pool.first - 1) < summit(pool.last + 1);
  }

  double level_of(const Pool& pool) const {
    double low = *std::min_element(height_.begin() + pool.first, height_.begin() + pool.last + 1);
    double high = low + pool.volume;
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (content(pool, middle) < pool.volume ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  /// Rain of the own pixels and of the summit beside that falls to this side, and what others
  /// spill.
  std::vector<double> inflows() const {
    std::vector<double> rates(pools_.size(), 0.0);
    for (std::size_t k = 0; k < pools_.size(); ++k) {
      pass_on(rates, k, pools_[k].last - pools_[k].first + 1);
      if (k + 1 == pools_.size()) continue;
      const int top = pools_[k].last + 1;
      pass_on(rates, height_[at(top - 1)] < height_[at(top + 1)] ? k : k + 1, 1);
    }
    return rates;
  }
  void pass_on(std::vector<double>& rates, std::size_t k, double rate) const {
    while (is_full(pools_[k])) k = spills_left(pools_[k]) ? k - 1 : k + 1;
    rates[k] += rate;
  }

  void merge_full_neighbours() {
    for (std::size_t k = 0; k + 1 < pools_.size();) {
      const bool meet = is_full(pools_[k]) && !spills_left(pools_[k]) && is_full(pools_[k + 1]) &&
                        spills_left(pools_[k + 1]);
      if (!meet) {
        ++k;
        continue;
      }
      Pool both{pools_[k].first, pools_[k + 1].last};
      both.volume = content(both, summit(pools_[k].last + 1));
      pools_[k] = both;
      pools_.erase(pools_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      k = 0;
    }
  }

  std::vector<double> height_;  ///< [m], no two neighbours alike
  std::vector<Pool> pools_;
};

/// Pits in pits: noise on waves of all lengths.
std::vector<double> nested_profile(std::uint64_t seed) {
  const CounterRandom random(seed);
  std::vector<double> height(240);
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(height.size());
    height[i] = 0.3e-6 * random.uniform(i);
    for (int wave = 1; wave <= 32; wave *= 2) {
      const double phase = 6.28 * random.uniform(1000 + static_cast<std::uint64_t>(wave));
      height[i] += 1e-6 / std::sqrt(wave) * std::sin(6.28 * wave * x + phase);
    }
  }
  return height;
}

TEST(FillSpillMerge, LeavesTheLevelsOfASimulationOfEventsInNestedPools) {
  const std::vector<double> doses = {0.01e-6, 0.1e-6, 0.3e-6, 0.8e-6, 3e-6};
  double error = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const std::vector<double> profile = nested_profile(seed);
    const auto n = static_cast<Index>(profile.size());
    const Field height = Eigen::Map<const Field>(profile.data(), 1, n);
    Dose dose;
    dose.mean_films = doses;
    dose.model = Model::limit;
    const std::vector<Film> films =
        deposit(height, {n, 1, 1e-6 * static_cast<double>(n), 1e-6}, dose);
    LineOfPools pools(profile);
    double rained = 0;
    for (std::size_t i = 0; i < doses.size(); ++i) {
      pools.rain(doses[i] - rained);
      rained = doses[i];
      const std::vector<double> levels = pools.levels();
      const Field ours = height + films[i].thickness;
      error =
          std::max(error, (ours - Eigen::Map<const Field>(levels.data(), 1, n)).abs().maxCoeff());
    }
  }
  expect_within("Deposition", "100 profiles of nested pits, five doses",
                "level of every pixel, over 1 um", "simulation of events along a line",
                error / 1e-6, 2e-8);  // heights and doses are rounded to quanta of 4 fm
}

}  // namespace
}  // namespace tabor::deposition
