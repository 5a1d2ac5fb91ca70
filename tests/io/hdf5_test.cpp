#include "tabor/io/hdf5/hdf5.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <thread>

#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/library.hpp"

namespace tabor::io {
namespace {

using test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;

Field sample_map(Index ny, Index nx) {
  Field map(ny, nx);
  for (Index i = 0; i < map.size(); ++i) map.data()[i] = std::sin(static_cast<double>(i)) * 1e-6;
  map(ny / 2, nx / 2) = std::nan("");
  return map;
}

bool same(const Field& a, const Field& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         ((a == b) || (a.isNaN() && b.isNaN())).all();
}

void write_sample(const std::filesystem::path& file) {
  Hdf5Writer writer(file);
  writer.attribute("/", "format", "tabor");
  writer.axes("/surface", {7, 5, 7e-6, 10e-6});
  writer.write("/surface/height", sample_map(5, 7));
  writer.describe("/surface/height", "m", "height");
  writer.attach_axes("/surface/height");
  writer.nxdata("/surface", "height");
  writer.write("/table/name", std::vector<std::string>{"a", "", "µ"});
  writer.write("/table/count", std::vector<std::int64_t>{1, -2});
  writer.commit();
}

TEST(Hdf5, MapsReadBackInBothPrecisions) {
  const Folder folder;
  const Field map = sample_map(70, 1100);  // more than one chunk each way, not a multiple
  Hdf5Writer writer(folder / "a.h5");
  writer.write("/double", map);
  writer.write("/deep/er/float", map, Precision::float32);
  writer.write("/bytes", ByteMap(ByteMap::Constant(3, 4, 2)));
  writer.commit();
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_TRUE(same(reader.field("/double"), map));
  EXPECT_TRUE(same(reader.field("/deep/er/float"), map.cast<float>().cast<double>()));
  EXPECT_TRUE((reader.bytes("/bytes") == 2).all());
  EXPECT_THAT(reader.shape("/bytes"), ElementsAre(3, 4));
}

/// Less than a chunk, exactly chunks, one row or column more, one row, one column, many batches.
TEST(Hdf5, MapsOfAnyShapeReadBack) {
  const Folder folder;
  for (const auto& [ny, nx] :
       {std::pair<Index, Index>{1, 1}, {64, 1024}, {65, 1025}, {1, 3000}, {300, 1}, {64 * 34, 8}}) {
    const Field map = sample_map(ny, nx);
    ByteMap bytes(ny, nx);
    for (Index i = 0; i < bytes.size(); ++i) bytes.data()[i] = static_cast<std::uint8_t>(i % 251);
    Hdf5Writer writer(folder / "a.h5");
    writer.write("/double", map);
    writer.write("/float", map, Precision::float32);
    writer.write("/bytes", bytes);
    writer.write("/zero", Field(Field::Zero(ny, nx)), Precision::float32);
    writer.commit();
    const Hdf5Reader reader(folder / "a.h5");
    EXPECT_TRUE(same(reader.field("/double"), map)) << ny << " x " << nx;
    EXPECT_TRUE(same(reader.field("/float"), map.cast<float>().cast<double>()))
        << ny << " x " << nx;
    EXPECT_TRUE((reader.bytes("/bytes") == bytes).all()) << ny << " x " << nx;
    EXPECT_TRUE((reader.field("/zero") == 0).all()) << ny << " x " << nx;
  }
}

TEST(Hdf5, AMapWithoutPixelsReadsBack) {
  const Folder folder;
  Hdf5Writer writer(folder / "a.h5");
  writer.write("/map", Field(0, 5), Precision::float32);
  writer.commit();
  EXPECT_THAT(Hdf5Reader(folder / "a.h5").shape("/map"), ElementsAre(0, 5));
}

TEST(Hdf5, BytesDoNotDependOnTheNumberOfThreads) {
  const Folder folder;
  const int before = thread_count();
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    Hdf5Writer writer(folder / fmt::format("{}.h5", threads));
    writer.write("/map", sample_map(700, 1500), Precision::float32);
    writer.commit();
  }
  set_thread_count(before);
  EXPECT_EQ(read_text(folder / "1.h5"), read_text(folder / "3.h5"));
}

TEST(Hdf5, ASecondNameIsTheSameMap) {
  const Folder folder;
  const Field map = sample_map(70, 1100);
  const auto size_with = [&](bool twice) {
    Hdf5Writer writer(folder / "a.h5");
    writer.write("/one/map", map);
    if (twice) writer.link("/two/map", "/one/map");
    writer.commit();
    return std::filesystem::file_size(folder / "a.h5");
  };
  const auto alone = size_with(false);
  EXPECT_LT(size_with(true), alone + 10000);
  EXPECT_TRUE(same(Hdf5Reader(folder / "a.h5").field("/two/map"), map));
  Hdf5Writer writer(folder / "b.h5");
  EXPECT_THROW(writer.link("/two/map", "/nothing"), OutputError);
}

TEST(Hdf5, ColumnsAndAttributesReadBack) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_EQ(reader.text("/", "format"), "tabor");
  EXPECT_THAT(reader.texts("/table/name"), ElementsAre("a", "", "µ"));
  EXPECT_THAT(reader.integers("/table/count"), ElementsAre(1, -2));
  EXPECT_THAT(reader.children("/table"), ElementsAre("count", "name"));
  EXPECT_THAT(reader.attribute_texts("/surface", "axes"), ElementsAre("y", "x"));
  EXPECT_EQ(reader.text("/surface/height", "units"), "m");
  EXPECT_TRUE(reader.is_dataset("/surface/height"));
  EXPECT_FALSE(reader.is_dataset("/surface"));
  EXPECT_FALSE(reader.exists("/surface/no/such"));
}

TEST(Hdf5, AxesAreCellCentres) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const std::vector<double> x = Hdf5Reader(folder / "a.h5").numbers("/surface/x");
  ASSERT_EQ(x.size(), 7u);
  EXPECT_DOUBLE_EQ(x[0], 0.5e-6);
  EXPECT_DOUBLE_EQ(x[6], 6.5e-6);
  EXPECT_DOUBLE_EQ(Hdf5Reader(folder / "a.h5").numbers("/surface/y")[1], 3e-6);
}

TEST(Hdf5, AttributeIsReplacedByANewerOneOfAnotherKind) {
  const Folder folder;
  Hdf5Writer writer(folder / "a.h5");
  writer.attribute("/", "n", 1.5);
  writer.attribute("/", "n", 3);
  writer.attribute("/", "none", std::vector<std::string>{});
  writer.commit();
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_EQ(reader.integer("/", "n"), 3);
  EXPECT_TRUE(reader.attribute_texts("/", "none").empty());
  EXPECT_THAT(reader.attribute_names("/"), ElementsAre("n", "none"));
}

TEST(Hdf5, ExternalLinkLeadsIntoTheStoreOrDangles) {
  const Folder folder;
  std::filesystem::create_directory(folder / "store");
  write_sample(folder / "store/data.h5");
  Hdf5Writer writer(folder / "main.h5");
  writer.external_link("/scans/0000/surface", "store/data.h5", "/surface");
  writer.external_link("/scans/0001/surface", "store/absent.h5", "/surface");
  writer.commit();
  const Hdf5Reader reader(folder / "main.h5");
  EXPECT_TRUE(same(reader.field("/scans/0000/surface/height"), sample_map(5, 7)));
  EXPECT_FALSE(reader.exists("/scans/0001/surface"));
  EXPECT_THROW(reader.field("/scans/0001/surface/height"), InputError);
}

TEST(Hdf5, OtherExternalLinksAreNotFollowed) {
  const Folder folder;
  std::filesystem::create_directories(folder / "store/deep");
  write_sample(folder / "data.h5");
  write_sample(folder / "store/deep/data.h5");
  const std::string away = (folder / "data.h5").string();
  const std::vector<std::string> targets{"data.h5", away, "store/../data.h5", "store/deep/data.h5"};
  for (const std::string& target : targets) {
    Hdf5Writer writer(folder / "main.h5");
    writer.external_link("/surface", target, "/surface");
    writer.commit();
    const Hdf5Reader reader(folder / "main.h5");
    EXPECT_FALSE(reader.exists("/surface/height")) << target;
    EXPECT_THAT(test::rejection([&] { reader.field("/surface/height"); }),
                HasSubstr("a link into another file"))
        << target;
  }
}

/// As h5py opens it where it shares the library with this program.
TEST(Hdf5, AFileIsReadWhileOthersOfTheProcessHaveItOpen) {
  const Folder folder;
  const auto file = folder / "a.h5";
  write_sample(file);
  const hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_WEAK);
  for (const bool locks : {true, false}) {
    H5Pset_file_locking(access, locks, true);
    const hdf5::Handle theirs(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), &H5Fclose);
    ASSERT_TRUE(theirs.valid());
    EXPECT_TRUE(same(Hdf5Reader(file).field("/surface/height"), sample_map(5, 7))) << locks;
    EXPECT_GT(H5Lexists(theirs, "surface", H5P_DEFAULT), 0);  // still open
  }
}

TEST(Hdf5, SameContentGivesTheSameBytes) {
  const Folder folder;
  write_sample(folder / "a.h5");
  write_sample(folder / "b.h5");
  EXPECT_EQ(test::bytes_of(folder / "a.h5"), test::bytes_of(folder / "b.h5"));
}

TEST(Hdf5, NothingStaysWithoutCommit) {
  const Folder folder;
  {
    Hdf5Writer writer(folder / "a.h5");
    writer.write("/map", sample_map(10, 10));
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(Hdf5, FullDiskIsAnOutputErrorAndLeavesNothing) {
  const Folder folder;
  sum(sample_map(300, 300));  // the threads of clang's OpenMP begin with a file of their own
  for (const rlim_t size : {0, 100, 2000, 60000}) {
    const test::FullDisk full(size);
    EXPECT_THROW(
        {
          Hdf5Writer writer(folder / "a.h5");
          writer.write("/map", sample_map(100, 400));
          writer.commit();
        },
        OutputError)
        << size;
    EXPECT_EQ(folder.n_files(), 0u) << size;
  }
  // The library must be usable afterwards.
  write_sample(folder / "a.h5");
  EXPECT_TRUE(same(Hdf5Reader(folder / "a.h5").field("/surface/height"), sample_map(5, 7)));
}

TEST(Hdf5, MissingFolderIsAnOutputErrorThatNamesTheFile) {
  const Folder folder;
  try {
    const Hdf5Writer writer(folder / "no" / "a.h5");
    FAIL() << "wrote into a folder that does not exist";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.h5"));
  }
}

TEST(Hdf5, EveryTruncationIsAnInputError) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const std::string all = test::bytes_of(folder / "a.h5");
  for (std::size_t size = 0; size < all.size(); size += 97) {
    test::put_bytes(folder / "b.h5", all.substr(0, size));
    EXPECT_THROW(Hdf5Reader(folder / "b.h5").field("/surface/height"), InputError) << size;
  }
}

TEST(Hdf5, RejectsWhatIsAbsentOrOfAnotherKind) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_THROW(Hdf5Reader(folder / "absent.h5"), InputError);
  EXPECT_THROW(Hdf5Reader(folder.path()), InputError);
  EXPECT_THROW(reader.field("/surface/depth"), InputError);
  EXPECT_THROW(reader.field("/surface"), InputError);
  EXPECT_THROW(reader.field("/surface/x"), InputError);    // one-dimensional
  EXPECT_THROW(reader.field("/table/name"), InputError);   // text
  EXPECT_THROW(reader.texts("/table/count"), InputError);  // numbers
  EXPECT_THROW(reader.number("/", "format"), InputError);
  EXPECT_THROW(reader.number("/", "absent"), InputError);
  EXPECT_THROW(reader.text("/surface", "axes"), InputError);  // two texts
  EXPECT_THROW(reader.children("/absent"), InputError);
}

TEST(Hdf5, RejectsASizeThatTheBytesCannotHold) {
  const Folder folder;
  Hdf5Writer writer(folder / "a.h5");
  writer.write("/map", Field(Field::Random(4, 4)));
  writer.commit();
  // The dataspace message stores both extents as 8-byte little-endian numbers: make them 2^31.
  std::string bytes = test::bytes_of(folder / "a.h5");
  const std::string extents("\4\0\0\0\0\0\0\0\4\0\0\0\0\0\0\0", 16);
  const std::string huge("\0\0\0\x80\0\0\0\0\0\0\0\x80\0\0\0\0", 16);
  const std::size_t at = bytes.find(extents);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, huge.size(), huge);
  if (bytes.compare(at + 16, 16, extents) == 0) {
    bytes.replace(at + 16, huge.size(), huge);  // the largest extents, stored behind
  }
  test::put_bytes(folder / "b.h5", bytes);
  try {
    Hdf5Reader(folder / "b.h5").field("/map");
    FAIL() << "read 2^62 values";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("claims"));
  }
}

TEST(Hdf5, FilesMayBeUsedFromSeveralThreads) {
  const Folder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&folder, i] {
      const auto file = folder / (std::to_string(i) + ".h5");
      for (int repeat = 0; repeat < 5; ++repeat) {
        write_sample(file);
        EXPECT_TRUE(same(Hdf5Reader(file).field("/surface/height"), sample_map(5, 7)));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Hdf5, IsRecognisedByItsFirstBytes) {
  const Folder folder;
  write_sample(folder / "a.h5");
  test::put_bytes(folder / "b", "no");
  EXPECT_TRUE(is_hdf5(folder / "a.h5"));
  EXPECT_FALSE(is_hdf5(folder / "b"));
  EXPECT_FALSE(is_hdf5(folder / "absent"));
}

}  // namespace
}  // namespace tabor::io
