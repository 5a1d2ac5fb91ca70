// What becomes of a copy of the process that reads a file of others.
#include <gtest/gtest.h>
#include <poll.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <vector>

#include "support/folder.hpp"
#include "support/sanitizers.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/file_lock.hpp"
#include "tabor/io/files/protection.hpp"
#include "tabor/io/hdf5/guard.hpp"

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

/// A process that makes a copy and is killed once that has said so, and what is left of it.
class Orphan {
 public:
  /// `read(say)` makes the copy, in which say() is called; the process holds a lock meanwhile.
  explicit Orphan(const std::function<void(const std::function<void()>& say)>& read) {
    if (::pipe(ends_) != 0) return;
    const pid_t process = ::fork();
    if (process == 0) {
      const auto lock = FileLock::take(folder_ / "lock", FileLock::Kind::alone);
      read([this] { say(); });
      ::_exit(0);
    }
    ::close(ends_[1]);
    EXPECT_EQ(::read(ends_[0], &copy_, sizeof copy_), static_cast<ssize_t>(sizeof copy_));
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
  ~Orphan() {
    if (!ends_in(0) && copy_ > 0) ::kill(copy_, SIGKILL);
    ::close(ends_[0]);
  }
  Orphan(const Orphan&) = delete;
  Orphan& operator=(const Orphan&) = delete;

  /// The pipe ends when the last one ends who could write to it.
  bool ends_in(int milliseconds) const {
    pollfd pipe{ends_[0], POLLIN, 0};
    return ::poll(&pipe, 1, milliseconds) == 1;
  }
  bool holds_the_lock() const {
    return !FileLock::take(folder_ / "lock", FileLock::Kind::alone).has_value();
  }

 private:
  void say() const {
    const pid_t copy = ::getpid();
    if (::write(ends_[1], &copy, sizeof copy) != static_cast<ssize_t>(sizeof copy)) ::_exit(1);
  }

  test::Folder folder_;
  int ends_[2] = {-1, -1};
  pid_t copy_ = 0;
};

[[noreturn]] void wait_for_ever() {
  for (;;) ::pause();
}

constexpr int kSoon = 10000;  // [ms]

TEST_F(Hdf5Guard, ACopyEndsWithItsProcess) {
  const Orphan orphan([](const auto& say) {
    survives([&] {
      say();
      wait_for_ever();
    });
  });
  EXPECT_TRUE(orphan.ends_in(kSoon));
}

// Between the making of the copy and its first step the process has all the time to die.
std::function<void()> say_when_made;  // a handler of fork() takes no argument
pid_t original_when_made = 0;

TEST_F(Hdf5Guard, SoDoesACopyWhoseProcessDiesBeforeItsFirstStep) {
  const Orphan orphan([](const auto& say) {
    say_when_made = say;
    original_when_made = ::getpid();
    ::pthread_atfork(nullptr, nullptr, [] {
      say_when_made();
      while (::getppid() == original_when_made) ::usleep(1000);
    });
    survives(&wait_for_ever);
  });
  EXPECT_TRUE(orphan.ends_in(kSoon));
  EXPECT_FALSE(orphan.holds_the_lock());
}

/// In a copy that is not told of the end of its process: waits for it.
void outlive(const std::function<void()>& say) {
  ::prctl(PR_SET_PDEATHSIG, 0);
  const pid_t original = ::getppid();
  say();
  while (::getppid() == original) ::usleep(1000);
}

TEST_F(Hdf5Guard, ACopyThatNobodyReceivesFromEndsAndDoesNotWait) {
  const Field large = Field::Zero(512, 512);  // more than a pipe holds
  const Orphan orphan([&](const auto& say) {
    guarded_hdf5_map("a.h5", {512, 512},
                     [&](const Rows& send) {
                       outlive(say);
                       for (;;) send(large);
                     },
                     {});
  });
  EXPECT_TRUE(orphan.ends_in(kSoon));
}

TEST_F(Hdf5Guard, ACopyHoldsNoLock) {
  const Orphan orphan([](const auto& say) {
    survives([&] {
      outlive(say);
      wait_for_ever();
    });
  });
  EXPECT_FALSE(orphan.ends_in(0));
  EXPECT_FALSE(orphan.holds_the_lock());
}

TEST_F(Hdf5Guard, ACopyHasALimitByTheClock) {
  EXPECT_TRUE(survives([] {
    const unsigned left = ::alarm(0);  // [s]
    if (left < 50 || left > 60) std::abort();
  }));
  EXPECT_THROW(survives([original = ::getpid()] {
                 if (::getpid() == original) return;
                 ::alarm(1);
                 wait_for_ever();
               }),
               InputError);
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
