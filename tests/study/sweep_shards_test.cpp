#include <thread>

#include "study/example_study.hpp"
#include "tabor/engine/plan.hpp"
#include "tabor/study/sweep.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using test::message_of;
using testing::HasSubstr;

SweepOptions shard(int index, int count) {
  SweepOptions options;
  options.shard = engine::Shard{index, count};
  return options;
}

TEST(ParseShard, TakesPartsOfAWhole) {
  EXPECT_EQ(engine::parse_shard("2/8").index, 2);
  EXPECT_EQ(engine::parse_shard("2/8").count, 8);
  for (const char* bad : {"0/8", "9/8", "1/0", "2", "a/b", "1/2/3", "1.5/2", "-1/2", ""}) {
    EXPECT_THROW(engine::parse_shard(bad), InputError) << bad;
  }
}

TEST(Shards, TogetherAreTheWholeByteForByte) {
  const ExampleStudy example;
  example.run({}, "whole");
  for (const int count : {2, 3, 7}) {
    const std::string name = "shards" + std::to_string(count);
    std::size_t n_contacts = 0;
    for (int index = count; index >= 1; --index) {
      n_contacts += example.run(shard(index, count), name).n_contacts;
    }
    EXPECT_EQ(n_contacts, 4u) << count;  // none twice, none left out
    EXPECT_EQ(example.csv(name), example.csv("whole")) << count;
    EXPECT_EQ(test::bytes_of(example.results(name) / "averages.csv"),
              test::bytes_of(example.results("whole") / "averages.csv"));
  }
}

TEST(Shards, AtTheSameTimeGiveTheSameBytesAndShareTheirFilms) {
  const ExampleStudy example;
  example.run({}, "whole");
  Outcome first;
  Outcome second;
  std::thread other([&] { second = example.run(shard(2, 2)); });
  first = example.run(shard(1, 2));
  other.join();
  EXPECT_EQ(first.n_contacts + second.n_contacts, 4u);
  EXPECT_EQ(first.n_films + second.n_films, 2u);
  EXPECT_EQ(example.csv(), example.csv("whole"));
}

TEST(TwoSweeps, OnOneStoreAreRejectedInOneLine) {
  const ExampleStudy example;
  std::string message;
  SweepOptions options;
  options.observer = [&](const Progress&) {
    if (message.empty()) message = message_of([&] { example.run(); });
    return true;
  };
  example.run(options);
  EXPECT_THAT(message, HasSubstr("another sweep works on these results"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace tabor::study
