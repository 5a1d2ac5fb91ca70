#include "tabor/io/text/json.hpp"

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

TEST(Json, ReadsBackWhatItWrites) {
  const std::string text =
      R"({"a":[1,-2,18446744073709551615,-9223372036854775808,0.1,1.0],"b":{"c":null},"d":"é\"\n","e":[],"f":{}})";
  EXPECT_EQ(to_text(parse_json(text), -1), text);
  EXPECT_EQ(to_text(parse_json(R"({"a": 1, "b": 2, "a": 3})"), -1), R"({"a":3,"b":2})");
  EXPECT_EQ(to_text(Json(std::vector<double>{0.1, -0.0, 1e300, std::nan("")}), -1),
            "[0.1,-0.0,1e+300,null]");
}

TEST(ParseJson, RejectsWhatIsNotJson) {
  for (const char* text : {"", "{", "[1,]", "nul", "{\"a\" 1}", "1 2", "\"\xff\""}) {
    EXPECT_THROW(parse_json(text), InputError) << text;
  }
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

TEST(ReadJson, RejectsDeepNesting) {
  const test::Folder folder;
  const std::string deep(200000, '[');
  test::put_bytes(folder / "open.json", deep);
  EXPECT_THROW(read_json(folder / "open.json"), InputError);
  test::put_bytes(folder / "closed.json", deep + std::string(deep.size(), ']'));
  EXPECT_THROW(read_json(folder / "closed.json"), InputError);
  const std::string shallow(500, '[');
  test::put_bytes(folder / "shallow.json", shallow + std::string(shallow.size(), ']'));
  EXPECT_NO_THROW(read_json(folder / "shallow.json"));
}

TEST(ReadJson, RejectsANumberBeyondTheRangeOfDoubles) {
  const test::Folder folder;
  test::put_bytes(folder / "large.json", R"({"x": 1e400})");
  EXPECT_THROW(read_json(folder / "large.json"), InputError);
}

}  // namespace
}  // namespace tabor::io
