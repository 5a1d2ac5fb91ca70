#include "tabor/io/json.hpp"

#include <cmath>
#include <limits>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

TEST(Json, HasNoNumberForNanAndInfinity) {
  EXPECT_TRUE(number(std::nan("")).is_null());
  EXPECT_TRUE(number(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_EQ(number(0.1).get<double>(), 0.1);
}

TEST(Json, KeepsTheOrderOfKeysAndReplacesBytesThatAreNotUtf8) {
  Json json;
  json["z"] = 1;
  json["a"] = "\xff";
  EXPECT_EQ(to_text(json, -1), "{\"z\":1,\"a\":\"\xEF\xBF\xBD\"}");
}

TEST(ReadJson, SaysWhereTheMistakeIs) {
  const test::Folder folder;
  test::put_bytes(folder / "a.json", "{\"a\": }");
  try {
    read_json(folder / "a.json");
    FAIL() << "accepted what is not JSON";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("byte 7"), std::string::npos) << error.what();
  }
}

TEST(ReadJson, SurvivesDeepNesting) {
  const test::Folder folder;
  const std::string deep(200000, '[');
  test::put_bytes(folder / "open.json", deep);
  EXPECT_THROW(read_json(folder / "open.json"), InputError);
  test::put_bytes(folder / "closed.json", deep + std::string(deep.size(), ']'));
  EXPECT_NO_THROW(read_json(folder / "closed.json"));
}

TEST(ReadJson, RefusesANumberBeyondTheRangeOfDoubles) {
  const test::Folder folder;
  test::put_bytes(folder / "large.json", R"({"x": 1e400})");
  EXPECT_THROW(read_json(folder / "large.json"), InputError);
}

}  // namespace
}  // namespace tabor::io
