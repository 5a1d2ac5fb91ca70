#include "tabor/io/files/digest.hpp"

#include "support/folder.hpp"
#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

// FIPS 180-4 and RFC 1321 test vectors.
constexpr const char* kSha256OfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Digest, MatchesThePublishedVectors) {
  EXPECT_EQ(sha256(std::string_view("abc")), kSha256OfAbc);
  EXPECT_EQ(sha256(std::string_view("")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(md5(std::as_bytes(std::span("message digest", 14))),
            "f96b697d7cb7938d525a2f31aaf161d0");
}

TEST(Digest, OfAFileIsTheDigestOfItsBytes) {
  const test::Folder folder;
  test::put_bytes(folder / "abc", "abc");
  EXPECT_EQ(sha256_of_file(folder / "abc"), kSha256OfAbc);
  const std::string large((3u << 20) + 17, 'q');  // more than one block
  test::put_bytes(folder / "large", large);
  EXPECT_EQ(sha256_of_file(folder / "large"), sha256(std::string_view(large)));
}

TEST(Digest, RejectsWhatIsNotAFile) {
  const test::Folder folder;
  EXPECT_THROW(sha256_of_file(folder / "absent"), InputError);
  EXPECT_THROW(sha256_of_file(folder.path()), InputError);
}

}  // namespace
}  // namespace tabor::io
