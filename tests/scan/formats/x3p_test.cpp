#include "scan/formats/sample.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::scan {
namespace {

using test::Folder;

struct Parts {
  std::string feature = "SUR";
  std::string y_type = "I";
  std::string z_type = "D";
  std::string y_scale = "<Increment>2e-6</Increment><Offset/>";
  std::string z_scale;
  std::string size = "<SizeX>2</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ>";
  std::string rotation;
  std::string data = "<DataLink><PointDataLink>bindata\\data.bin</PointDataLink></DataLink>";
};

std::string xml(const Parts& parts) {
  const auto axis = [](const std::string& name, const std::string& type, const std::string& data,
                       const std::string& rest) {
    return "<" + name + "><AxisType>" + type + "</AxisType><DataType>" + data + "</DataType>" +
           rest + "</" + name + ">";
  };
  return "<?xml version=\"1.0\"?><p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">"
         "<Record1><Revision>ISO5436 – 2000</Revision><FeatureType>" +
         parts.feature + "</FeatureType><Axes>" +
         axis("CX", "I", "D", "<Increment>1e-6</Increment>") +
         axis("CY", parts.y_type, "D", parts.y_scale) +
         axis("CZ", "A", parts.z_type, parts.z_scale) + parts.rotation +
         "</Axes></Record1><Record3><MatrixDimension>" + parts.size + "</MatrixDimension>" +
         parts.data + "</Record3></p:ISO5436_2>";
}

template <typename T>
std::string binary(std::initializer_list<T> values) {
  test::ByteFile bytes;
  for (const T value : values) bytes.append(value);
  return bytes.bytes();
}

std::string archive(const Parts& parts, const std::string& data, const std::string& folder = "") {
  return io::zip({{"__MACOSX/main.xml", "junk"},
                  {folder + "main.xml", xml(parts)},
                  {folder + "bindata/data.bin", data}});
}

Field square(double a, double b, double c, double d) {
  Field field(2, 2);
  field << a, b, c, d;
  return field;
}

TEST(X3p, ToleratesTopFoldersBackSlashesAndEmptyOffsets) {
  const Folder folder;
  const topography::Topography map =
      test::read_bytes(folder, archive({}, binary({1.0, 2.0, test::kNaN, 4.0}), "scan/"));
  EXPECT_TRUE(test::same_bits(map.height, square(1, 2, test::kNaN, 4)));
  EXPECT_NEAR(map.grid.dy(), 2e-6, 1e-18);
}

TEST(X3p, IntegersAreSignedAndScaledByTheIncrement) {
  const Folder folder;
  Parts parts;
  parts.z_type = "I";
  parts.z_scale = "<Increment>0.5</Increment><Offset>10</Offset>";
  const topography::Topography map =
      test::read_bytes(folder, archive(parts, binary<std::int16_t>({-2, 0, 2, 4})));
  EXPECT_TRUE(test::same_bits(map.height, square(9, 10, 11, 12)));
}

TEST(X3p, ListedHeightsTakeTheLastCoordinateAndEmptyOnesAreHoles) {
  const Folder folder;
  Parts parts;
  parts.data =
      "<DataList><Datum>1</Datum><Datum>0;1;2</Datum><Datum/><Datum>4e0</Datum></DataList>";
  EXPECT_TRUE(test::same_bits(test::read_bytes(folder, archive(parts, "")).height,
                              square(1, 2, test::kNaN, 4)));
}

TEST(X3p, LayersAreChannels) {
  const Folder folder;
  Parts parts;
  parts.size = "<SizeX>2</SizeX><SizeY>1</SizeY><SizeZ>2</SizeZ>";
  const std::string bytes = archive(parts, binary({1.0, 2.0, 3.0, 4.0}));
  EXPECT_NE(test::rejection(folder, bytes).find("<channel"), std::string::npos);
  ReadOptions options;
  options.channel = "layer 1";
  EXPECT_EQ(test::read_bytes(folder, bytes, options).height(0, 0), 3);
}

TEST(X3p, PointCloudsAndIrregularAxesAreRejectedWithTheReason) {
  const Folder folder;
  Parts cloud;
  cloud.feature = "PCL";
  EXPECT_NE(test::rejection(folder, archive(cloud, "")).find("point cloud"), std::string::npos);
  Parts irregular;
  irregular.y_type = "A";
  EXPECT_NE(test::rejection(folder, archive(irregular, "")).find("evenly spaced"),
            std::string::npos);
}

TEST(X3p, SizesThatContradictTheDataAreRejectedBeforeAllocating) {
  const Folder folder;
  const std::string data = binary({1.0, 2.0, 3.0, 4.0});
  Parts larger;
  larger.size = "<SizeX>3</SizeX><SizeY>2</SizeY>";
  EXPECT_NE(test::rejection(folder, archive(larger, data)).find("got 4 samples; expected 3 x 2"),
            std::string::npos);
  for (const char* size :
       {"<SizeX>1000000000</SizeX><SizeY>1000000000</SizeY>", "<SizeX>0</SizeX><SizeY>2</SizeY>",
        "<SizeX>-2</SizeX><SizeY>-2</SizeY>", "<SizeX>nan</SizeX><SizeY>2</SizeY>",
        "<SizeX>1e300</SizeX><SizeY>1e300</SizeY>"}) {
    Parts absurd;
    absurd.size = size;
    EXPECT_NE(test::rejection(folder, archive(absurd, data)), "") << size;
  }
}

/// Each layer becomes a channel: a million of them would be listed for minutes.
TEST(X3p, MoreLayersThanAnyInstrumentWritesAreRejected) {
  const Folder folder;
  const std::string zeros(std::size_t{1001} * 4 * sizeof(double), '\0');
  Parts most;
  most.size = "<SizeX>2</SizeX><SizeY>2</SizeY><SizeZ>1000</SizeZ>";
  test::put_bytes(folder / "scan.bin", archive(most, zeros.substr(4 * sizeof(double))));
  EXPECT_EQ(inspect(folder / "scan.bin").channels.size(), 1000u);
  Parts more;
  more.size = "<SizeX>2</SizeX><SizeY>2</SizeY><SizeZ>1001</SizeZ>";
  EXPECT_NE(
      test::rejection(folder, archive(more, zeros)).find("1001 layers; expected at most 1000"),
      std::string::npos);
}

TEST(X3p, ZipWithoutMainXmlIsRejectedByName) {
  const Folder folder;
  const std::string message = test::rejection(folder, io::zip({{"readme.txt", "hello"}}));
  EXPECT_NE(message.find("without main.xml"), std::string::npos) << message;
}

TEST(X3p, ZipBombIsRejectedWithoutUnpackingIt) {
  const Folder folder;
  const std::string bomb = io::zip({{"main.xml", std::string(std::size_t{65} << 20, '\0')}});
  EXPECT_LT(bomb.size(), 1u << 17);
  EXPECT_NE(test::rejection(folder, bomb).find("at most"), std::string::npos);
  const std::string zeros(std::size_t{1} << 20, '\0');
  EXPECT_NE(test::rejection(folder, io::zip({{"main.xml", xml({})}, {"bindata/data.bin", zeros}}))
                .find("32 bytes as main.xml says"),
            std::string::npos);
}

TEST(X3p, BrokenXmlIsRejected) {
  const Folder folder;
  EXPECT_NE(test::rejection(folder, io::zip({{"main.xml", "<a><b></a>"}})).find("XML"),
            std::string::npos);
  EXPECT_NE(test::rejection(folder, io::zip({{"main.xml", "<a/>"}})), "");
}

TEST(X3p, ChangedDataAreWarnedOf) {
  const Folder folder;
  Parts parts;
  parts.data =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
      "<MD5ChecksumPointData>00000000000000000000000000000000</MD5ChecksumPointData></DataLink>";
  const topography::Topography map =
      test::read_bytes(folder, archive(parts, binary({1.0, 2.0, 3.0, 4.0})));
  ASSERT_FALSE(map.warnings.empty());
  EXPECT_NE(map.warnings.front().text.find("MD5"), std::string::npos);
}

TEST(X3p, ProfilesNeedNoSecondIncrement) {
  const Folder folder;
  Parts parts;
  parts.size = "<SizeX>4</SizeX><SizeY>1</SizeY><SizeZ>1</SizeZ>";
  for (const char* scale : {"", "<Increment>0</Increment>"}) {
    parts.y_scale = scale;
    const topography::Topography map =
        test::read_bytes(folder, archive(parts, binary({1.0, 2.0, 3.0, 5.0})));
    EXPECT_NEAR(map.grid.dy(), 1e-6, 1e-18);
  }
}

TEST(X3p, ANegativeIncrementOfHeightsIsWarnedOf) {
  const Folder folder;
  Parts parts;
  parts.z_scale = "<Increment>-1e-6</Increment>";
  const topography::Topography map =
      test::read_bytes(folder, archive(parts, binary({1.0, 2.0, 3.0, 5.0})));
  EXPECT_DOUBLE_EQ(map.height(1, 1), -5e-6);
  ASSERT_FALSE(map.warnings.empty());
  EXPECT_NE(map.warnings.front().text.find("negative"), std::string::npos);
}

TEST(X3p, ARotationOfItsAxesIsSaid) {
  const Folder folder;
  const std::string data = binary({1.0, 2.0, 3.0, 5.0});
  const auto is_said = [&](const std::string& r11) {
    Parts parts;
    parts.rotation = "<Rotation><r11>" + r11 + "</r11><r12>0.0</r12></Rotation>";
    const topography::Topography map = test::read_bytes(folder, archive(parts, data));
    return !map.warnings.empty() && map.warnings.front().text.find("Rotation") != std::string::npos;
  };
  EXPECT_TRUE(is_said("-1"));
  EXPECT_FALSE(is_said("1.0"));
  EXPECT_FALSE(is_said(""));
}

}  // namespace
}  // namespace tabor::scan
