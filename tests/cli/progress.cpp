#include "tabor/cli/progress.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "tabor/cli/interrupt.hpp"

namespace tabor::cli {
namespace {

using testing::HasSubstr;

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

TEST(Progress, OfAStageTellsTheShareOfTheWhole) {
  std::ostringstream err;
  ProgressPrinter printer(err, ProgressStyle::terminal);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));  // more often it would not print
  printer.observer()({.stage = "film", .fraction = 0.99, .whole = 0.25});
  EXPECT_THAT(err.str(), HasSubstr("film  25 %"));
}

}  // namespace
}  // namespace tabor::cli
