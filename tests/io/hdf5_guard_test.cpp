// What becomes of a copy of the process that reads a file of others.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "support/folder.hpp"
#include "support/sanitizers.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/hdf5_guard.hpp"
#include "tabor/io/protection.hpp"

namespace tabor::io {
namespace {

using Rows = std::function<void(const Field& rows)>;

const Field kMap = Field::Random(7, 5);

bool survives(const std::function<void()>& action) {
  const test::Folder folder;
  test::put_bytes(folder / "a.h5", "a");
  return hdf5_survives(folder / "a.h5", action);
}

class Hdf5Guard : public ::testing::Test {
 protected:
  Hdf5Guard() { isolate_hdf5_reading(true); }
  ~Hdf5Guard() override { isolate_hdf5_reading(false); }
};

TEST_F(Hdf5Guard, ResultsAndRejectionsSurvive) {
  EXPECT_TRUE(survives([] {}));
  EXPECT_TRUE(survives([] { throw InputError("no scan"); }));
}

TEST_F(Hdf5Guard, CrashesDoNot) {
  EXPECT_FALSE(survives([] { ::raise(SIGSEGV); }));
  EXPECT_FALSE(survives([] { std::abort(); }));
}

#if !defined(__SANITIZE_ADDRESS__)  // whose own memory hides what is asked for
TEST_F(Hdf5Guard, NorDoesWantingFarMoreMemoryThanTheFileHas) {
  EXPECT_FALSE(survives([] { const std::vector<char> large(std::size_t{1} << 30); }));
  EXPECT_TRUE(survives([] { const std::vector<char> small(std::size_t{1} << 20); }));
}
#endif

TEST_F(Hdf5Guard, AMapComesBackPieceByPiece) {
  std::vector<double> shares;
  const auto map = guarded_hdf5_map(
      "a.h5", {7, 5},
      [](const Rows& send) {
        send(kMap.topRows(3));
        send(kMap.bottomRows(4));
      },
      [&](double share) { shares.push_back(share); });
  ASSERT_TRUE(map);
  EXPECT_TRUE((*map == kMap).all());
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1);
}

TEST_F(Hdf5Guard, NoMapComesFromACopyThatBreaksOrSendsLess) {
  const auto received = [](const SendRows& send) {
    return guarded_hdf5_map("a.h5", {7, 5}, send, {}).has_value();
  };
  EXPECT_FALSE(received([](const Rows&) { ::raise(SIGSEGV); }));
  EXPECT_FALSE(received([](const Rows& send) { send(kMap.topRows(3)); }));
  EXPECT_FALSE(received([](const Rows& send) {
    send(kMap.topRows(3));
    throw InputError("damaged");
  }));
  EXPECT_FALSE(received([](const Rows& send) {
    send(kMap);
    std::abort();
  }));
}

TEST_F(Hdf5Guard, WhoWatchesMayStopIt) {
  EXPECT_THROW(guarded_hdf5_map(
                   "a.h5", {7, 5}, [](const Rows& send) { send(kMap); },
                   [](double) { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

TEST_F(Hdf5Guard, ACopyThatWorksForEverIsEnded) {
  EXPECT_FALSE(survives([] {
    for (volatile int i = 0;;) i = 1 - i;
  }));
}

TEST_F(Hdf5Guard, ACopyEndsWithItsProcess) {
  const test::Folder folder;
  test::put_bytes(folder / "a.h5", "a");
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    hdf5_survives(folder / "a.h5", [&] {
      if (::write(ends[1], "x", 1) != 1) return;
      for (;;) ::pause();
    });
    ::_exit(0);
  }
  ::close(ends[1]);
  char begun = 0;
  EXPECT_EQ(::read(ends[0], &begun, 1), 1);
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  // The pipe ends when the last one ends who could write to it.
  pollfd pipe{ends[0], POLLIN, 0};
  EXPECT_EQ(::poll(&pipe, 1, 10000), 1);
  ::close(ends[0]);
}

TEST_F(Hdf5Guard, ACopyThatWaitsForEverIsARejection) {
  const pid_t original = ::getpid();
  const auto wait_in_copy = [original] {
    if (::getpid() != original) ::pause();
  };
  EXPECT_THROW(survives(wait_in_copy), InputError);
}

TEST_F(Hdf5Guard, SoIsAMapWhoseCopyWaitsForEver) {  // slow
  const pid_t original = ::getpid();
  const SendRows never_ends = [&](const Rows& send) {
    send(kMap);
    if (::getpid() != original) ::pause();
  };
  EXPECT_THROW(guarded_hdf5_map("a.h5", {7, 5}, never_ends, {}), InputError);
}

TEST_F(Hdf5Guard, WithoutACopyNothingIsRead) {
  if (test::kSanitized) {
    GTEST_SKIP() << "the sanitizer opens files itself";
  }
  bool is_read = false;
  const auto read = [&] { is_read = true; };
  const test::Folder folder;
  test::put_bytes(folder / "a.h5", "a");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};  // no pipe to the copy
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THROW(hdf5_survives(folder / "a.h5", read), Error);
  EXPECT_THROW(guarded_hdf5_map(folder / "a.h5", {7, 5}, [&](const Rows&) { read(); }, {}), Error);
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_FALSE(is_read);
}

}  // namespace
}  // namespace tabor::io
