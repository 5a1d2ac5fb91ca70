#include "tabor/io/files/mapped_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/protection.hpp"

namespace tabor::io {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::size_t kSize = std::size_t{1} << 20;

void expect_changed(const MappedFile& file) {
  try {
    file.check();
    FAIL() << "did not notice";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("changed while it was read"));
  }
}

std::ptrdiff_t n_ones(const MappedFile& file) {
  return std::count(file.bytes().begin(), file.bytes().end(), '\1');
}

class LostPages : public ::testing::Test {
 protected:
  LostPages() { trap_lost_pages(true); }
  ~LostPages() override { trap_lost_pages(false); }
};

TEST(MappedFile, HoldsTheBytesOfTheFile) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  const MappedFile file(folder / "a");
  EXPECT_EQ(n_ones(file), std::ptrdiff_t{kSize});
  EXPECT_NO_THROW(file.check());
}

TEST_F(LostPages, AreReadAsZerosAndNoticed) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  test::put_bytes(folder / "b", std::string(kSize, '\1'));
  const MappedFile cut(folder / "a");
  const MappedFile whole(folder / "b");
  fs::resize_file(folder / "a", kSize / 2);
  EXPECT_EQ(n_ones(cut), std::ptrdiff_t{kSize / 2});
  expect_changed(cut);
  EXPECT_EQ(n_ones(whole), std::ptrdiff_t{kSize});
  EXPECT_NO_THROW(whole.check());
}

TEST_F(LostPages, AreNoticedUnderSeveralThreads) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  const MappedFile file(folder / "a");
  fs::resize_file(folder / "a", kSize / 2);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] { EXPECT_EQ(n_ones(file), std::ptrdiff_t{kSize / 2}); });
  }
  for (std::thread& thread : threads) thread.join();
  expect_changed(file);
}

TEST(MappedFile, WrittenAnewIsNoticed) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  const MappedFile file(folder / "a");
  std::ofstream(folder / "a") << std::string(kSize, '\2');  // the same file: not removed before
  // Clocks of file systems are coarse.
  fs::last_write_time(folder / "a", fs::last_write_time(folder / "a") + std::chrono::seconds(1));
  expect_changed(file);
}

TEST(MappedFile, ReplacedByAnotherFileStaysAsItWas) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  test::put_bytes(folder / "b", std::string(kSize, '\2'));
  const MappedFile file(folder / "a");
  fs::rename(folder / "b", folder / "a");
  EXPECT_EQ(n_ones(file), std::ptrdiff_t{kSize});
  EXPECT_NO_THROW(file.check());
  EXPECT_THROW(file.check_name(), InputError);
}

TEST(MappedFile, IsStillWhatItsNameLeadsTo) {
  const test::Folder folder;
  test::put_bytes(folder / "a", "bytes");
  fs::create_symlink("a", folder / "link");
  const MappedFile file(folder / "link");
  EXPECT_NO_THROW(file.check_name());
  fs::remove(folder / "a");
  EXPECT_THROW(file.check_name(), InputError);
}

/// Whoever wants to end at a bus error of his own still does.
TEST_F(LostPages, LeaveOtherBusErrorsToTheHandlerBefore) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(kSize, '\1'));
  EXPECT_DEATH(
      {
        const MappedFile file(folder / "a");
        ::raise(SIGBUS);
      },
      "");
}

}  // namespace
}  // namespace tabor::io
