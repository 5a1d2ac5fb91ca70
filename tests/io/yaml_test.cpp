#include "tabor/io/text/yaml.hpp"

#include <gmock/gmock.h>

#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

std::string rejection(const std::string& text) {
  try {
    parse_yaml(text, "index");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Yaml, ScalarsHaveTheTypesOfTheCoreSchema) {
  const Json value = parse_yaml(
      "a: 1.5\nb: '1.5'\nc: true\nd: ~\ne: [x, \"\\xB5m\"]\nf: 2024-01-01\ng: !!python/tuple [1, "
      "2]\n",
      "index");
  EXPECT_EQ(value["a"], 1.5);
  EXPECT_EQ(value["b"], "1.5");
  EXPECT_EQ(value["c"], true);
  EXPECT_TRUE(value["d"].is_null());
  EXPECT_EQ(value["e"], Json::array({"x", "\xc2\xb5m"}));
  EXPECT_EQ(value["f"], "2024-01-01");
  EXPECT_EQ(value["g"].size(), 2u);
}

TEST(Yaml, AliasesRepeatWhatTheyName) {
  const Json value = parse_yaml("a: &one {n: 1}\nb: *one\n", "index");
  EXPECT_EQ(value["b"]["n"], 1);
}

TEST(Yaml, JsonIsYaml) {
  EXPECT_EQ(parse_yaml("{\"a\": [1, null, \"x\"]}", "index"), parse_json("{\"a\":[1,null,\"x\"]}"));
}

TEST(Yaml, BrokenTextIsRejectedWithItsLine) {
  EXPECT_THAT(rejection("a: 1\nb: [\n"), testing::HasSubstr("index: got text that is no YAML"));
  EXPECT_THAT(rejection("a: *b\n"), testing::HasSubstr("alias 'b' of nothing"));
}

TEST(Yaml, AliasesThatMultiplyAndDeepNestingAreRejected) {
  std::string bomb = "a: &l0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int level = 1; level < 10; ++level) {
    const std::string below = "*l" + std::to_string(level - 1);
    bomb += "b" + std::to_string(level) + ": &l" + std::to_string(level) + " [" + below;
    for (int i = 0; i < 9; ++i) bomb += ", " + below;
    bomb += "]\n";
  }
  EXPECT_THAT(rejection(bomb), testing::HasSubstr("more than 1000000 values"));
  std::string long_text = "- &t '" + std::string(1 << 20, 'x') + "'\n";
  for (int i = 0; i < 100; ++i) long_text += "- *t\n";
  EXPECT_THAT(rejection(long_text), testing::HasSubstr("more than 1000000 values"));
  std::string nested;
  for (int i = 0; i < 90; ++i) nested += "&a" + std::to_string(i) + " [";
  for (int i = 0; i < 20000; ++i) nested += "1,";
  EXPECT_THAT(rejection(nested + "1" + std::string(90, ']')),
              testing::HasSubstr("more than 1000000 values"));
  EXPECT_THAT(rejection(std::string(200, '[') + std::string(200, ']')),
              testing::HasSubstr("nested more than 100 deep"));
}

}  // namespace
}  // namespace tabor::io
