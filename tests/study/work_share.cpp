#include "tabor/study/work_share.hpp"

#include <gtest/gtest.h>

namespace tabor::study {
namespace {

using Kind = Task::Kind;

TEST(WorkShare, CountsTasksByTheTimeTheirKindTakes) {
  WorkShare work({{Kind::film, 0}, {Kind::contact, 0, 0}, {Kind::contact, 0, 1}});
  EXPECT_EQ(work.share(), 0);
  work.end(0, 80);
  work.end(1, 10);
  EXPECT_DOUBLE_EQ(work.share(), 0.9);
  work.inside(2, 0.5);
  EXPECT_DOUBLE_EQ(work.share(), 0.95);
  work.end(2, 10);
  EXPECT_EQ(work.share(), 1);
}

TEST(WorkShare, ScalesKindsThatHaveNotEndedWithThoseThatHave) {
  WorkShare fast({{Kind::film, 0}, {Kind::contact, 0}});
  WorkShare slow({{Kind::film, 0}, {Kind::contact, 0}});
  fast.end(0, 1);
  slow.end(0, 1000);
  EXPECT_DOUBLE_EQ(fast.share(), slow.share());
  EXPECT_GT(fast.share(), 0);
  EXPECT_LT(fast.share(), 1);
}

}  // namespace
}  // namespace tabor::study
