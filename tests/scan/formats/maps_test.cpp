// Maps of results, as other programs read them.
#include "tabor/scan/maps.hpp"

#include <cstring>

#include "scan/formats/sample.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using test::kNaN;

Field pressures() {
  Field values(2, 3);
  values << 0, 1.5e6, 2e6, kNaN, 3e6, 0.1;
  return values;
}

Field states() {
  Field values(2, 3);
  values << 0, 1, 1, 0, 1, 0;
  return values;
}

MapSet two_maps() {
  return {
      .grid = {.nx = 3, .ny = 2, .lx = 3e-6, .ly = 4e-6},
      .maps = {
          {.name = "pressure", .unit = "Pa", .load = pressures},
          {.name = "contact", .unit = "1", .load = states, .precision = io::Precision::float32}}};
}

MapSet one_map() {
  MapSet set = two_maps();
  set.maps.pop_back();
  return set;
}

std::string rejection_of(const MapSet& maps, const std::filesystem::path& file) {
  try {
    write(maps, file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The numbers of a DataArray, row 0 on top again.
template <typename Number>
Field array_in(const std::string& vti, const std::string& name) {
  const std::size_t tag = vti.find("Name=\"" + name + "\"");
  const std::size_t offset = vti.find("offset=\"", tag) + 8;
  const std::size_t data = vti.find("\n_") + 2 + std::stoul(vti.substr(offset));
  std::uint64_t size = 0;
  std::memcpy(&size, vti.data() + data, sizeof size);
  EXPECT_EQ(size, 6 * sizeof(Number)) << name;
  Eigen::Array<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(2, 3);
  std::memcpy(values.data(), vti.data() + data + sizeof size, 6 * sizeof(Number));
  return values.template cast<double>().colwise().reverse();
}

TEST(MapSet, StandsInOneVtiWithItsUnits) {
  const Folder folder;
  write(two_maps(), folder / "maps.vti");
  const std::string vti = test::bytes_of(folder / "maps.vti");
  EXPECT_TRUE(test::same_bits(array_in<double>(vti, "pressure"), pressures()));
  EXPECT_TRUE(test::same_bits(array_in<float>(vti, "contact"), states()));
  EXPECT_NE(vti.find("location=\"vtkDataArray\">Pa<"), std::string::npos);
  EXPECT_NE(vti.find("Spacing=\"1e-06 2e-06 1\""), std::string::npos);
  EXPECT_TRUE(vti.ends_with("</AppendedData>\n</VTKFile>\n"));
}

TEST(MapSet, IsChannelsOfOneGwy) {
  const Folder folder;
  write(two_maps(), folder / "maps.gwy");
  const FileInfo info = inspect(folder / "maps.gwy");
  ASSERT_EQ(info.channels.size(), 2u);
  EXPECT_EQ(info.channels[0].name, "pressure");
  EXPECT_EQ(info.channels[0].unit, "Pa");
  EXPECT_EQ(info.channels[1].name, "contact");
  MapSet heights = one_map();
  heights.maps[0].unit = "m";
  heights.maps[0].load = [] { return Field(1e-9 * pressures()); };
  write(heights, folder / "heights.gwy");
  const topography::Topography read_back = read(folder / "heights.gwy");
  EXPECT_TRUE(test::same_bits(read_back.height, 1e-9 * pressures()));  // and the hole
}

TEST(MapSet, IsATableOfPixelsInCsv) {
  const Folder folder;
  write(two_maps(), folder / "maps.csv");
  const io::CsvTable table = io::read_csv(folder / "maps.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x_m", "y_m", "pressure_Pa", "contact"}));
  ASSERT_EQ(table.rows.size(), 6u);
  for (std::size_t row = 0; row < 6; ++row) {
    const auto x = static_cast<double>(row % 3), y = static_cast<double>(row / 3);
    EXPECT_NEAR(table.number(row, "x_m"), (x + 0.5) * 1e-6, 1e-18);
    EXPECT_NEAR(table.number(row, "y_m"), (y + 0.5) * 2e-6, 1e-18);
    EXPECT_EQ(table.number(row, "contact"), states().data()[row]);
    if (row == 3) continue;
    EXPECT_EQ(table.number(row, "pressure_Pa"), pressures().data()[row]);
  }
  EXPECT_EQ(table.text(3, "pressure_Pa"), "");  // a hole
}

TEST(MapSet, OfOneMapIsWrittenInEveryFormat) {
  const Folder folder;
  for (const std::string& extension : map_extensions()) {
    write(one_map(), folder / ("map" + extension));
    EXPECT_TRUE(std::filesystem::exists(folder / ("map" + extension))) << extension;
  }
  const std::string text = test::bytes_of(folder / "map.txt");
  EXPECT_NE(text.find("# Channel: pressure\n"), std::string::npos);
  EXPECT_NE(text.find("# Value units: Pa\n0\t1500000\t2000000\nnan"), std::string::npos);
  EXPECT_EQ(test::bytes_of(folder / "map.xyz").find("# x [m] y [m] pressure [Pa]\n"), 0u);
}

TEST(MapSet, OfFloat32StaysFloat32InNpy) {
  const Folder folder;
  MapSet set = one_map();
  set.maps[0].precision = io::Precision::float32;
  set.maps[0].unit = "m";
  write(set, folder / "map.npy");
  EXPECT_NE(test::bytes_of(folder / "map.npy").find("'<f4'"), std::string::npos);
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.unit = "nm";
  const Field read_back = read(folder / "map.npy", options).height;
  EXPECT_EQ(read_back(0, 1), 1.5e6 * 1e-9);
}

TEST(MapSet, OfSeveralMapsIsRejectedInAFileOfOne) {
  const Folder folder;
  for (const char* name : {"maps.npy", "maps.txt", "maps.xyz"}) {
    const std::string line = rejection_of(two_maps(), folder / name);
    EXPECT_NE(line.find("2 maps"), std::string::npos) << line;
    EXPECT_NE(line.find(".vti .gwy .csv"), std::string::npos) << line;
  }
  EXPECT_NE(rejection_of(one_map(), folder / "map.x3p").find(".vti .gwy .csv .xyz .npy .txt"),
            std::string::npos);
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(MapSet, LeavesNothingBehindOnAFullDisk) {
  const Folder folder;
  const test::FullDisk disk(100);
  for (const std::string& extension : map_extensions()) {
    EXPECT_THROW(write(one_map(), folder / ("map" + extension)), OutputError) << extension;
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

}  // namespace
}  // namespace tabor::scan
