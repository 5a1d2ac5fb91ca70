#include "tabor/io/text/toml.hpp"

#include <gmock/gmock.h>

#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kText = R"(title = "test"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
bare = 70e9
[sweep]
mean_pressure = ["2 MPa", "5 MPa"]
mixed = ["2 MPa", 5]
seed = 3
on = true
[[scan]]
file = "a.x3p"
[[scan]]
file = ["b.x3p", "c.x3p"]
)";

Config config() { return Config::parse(kText, "study.toml"); }

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Config, GivesValuesInSi) {
  EXPECT_EQ(config().text("title"), "test");
  EXPECT_EQ(config().quantity("material.youngs_modulus", dimension::pressure), 70e9);
  EXPECT_EQ(config().number("material.poissons_ratio"), 0.33);
  EXPECT_THAT(config().quantities("sweep.mean_pressure", dimension::pressure),
              ElementsAre(2e6, 5e6));
  EXPECT_EQ(config().integer("sweep.seed"), 3);
  EXPECT_TRUE(config().flag("sweep.on"));
  EXPECT_FALSE(config().has("material.hardness"));
}

TEST(Config, WalksThroughArraysOfTables) {
  const std::vector<Config> scans = config().tables("scan");
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_THAT(scans[0].texts("file"), ElementsAre("a.x3p"));
  EXPECT_THAT(scans[1].texts("file"), ElementsAre("b.x3p", "c.x3p"));
  EXPECT_TRUE(config().tables("absent").empty());
}

TEST(Config, RejectsANumberWithoutItsUnitAndShowsTheCorrectedForm) {
  const auto bare = [] { config().quantity("material.bare", dimension::pressure); };
  EXPECT_THAT(message_of(bare), HasSubstr("study.toml:5: material.bare"));
  EXPECT_THAT(message_of(bare), HasSubstr("MPa\""));
  const auto mixed = [] { config().quantities("sweep.mixed", dimension::pressure); };
  EXPECT_THAT(message_of(mixed), HasSubstr("sweep.mixed: got 5 without a unit"));
  const auto length = [] { config().quantity("material.youngs_modulus", dimension::length); };
  EXPECT_THAT(message_of(length), HasSubstr("material.youngs_modulus"));
}

TEST(Config, NamesTheKindOfAWrongValue) {
  EXPECT_THAT(message_of([] { config().text("sweep.seed"); }),
              HasSubstr("study.toml:9: sweep.seed: got the number 3; expected text"));
  EXPECT_THAT(message_of([] { config().number("sweep.on"); }), HasSubstr("got true"));
  EXPECT_THAT(message_of([] { config().integer("material.poissons_ratio"); }),
              HasSubstr("a whole number in digits alone"));
  EXPECT_THAT(message_of([] { config().integer("title"); }), EndsWith("expected a whole number"));
  EXPECT_THAT(message_of([] { config().flag("title"); }), HasSubstr("true or false"));
  EXPECT_THAT(message_of([] { config().tables("material"); }), HasSubstr("[[material]]"));
  EXPECT_THAT(message_of([] { config().text("material.hardness"); }),
              HasSubstr("material.hardness is missing"));
}

TEST(Config, NamesTheLineOfAnUnknownKeyAndItsNearestMatch) {
  const std::vector<std::string> known{"title",
                                       "material.youngs_modulus",
                                       "material.poissons_ratio",
                                       "material.bare",
                                       "sweep.mixed",
                                       "sweep.mean_pressure",
                                       "sweep.seed",
                                       "sweep.on",
                                       "scan[].file"};
  EXPECT_NO_THROW(config().reject_unknown(known));
  const Config misspelt =
      Config::parse("title = 'a'\n[material]\nyoung_modulus = '1 Pa'\n", "study.toml");
  EXPECT_THAT(message_of([&] { misspelt.reject_unknown(known); }),
              HasSubstr("study.toml:3: unknown key 'material.young_modulus'; did you mean "
                        "'material.youngs_modulus'?"));
  const Config of_table = Config::parse("material = 'steel'\n[sweep]\non = 1\n", "study.toml");
  EXPECT_THAT(message_of([&] { of_table.reject_unknown(known); }),
              HasSubstr("study.toml:1: unknown key 'material'; did you mean 'material."));
  const Config in_array = Config::parse("[[scan]]\nfiel = 'a'\n", "study.toml");
  EXPECT_THAT(message_of([&] { in_array.reject_unknown(known); }),
              HasSubstr("study.toml:2: unknown key 'scan[].fiel'; did you mean 'scan[].file'?"));
}

TEST(Config, NamesTheLineOfASyntaxError) {
  EXPECT_THAT(message_of([] { Config::parse("a = 1\nb = = 2\n", "study.toml"); }),
              HasSubstr("study.toml:2:"));
  EXPECT_THAT(message_of([] { Config::parse("a = 1\na = 2\n", "study.toml"); }),
              HasSubstr("study.toml:2:"));
}

TEST(Config, TakesNewValuesWithoutChangingTheOld) {
  const Config old = config();
  const Config changed =
      old.with("sweep.seed", "5").with("material.youngs_modulus", "1 GPa").with("new.table", "1.5");
  EXPECT_EQ(old.integer("sweep.seed"), 3);
  EXPECT_EQ(changed.integer("sweep.seed"), 5);
  EXPECT_EQ(changed.quantity("material.youngs_modulus", dimension::pressure), 1e9);
  EXPECT_EQ(changed.number("new.table"), 1.5);
  EXPECT_THROW(old.with("title.part", "1"), InputError);
  EXPECT_THAT(message_of([] {
                Config::parse("[[scan]]\nfile = \"a\"\n", "s.toml").with("scan.file", "b");
              }),
              HasSubstr("'scan' is a list of tables"));
}

TEST(Config, TextReadsBackToTheSameValues) {
  const Config again = Config::parse(config().to_text(), "again.toml");
  EXPECT_EQ(again.quantity("material.youngs_modulus", dimension::pressure), 70e9);
  EXPECT_EQ(again.tables("scan").size(), 2u);
}

std::string repeated(const std::string& part, int n) {
  std::string text;
  for (int i = 0; i < n; ++i) text += part;
  return text;
}

TEST(Config, DeepNestingIsRejected) {
  constexpr int kDepth = 200000;
  for (const std::string& text :
       {"[" + repeated("a.", kDepth) + "a]\n", repeated("a.", kDepth) + "a = 1\n",
        "k = {" + repeated("'a' . ", kDepth) + "a = 1}\n",
        "k = " + repeated("[", kDepth) + repeated("]", kDepth) + "\n",
        "k = " + repeated("{a=", kDepth) + "1" + repeated("}", kDepth) + "\n"}) {
    EXPECT_THROW(Config::parse(text, "study.toml"), InputError) << text.substr(0, 20);
  }
}

TEST(Config, LongLinesAreRejectedNamingTheLine) {
  try {
    Config::parse("a = 1\n# " + repeated(".", 20000) + "\n", "study.toml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("study.toml:2: got a line of 20002 bytes"));
  }
}

TEST(Config, TheLongestKeyIsHandled) {
  const std::string parts = repeated("a.", 8000);
  EXPECT_TRUE(Config::parse("[" + parts + "b]\n" + parts + "c = 1\n", "study.toml").has("a"));
}

}  // namespace
}  // namespace tabor::io
