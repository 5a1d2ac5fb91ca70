#include "tabor/io/image/png.hpp"

#include <cmath>
#include <span>
#include <string>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"

namespace tabor::io {
namespace {

using test::Folder;

TEST(Png, GreyPictureReadsBack) {
  const Folder folder;
  write_png({3, 2, 1, {0, 1, 2, 100, 200, 255}}, folder / "a.png");
  const GreyImage image = read_png(folder / "a.png");
  Field expected(2, 3);
  expected << 0, 1, 2, 100, 200, 255;
  EXPECT_EQ(image.bits, 8);
  EXPECT_TRUE((image.counts == expected).all());
}

GreyImage image_of(std::span<const unsigned char> bytes) {
  const Folder folder;
  test::put_bytes(folder / "a.png", std::string(bytes.begin(), bytes.end()));
  return read_png(folder / "a.png");
}

TEST(Png, ReadsSixteenBitCountsMostSignificantByteFirst) {
  // 2 x 1 pixels, 16-bit grey, counts 0x0102 and 0xfffe in one stored deflate block (made with
  // Python's struct and zlib after the PNG specification).
  constexpr unsigned char bytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x10, 0x00, 0x00, 0x00, 0x00, 0x81,
      0xd9, 0xfc, 0x15, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x05,
      0x00, 0xfa, 0xff, 0x00, 0x01, 0x02, 0xff, 0xfe, 0x03, 0x0b, 0x02, 0x01, 0x06, 0x90, 0x21,
      0x19, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const GreyImage image = image_of(bytes);
  EXPECT_EQ(image.bits, 16);
  ASSERT_EQ(image.counts.cols(), 2);
  EXPECT_EQ(image.counts(0, 0), 258);
  EXPECT_EQ(image.counts(0, 1), 65534);
}

TEST(Png, TransparentPixelsAreHoles) {
  // 2 x 1 pixels, 8-bit grey and alpha: 7 (255) and 9 (0), made as above.
  constexpr unsigned char bytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x04, 0x00, 0x00, 0x00, 0x5e,
      0x2b, 0xb7, 0x01, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x05,
      0x00, 0xfa, 0xff, 0x00, 0x07, 0xff, 0x09, 0x00, 0x03, 0x30, 0x01, 0x10, 0x98, 0x3a, 0x1e,
      0xff, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const GreyImage image = image_of(bytes);
  ASSERT_EQ(image.counts.size(), 2);
  EXPECT_EQ(image.counts(0, 0), 7);
  EXPECT_TRUE(std::isnan(image.counts(0, 1)));
}

TEST(Png, TheGreyValueNamedTransparentIsAHole) {
  // 2 x 1 pixels, 8-bit grey 7 and 9, tRNS 9, made as above.
  constexpr unsigned char bytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0xd1,
      0x49, 0x20, 0x56, 0x00, 0x00, 0x00, 0x02, 0x74, 0x52, 0x4e, 0x53, 0x00, 0x09, 0x0f, 0x4f,
      0x75, 0x9c, 0x00, 0x00, 0x00, 0x0e, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x03, 0x00,
      0xfc, 0xff, 0x00, 0x07, 0x09, 0x00, 0x1a, 0x00, 0x11, 0xb4, 0x52, 0x3f, 0xac, 0x00, 0x00,
      0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const GreyImage image = image_of(bytes);
  ASSERT_EQ(image.counts.size(), 2);
  EXPECT_EQ(image.counts(0, 0), 7);
  EXPECT_TRUE(std::isnan(image.counts(0, 1)));
}

TEST(Png, RejectsColour) {
  const Folder folder;
  write_png({1, 1, 3, {1, 2, 3}}, folder / "a.png");
  EXPECT_THROW(read_png(folder / "a.png"), InputError);
}

TEST(Png, RejectsEveryTruncation) {
  const Folder folder;
  std::vector<std::uint8_t> values(32 * 32);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<std::uint8_t>(i * 37 % 251);
  }
  write_png({32, 32, 1, values}, folder / "a.png");
  const std::string all = test::bytes_of(folder / "a.png");
  for (std::size_t size = 0; size + 12 < all.size(); ++size) {  // 12 bytes: the empty end mark
    test::put_bytes(folder / "b.png", all.substr(0, size));
    EXPECT_THROW(read_png(folder / "b.png"), InputError) << size;
  }
}

TEST(Png, BelievesNoLengthThatTheFileCannotHave) {
  const Folder folder;
  write_png({2, 1, 1, {7, 9}}, folder / "a.png");
  std::string bytes = test::bytes_of(folder / "a.png");
  bytes.insert(bytes.find("IDAT") - 4,
               std::string("\x44\x52\x00\x21tEXtTitle", 13));  // 1.1 GB of text
  test::put_bytes(folder / "a.png", bytes);
  const std::size_t before = peak_memory_bytes();
  EXPECT_THROW(read_png(folder / "a.png"), InputError);
  EXPECT_LT(peak_memory_bytes() - before, std::size_t{100} << 20);
}

TEST(Png, FullDiskLeavesNothing) {
  const Folder folder;
  std::vector<std::uint8_t> values(100 * 100);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<std::uint8_t>((i * i * 2654435761u) >> 13);
  }
  {
    const test::FullDisk full(1000);
    EXPECT_THROW(write_png({100, 100, 1, values}, folder / "a.png"), OutputError);
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

}  // namespace
}  // namespace tabor::io
