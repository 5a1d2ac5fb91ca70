#include "tabor/io/files/sealed_file.hpp"

#include <gmock/gmock.h>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::io {
namespace {

using test::Folder;
using testing::HasSubstr;

TEST(SealedFile, ShowsEveryChangeOfItsBytes) {
  const Folder folder;
  const auto file = folder / "a";
  for (const std::string& content :
       {std::string(), std::string("one\ntwo"), std::string(300, '\0')}) {
    test::put_bytes(file, content);
    EXPECT_NE(broken_seal(file), "");
    seal(file);
    const std::string bytes = test::bytes_of(file);
    EXPECT_EQ(bytes.substr(0, content.size()), content);
    EXPECT_EQ(broken_seal(file), "");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ (1 << (at % 8)));
      test::put_bytes(file, other);
      EXPECT_THAT(broken_seal(file), HasSubstr(file.string())) << at;
      test::put_bytes(file, bytes.substr(0, at));
      EXPECT_NE(broken_seal(file), "") << at;
      test::put_bytes(file, bytes.substr(at + 1));
      EXPECT_NE(broken_seal(file), "") << at;
    }
    test::put_bytes(file, bytes + "x");
    EXPECT_NE(broken_seal(file), "");
  }
  EXPECT_NE(broken_seal(folder / "absent"), "");
  EXPECT_NE(broken_seal(folder.path()), "");
}

TEST(SealedFile, OfHdf5IsReadAsIfItHadNoSeal) {
  const Folder folder;
  const auto file = folder / "a.h5";
  Hdf5Writer writer(file, Seal::yes);
  writer.write("/map", Field(Field::Constant(3, 4, 0.1)));
  writer.attribute("/map", "scalar", 0.25);
  EXPECT_FALSE(std::filesystem::exists(file));
  writer.commit();
  EXPECT_EQ(broken_seal(file), "");
  EXPECT_TRUE(is_hdf5(file));
  const Hdf5Reader reader(file);
  EXPECT_EQ(reader.number("/map", "scalar"), 0.25);
  EXPECT_EQ(reader.field("/map")(2, 3), 0.1);
}

TEST(SealedFile, CannotBeMadeOnAFullDisk) {
  const Folder folder;
  test::put_bytes(folder / "a", std::string(100, 'x'));
  const test::FullDisk full(120);
  EXPECT_THROW(seal(folder / "a"), OutputError);
}

TEST(SealedJson, ShowsEveryOtherValue) {
  const Json object = sealed({{"a", 0.1}, {"b", {1, 2}}, {"c", nullptr}});
  EXPECT_TRUE(is_sealed(object));
  EXPECT_TRUE(is_sealed(Json::parse(to_text(object))));
  for (const auto& [key, value] : object.items()) {
    Json other = object;
    other[key] = "x";
    EXPECT_FALSE(is_sealed(other)) << key;
    other.erase(key);
    EXPECT_FALSE(is_sealed(other)) << key;
  }
  EXPECT_FALSE(is_sealed({{"a", 0.1}}));
  EXPECT_FALSE(is_sealed(Json::array({1, 2})));
  EXPECT_FALSE(is_sealed(nullptr));
}

}  // namespace
}  // namespace tabor::io
