#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scan/formats/sample.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/holes.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

class RoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, GivesTheSameHeightsHolesAndPixels) {
  const Folder folder;
  const topography::Topography written = test::small_map();
  const auto file = folder / (std::string("map") + GetParam());
  write(written, file);
  const topography::Topography read_back = read(file);
  EXPECT_TRUE(test::same_bits(read_back.height, written.height));
  EXPECT_NEAR(read_back.grid.dx(), written.grid.dx(), 1e-12 * written.grid.dx());
  EXPECT_NEAR(read_back.grid.dy(), written.grid.dy(), 1e-12 * written.grid.dy());
}

TEST_P(RoundTrip, IsRecognisedByContentUnderAWrongExtension) {
  const Folder folder;
  write(test::small_map(), folder / (std::string("map") + GetParam()));
  std::filesystem::rename(folder / (std::string("map") + GetParam()), folder / "map.jpg");
  EXPECT_EQ(topography::count_holes(read(folder / "map.jpg")), 2);
}

TEST_P(RoundTrip, LeavesNothingBehindOnAFullDisk) {
  const Folder folder;
  topography::Topography large = test::small_map();
  large.grid = {.nx = 300, .ny = 300, .lx = 1e-3, .ly = 1e-3};
  large.height = Field::Random(300, 300);
  {
    const test::FullDisk disk(4096);
    EXPECT_THROW(write(large, folder / (std::string("map") + GetParam())), OutputError);
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST_P(RoundTrip, OfOnePixelRowsWorks) {
  const Folder folder;
  topography::Topography row = test::small_map();
  // Square pixels: a row of points does not tell how wide it is.
  row.grid = {.nx = 5, .ny = 1, .lx = 5e-6, .ly = 1e-6};
  row.height = Field(row.height.row(1));
  const auto file = folder / (std::string("row") + GetParam());
  write(row, file);
  EXPECT_TRUE(test::same_bits(read(file).height, row.height));
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(".h5", ".gwy", ".sdf", ".asdf", ".x3p", ".txt", ".xyz",
                                           ".nc", ".zip"),
                         [](const auto& suite) { return std::string(suite.param).substr(1); });

TEST(H5, RemembersThatHeightsWereInvented) {
  const Folder folder;
  topography::Topography map = topography::fill_holes(
      test::small_map(), topography::Fill::nearest);  // 2 of its few pixels are holes
  const auto is_invented = [](const Warning& warning) { return warning.code == "filled-holes"; };
  ASSERT_EQ(std::count_if(map.warnings.begin(), map.warnings.end(), is_invented), 1);
  for (int copy = 0; copy < 2; ++copy) {
    write(map, folder / "map.h5");
    map = read(folder / "map.h5");
    EXPECT_EQ(std::count_if(map.warnings.begin(), map.warnings.end(), is_invented), 1);
  }
}

TEST(Gsf, KeepsFloat32Heights) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.height = map.height.cast<float>().cast<double>().eval();
  write(map, folder / "map.gsf");
  EXPECT_TRUE(test::same_bits(read(folder / "map.gsf").height, map.height));
}

TEST(Npy, KeepsHeightsButNeedsPixelAndUnit) {
  const Folder folder;
  const topography::Topography map = test::small_map();
  write(map, folder / "map.npy");
  EXPECT_NE(test::rejection(folder / "map.npy").find("<pixel"), std::string::npos);
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_NE(test::rejection(folder / "map.npy", options).find("<unit"), std::string::npos);
  options.unit = "m";
  EXPECT_TRUE(test::same_bits(read(folder / "map.npy", options).height, map.height));
}

TEST(Npy, TransposesColumnMajorAndBigEndianArrays) {
  const Folder folder;
  const std::string dictionary = "{'descr': '>i2', 'fortran_order': True, 'shape': (2, 3), }";
  test::ByteFile file;
  file.text(0, "\x93NUMPY").number<std::uint8_t>(6, 2);
  file.number(8, static_cast<std::uint32_t>(dictionary.size())).text(12, dictionary);
  for (const std::int16_t value : std::initializer_list<std::int16_t>{1, 4, 2, 5, 3, 6}) {
    file.big_endian(file.bytes().size(), value);
  }
  Field expected(2, 3);
  expected << 1, 2, 3, 4, 5, 6;
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.z_scale = 1.0;
  EXPECT_TRUE(test::same_bits(test::read_bytes(folder, file.bytes(), options).height, expected));
}

TEST(Hdf5Surface, KeepsTreatmentAndPeriodicity) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.periodic = true;
  map.history = {"level=plane"};
  map.instrument = "profiler";
  write(map, folder / "map.h5");
  const topography::Topography read_back = read(folder / "map.h5");
  EXPECT_TRUE(read_back.periodic);
  EXPECT_EQ(read_back.history, map.history);
  EXPECT_EQ(read_back.instrument, "profiler");
}

TEST(Hdf5Surface, KeepsWhatLiesBeyondItsEdges) {
  const Folder folder;
  const topography::Topography map = test::small_map();
  write(map, folder / "map.h5");
  EXPECT_EQ(read(folder / "map.h5").edges, std::nullopt);
  using topography::Edges;
  for (const Edges edges : {Edges::tile, Edges::cut, Edges::end}) {
    const topography::Topography said = topography::with_edges(map, edges);
    write(said, folder / "map.h5");
    const topography::Topography read_back = read(folder / "map.h5");
    EXPECT_EQ(read_back.edges, edges);
    EXPECT_EQ(read_back.tiles, said.tiles);
    EXPECT_EQ(topography::repeats(read_back), edges != Edges::end);
  }
}

TEST(Hdf5Surface, RejectsEdgesThatItDoesNotKnow) {
  const Folder folder;
  const auto write_with = [&](const auto& change) {
    io::Hdf5Writer writer(folder / "map.h5");
    topography::write_surface_group(writer, test::small_map(), "");
    change(writer);
    writer.commit();
  };
  write_with([](io::Hdf5Writer& file) { file.attribute("/surface", "edges", "torn"); });
  EXPECT_THAT(test::rejection(folder / "map.h5"),
              testing::AllOf(testing::HasSubstr("'torn'"), testing::HasSubstr("tile, cut, end")));
  for (const double tiles : {0.0, 1e9, std::nan("")}) {
    write_with([&](io::Hdf5Writer& file) { file.attribute("/surface", "tiles", tiles); });
    EXPECT_THAT(test::rejection(folder / "map.h5"), testing::HasSubstr("tiles = "));
  }
}

TEST(Vti, HoldsTheBottomRowFirst) {
  const Folder folder;
  const topography::Topography map = test::small_map();
  write(map, folder / "map.vti");
  const std::string bytes = test::bytes_of(folder / "map.vti");
  EXPECT_NE(bytes.find("WholeExtent=\"0 4 0 3 0 0\""), std::string::npos);
  const std::size_t data = bytes.find("\n_") + 2;
  std::uint64_t size = 0;
  double first = 0;
  std::memcpy(&size, bytes.data() + data, 8);
  std::memcpy(&first, bytes.data() + data + 8, 8);
  EXPECT_EQ(size, 20u * 8u);
  EXPECT_EQ(first, map.height(3, 0));
}

TEST(WriteMap, RejectsAnUnknownExtensionByNamingTheKnown) {
  const Folder folder;
  try {
    write(test::small_map(), folder / "map.doc");
    FAIL() << "written";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(".x3p"), std::string::npos);
  }
}

TEST(WriteMap, RejectsMoreThan65535PixelsInSdf) {
  const Folder folder;
  topography::Topography line = test::small_map();
  line.grid = {.nx = 65536, .ny = 1, .lx = 1, .ly = 1e-5};
  line.height = Field::Zero(1, 65536);
  EXPECT_THROW(write(line, folder / "line.sdf"), InputError);
}

TEST(FormatTable, SaysWhatItReadsAndWrites) {
  std::size_t n_read_and_write = 0;
  for (const FormatRow& row : formats()) {
    EXPECT_TRUE(row.reads || row.writes) << row.name;
    n_read_and_write += row.reads && row.writes;
  }
  // h5 x3p nc ce gwy gsf sdf sdf-ascii npy sur png tiff matrix xyz
  EXPECT_EQ(n_read_and_write, 14u);
}

}  // namespace
}  // namespace tabor::scan
