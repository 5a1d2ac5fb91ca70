#include "tabor/numerics/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "tabor/core/random.hpp"

namespace tabor::numerics {
namespace {

/// Steps on a square lattice.
struct Step {
  int x = 0;
  int y = 0;
  Step operator+(Step o) const { return {x + o.x, y + o.y}; }
  Step operator-(Step o) const { return {x - o.x, y - o.y}; }
  bool operator==(const Step&) const = default;
};

TEST(DisjointSets, BeginApart) {
  DisjointSets<int> sets(3);
  EXPECT_EQ(sets.n_sets(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sets.root(i), i);
  EXPECT_EQ(sets.add(), 3);
  EXPECT_EQ(sets.n_sets(), 4u);
  EXPECT_EQ(sets.size(), 4u);
}

TEST(DisjointSets, AreJoinedUnderTheSmallestMember) {
  DisjointSets<std::uint32_t> sets(6);
  EXPECT_FALSE(sets.join(5, 3).were_one);
  EXPECT_EQ(sets.join(3, 4).root, 3u);
  EXPECT_EQ(sets.join(4, 1).root, 1u);
  EXPECT_TRUE(sets.join(5, 1).were_one);
  EXPECT_EQ(sets.n_sets(), 3u);  // {0}, {1, 3, 4, 5}, {2}
  for (const std::uint32_t member : {3u, 4u, 5u}) EXPECT_EQ(sets.root(member), 1u);
  EXPECT_EQ(sets.root(2), 2u);
}

/// Sets as lists of members, joined by renaming.
class Renamed {
 public:
  explicit Renamed(int n) {
    for (int i = 0; i < n; ++i) name_.push_back(i);
  }
  void join(int a, int b) {
    const int from = std::max(name(a), name(b));
    const int to = std::min(name(a), name(b));
    for (int& one : name_) {
      if (one == from) one = to;
    }
  }
  int name(int i) const { return name_[static_cast<std::size_t>(i)]; }
  std::size_t n_sets() const { return std::set<int>(name_.begin(), name_.end()).size(); }

 private:
  std::vector<int> name_;
};

TEST(DisjointSets, AgreeWithRenamingForRandomJoins) {
  constexpr int kMembers = 60;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CounterRandom random(seed);
    DisjointSets<std::int32_t> sets(kMembers);
    Renamed slow(kMembers);
    for (std::uint64_t k = 0; k < 50; ++k) {
      const auto pick = [&](std::uint64_t i) {
        return static_cast<int>(random.uniform(2 * k + i) * kMembers);
      };
      sets.join(pick(0), pick(1));
      slow.join(pick(0), pick(1));
      ASSERT_EQ(sets.n_sets(), slow.n_sets());
    }
    for (int i = 0; i < kMembers; ++i) EXPECT_EQ(sets.root(i), slow.name(i));
  }
}

/// The number of a place on a map of 5 columns.
int at(Step place) { return 5 * place.y + place.x; }

TEST(DisjointSets, KnowWhereTheirMembersAre) {
  DisjointSets<int, Step> sets(25);
  // A random walk over the map: whatever the path, a place is where it is.
  const CounterRandom random(7);
  Step here{2, 2};
  for (std::uint64_t k = 0; k < 300; ++k) {
    const auto turn = static_cast<int>(random.uniform(k) * 4);
    const Step step{turn == 0 ? 1 : (turn == 1 ? -1 : 0), turn == 2 ? 1 : (turn == 3 ? -1 : 0)};
    const Step next = here + step;
    if (next.x < 0 || next.y < 0 || next.x > 4 || next.y > 4) continue;
    const auto joined = sets.join(at(here), at(next), step);
    EXPECT_EQ(joined.difference, Step{});
    here = next;
  }
  EXPECT_EQ(sets.n_sets(), 1u);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) EXPECT_EQ(sets.find(at({x, y})).from_root, (Step{x, y}));
  }
}

TEST(DisjointSets, NoticeARingThatClosesOnItself) {
  DisjointSets<int, Step> ring(4);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(ring.join(i, i + 1, {1, 0}).were_one);
  const auto closed = ring.join(3, 0, {1, 0});  // four steps on it is where it began
  EXPECT_TRUE(closed.were_one);
  EXPECT_EQ(closed.difference, (Step{4, 0}));
}

TEST(DisjointSets, RejectMoreMembersThanTheirNumbersCount) {
  EXPECT_NO_THROW(DisjointSets<std::int8_t>(127));
  EXPECT_THROW(DisjointSets<std::int8_t>(128), InputError);
}

}  // namespace
}  // namespace tabor::numerics
