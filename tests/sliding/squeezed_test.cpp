// Oil that contacts squeeze out.
#include "tabor/sliding/squeezed.hpp"

#include <gtest/gtest.h>

#include "tabor/core/random.hpp"

namespace tabor::sliding {
namespace {

struct Closed {
  Grid grid{24, 16, 24e-6, 16e-6};
  Field gap = Field::Zero(16, 24);
  Field film = Field::Zero(16, 24);

  explicit Closed(double oil) {
    const CounterRandom random(3);
    for (Index i = 0; i < gap.size(); ++i) {
      const double place = random.uniform(static_cast<std::uint64_t>(i));
      gap(i) = place < 0.3 ? -1e-8 * place : 1e-6 * (place - 0.3);
      film(i) = oil * random.uniform(static_cast<std::uint64_t>(i + 5000));
    }
  }

  Squeezed squeezed(const Mask* sealed = nullptr) const {
    return squeeze(film, gap, sealed, grid, deposition::Edge::periodic);
  }
};

TEST(SqueezedOil, LeavesTheContactAndFitsIntoTheGap) {
  const Closed closed(2e-7);
  const Squeezed found = closed.squeezed();
  for (Index i = 0; i < found.film.size(); ++i) {
    EXPECT_LE(found.film(i), std::max(closed.gap(i), 0.0));
  }
  EXPECT_EQ(found.without_space, 0);
  EXPECT_NEAR(found.film.sum() / closed.film.sum(), 1, 1e-12);
}

TEST(SqueezedOil, ThatTheGapCannotHoldIsCounted) {
  const Closed closed(2e-6);
  const Squeezed found = closed.squeezed();
  EXPECT_GT(found.without_space, 0);
  const auto n = static_cast<double>(closed.film.size());
  EXPECT_NEAR((found.film.sum() + n * found.without_space) / closed.film.sum(), 1, 1e-12);
  EXPECT_NEAR(found.film.sum() / closed.gap.max(0.0).sum(), 1, 1e-6);  // levels are whole quanta
  EXPECT_LE((found.film - closed.gap.max(0.0)).maxCoeff(), 0);         // contact is dry
}

TEST(SqueezedOil, StaysInSealedPockets) {
  const Closed closed(2e-7);
  Mask sealed = Mask::Constant(16, 24, false);
  sealed.block(3, 3, 5, 6) = true;
  const Squeezed found = closed.squeezed(&sealed);
  for (Index i = 0; i < found.film.size(); ++i) {
    if (sealed(i)) {
      EXPECT_EQ(found.film(i), closed.film(i));
    }
  }
  EXPECT_NEAR(found.film.sum() / closed.film.sum(), 1, 1e-12);
}

TEST(SqueezedOil, HasNowhereToGoInFullContact) {
  Closed closed(1e-7);
  closed.gap.setZero();
  const Squeezed found = closed.squeezed();
  EXPECT_EQ(found.film.sum(), 0);
  EXPECT_NEAR(found.without_space, closed.film.mean(), 1e-20);
}

}  // namespace
}  // namespace tabor::sliding
