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

TEST(Json, IsMadeFromBracesAsWritten) {
  EXPECT_EQ(to_text(Json{{"a", 1}, {"b", {2, 3}}}, -1), R"({"a":1,"b":[2,3]})");
  EXPECT_EQ(to_text(Json{"a", "b"}, -1), R"(["a","b"])");
  EXPECT_EQ(to_text(Json::array({{"a", 1}}), -1), R"([["a",1]])");
  EXPECT_EQ(to_text(Json(std::vector<double>{0.1, -0.0, 1e300, std::nan("")}), -1),
            "[0.1,-0.0,1e+300,null]");
  EXPECT_EQ(to_text(Json(std::map<std::string, bool>{{"x", true}}), -1), R"({"x":true})");
  EXPECT_THROW(Json::object({"a"}), Json::exception);
}

TEST(Json, ReadsBackWhatItWrites) {
  const std::string text =
      R"({"a":[1,-2,18446744073709551615,-9223372036854775808,0.1,1.0],"b":{"c":null},"d":"é\"\n","e":[],"f":{}})";
  EXPECT_EQ(to_text(Json::parse(text), -1), text);
  EXPECT_EQ(to_text(Json::parse(R"({"a": 1, "b": 2, "a": 3})"), -1), R"({"a":3,"b":2})");
}

TEST(Json, ComparesNumbersByValue) {
  EXPECT_EQ(Json(3), Json(3U));
  EXPECT_EQ(Json(3), Json(3.0));
  EXPECT_NE(Json(-1), Json(std::uint64_t(-1)));
  EXPECT_NE(Json(1), Json(true));
  EXPECT_LT(Json(2), Json(2.5));
}

TEST(Json, UpdatesMembersInTheirPlaceAndAppendsOthers) {
  Json json = {{"a", 1}, {"b", 2}};
  json.update({{"c", 3}, {"a", "new"}});
  EXPECT_EQ(to_text(json, -1), R"({"a":"new","b":2,"c":3})");
  json.erase("b");
  EXPECT_FALSE(json.contains("b"));
  EXPECT_EQ(json.value("b", 7), 7);
  EXPECT_EQ(json.value("c", 7), 3);
  EXPECT_EQ(json.find("d"), nullptr);
}

TEST(Json, WhatDoesNotFitIsAnException) {
  const Json json = {{"a", "text"}, {"b", {1, 2}}};
  EXPECT_THROW(json.at("c"), Json::exception);
  EXPECT_THROW(json.at("a").get<double>(), Json::exception);
  EXPECT_THROW(json.at("b").at(2), Json::exception);
  EXPECT_THROW(json.at("b").items(), Json::exception);
  EXPECT_THROW(Json(1).push_back(2), Json::exception);
  EXPECT_EQ(json.at("b").get<std::vector<int>>(), (std::vector<int>{1, 2}));
  EXPECT_EQ(json.size() + Json().size() + Json(1).size(), 3U);
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

TEST(ReadJson, RejectsANumberBeyondTheRangeOfDoubles) {
  const test::Folder folder;
  test::put_bytes(folder / "large.json", R"({"x": 1e400})");
  EXPECT_THROW(read_json(folder / "large.json"), InputError);
}

}  // namespace
}  // namespace tabor::io
