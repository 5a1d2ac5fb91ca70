#include "tabor/core/names.hpp"

#include <gtest/gtest.h>

#include "support/rejection.hpp"

namespace tabor {
namespace {

enum class Season { spring, summer, autumn };
constexpr auto kSeasons = names<Season>("spring", "summer", "autumn");

TEST(Names, StandInTheOrderOfTheEnumerators) {
  EXPECT_EQ(kSeasons.of(Season::autumn), "autumn");
  EXPECT_EQ(kSeasons.find("summer"), Season::summer);
  EXPECT_EQ(kSeasons.parse("spring", "season"), Season::spring);
}

TEST(Names, UnknownOnesAreNotFound) {
  EXPECT_EQ(kSeasons.find("Summer"), std::nullopt);
  EXPECT_EQ(kSeasons.find(""), std::nullopt);
}

TEST(Names, ARejectionNamesAllAndTheNearest) {
  const std::string text = test::rejection([] { kSeasons.parse("sumer", "season"); });
  EXPECT_NE(text.find("season"), std::string::npos) << text;
  EXPECT_NE(text.find("spring, summer, autumn"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean 'summer'"), std::string::npos) << text;
}

}  // namespace
}  // namespace tabor
