#include "tabor/cli/progress.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "tabor/cli/interrupt.hpp"
#include "tabor/engine/work_share.hpp"

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

/// A printer on a clock that the test moves.
struct Watched {
  double now = 0;
  std::ostringstream err = {};
  ProgressPrinter printer{err, ProgressStyle::terminal, [this] { return now; }};
  Observer observer = printer.observer();

  /// What one message at `at` prints.
  std::string line(double at, const Progress& progress) {
    err.str("");
    now = at;
    observer(progress);
    return err.str();
  }
};

TEST(Progress, OfAStageTellsTheShareOfTheWhole) {
  Watched watched;
  EXPECT_THAT(watched.line(1, {.stage = "film", .fraction = 0.99, .whole = 0.25}),
              HasSubstr("film  25 % of all"));
}

TEST(Progress, TellsTheTimeLeftOfAStage) {
  Watched watched;
  for (double at = 0; at < 20; at += 0.5) watched.line(at, {.stage = "read", .fraction = at / 20});
  for (double at = 20; at < 60; at += 0.5) {
    const std::string line = watched.line(at, {.stage = "rain", .fraction = (at - 20) / 100});
    const bool is_told = line.find("left") != std::string::npos;
    EXPECT_EQ(is_told, at >= 27) << at << line;  // 5 % after 5 s, and two seconds that agree
  }
  EXPECT_THAT(watched.line(60, {.stage = "rain", .fraction = 0.4}), HasSubstr("1 min 0 s left"));
}

TEST(Progress, AnUnknownShareOfAStageIsThatOfTheMessageBefore) {
  Watched watched;
  watched.line(1, {.stage = "rain", .fraction = 0.5});
  EXPECT_THAT(watched.line(2, {.stage = "rain"}), HasSubstr("rain  50 %"));
  EXPECT_THAT(watched.line(3, {.stage = "write"}), testing::Not(HasSubstr("%")));
}

TEST(TimeLeft, OfSteadyWorkIsRightAndNeverEarly) {
  TimeLeft left;
  for (double now = 0; now < 100; now += 0.1) {
    const auto told = left.at(now, now / 100);
    if (now < 5 || now > 8) {
      EXPECT_EQ(told.has_value(), now > 8) << now;
    }
    EXPECT_NEAR(told.value_or(100 - now), 100 - now, 1e-6);
  }
}

TEST(TimeLeft, IsNotToldFromAShareThatJumps) {
  TimeLeft left;
  bool was_told = false;
  for (double now = 0; now < 60; now += 0.1) {
    // From 6 % to 50 % and back every two seconds: 15 times as long or once more.
    const bool high = static_cast<int>(now / 2) % 2 == 1;
    was_told = was_told || left.at(now, high ? 0.5 : 0.06);
  }
  EXPECT_FALSE(was_told);
}

TEST(TimeLeft, OfAContinuedRunCountsFromWhereItGoesOn) {
  TimeLeft left;
  // 40 % are there after two seconds, the rest takes 60.
  for (double now = 2; now < 50; now += 0.1) {
    const auto told = left.at(now, 0.4 + 0.6 * (now - 2) / 60);
    if (std::abs(now - 7.1) > 0.15) {
      EXPECT_EQ(told.has_value(), now > 7.1) << now;
    }
    EXPECT_NEAR(told.value_or(62 - now), 62 - now, 1e-6);
  }
}

TEST(TimeLeft, IsSilentWithoutAShare) {
  TimeLeft left;
  for (double now = 0; now < 60; now += 1) {
    EXPECT_FALSE(left.at(now, std::nan("")));
  }
}

TEST(Duration, OfAnEstimateHasFewDigits) {
  EXPECT_EQ(format_estimate(4.2), "4 s");
  EXPECT_EQ(format_estimate(58.6), "1 min 0 s");
  EXPECT_EQ(format_estimate(137), "2 min 15 s");
  EXPECT_EQ(format_estimate(1437), "24 min");
  EXPECT_EQ(format_estimate(7507), "2 h 5 min");
}

/// What a sweep of 4 scans with 6 contacts each prints, from its first second to its last. The
/// workers take tasks in order; one that runs says each second how far it is.
struct SimulatedSweep {
  double seconds_of(const std::string& kind) const {
    return kind == "surface" ? surface : kind == "film" ? film : contact;
  }

  /// Calls look(now, share) once a second and returns when it ended.
  double run(const std::function<void(double, double)>& look) const {
    std::vector<std::string> jobs;
    for (int scan = 0; scan < 4; ++scan) {
      jobs.insert(jobs.end(), {"surface", "film"});
      jobs.insert(jobs.end(), 6, "contact");
    }
    double now = 0;
    engine::WorkShare work(jobs, [&] { return now; });
    work.set_workers(n_workers);
    std::vector<std::pair<std::size_t, double>> running;  // job, when it began
    for (std::size_t next = 0; next < jobs.size() || !running.empty(); now += 0.1) {
      std::erase_if(running, [&](const auto& job) {
        const double share = (now - job.second) / seconds_of(jobs[job.first]);
        if (share >= 1) work.end(job.first);
        if (share < 1) work.inside(job.first, share);
        return share >= 1;
      });
      while (next < jobs.size() && running.size() < static_cast<std::size_t>(n_workers)) {
        work.begin(next);
        running.emplace_back(next++, now);
      }
      look(now, work.share());
    }
    return now;
  }

  int n_workers;
  double surface, film, contact;
};

TEST(TimeLeft, OfASweepIsOfTheRightSizeWheneverItIsTold) {
  for (const SimulatedSweep& sweep :
       {SimulatedSweep{1, 2, 12, 3}, SimulatedSweep{2, 0.5, 2, 12}, SimulatedSweep{2, 5, 60, 2},
        SimulatedSweep{4, 0.2, 1, 5}, SimulatedSweep{1, 20, 1, 1}}) {
    const double end = sweep.run([](double, double) {});
    TimeLeft left;
    double first_told = end;
    sweep.run([&](double now, double share) {
      const auto told = left.at(now, share);
      if (!told) return;
      first_told = std::min(first_told, now);
      EXPECT_LT(*told, 2 * (end - now) + 5) << "at " << now << " of " << end;
      EXPECT_GT(*told, (end - now) / 2 - 5) << "at " << now << " of " << end;
    });
    EXPECT_LT(first_told, 0.6 * end);
  }
}

}  // namespace
}  // namespace tabor::cli
