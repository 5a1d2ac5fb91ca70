#include <cmath>

#include "study/example_study.hpp"
#include "tabor/study/sweep.hpp"

// What a sweep does about damaged stores and disks that are full.
namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::HasSubstr;

std::vector<std::filesystem::path> stored(const ExampleStudy& example, const std::string& kind) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(example.results() / "store")) {
    if (entry.path().filename().string().starts_with(kind)) {
      files.push_back(entry.path());
    }
  }
  return files;
}

TEST(DamagedStore, CutFilesAreNamedAndComputedAgain) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  for (const std::string kind : {"surface-", "contact-", "film-", "case-"}) {
    const auto files = stored(example, kind);
    ASSERT_FALSE(files.empty()) << kind;
    const std::string bytes = test::bytes_of(files.front());
    for (const std::size_t size : {std::size_t{0}, bytes.size() / 3, bytes.size() - 3}) {
      test::put_bytes(files.front(), bytes.substr(0, size));
      const Outcome outcome = example.run();
      ASSERT_EQ(outcome.warnings.size(), 1u) << kind << size;
      EXPECT_THAT(outcome.warnings[0], HasSubstr(files.front().filename().string()));
      EXPECT_EQ(outcome.n_failed, 0u);
      EXPECT_EQ(example.csv(), csv) << kind << size;
      EXPECT_TRUE(example.run().warnings.empty()) << kind << size;
    }
  }
}

TEST(DamagedStore, DamageInsideAMapIsFoundBeforeItIsUsed) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  for (const auto& file : stored(example, "contact-")) {
    std::string bytes = test::bytes_of(file);
    // The compressed gap is the largest piece of the file: break its middle.
    const std::size_t at = bytes.size() * 2 / 3;
    for (std::size_t i = at; i < at + 8; ++i) {
      bytes[i] = static_cast<char>(~bytes[i]);
    }
    test::put_bytes(file, bytes);
  }
  for (const auto& file : stored(example, "case-")) {
    std::filesystem::remove(file);
  }
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_failed, 0u);
  EXPECT_EQ(example.csv(), csv);
}

TEST(DamagedStore, DeletedFilesAreComputedAgain) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  for (const std::string kind : {"surface-", "contact-", "film-", "case-"}) {
    std::filesystem::remove(stored(example, kind).front());
    const Outcome outcome = example.run();
    EXPECT_EQ(outcome.n_surfaces + outcome.n_contacts + outcome.n_films + (kind == "case-"), 1u);
    EXPECT_EQ(example.csv(), csv) << kind;
  }
}

TEST(FullDisk, EndsTheSweepWithAnOutputErrorAndLosesNothingFinished) {
  const ExampleStudy example;
  example.run({}, "whole");
  for (const rlim_t size : {0, 700, 6000, 12000}) {
    const test::FullDisk full(size);
    EXPECT_THROW(example.run(), OutputError) << size;
  }
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_done, 8u);
  EXPECT_TRUE(outcome.warnings.empty());
  EXPECT_EQ(example.csv(), example.csv("whole"));
}

TEST(FullDisk, UnusableResultFolderIsAnOutputError) {
  const ExampleStudy example;
  EXPECT_THROW(run(example.read(), example.folder / "scan_1.h5" / "out"), OutputError);
}

}  // namespace
}  // namespace tabor::study
