#include "tabor/io/files/file_lock.hpp"

#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

using Kind = FileLock::Kind;

class FileLocks : public testing::Test {
 protected:
  bool can_take(Kind kind) const { return FileLock::take(file_, kind).has_value(); }

  test::Folder folder_;
  std::filesystem::path file_ = folder_ / "lock";
};

TEST_F(FileLocks, ExcludeOthersUntilTheyEnd) {
  {
    const auto alone = FileLock::take(file_, Kind::alone);
    ASSERT_TRUE(alone);
    EXPECT_FALSE(can_take(Kind::alone));
    EXPECT_FALSE(can_take(Kind::shared));
  }
  EXPECT_TRUE(can_take(Kind::alone));
}

TEST_F(FileLocks, AreSharedByThoseThatShare) {
  const auto first = FileLock::take(file_, Kind::shared);
  const auto second = FileLock::take(file_, Kind::shared);
  EXPECT_TRUE(first && second);
  EXPECT_FALSE(can_take(Kind::alone));
}

TEST_F(FileLocks, AreOnTheFileThatIsThere) {
  const auto first = FileLock::take(file_, Kind::alone);
  std::filesystem::remove(file_);
  const auto second = FileLock::take(file_, Kind::alone);
  EXPECT_TRUE(second);
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_FALSE(can_take(Kind::alone));
}

TEST_F(FileLocks, AreRejectedInTheWordsOfWhoAsks) {
  const auto file = folder_ / "new" / "lock";
  const FileLock first = FileLock::take_or_reject(file, Kind::alone, "in use");
  EXPECT_THROW(FileLock::take_or_reject(file, Kind::alone, "in use"), InputError);
}

TEST_F(FileLocks, NeedAFolderThatCanBeWritten) {
  EXPECT_THROW(FileLock::take(folder_ / "absent" / "lock", Kind::alone), OutputError);
}

}  // namespace
}  // namespace tabor::io
