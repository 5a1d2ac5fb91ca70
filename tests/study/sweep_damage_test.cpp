#include <cmath>
#include <fstream>
#include <random>

#include "study/example_study.hpp"
#include "tabor/study/sweep.hpp"

// What a sweep does about damaged stores and disks that are full.
namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::filesystem::path> stored(const ExampleStudy& example, const std::string& kind) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(example.results() / "store")) {
    if (entry.path().filename().string().starts_with(kind)) files.push_back(entry.path());
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
    for (std::size_t i = at; i < at + 8; ++i) bytes[i] = static_cast<char>(~bytes[i]);
    test::put_bytes(file, bytes);
  }
  for (const auto& file : stored(example, "case-")) std::filesystem::remove(file);
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_failed, 0u);
  EXPECT_EQ(example.csv(), csv);
}

TEST(DamagedStore, ABitThatTurnedOverAnywhereChangesNoTable) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  std::mt19937 random(7);
  int n_found = 0;
  for (const std::string kind : {"surface-", "contact-", "film-", "case-"}) {
    for (int i = 0; i < 12; ++i) {
      const auto files = stored(example, kind);
      const auto& file = files[random() % files.size()];
      std::string bytes = test::bytes_of(file);
      const std::size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
      test::put_bytes(file, bytes);
      // With a row gone, the files below it are read again.
      const auto rows = stored(example, "case-");
      std::filesystem::remove(rows[random() % rows.size()]);
      const Outcome outcome = example.run();
      n_found += outcome.warnings.empty() ? 0 : 1;
      EXPECT_EQ(outcome.n_failed, 0u);
      EXPECT_EQ(example.csv(), csv) << file << " byte " << at;
    }
  }
  EXPECT_GT(n_found, 36);
}

TEST(DamagedStore, ADigitThatChangedInAScalarIsFoundAndNamed) {
  const ExampleStudy example;
  example.run();
  const std::string csv = example.csv();
  for (const auto& file : stored(example, "case-")) {
    const std::string bytes = test::bytes_of(file);
    const auto at = bytes.find("\"friction_dry\": 0.") + 19;
    std::string other = bytes;
    other[at] = other[at] == '1' ? '2' : '1';
    test::put_bytes(file, other);
    const Outcome outcome = example.run();
    ASSERT_EQ(outcome.warnings.size(), 1u);
    EXPECT_THAT(outcome.warnings[0], HasSubstr(file.filename().string()));
    EXPECT_EQ(example.csv(), csv);
  }
}

TEST(ReplacedScan, StopsTheSweepAndIsNeverStoredAsTheOneBefore) {
  const ExampleStudy example;
  const std::string one = test::bytes_of(example.folder / "scan_1.h5");
  const std::string other = test::bytes_of(example.folder / "scan_2.h5");
  example.run({}, "whole");
  for (const bool in_place : {true, false}) {
    SweepOptions options;
    bool is_replaced = false;
    options.jobs = 1;
    options.observer = [&](const Progress& progress) {
      if (is_replaced || progress.stage.starts_with("hash ")) return true;  // no digest of all yet
      is_replaced = true;
      if (in_place) {
        std::ofstream(example.folder / "scan_2.h5", std::ios::binary) << one;
      } else {
        test::put_bytes(example.folder / "scan_2.h5", one);
      }
      return true;
    };
    const std::string name = in_place ? "in_place" : "anew";
    try {
      example.run(options, name);
      ADD_FAILURE() << "the sweep went on";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("scan_2.h5"), HasSubstr("replaced or changed")));
    }
    test::put_bytes(example.folder / "scan_2.h5", other);
    EXPECT_EQ(example.run({}, name).n_failed, 0u);
    EXPECT_EQ(example.csv(name), example.csv("whole"));
  }
}

TEST(ReplacedScan, GoneIsNotAFailureOfItsCases) {
  const ExampleStudy example;
  SweepOptions options;
  options.observer = [&](const Progress&) {
    std::filesystem::remove(example.folder / "scan_2.h5");
    return true;
  };
  EXPECT_THROW(example.run(options), Error);
  for (const auto& file : stored(example, "case-")) {
    EXPECT_THAT(test::bytes_of(file), HasSubstr("\"error\": \"\""));
  }
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
