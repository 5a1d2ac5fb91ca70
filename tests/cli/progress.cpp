#include "tabor/cli/progress.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "tabor/cli/interrupt.hpp"

namespace tabor::cli {
namespace {

using testing::HasSubstr;

TEST(ShareDone, IsLogarithmicInTheCertificate) {
  const Convergence half{.certificate = 1e-3, .tolerance = 1e-6};
  EXPECT_DOUBLE_EQ(share_done(0, half), 0.5);
}

TEST(ShareDone, StaysBetweenNothingAndAll) {
  EXPECT_EQ(share_done(0, {.certificate = 10, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(0, {.certificate = 1e-9, .tolerance = 1e-6}), 1);
  EXPECT_EQ(share_done(0, {.certificate = INFINITY, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(0, {.certificate = NAN, .tolerance = 1e-6}), 0);
}

TEST(Duration, IsReadable) {
  EXPECT_EQ(format_duration(12.3), "12 s");
  EXPECT_EQ(format_duration(200), "3 min 20 s");
  EXPECT_EQ(format_duration(7500), "2 h 5 min");
}

TEST(Progress, OfAQuietProgramIsSilentButStillStopsIt) {
  std::ostringstream err;
  ProgressPrinter printer(err, ProgressStyle::none);
  const Observer observer = printer.observer();
  EXPECT_TRUE(observer({.stage = "rain", .fraction = 0.5}));
  set_interrupted(true);
  EXPECT_FALSE(observer({.stage = "rain", .fraction = 0.6}));
  set_interrupted(false);
  EXPECT_EQ(err.str(), "");
}

TEST(Progress, DoesNotFloodALogFile) {
  std::ostringstream err;
  ProgressPrinter printer(err, ProgressStyle::lines);
  const Observer observer = printer.observer();
  for (int i = 0; i < 1000; ++i) observer({.stage = "rain", .fraction = i / 1000.0});
  EXPECT_EQ(err.str(), "");  // the first line comes after ten seconds
}

}  // namespace
}  // namespace tabor::cli
