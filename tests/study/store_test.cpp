#include "tabor/study/store.hpp"

#include <sys/wait.h>

#include <thread>

#include "study/example_study.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/task_file.hpp"

namespace tabor::study {
namespace {

using test::Folder;
using test::message_of;
using testing::HasSubstr;

/// A row says what it depends on, which a test leaves alone.
std::string without_head(const std::string& row) { return row.substr(row.find("\"scan\"")); }

TEST(Store, IsOneSweepsAlone) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  EXPECT_THAT(message_of([&] { Store(folder / "out", Store::Use::alone); }),
              HasSubstr("another sweep works on these results"));
  EXPECT_THAT(message_of([&] { Store(folder / "out", Store::Use::shared); }),
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

TEST(Row, ReadsBackToTheSameBits) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  row.scan = "a \"b\"\xff.x3p";
  row.mean_pressure = 1.0 / 3;
  row.friction_dry = 0.1 + 0.2;
  row.mean_gap = 4.9e-324;
  row.converged = true;
  write_row(store, task, row);
  const Row again = read_row(store, task);
  EXPECT_EQ(again.mean_pressure, row.mean_pressure);
  EXPECT_EQ(again.friction_dry, row.friction_dry);
  EXPECT_EQ(again.mean_gap, row.mean_gap);
  EXPECT_TRUE(std::isnan(again.friction_lubricated));
  EXPECT_TRUE(again.converged);
  EXPECT_TRUE(defect(store, task).empty());
}

TEST(Row, AnyOtherByteIsADefectOrSaysTheSame) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  row.scan = "a.h5";
  row.friction_dry = 0.1 + 0.2;
  row.contact_area_fraction = 0.125;
  row.converged = true;
  write_row(store, task, row);
  const std::string all = test::bytes_of(store.path(task));
  int n_found = 0;
  for (std::size_t at = 0; at < all.size(); ++at) {
    for (const int flip : {1, 2, 4, 8, 16, 32, 64, 128}) {
      std::string bytes = all;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      test::put_bytes(store.path(task), bytes);
      if (!defect(store, task).empty()) {
        ++n_found;
        continue;
      }
      write_row(store, task, read_row(store, task));
      EXPECT_EQ(without_head(test::bytes_of(store.path(task))), without_head(all)) << at;
    }
  }
  EXPECT_GT(n_found, std::ssize(all) * 7);
}

TEST(Task, AnyOtherByteOfItsFileIsADefect) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "contact-0123456789abcdef.h5"};
  task_writer(store, task, "contact").commit();
  ASSERT_EQ(defect(store, task), "");
  EXPECT_NE(defect(store, {"another text", task.key, task.file}), "");
  const std::string all = test::bytes_of(store.path(task));
  for (std::size_t at = 0; at < all.size(); at += 7) {
    std::string bytes = all;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    test::put_bytes(store.path(task), bytes);
    EXPECT_THAT(defect(store, task), HasSubstr(task.file)) << at;
    test::put_bytes(store.path(task), all.substr(0, at));
    EXPECT_THAT(defect(store, task), HasSubstr(task.file)) << at;
  }
}

TEST(Row, EveryTruncationIsADefect) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  write_row(store, task, row);
  const std::string all = test::bytes_of(store.path(task));
  for (std::size_t size = 0; size + 2 < all.size(); ++size) {
    test::put_bytes(store.path(task), all.substr(0, size));
    EXPECT_FALSE(defect(store, task).empty()) << size;
  }
}

}  // namespace
}  // namespace tabor::study
