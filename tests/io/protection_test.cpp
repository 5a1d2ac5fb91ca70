// A library leaves the process it is linked into as it is, until the program asks for protection.
#include "tabor/io/files/protection.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>

#include <filesystem>
#include <map>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/mapped_file.hpp"
#include "tabor/io/hdf5/guard.hpp"

namespace tabor::io {
namespace {

int n_forks = 0;

void count_forks() {
  static const bool is_counting = ::pthread_atfork([] { ++n_forks; }, nullptr, nullptr) == 0;
  ASSERT_TRUE(is_counting);
  n_forks = 0;
}

/// What each signal of this process does now.
std::map<int, void (*)(int)> signal_handlers() {
  std::map<int, void (*)(int)> handlers;
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction now {};
    if (::sigaction(signal, nullptr, &now) == 0) handlers[signal] = now.sa_handler;
  }
  return handlers;
}

/// Reads a map in every guarded way.
void read_map(const std::filesystem::path& file) {
  {
    Hdf5Writer writer(file);
    writer.write("/map", Field(Field::Constant(3, 2, 1.5)));
    writer.commit();
  }
  const auto n_rows = [](const Hdf5Reader& reader) { return reader.map_shape("/map")[0]; };
  EXPECT_EQ(read_guarded(file, n_rows), 3);
  EXPECT_TRUE((read_guarded_map(file, "/map") == 1.5).all());
  EXPECT_EQ(MappedFile(file).bytes().substr(1, 3), "HDF");
}

TEST(Protection, IsOffUntilTheProgramAsksForIt) {
  EXPECT_FALSE(hdf5_reading_is_isolated());
  EXPECT_FALSE(lost_pages_are_trapped());
}

TEST(Protection, WithoutItReadingNeitherForksNorChangesAnySignalHandler) {
  count_forks();
  const auto before = signal_handlers();
  const test::Folder folder;
  read_map(folder / "a.h5");
  EXPECT_EQ(n_forks, 0);
  EXPECT_EQ(signal_handlers(), before);
}

TEST(Protection, IsolationReadsInCopies) {
  count_forks();
  const test::Folder folder;
  isolate_hdf5_reading(true);
  read_map(folder / "a.h5");
  isolate_hdf5_reading(false);
  EXPECT_EQ(n_forks, 3);  // of numbers, of the map's shape, of the map
}

TEST(Protection, TheTrapIsOneHandlerThatCanBeTakenAwayAgain) {
  const auto before = signal_handlers();
  trap_lost_pages(true);
  EXPECT_TRUE(lost_pages_are_trapped());
  auto trapped = signal_handlers();
  EXPECT_NE(trapped[SIGBUS], before.at(SIGBUS));
  trapped[SIGBUS] = before.at(SIGBUS);
  EXPECT_EQ(trapped, before);
  trap_lost_pages(false);
  EXPECT_EQ(signal_handlers(), before);
}

TEST(Protection, AMapOfAnotherSizeThanItsFileSaidIsDamagedWithoutACopyToo) {
  const auto received = [](Index n_rows) {
    const SendRows send = [n_rows](const auto& accept) { accept(Field::Zero(n_rows, 2)); };
    return guarded_hdf5_map("a.h5", {3, 2}, send, {}).has_value();
  };
  EXPECT_TRUE(received(3));
  EXPECT_FALSE(received(2));
  EXPECT_FALSE(received(4));
}

TEST(ProtectionDeathTest, WithoutTheTrapAPageThatVanishesEndsTheProcess) {
  const test::Folder folder;
  test::put_bytes(folder / "a", std::string(std::size_t{1} << 20, '\1'));
  const MappedFile file(folder / "a");
  std::filesystem::resize_file(folder / "a", 0);
  EXPECT_DEATH(
      {
        const volatile char touched = file.bytes().front();
        static_cast<void>(touched);
      },
      "");
}

}  // namespace
}  // namespace tabor::io
