// NetCDF, containers of contact.engineering, spreadsheets, layers of Digital Surf, Zygo's texts,
// and what is written for other programs.
#include "support/exchange_files.hpp"

#include <cstdlib>
#include <numbers>

#include "scan/formats/sample.hpp"
#include "support/instrument_files.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using testing::Contains;
using testing::HasSubstr;

Field one_to_five(double unit) {
  Field field(2, 3);
  field << 1, 2, 3, 4, 5, test::kNaN;
  return field * unit;
}

/// No converter: what no reader recognises shall be rejected at once.
class Exchange : public ::testing::Test {
 protected:
  Exchange() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nonexistent", 1); }
  ~Exchange() override { ::setenv("PATH", path_.c_str(), 1); }
  Folder folder;

 private:
  std::string path_;
};

using Netcdf = Exchange;
using Container = Exchange;
using Spreadsheet = Exchange;
using DigitalSurfLayers = Exchange;
using ZygoText = Exchange;
using Picture = Exchange;
using Stl = Exchange;

TEST_F(Netcdf, EveryVersionOfTheHeaderGivesTheSameMap) {
  for (const int version : {1, 2, 5}) {
    const topography::Topography map = test::read_bytes(folder, test::netcdf(version));
    EXPECT_EQ(map.format, "nc");
    EXPECT_TRUE(test::same_bits(map.height, one_to_five(1e-6))) << version;
    EXPECT_DOUBLE_EQ(map.grid.dx(), 2e-6);
    EXPECT_DOUBLE_EQ(map.grid.dy(), 4e-6);
    EXPECT_EQ(map.channel, "sheet");
    EXPECT_EQ(map.instrument, "WLI");
    EXPECT_FALSE(map.periodic);
  }
}

TEST_F(Netcdf, UnevenLineIsInterpolatedAndSaysSo) {
  const topography::Topography line = test::read_bytes(folder, test::netcdf_line());
  // Even positions 0 1.5 3 4.5 um between 0 1 3 4.5.
  Field expected(1, 4);
  expected << 1e-6, 1.5e-6, 0, 3e-6;
  EXPECT_TRUE((line.height - expected).abs().maxCoeff() < 1e-18) << line.height;
  EXPECT_NEAR(line.grid.dx(), 1.5e-6, 1e-18);
  EXPECT_THAT(texts_of(line.warnings), Contains(HasSubstr("interpolated to even steps of 1.5 um")));
}

TEST_F(Netcdf, OfOtherContentIsNotTaken) {
  std::string bytes = test::netcdf();
  bytes.replace(bytes.find("heights"), 7, "fringes");
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("without 'heights'"));
}

TEST_F(Netcdf, LiesAboutSizesAreRejected) {
  std::string bytes = test::netcdf();
  bytes[bytes.find("\0\0\0\x01x", 0, 5) + 8] = '\x7f';  // 2^31 columns
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("as its header says"));
}

TEST_F(Netcdf, LongNamesAndListsAreRejected) {
  const std::string head("CDF\x01\0\0\0\0", 8), dimensions("\0\0\0\x0a", 4);
  const std::string long_name = head + dimensions + std::string("\0\0\0\x01\0\0\x10\0", 8);
  EXPECT_THAT(test::rejection(folder, long_name + std::string(5000, 'x')),
              HasSubstr("a name of 4096 bytes"));
  const std::string long_list = head + dimensions + std::string("\0\x03\0\0", 4);
  EXPECT_THAT(test::rejection(folder, long_list + std::string(1 << 20, '\0')),
              HasSubstr("more than 100000 items"));
}

TEST_F(Netcdf, RowsOfAnyPixelComeBack) {
  topography::Topography row = test::small_map();
  row.height = Field(row.height.row(0));
  for (const double dy : {2e-6, 7e-6}) {  // a line without y, and a map of one row
    row.grid = {.nx = row.height.cols(), .ny = 1, .lx = 10e-6, .ly = dy};
    for (const char* name : {"row.nc", "row.zip"}) {
      write(row, folder / name);
      const topography::Topography read_back = read(folder / name);
      EXPECT_TRUE(test::same_bits(read_back.height, row.height)) << name;
      EXPECT_DOUBLE_EQ(read_back.grid.dx(), 2e-6) << name;
      EXPECT_DOUBLE_EQ(read_back.grid.dy(), dy) << name;
    }
  }
}

TEST_F(Netcdf, BasedOnHdf5GivesTheSameMap) {
  io::Hdf5Writer writer(folder / "a.nc");
  Field x_first(3, 2);
  x_first << 1, 4, 2, 5, 3, 9;
  Field mask = Field::Zero(3, 2);
  mask(2, 1) = 1;
  writer.write("/heights", x_first);
  writer.write("/mask", mask);
  writer.write("/x", std::vector<double>{0, 2, 4});
  writer.write("/y", std::vector<double>{0, 4});
  writer.attribute("/x", "length", 6.0);
  writer.attribute("/y", "length", 8.0);
  for (const char* path : {"/x", "/y", "/heights"}) writer.attribute(path, "unit", "um");
  writer.commit();
  const topography::Topography map = read(folder / "a.nc");
  EXPECT_EQ(map.format, "nc");
  EXPECT_TRUE(test::same_bits(map.height, one_to_five(1e-6))) << map.height;
  EXPECT_DOUBLE_EQ(map.grid.dx(), 2e-6);
  EXPECT_DOUBLE_EQ(map.grid.dy(), 4e-6);
}

TEST_F(Netcdf, KeepsPeriodicityAndTreatment) {
  topography::Topography map = test::small_map();
  map.periodic = true;
  map.history = {"level=plane"};
  write(map, folder / "map.nc");
  const topography::Topography read_back = read(folder / "map.nc");
  EXPECT_TRUE(read_back.periodic);
  EXPECT_EQ(read_back.history, map.history);
}

TEST_F(Container, BothKindsOfIndexGiveTheMap) {
  for (const char* index : {"index.json", "meta.yml"}) {
    const topography::Topography map = test::read_bytes(folder, test::container(index));
    EXPECT_EQ(map.format, "ce");
    EXPECT_EQ(map.channel, "spot 1");
    EXPECT_TRUE(test::same_bits(map.height, one_to_five(1e-6)));
  }
}

TEST_F(Container, SaysHowTheHeightsWereTreated) {
  const topography::Topography map = test::read_bytes(folder, test::container("meta.yml"));
  EXPECT_THAT(texts_of(map.warnings), Contains(HasSubstr("detrend: height")));
  EXPECT_THAT(texts_of(map.warnings), Contains(HasSubstr("filled missing heights (harmonic)")));
}

TEST_F(Container, IndexCompletesTheFileOfAnInstrument) {
  const topography::Topography map =
      test::read_bytes(folder, test::container_of_original("a.txt", "1 2 3\n4 5 NaN\n"));
  EXPECT_TRUE(test::same_bits(map.height, one_to_five(0.5e-6))) << map.height;
  EXPECT_DOUBLE_EQ(map.grid.dx(), 2e-6);
  EXPECT_DOUBLE_EQ(map.grid.dy(), 4e-6);
}

TEST_F(Container, MessagesNameArchiveAndEntry) {
  const std::string bytes = test::container_of_original("a.txt", "1 2 3\n4 5\n");
  EXPECT_THAT(test::rejection(folder, bytes),
              HasSubstr((folder / "scan.bin").string() + ": a.txt: got 2 numbers on line 2"));
}

TEST_F(Container, OtherArchivesAreRejectedInOneShortLine) {
  EXPECT_THAT(test::rejection(folder, io::zip({{"a.txt", "1 2\n"}})),
              HasSubstr("a ZIP archive without main.xml (so not X3P), index.xml (so not PLUX), "
                        "meta.yml (so not contact.engineering), xl/workbook.xml (so not a "
                        "spreadsheet)"));
}

TEST_F(Container, InAContainerIsRejected) {
  const std::string bytes = test::container_of_original("a.zip", test::container());
  EXPECT_NE(test::rejection(folder, bytes), "");
}

TEST_F(Container, MeasurementsAreChannels) {
  const std::string index =
      "surfaces: [{name: a, topographies: [&one {name: p, datafile: {squeezed-netcdf: a.nc}},"
      " {name: q, datafile: {squeezed-netcdf: a.nc}}, *one]}]";
  const std::string bytes = io::zip({{"meta.yml", index}, {"a.nc", test::netcdf()}});
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("0 'p' [um], 1 'q' [um], 2 'p' [um]"));
  ReadOptions options;
  options.channel = "q";
  EXPECT_EQ(test::read_bytes(folder, bytes, options).channel, "q");
}

TEST_F(Container, SurfacesStandBeforeTheirMeasurements) {
  const std::string index =
      "surfaces: [{name: a, topographies: [{name: p, datafile: {squeezed-netcdf: a.nc}}]},"
      " {name: b, topographies: [{name: p, datafile: {squeezed-netcdf: a.nc}}]}]";
  test::put_bytes(folder / "a.zip", io::zip({{"meta.yml", index}, {"a.nc", test::netcdf()}}));
  const FileInfo info = inspect(folder / "a.zip");
  ASSERT_EQ(info.channels.size(), 2u);
  EXPECT_EQ(info.channels[0].name, "a: p");
  EXPECT_EQ(info.channels[1].name, "b: p");
}

TEST_F(Container, IndexWinsOverTheFileInPeriodicity) {
  topography::Topography map = test::small_map();
  map.periodic = true;
  write(map, folder / "map.nc");
  const std::string bytes = test::bytes_of(folder / "map.nc");
  const auto is_periodic = [&](const std::string& said) {
    const std::string index =
        "surfaces: [{topographies: [{name: p, datafile: {squeezed-netcdf: a.nc}" + said + "}]}]";
    return test::read_bytes(folder, io::zip({{"meta.yml", index}, {"a.nc", bytes}})).periodic;
  };
  EXPECT_TRUE(is_periodic(""));
  EXPECT_TRUE(is_periodic(", is_periodic: true"));
  EXPECT_FALSE(is_periodic(", is_periodic: false"));
}

TEST_F(Container, BrokenIndicesAreRejected) {
  const auto rejected = [&](const std::string& name, const std::string& index) {
    return test::rejection(folder, io::zip({{name, index}, {"a.nc", test::netcdf()}}));
  };
  EXPECT_THAT(rejected("meta.yml", "surfaces: [}"), HasSubstr("no YAML on line 1"));
  EXPECT_THAT(rejected("index.json", "{\"surfaces\": ["), HasSubstr("not JSON"));
  EXPECT_THAT(rejected("index.json", "{}"), HasSubstr("without surfaces"));
  EXPECT_THAT(rejected("meta.yml", "surfaces: []"), HasSubstr("no measurement"));
  EXPECT_THAT(rejected("meta.yml", "surfaces: [{topographies: [{name: a}]}]"),
              HasSubstr("without a data file"));
  EXPECT_THAT(rejected("meta.yml",
                       "surfaces: [{topographies: [{datafile: {squeezed-netcdf: ../../b.nc}}]}]"),
              HasSubstr("no entry '../../b.nc'"));
}

TEST_F(Spreadsheet, OfMitutoyoGivesItsProfile) {
  const topography::Topography line = test::read_bytes(folder, test::mitutoyo());
  EXPECT_EQ(line.format, "mitutoyo");
  Field expected(1, 4);
  expected << 1e-6, 2e-6, 4e-6, 8e-6;
  EXPECT_TRUE(test::same_bits(line.height, expected));
  EXPECT_NEAR(line.grid.dx(), 0.1e-3, 1e-15);
}

TEST_F(Spreadsheet, CellsWithoutAPlaceAreLeftOut) {
  const std::string whole = test::mitutoyo();
  const io::ZipReader archive(whole, "a");
  std::vector<io::ZipContent> parts;
  for (const io::ZipEntry& entry : archive.entries()) {
    std::string bytes = archive.read(entry, 1 << 20);
    const std::size_t row = bytes.find("<row>");
    if (row != std::string::npos) bytes.insert(row + 5, "<c><v>1</v></c><c r=\"EE1\"><v>1</v></c>");
    parts.push_back({entry.name, bytes});
  }
  EXPECT_EQ(test::read_bytes(folder, io::zip(parts)).grid.nx, 4);
}

TEST_F(Spreadsheet, OfOthersIsNotTaken) {
  const std::string bytes = io::zip({{"xl/workbook.xml", "<workbook><sheets/></workbook>"},
                                     {"xl/_rels/workbook.xml.rels", "<Relationships/>"}});
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("without the sheets DATA"));
}

TEST_F(DigitalSurfLayers, HeightsAreTheFirstOne) {
  test::put_bytes(folder / "a.sur", test::layered_sur());
  const FileInfo info = inspect(folder / "a.sur");
  ASSERT_EQ(info.channels.size(), 2u);
  EXPECT_TRUE(info.channels[0].is_height);
  EXPECT_FALSE(info.channels[1].is_height);
  EXPECT_TRUE(test::same_bits(read(folder / "a.sur").height,
                              test::read_bytes(folder, test::plain_sur()).height));
}

TEST_F(DigitalSurfLayers, MissingOnesAreSaid) {
  const std::string bytes = test::layered_sur().substr(0, test::plain_sur().size());
  EXPECT_THAT(texts_of(test::read_bytes(folder, bytes).warnings),
              Contains(HasSubstr("only 1 of 2 layers")));
  EXPECT_NE(test::rejection(folder, test::layered_sur().substr(0, bytes.size() + 100)), "");
}

TEST(DigitalSurf, WrittenHeightsComeBackWithinHalfAStep) {
  const Folder folder;
  const topography::Topography map = test::small_map();
  write(map, folder / "map.sur");
  const topography::Topography read_back = read(folder / "map.sur");
  const double step = map.height.isNaN().select(0, map.height.abs()).maxCoeff() / (1 << 30);
  EXPECT_TRUE((read_back.height.isNaN() == map.height.isNaN()).all());
  EXPECT_LE((read_back.height - map.height)
                .isNaN()
                .select(0, read_back.height - map.height)
                .abs()
                .maxCoeff(),
            0.51 * step);
  EXPECT_NEAR(read_back.grid.dx() / map.grid.dx(), 1, 1e-7);
}

TEST_F(ZygoText, PointsNeedTheirUnit) {
  EXPECT_THAT(test::rejection(folder, test::zygo_points()), HasSubstr("<unit"));
  ReadOptions options;
  options.unit = "um";
  const topography::Topography map = test::read_bytes(folder, test::zygo_points(), options);
  EXPECT_TRUE(test::same_bits(map.height, one_to_five(1e-6)));
  EXPECT_DOUBLE_EQ(map.grid.dx(), 2e-6);
}

TEST_F(ZygoText, TabsSeparateAsBlanksDo) {
  ReadOptions options;
  options.unit = "um";
  std::string bytes = test::zygo_points();
  bytes.replace(bytes.find("12 20 3"), 7, "12\t20\t3");
  EXPECT_TRUE(test::same_bits(test::read_bytes(folder, bytes, options).height, one_to_five(1e-6)));
}

TEST_F(ZygoText, PointsOutsideTheFieldAndCutFilesAreRejected) {
  ReadOptions options;
  options.unit = "um";
  std::string outside = test::zygo_points();
  outside.replace(outside.find("12 20 3"), 2, "99");
  EXPECT_THAT(test::rejection(folder, outside, options), HasSubstr("'99 20 3'"));
  const std::string cut = test::zygo_points().substr(0, test::zygo_points().find("11 21"));
  EXPECT_THAT(test::rejection(folder, cut, options), HasSubstr("4 points and no '#'"));
}

TEST_F(Picture, PngHasItsScaleAndHoles) {
  const topography::Topography map = test::small_map();
  write(map, folder / "map.png");
  const topography::Topography read_back = read(folder / "map.png");
  EXPECT_TRUE((read_back.height.isNaN() == map.height.isNaN()).all());
  const double range = map.height.isNaN().select(-1, map.height).maxCoeff() -
                       map.height.isNaN().select(1, map.height).minCoeff();
  EXPECT_LE((read_back.height - map.height)
                .isNaN()
                .select(0, read_back.height - map.height)
                .abs()
                .maxCoeff(),
            0.51 * range / 65534);
  EXPECT_DOUBLE_EQ(read_back.grid.dx(), map.grid.dx());
  EXPECT_DOUBLE_EQ(read_back.grid.dy(), map.grid.dy());
  EXPECT_THAT(note_of(map, folder / "map.png"), HasSubstr("<z_scale"));
}

TEST_F(Picture, ArrayOfNumPySaysWhatItLacks) {
  topography::Topography map = test::small_map();
  map.grid.lx = 0.67e-6 * static_cast<double>(map.grid.nx);
  map.grid.ly = 0.5e-6 * static_cast<double>(map.grid.ny);
  EXPECT_THAT(note_of(map, "map.npy"),
              testing::AllOf(HasSubstr("<unit=m>"), HasSubstr("<pixel=0.67um,0.5um>")));
}

TEST_F(Picture, TiffHasSinglePrecisionAndHoles) {
  const topography::Topography map = test::small_map();
  write(map, folder / "map.tif");
  const topography::Topography read_back = read(folder / "map.tif");
  EXPECT_TRUE(test::same_bits(read_back.height, map.height.cast<float>().cast<double>()));
  EXPECT_THAT(note_of(map, folder / "map.tif"), HasSubstr("single precision"));
  EXPECT_DOUBLE_EQ(read_back.grid.dx(), map.grid.dx());
  EXPECT_DOUBLE_EQ(read_back.grid.dy(), map.grid.dy());
}

TEST_F(Picture, LeavesNothingBehindOnAFullDisk) {
  topography::Topography large = test::small_map();
  large.grid = {.nx = 300, .ny = 300, .lx = 1e-3, .ly = 1e-3};
  large.height = Field::Random(300, 300);
  for (const char* name : {"map.png", "map.tif", "map.sur", "map.stl"}) {
    const test::FullDisk disk(4096);
    EXPECT_THROW(write(large, folder / name), OutputError) << name;
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

using Opdx = Exchange;

TEST_F(Opdx, ItemsOfOtherKindsAreNoHeights) {
  std::string bytes = test::opdx();
  bytes.replace(bytes.find("\x06\0\0\0Matrix", 0, 10), 10, "\x06\0\0\0Mitrax", 10);
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("neither 2D_Data nor 1D_Data"));
  const std::string number = test::opdx_number("Matrix", 3);
  EXPECT_THAT(test::rejection(folder, number), HasSubstr("neither 2D_Data nor 1D_Data"));
}

using StylusText = Exchange;

TEST_F(StylusText, OfBothKindsGivesTheProfile) {
  Field expected(1, 3);
  expected << 1e-9, 2e-9, 4e-9;
  const topography::Topography dektak =
      test::read_bytes(folder,
                       "Scan Type,Standard\nStylus,Radius: 2 um\n\nScan Data\n\n"
                       "Lateral um,Raw Nanometer,\n0.0,1,\n0.5,2,\n1.0,4,\n");
  EXPECT_EQ(dektak.format, "stylus-text");
  EXPECT_TRUE(test::same_bits(dektak.height, expected));
  EXPECT_NEAR(dektak.grid.dx(), 0.5e-6, 1e-15);
  const topography::Topography hfm =
      test::read_bytes(folder, "X;Y;valid\n[mm];[mm];[1/0]\n0.1;1;1\n0.2;2;0\n0.3;4;1\n");
  EXPECT_TRUE(std::isnan(hfm.height(0, 1)));
  EXPECT_DOUBLE_EQ(hfm.height(0, 2), 4e-3);
  EXPECT_NEAR(hfm.grid.dx(), 0.1e-3, 1e-12);
}

TEST_F(StylusText, PositionsThatDoNotRiseAndOtherLinesAreRejected) {
  const std::string head = "X;Y;valid\n[mm];[mm];[1/0]\n";
  EXPECT_THAT(test::rejection(folder, head + "0;1;1\n1;2;1\n1;3;1\n2;3;1\n"),
              HasSubstr("neither rise nor fall"));
  EXPECT_THAT(test::rejection(folder, head + "0;1;1\nend\n"), HasSubstr("'end'"));
  EXPECT_THAT(test::rejection(folder, head + "0;1;1\n"), HasSubstr("at least two points"));
}

/// Numbers of a triangle: normal and three corners.
std::array<float, 12> triangle(const std::string& bytes, std::size_t i) {
  std::array<float, 12> numbers{};
  std::memcpy(numbers.data(), bytes.data() + 84 + 50 * i, sizeof numbers);
  return numbers;
}

TEST_F(Stl, TrianglesOfATiltedPlaneHaveItsNormal) {
  topography::Topography plane;
  plane.grid = {.nx = 3, .ny = 2, .lx = 3e-3, .ly = 4e-3};
  plane.height.resize(2, 3);
  plane.height << 0, 1e-3, 2e-3, 0, 1e-3, 2e-3;  // rises by 45 degrees along x
  write(plane, folder / "plane.stl");
  const std::string bytes = test::bytes_of(folder / "plane.stl");
  ASSERT_EQ(bytes.size(), 84u + 50u * 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto numbers = triangle(bytes, i);
    EXPECT_NEAR(numbers[0], -std::numbers::sqrt2 / 2, 1e-6);
    EXPECT_NEAR(numbers[1], 0, 1e-6);
    EXPECT_NEAR(numbers[2], std::numbers::sqrt2 / 2, 1e-6);
  }
  // The first corner is the lower left pixel's centre, in millimetres.
  EXPECT_NEAR(triangle(bytes, 0)[3], 0.5, 1e-6);
  EXPECT_NEAR(triangle(bytes, 0)[4], 1.0, 1e-6);
}

TEST_F(Stl, IsNotRead) {
  topography::Topography map;
  map.grid = {.nx = 3, .ny = 2, .lx = 3e-3, .ly = 4e-3};
  map.height = Field::Random(2, 3);
  write(map, folder / "map.stl");
  EXPECT_THAT(test::rejection(folder, test::bytes_of(folder / "map.stl")),
              HasSubstr("mesh of triangles"));
}

TEST_F(Stl, HolesAreLeftOut) {
  const topography::Topography map = test::small_map();
  Index n_squares = 0;
  for (Index y = 0; y < 3; ++y) {
    for (Index x = 0; x < 4; ++x) n_squares += !map.height.block(y, x, 2, 2).isNaN().any();
  }
  write(map, folder / "map.stl");
  EXPECT_EQ(std::filesystem::file_size(folder / "map.stl"), 84u + 100u * n_squares);
  EXPECT_THAT(note_of(map, "map.stl"), HasSubstr(std::to_string(2 * n_squares) + " triangles"));
}

TEST_F(Stl, NeedsFourNeighboursWithHeights) {
  const auto rejection_of = [&](const topography::Topography& map) {
    try {
      write(map, folder / "map.stl");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  topography::Topography map = test::small_map();
  map.height.setConstant(test::kNaN);
  map.height(1, 1) = 0;
  EXPECT_THAT(rejection_of(map),
              HasSubstr("no four neighbours have a height; use <fill=harmonic>"));
  topography::Topography row;
  row.grid = {.nx = 4, .ny = 1, .lx = 4e-6, .ly = 1e-6};
  row.height = Field::Zero(1, 4);
  EXPECT_THAT(rejection_of(row), HasSubstr("at least 2 x 2 pixels"));
}

TEST_F(Exchange, OnePixelHasNoPlaceInTextPoints) {
  topography::Topography pixel;
  pixel.grid = {.nx = 1, .ny = 1, .lx = 1e-6, .ly = 1e-6};
  pixel.height = Field::Zero(1, 1);
  EXPECT_THROW(write(pixel, folder / "one.xyz"), InputError);
  write(pixel, folder / "one.txt");
  EXPECT_EQ(read(folder / "one.txt").grid.size(), 1);
}

/// Files of these formats, cut and with flipped bits: read or rejected, never a crash.
TEST_F(Exchange, DamagedFilesNeverBreakTheProgram) {
  ReadOptions options = test::micrometres();
  options.override_unit = true;
  for (const std::string& bytes : {test::netcdf(), test::netcdf_line(), test::container(),
                                   test::mitutoyo(), test::layered_sur(), test::zygo_points()}) {
    for (std::size_t size = 0; size < bytes.size(); size += 11) {
      EXPECT_NO_FATAL_FAILURE(test::rejection(folder, bytes.substr(0, size), options));
    }
    for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 37) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
      EXPECT_NO_FATAL_FAILURE(test::rejection(folder, flipped, options)) << bit;
    }
  }
}

}  // namespace
}  // namespace tabor::scan
