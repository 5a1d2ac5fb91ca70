#include <cstdlib>

#include "scan/formats/sample.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

std::string written_bytes(const Folder& folder, const std::string& extension) {
  write(test::small_map(), folder / ("map" + extension));
  return test::bytes_of(folder / ("map" + extension));
}

/// Complete options, so that every damaged file gets as far as its data.
ReadOptions generous() {
  ReadOptions options = test::micrometres();
  options.override_unit = true;
  return options;
}

/// No converter in these tests: what no reader recognises shall be rejected at once.
class WithoutPath {
 public:
  WithoutPath() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nonexistent", 1); }
  ~WithoutPath() { ::setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

class NoConverter : public ::testing::Test, WithoutPath {};
class BinaryFile : public ::testing::TestWithParam<const char*>, WithoutPath {};
class AnyFile : public ::testing::TestWithParam<const char*>, WithoutPath {};

TEST_P(BinaryFile, TruncatedAnywhereIsRejected) {
  const Folder folder;
  const std::string bytes = written_bytes(folder, GetParam());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(test::rejection(folder, bytes.substr(0, size), generous()), "") << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, BinaryFile,
                         ::testing::Values(".gwy", ".gsf", ".sdf", ".x3p", ".npy", ".nc", ".zip",
                                           ".sur"),
                         [](const auto& suite) { return std::string(suite.param).substr(1); });

TEST_P(AnyFile, WithAFlippedBitIsReadOrRejectedButNeverBreaksTheProgram) {
  const Folder folder;
  const std::string bytes = written_bytes(folder, GetParam());
  // Every bit of the first 128 bytes, then a stride: data bits only change heights.
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += bit < 8 * 128 ? 1 : 13) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, flipped, generous())) << bit;
  }
}

TEST_P(AnyFile, TruncatedAnywhereNeverBreaksTheProgram) {
  const Folder folder;
  const std::string bytes = written_bytes(folder, GetParam());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_NO_FATAL_FAILURE(test::rejection(folder, bytes.substr(0, size), generous()));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, AnyFile,
                         ::testing::Values(".gwy", ".gsf", ".sdf", ".asdf", ".x3p", ".npy", ".txt",
                                           ".xyz"),
                         [](const auto& suite) { return std::string(suite.param).substr(1); });

TEST_F(NoConverter, Hdf5TruncatedIsRejected) {
  const Folder folder;
  const std::string bytes = written_bytes(folder, ".h5");
  for (std::size_t size = 0; size < bytes.size(); size += bytes.size() / 40) {
    EXPECT_NE(test::rejection(folder, bytes.substr(0, size)), "") << size;
  }
}

TEST_F(NoConverter, AbsurdSizesInHeadersAreRejectedBeforeAllocating) {
  const Folder folder;
  std::string gsf = written_bytes(folder, ".gsf");
  gsf.replace(gsf.find("XRes = 5"), 8, "XRes = 2000000000");
  EXPECT_NE(test::rejection(folder, gsf).find("as its header says"), std::string::npos);
  std::string npy = written_bytes(folder, ".npy");
  npy.replace(npy.find("(4, 5), }"), 23, "(4000000000, 500000), }");
  EXPECT_NE(test::rejection(folder, npy, generous()).find("as its header says"), std::string::npos);
  std::string sdf = written_bytes(folder, ".sdf");
  sdf.replace(42, 4, "\xff\xff\xff\xff");
  EXPECT_NE(test::rejection(folder, sdf).find("65535 x 65535"), std::string::npos);
  std::string zero = written_bytes(folder, ".sdf");
  zero.replace(42, 2, std::string(2, '\0'));
  EXPECT_NE(test::rejection(folder, zero).find("at least 1 x 1"), std::string::npos);
}

TEST_F(NoConverter, NegativePixelsAreRejected) {
  const Folder folder;
  std::string sdf = written_bytes(folder, ".sdf");
  const double pixel = -1e-6;
  std::memcpy(sdf.data() + 46, &pixel, sizeof pixel);
  EXPECT_NE(test::rejection(folder, sdf).find("positive length"), std::string::npos);
}

TEST_F(NoConverter, AMapOfHolesIsRejected) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.height.setConstant(test::kNaN);
  write(map, folder / "map.x3p");
  EXPECT_NE(test::rejection(folder / "map.x3p").find("no valid height"), std::string::npos);
}

TEST_F(NoConverter, WhatIsNoScanIsRejectedWithTheLineThatInstallsGwyddion) {
  const Folder folder;
  const std::string message = test::rejection(folder, std::string("\x01\x02\x03", 3));
  EXPECT_NE(message.find("sudo apt install gwyddion"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_NE(test::rejection(folder, "").find("empty"), std::string::npos);
  EXPECT_NE(test::rejection(folder / "absent.x3p").find("no such file"), std::string::npos);
  EXPECT_NE(test::rejection(folder.path()).find("folder"), std::string::npos);
}

TEST_F(NoConverter, DeeplyNestedGwyObjectsAreRejected) {
  const Folder folder;
  std::string object;
  for (int depth = 0; depth < 2000; ++depth) {
    test::ByteFile outer;
    outer.text(0, std::string("A\0", 2)).append(static_cast<std::uint32_t>(object.size()));
    const std::string inner = outer.bytes() + object;
    object = std::string("k\0o", 3) + inner;
  }
  test::ByteFile root;
  root.text(0, std::string("GWYPG\0", 6)).append(static_cast<std::uint32_t>(object.size()));
  EXPECT_NE(test::rejection(folder, root.bytes() + object).find("nested"), std::string::npos);
}

/// HDF5 1.10 never returns from a global heap whose first object is free and has no size.
TEST_F(NoConverter, AnEndlessHdf5HeapIsRejected) {
  const Folder folder;
  std::string bytes = written_bytes(folder, ".h5");
  const std::size_t heap = bytes.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  bytes.replace(heap + 16, 2, std::string(2, '\0'));  // index of the first object: free
  bytes.replace(heap + 24, 8, std::string(8, '\0'));  // its size
  EXPECT_NE(test::rejection(folder, bytes).find("tables are damaged"), std::string::npos);
}

/// HDF5 1.10 asks for as much memory as the header of an object says that its continuation has: 4
/// GB here, which the copy that reads the tables first is not given.
TEST_F(NoConverter, AnHdf5HeaderThatGoesOnForGigabytesIsRejected) {
  const Folder folder;
  const std::string bytes = written_bytes(folder, ".h5");
  // The message of type 16: its head, then address and length of the continuation in 8 bytes each
  // (HDF5 File Format Specification 2.0, IV.A.2.q).
  const std::string head("\x10\0\x10\0\0\0\0\0", 8);
  int n_headers = 0;
  for (std::size_t at = bytes.find(head); at != std::string::npos; at = bytes.find(head, at + 1)) {
    std::string forged = bytes;
    forged.replace(at + head.size() + 8 + 2, 2, "\xFF\xFB");
    n_headers += test::rejection(folder, forged).find("tables are damaged") != std::string::npos;
  }
  EXPECT_GE(n_headers, 1);
}

/// The tables are sound here, so that the file is described; unpacking the heights fails.
TEST_F(NoConverter, HeightsInDamagedHdf5BlocksAreRejected) {
  const Folder folder;
  std::string bytes = written_bytes(folder, ".h5");
  const std::size_t block = bytes.rfind("\x78\x5E");  // of a zlib stream
  ASSERT_NE(block, std::string::npos);
  bytes.replace(block + 2, 8, std::string(8, '\xFF'));
  EXPECT_NE(test::rejection(folder, bytes).find("damaged HDF5 blocks"), std::string::npos);
}

TEST_F(NoConverter, CoordinatesWithoutAFiniteSpanAreNoGrid) {
  const Folder folder;
  const char* text = "-1e308 0 1\n1e308 0 2\n-1e308 1 3\n1e308 1 4\n";
  EXPECT_EQ(test::read_bytes(folder, text, test::micrometres()).format, "matrix");
}

TEST_F(NoConverter, FieldsWithoutAFiniteSizeAreRejected) {
  const Folder folder;
  for (const char* size : {"inf m", "1e-323 nm"}) {
    const std::string width = std::string("# Width: ") + size;
    const std::string text = width + "\n# Height: 1e308 m\n# Value units: m\n1 2\n3 4\n";
    EXPECT_NE(test::rejection(folder, text), "") << size;
  }
}

TEST_F(NoConverter, AnAbsurdCompressionIsRejected) {
  const Folder folder;
  std::string sdf = written_bytes(folder, ".asdf");
  sdf.replace(sdf.find("Compression = 0"), 15, "Compression = 1e300");
  EXPECT_NE(test::rejection(folder, sdf).find("compressed"), std::string::npos);
}

TEST_F(NoConverter, APngThatClaimsMoreThanItHoldsIsRejectedBeforeAllocating) {
  const Folder folder;
  // The head of a grey PNG of 100 000 x 100 000 pixels of 16 bits, with its checksum.
  const std::string bytes(
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\x86\xa0\0\1\x86\xa0\x10\0\0\0\0\xdd\xa9\x88\x57"
      "\0\0\0\0IDAT\x35\xaf\x06\x1e",
      45);
  EXPECT_NE(test::rejection(folder, bytes).find("100000 x 100000"), std::string::npos);
}

}  // namespace
}  // namespace tabor::scan
