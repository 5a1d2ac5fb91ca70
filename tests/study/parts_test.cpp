// A study in parts: together they are the whole, each is done once, and the store says which are
// missing.
#include <algorithm>
#include <set>
#include <thread>

#include "study/example_study.hpp"
#include "tabor/study/sweep.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Parts, AreAScanUnderAPressureEach) {
  const ExampleStudy example;
  const Study study = example.read();
  std::set<std::pair<std::string, double>> seen;
  for (const Study& part : parts_of(study)) {
    ASSERT_EQ(part.n_cases(), 2u);  // densities
    seen.emplace(part.scans.front().label, part.of(part.scans.front()).settings.mean_pressures[0]);
  }
  EXPECT_EQ(seen.size(), 4u);
}

TEST(Parts, AreTheSameStudyAsText) {
  const ExampleStudy example;
  for (const Study& part : parts_of(example.read())) {
    const std::string text = to_toml(part);
    const Study again = parse_study(text, part.file);
    EXPECT_EQ(to_toml(again), text);
    EXPECT_EQ(again.scans.front().file, part.scans.front().file);
    EXPECT_THAT(parts_of(again), SizeIs(1));
  }
}

TEST(Parts, TogetherGiveTheBytesOfTheWhole) {
  const ExampleStudy example;
  example.run({}, "whole");
  const Study study = example.read();
  const std::vector<Study> parts = parts_of(study);
  const Missing missing = missing_parts(study, example.results());
  ASSERT_THAT(missing.parts, ElementsAre(0, 2, 1, 3));  // all scans begin first
  std::size_t n_contacts = 0;
  for (const std::size_t place : missing.parts) {
    n_contacts += run_part(parts[place], example.results()).n_contacts;
  }
  EXPECT_EQ(n_contacts, 4u);
  EXPECT_THAT(missing_parts(study, example.results()).parts, IsEmpty());
  EXPECT_EQ(example.run().n_contacts, 0u);
  EXPECT_EQ(example.csv(), example.csv("whole"));
}

TEST(Parts, AtTheSameTimeShareTheirFilms) {
  const ExampleStudy example;
  example.run({}, "whole");
  const Study study = example.read();
  missing_parts(study, example.results());  // makes the folder
  {
    std::vector<std::jthread> workers;
    for (const Study& part : parts_of(study)) {
      workers.emplace_back([&example, part] { run_part(part, example.results()); });
    }
  }
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_contacts + outcome.n_films + outcome.n_surfaces, 0u);
  EXPECT_EQ(example.csv(), example.csv("whole"));
}

TEST(Parts, ThatAreDamagedAreMissingWithAWarning) {
  const ExampleStudy example;
  example.run();
  for (const auto& file : std::filesystem::directory_iterator(example.results() / "store")) {
    if (!file.path().filename().string().starts_with("contact-")) continue;
    std::filesystem::resize_file(file, file.file_size() - 9);
    break;
  }
  const Missing missing = missing_parts(example.read(), example.results());
  EXPECT_THAT(missing.parts, SizeIs(1));
  EXPECT_THAT(missing.warnings, SizeIs(1));
}

TEST(Parts, ThatFailSayWhy) {
  const ExampleStudy example;
  example.add_scan("scan_1.h5", 1, true);
  const Study study = example.read();
  const PartOutcome outcome = run_part(parts_of(study).front(), example.results());
  ASSERT_THAT(outcome.failures, testing::Not(IsEmpty()));
  EXPECT_THAT(outcome.failures.front(), testing::HasSubstr("scan_1.h5"));
  EXPECT_THAT(missing_parts(study, example.results()).parts, testing::Not(testing::Contains(0u)));
}

}  // namespace
}  // namespace tabor::study
