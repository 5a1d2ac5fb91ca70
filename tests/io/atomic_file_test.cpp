#include "tabor/io/files/atomic_file.hpp"

#include <sys/stat.h>

#include <vector>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

using test::Folder;

TEST(TemporaryFile, AppearsUnderItsNameOnlyWhenCommitted) {
  const Folder folder;
  TemporaryFile file(folder / "out.txt");
  test::put_bytes(file.path(), "all of it");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.txt"));
  EXPECT_TRUE(is_temporary_name(file.path()));
  file.commit();
  EXPECT_EQ(test::bytes_of(folder / "out.txt"), "all of it");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(TemporaryFile, LeavesNothingWhenDiscarded) {
  const Folder folder;
  { const TemporaryFile file(folder / "out.txt"); }
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(RemoveLeftovers, TakesThoseOfDeadProgramsOfThisFileOnly) {
  const Folder folder;
  const TemporaryFile living(folder / "out.h5");
  test::put_bytes(folder / ".out.h5.4194305-0.tabor-tmp", "half");
  test::put_bytes(folder / ".out.h5.4194305-11.tabor-tmp", "half");
  const std::vector<std::string> kept = {".out.h5.mine-0.tabor-tmp", ".out.h5.tabor-tmp",
                                         ".out.4194305-0.tabor-tmp", ".out.h5.4194305-0.txt",
                                         "out.h5.4194305-0.tabor-tmp"};
  for (const std::string& name : kept) test::put_bytes(folder / name, "not of out.h5");
  remove_leftovers(folder / "out.h5");
  for (const std::string& name : kept) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  EXPECT_TRUE(std::filesystem::exists(living.path()));
  EXPECT_EQ(folder.n_files(), kept.size() + 1);
}

TEST(RemoveLeftovers, LooksBehindALink) {
  const Folder folder;
  std::filesystem::create_directory(folder / "far");
  std::filesystem::create_symlink("far/real", folder / "link");
  test::put_bytes(folder / "far/.real.4194305-0.tabor-tmp", "half");
  remove_leftovers(folder / "link");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "far"));
}

TEST(WriteFile, ReplacesTheOldContent) {
  const Folder folder;
  write_file(folder / "a", "a long first version");
  write_file(folder / "a", "second");
  EXPECT_EQ(read_text(folder / "a"), "second");
}

TEST(WriteFile, KeepsTheOldContentWhenTheDiskIsFull) {
  const Folder folder;
  write_file(folder / "a", "first");
  {
    const test::FullDisk full(100);
    EXPECT_THROW(write_file(folder / "a", std::string(1000, 'x')), OutputError);
  }
  EXPECT_EQ(read_text(folder / "a"), "first");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(WriteFile, NamesTheFileInAFolderThatDoesNotExist) {
  const Folder folder;
  try {
    write_file(folder / "no" / "a.txt", "x");
    FAIL() << "wrote into a folder that does not exist";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("a.txt"), std::string::npos) << error.what();
  }
}

TEST(WriteFile, RejectsAFolderAsItsName) {
  const Folder folder;
  EXPECT_THROW(write_file(folder.path(), "x"), OutputError);
}

TEST(WriteFile, FollowsLinksAndLeavesThem) {
  const Folder folder;
  std::filesystem::create_directory(folder / "far");
  write_file(folder / "far/real", "first");
  std::filesystem::create_symlink("far/middle", folder / "link");
  std::filesystem::create_symlink("real", folder / "far/middle");
  write_file(folder / "link", "second");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "far/middle"));
  EXPECT_EQ(read_text(folder / "far/real"), "second");
}

TEST(WriteFile, MakesTheFileALinkPromises) {
  const Folder folder;
  std::filesystem::create_symlink("later", folder / "link");
  write_file(folder / "link", "x");
  EXPECT_EQ(read_text(folder / "later"), "x");
}

TEST(WriteFile, KeepsThePermissionsOfWhatItReplaces) {
  using std::filesystem::perms;
  const Folder folder;
  write_file(folder / "a", "first");
  const perms mode = perms::owner_read | perms::owner_write | perms::group_read;
  std::filesystem::permissions(folder / "a", mode);
  write_file(folder / "a", "second");
  EXPECT_EQ(std::filesystem::status(folder / "a").permissions(), mode);
}

TEST(WriteFile, RejectsWhatIsNoFileAndLeavesIt) {
  const Folder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(write_file(pipe, "x"), OutputError);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_THROW(write_file("/dev/null", "x"), OutputError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFile, RejectsLinksInACircle) {
  const Folder folder;
  std::filesystem::create_symlink("b", folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  EXPECT_THROW(write_file(folder / "a", "x"), OutputError);
}

TEST(WriteFile, RejectsAnUnwritableFolder) {
  if (::geteuid() == 0) {
    GTEST_SKIP() << "root may write anywhere";
  }
  const Folder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
  EXPECT_THROW(write_file(folder / "a", "x"), OutputError);
}

TEST(MakeFolder, RejectsANameThatIsAFile) {
  const Folder folder;
  write_file(folder / "a", "x");
  EXPECT_THROW(make_folder(folder / "a"), OutputError);
  EXPECT_THROW(make_folder(folder / "a/b"), OutputError);
}

TEST(ReadText, RejectsWhatIsAbsentAFolderOrTooLarge) {
  const Folder folder;
  write_file(folder / "a", "0123456789");
  EXPECT_EQ(read_text(folder / "a", 10), "0123456789");
  EXPECT_THROW(read_text(folder / "a", 9), InputError);
  EXPECT_THROW(read_text(folder / "b"), InputError);
  EXPECT_THROW(read_text(folder.path()), InputError);
}

}  // namespace
}  // namespace tabor::io
