#include "tabor/engine/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <thread>

#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::engine {
namespace {

using test::Folder;
using test::rejection;
using testing::HasSubstr;

TEST(Store, IsOneSweepsAlone) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  EXPECT_THAT(rejection([&] { Store(folder / "out", Store::Use::alone); }),
              HasSubstr("another sweep works on these results"));
  EXPECT_THAT(rejection([&] { Store(folder / "out", Store::Use::shared); }),
              HasSubstr("another sweep"));
}

TEST(Store, IsSharedByShardsButNotWithOthers) {
  const Folder folder;
  const Store first(folder / "out", Store::Use::shared);
  EXPECT_NO_THROW(Store(folder / "out", Store::Use::shared));
  EXPECT_THROW(Store(folder / "out", Store::Use::alone), InputError);
}

TEST(Store, IsFreeAgainWhenItsProcessDied) {
  const Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const Store store(folder / "out", Store::Use::alone);
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_NO_THROW(Store(folder / "out", Store::Use::alone));
}

TEST(Store, RemovesWhatAKilledSweepLeftHalfWritten) {
  const Folder folder;
  { const Store store(folder / "out", Store::Use::alone); }
  std::filesystem::path leftover;
  {
    const io::TemporaryFile file(folder / "out/store/contact-1.h5");
    leftover = file.path();
  }
  test::put_bytes(leftover, "half");
  test::put_bytes(folder / "out/store/contact-1.h5", "whole");
  { const Store shard(folder / "out", Store::Use::shared); }
  EXPECT_TRUE(std::filesystem::exists(leftover));  // another shard may be writing it
  { const Store store(folder / "out", Store::Use::alone); }
  EXPECT_FALSE(std::filesystem::exists(leftover));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/store/contact-1.h5"));
}

TEST(Store, RejectsAFileAsItsFolder) {
  const Folder folder;
  test::put_bytes(folder / "out", "x");
  EXPECT_THROW(Store(folder / "out", Store::Use::alone), OutputError);
}

TEST(Store, ATaskLockMakesOtherShardsWait) {
  const Folder folder;
  const Store one(folder / "out", Store::Use::shared);
  const Store other(folder / "out", Store::Use::shared);
  int n_asked = 0;
  {
    const auto held = one.lock("film-1", [] {});
    const auto give_up = [&] {
      if (++n_asked == 2) throw Interrupted();
    };
    EXPECT_THROW(other.lock("film-1", give_up), Interrupted);
    EXPECT_NO_THROW(other.lock("film-2", [] { throw Interrupted(); }));
  }
  EXPECT_EQ(n_asked, 2);
  EXPECT_NO_THROW(other.lock("film-1", [] { throw Interrupted(); }));
}

}  // namespace
}  // namespace tabor::engine
