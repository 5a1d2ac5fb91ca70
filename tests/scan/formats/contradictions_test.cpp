// Files that a reader could take and get wrong: what they leave out, say twice or contradict.
#include <cstring>
#include <functional>

#include "scan/formats/sample.hpp"
#include "support/container_files.hpp"
#include "support/instrument_files.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/scan/formats/gwy_object.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using testing::Contains;
using testing::HasSubstr;

/// X3P of 2 x 2 heights 1 ... 4, whose main.xml a test may edit.
std::string x3p(const std::function<std::string(std::string)>& edit) {
  test::ByteFile heights;
  for (const double z : {1.0, 2.0, 3.0, 4.0}) heights.append(z);
  return io::zip({{"main.xml", edit(test::x3p_xml({}))}, {"data.bin", heights.bytes()}});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string x3p_with(const std::string& from, const std::string& to) {
  return x3p([&](const std::string& xml) { return replaced(xml, from, to); });
}

constexpr const char* kIncrement = "<Increment>1e-6</Increment>";

TEST(X3pContradictions, APixelThatIsNotStatedIsAskedFor) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, x3p_with(kIncrement, "")), HasSubstr("<pixel"));
  EXPECT_THAT(test::rejection(folder, x3p_with(kIncrement, "<Increment/>")), HasSubstr("<pixel"));
  ReadOptions options;
  options.pixel_x = 1e-6;
  EXPECT_DOUBLE_EQ(test::read_bytes(folder, x3p_with(kIncrement, ""), options).grid.dx(), 1e-6);
}

TEST(X3pContradictions, HeightsThatAreAllTheSameByTheirScaleAreRejected) {
  const Folder folder;
  const std::string z = "<CZ><AxisType>A</AxisType><DataType>D</DataType>";
  EXPECT_THAT(test::rejection(folder, x3p_with(z, z + "<Increment>0</Increment>")),
              HasSubstr("Increment of 0"));
}

TEST(X3pContradictions, WholeNumbersOfMetresAreWarnedOf) {
  const Folder folder;
  const std::string xml = replaced(test::x3p_xml({}), "<CZ><AxisType>A</AxisType><DataType>D",
                                   "<CZ><AxisType>A</AxisType><DataType>I");
  test::ByteFile heights;
  for (const std::int16_t z : std::initializer_list<std::int16_t>{1, 2, 3, 4}) heights.append(z);
  const std::string bytes = io::zip({{"main.xml", xml}, {"data.bin", heights.bytes()}});
  EXPECT_THAT(texts_of(test::read_bytes(folder, bytes).warnings),
              Contains(HasSubstr("heights in metres")));
}

TEST(X3pContradictions, AnUnknownKindOfAxisIsRejected) {
  const Folder folder;
  EXPECT_THAT(test::rejection(folder, x3p_with("<AxisType>I", "<AxisType>B")),
              HasSubstr("AxisType 'B'"));
}

TEST(X3pContradictions, CommentsAndPrefixesDoNotChangeWhatIsSaid) {
  const Folder folder;
  const auto commented = x3p_with(kIncrement, "<Increment>1<!-- micro -->e-6</Increment>");
  EXPECT_DOUBLE_EQ(test::read_bytes(folder, commented).grid.dx(), 1e-6);
  const auto prefixed = x3p([](std::string xml) {
    xml = replaced(xml, "<Record1>", "<p:Record1>");
    return replaced(xml, "</Record1>", "</p:Record1>");
  });
  EXPECT_DOUBLE_EQ(test::read_bytes(folder, prefixed).grid.dx(), 1e-6);
}

TEST(X3pContradictions, AnEmptyLinkLeavesTheListOfHeights) {
  const Folder folder;
  const auto both = x3p_with("<DataLink><PointDataLink>data.bin</PointDataLink></DataLink>",
                             "<DataLink/><DataList><Datum>5</Datum><Datum>6</Datum><Datum>7</Datum>"
                             "<Datum>8</Datum></DataList>");
  EXPECT_EQ(test::read_bytes(folder, both).height(1, 1), 8);
}

TEST(X3pContradictions, AChangedMaskIsWarnedOf) {
  const Folder folder;
  const std::string link = "<PointDataLink>data.bin</PointDataLink>";
  test::ByteFile heights;
  for (const double z : {1.0, 2.0, 3.0, 4.0}) heights.append(z);
  const std::string xml =
      replaced(test::x3p_xml({}), link,
               link +
                   "<ValidPointsLink>valid.bin</ValidPointsLink><MD5ChecksumValidPoints>"
                   "00000000000000000000000000000000</MD5ChecksumValidPoints>");
  const topography::Topography map = test::read_bytes(
      folder, io::zip({{"main.xml", xml}, {"data.bin", heights.bytes()}, {"valid.bin", "\x07"}}));
  EXPECT_EQ(topography::count_holes(map), 1);
  EXPECT_THAT(texts_of(map.warnings), Contains(HasSubstr("valid points do not match")));
}

TEST(ArchiveContradictions, TwoScansInOneArchiveAreRejected) {
  const Folder folder;
  const std::string xml = test::x3p_xml({});
  EXPECT_THAT(test::rejection(folder, io::zip({{"a/main.xml", xml}, {"b/main.xml", xml}})),
              HasSubstr("'a/main.xml' and 'b/main.xml'"));
}

TEST(ArchiveContradictions, BackSlashesSeparateFoldersToo) {
  const Folder folder;
  test::ByteFile heights;
  for (const double z : {1.0, 2.0, 3.0, 4.0}) heights.append(z);
  EXPECT_EQ(test::rejection(folder, io::zip({{"scan\\main.xml", test::x3p_xml({})},
                                             {"scan\\data.bin", heights.bytes()}})),
            "");
}

/// tabor's own HDF5 file with something changed by another program.
std::string rejection_of_h5(const Folder& folder,
                            const std::function<void(io::Hdf5Writer& writer)>& write) {
  io::Hdf5Writer writer(folder / "map.h5");
  writer.write("/surface/height", test::small_map().height);
  write(writer);
  writer.commit();
  return test::rejection(folder / "map.h5");
}

/// Pixel centres of the map along one side, a pixel of 1 m.
std::vector<double> centres(Index n) {
  std::vector<double> places;
  for (Index i = 0; i < n; ++i) places.push_back(static_cast<double>(i) + 0.5);
  return places;
}

void write_centres(io::Hdf5Writer& writer) {
  writer.write("/surface/x", centres(5));
  writer.write("/surface/y", centres(4));
}

TEST(Hdf5Contradictions, UnitsOfOthersAreHeeded) {
  const Folder folder;
  EXPECT_EQ(rejection_of_h5(folder,
                            [](io::Hdf5Writer& writer) {
                              write_centres(writer);
                              writer.describe("/surface/height", "um", "height");
                              writer.describe("/surface/x", "nm", "x");
                              writer.describe("/surface/y", "mm", "y");
                            }),
            "");
  const topography::Topography map = read(folder / "map.h5");
  EXPECT_NEAR(map.grid.dx(), 1e-9, 1e-18);
  EXPECT_NEAR(map.grid.dy(), 1e-3, 1e-12);
  EXPECT_NEAR(map.height(1, 1), 1e-6 * test::small_map().height(1, 1), 1e-20);
}

TEST(Hdf5Contradictions, PlacesMustBeEvenAndAsManyAsTheMapHas) {
  const Folder folder;
  const auto with_x = [&](std::vector<double> x) {
    return rejection_of_h5(folder, [&](io::Hdf5Writer& writer) {
      writer.write("/surface/x", x);
      writer.write("/surface/y", centres(4));
    });
  };
  EXPECT_EQ(with_x(centres(5)), "");
  EXPECT_THAT(with_x({0.5, 1.5, 2.5, 3.5, 9.5}), HasSubstr("uneven places in /surface/x"));
  EXPECT_THAT(with_x(centres(4)), HasSubstr("4 places in /surface/x; expected 5"));
  EXPECT_THAT(with_x({}), HasSubstr("0 places in /surface/x"));
}

TEST(Hdf5Contradictions, TwoPixelSizesAreRejected) {
  const Folder folder;
  EXPECT_THAT(rejection_of_h5(folder,
                              [](io::Hdf5Writer& writer) {
                                write_centres(writer);
                                writer.attribute("/surface", "pixel_x_m", 2.0);
                              }),
              HasSubstr("pixel_x_m = 2 m, but other steps"));
}

TEST(Hdf5Contradictions, AMaskOfAnotherShapeIsRejected) {
  const Folder folder;
  EXPECT_THAT(rejection_of_h5(folder,
                              [](io::Hdf5Writer& writer) {
                                write_centres(writer);
                                writer.write("/surface/mask", io::ByteMap(io::ByteMap::Ones(5, 4)));
                              }),
              HasSubstr("/surface/mask of shape 5 x 4; expected 4 x 5"));
}

TEST(Hdf5Contradictions, ANewerFormatIsRejected) {
  const Folder folder;
  EXPECT_THAT(
      rejection_of_h5(folder,
                      [](io::Hdf5Writer& writer) { writer.attribute("/", "format_version", 3); }),
      HasSubstr("format_version 3"));
}

format::GwyBuilder gwy_field(std::int32_t nx, std::int32_t ny, double xreal) {
  format::GwyBuilder metre("GwySIUnit");
  metre.add("unitstr", std::string("m"));
  format::GwyBuilder field("GwyDataField");
  field.add("xres", nx);
  field.add("yres", ny);
  field.add("xreal", xreal);
  field.add("yreal", 2e-6);
  field.add("si_unit_xy", metre);
  field.add("si_unit_z", metre);
  field.add("data", Field(Field::Constant(ny, nx, 1.0)));
  return field;
}

std::string gwy(const std::vector<std::pair<std::string, format::GwyBuilder>>& objects) {
  format::GwyBuilder root("GwyContainer");
  for (const auto& [name, object] : objects) root.add(name, object);
  return "GWYP" + root.bytes();
}

TEST(GwyContradictions, AMaskOfAnotherShapeIsRejected) {
  const Folder folder;
  const auto with_mask = [&](std::int32_t nx, std::int32_t ny) {
    return test::rejection(
        folder, gwy({{"/0/data", gwy_field(3, 2, 3e-6)}, {"/0/mask", gwy_field(nx, ny, 3e-6)}}));
  };
  EXPECT_THAT(with_mask(2, 3), HasSubstr("expected 3 x 2 numbers"));
  EXPECT_THAT(with_mask(3, 2), HasSubstr("no valid height"));  // all under the mask
}

TEST(GwyContradictions, OnlyWholeNumbersAreChannels) {
  const Folder folder;
  test::put_bytes(folder / "a.gwy", gwy({{"/0.5/data", gwy_field(2, 2, 1e-6)},
                                         {"/7/data", gwy_field(3, 2, 3e-6)},
                                         {"/+1/data", gwy_field(2, 2, 1e-6)}}));
  const FileInfo info = inspect(folder / "a.gwy");
  ASSERT_EQ(info.channels.size(), 1u);
  EXPECT_EQ(info.channels[0].index, 7);
}

TEST(GwyContradictions, AWidthThatIsNoLengthIsRejected) {
  const Folder folder;
  for (const double width : {-3e-6, 0.0, test::kNaN}) {
    EXPECT_THAT(test::rejection(folder, gwy({{"/0/data", gwy_field(3, 2, width)}})),
                HasSubstr("got a pixel of"));
  }
}

TEST(GwyContradictions, TheInstrumentComesBackOnce) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.instrument = "profiler";
  write(map, folder / "a.gwy");
  const topography::Topography again = read(folder / "a.gwy");
  EXPECT_EQ(again.instrument, "profiler");
  EXPECT_EQ(again.metadata.count("Instrument"), 0u);
  EXPECT_NO_THROW(write(again, folder / "b.gwy"));
  EXPECT_EQ(read(folder / "b.gwy").instrument, "profiler");
}

TEST(Surplus, BytesBehindTheMapAreWarnedOf) {
  const Folder folder;
  const topography::Topography map = test::small_map();
  for (const char* name : {"a.gsf", "a.npy"}) {
    write(map, folder / name);
    const std::string bytes = test::bytes_of(folder / name);
    const ReadOptions options = name[2] == 'n' ? test::micrometres() : ReadOptions{};
    EXPECT_THAT(texts_of(test::read_bytes(folder, bytes, options).warnings),
                testing::Not(Contains(HasSubstr("bytes follow"))))
        << name;
    EXPECT_THAT(texts_of(test::read_bytes(folder, bytes + "12345", options).warnings),
                Contains(HasSubstr("5 bytes follow the map")))
        << name;
  }
}

std::string npy(const std::string& dictionary) {
  test::ByteFile file;
  file.text(0, "\x93NUMPY").number<std::uint8_t>(6, 2);
  file.number(8, static_cast<std::uint32_t>(dictionary.size())).text(12, dictionary);
  for (int i = 0; i < 6; ++i) file.append(static_cast<double>(i));
  return file.bytes();
}

TEST(NpyContradictions, EveryPythonsSpellingIsUnderstood) {
  const Folder folder;
  for (const char* dictionary :
       {"{'descr': '<f8', 'fortran_order': False, 'shape': (2L, 3L), }",
        "{\"descr\": \"<f8\", \"fortran_order\": False, \"shape\": (2, 3)}",
        "{'descr' : '<f8' , 'fortran_order' :False, 'shape' : (2, 3)}"}) {
    EXPECT_EQ(test::rejection(folder, npy(dictionary), test::micrometres()), "") << dictionary;
  }
  EXPECT_THAT(test::rejection(folder, npy("{'descr': '<f8', 'fortran_order': 1, 'shape': (2, 3)}"),
                              test::micrometres()),
              HasSubstr("fortran_order 1"));
  EXPECT_THAT(test::rejection(folder,
                              npy("{'descr': [('z', '<f8')], 'fortran_order': False, "
                                  "'shape': (2, 3)}"),
                              test::micrometres()),
              HasSubstr("type [('z', '<f8')]"));
}

TEST(Absurd, HeightsThatNoSurfaceHasAreMissingAndSaid) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.height(1, 1) = 3e38;
  map.height(1, 2) = -1e7;
  write(map, folder / "a.gwy");
  const topography::Topography again = read(folder / "a.gwy");
  EXPECT_EQ(topography::count_holes(again), topography::count_holes(map) + 2);
  EXPECT_THAT(texts_of(again.warnings), Contains(HasSubstr("2 heights beyond 1000 km")));
}

TEST(Absurd, PixelsThatNothingCanScanAreRejected) {
  const Folder folder;
  for (const char* increment : {"1e-320", "1e-16", "1e7", "1e300"}) {
    const std::string bytes =
        x3p_with(kIncrement, "<Increment>" + std::string(increment) + "</Increment>");
    EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("from 1e-15 to 1e6 m")) << increment;
    ReadOptions options;
    options.pixel_x = *parse_number(increment);
    EXPECT_THAT(test::rejection(folder, x3p_with(kIncrement, ""), options), HasSubstr("<pixel"))
        << increment;
  }
}

/// A file with a number of its header changed.
template <typename T>
std::string with(std::string bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

std::string with_big(std::string bytes, std::size_t at, std::int16_t value) {
  bytes[at] = static_cast<char>(value >> 8);
  bytes[at + 1] = static_cast<char>(value & 0xFF);
  return bytes;
}

TEST(InstrumentContradictions, MetroProsSignTurnsHeightsOver) {
  const Folder folder;
  const Field up = test::read_bytes(folder, test::metropro()).height;
  const topography::Topography down = test::read_bytes(folder, with_big(test::metropro(), 232, 1));
  EXPECT_TRUE(test::same_bits(down.height, -up));
}

TEST(InstrumentContradictions, MetroProsSizesMustAgree) {
  const Folder folder;
  // A part of the intensities would be read as heights.
  EXPECT_THAT(test::rejection(folder, with_big(test::metropro(), 62, 4)),
              HasSubstr("4 bytes of intensity"));
  EXPECT_THAT(test::rejection(folder, with_big(test::metropro(), 70, 1)),
              testing::AnyOf(HasSubstr("24 of phase"), testing::Eq("")));
}

TEST(InstrumentContradictions, OpdSkipsTheBytesOfUnnamedBlocksAndTakesNumbersByTheirKind) {
  const Folder folder;
  const topography::Topography map = test::read_bytes(folder, test::opd());
  EXPECT_NEAR(map.grid.dx(), 2e-6, 1e-12);
  // Kind of "Mult", the fifth entry.
  const std::string wrong_kind = with(test::opd(), 2 + 4 * 24 + 16, std::int16_t{5});
  EXPECT_THAT(test::rejection(folder, wrong_kind), HasSubstr("'Mult' of kind 5"));
}

TEST(InstrumentContradictions, SizesThatLeaveHeightsOverAreWarnedOfOrRejected) {
  const Folder folder;
  const auto warnings = [&](const std::string& bytes) {
    return texts_of(test::read_bytes(folder, bytes).warnings);
  };
  EXPECT_THAT(warnings(with(test::tmd(), 37, std::uint32_t{2})),
              Contains(HasSubstr("bytes follow")));
  EXPECT_THAT(warnings(test::nms()), testing::Not(Contains(HasSubstr("bytes follow"))));
  EXPECT_THAT(warnings(test::nms() + "x"), Contains(HasSubstr("1 bytes follow")));
  EXPECT_THAT(test::rejection(folder, with(test::plain_sur(), 108, std::int32_t{2})),
              HasSubstr("6 points; expected 2 x 2"));
}

TEST(InstrumentContradictions, HeightsStatedUpsideDownAreWarnedOf) {
  const Folder folder;
  EXPECT_THAT(
      texts_of(test::read_bytes(folder, with(test::plain_sur(), 290, std::int16_t{1})).warnings),
      Contains(HasSubstr("inverted")));
  EXPECT_THAT(texts_of(test::read_bytes(folder, with(test::plain_sur(), 128, -0.5F)).warnings),
              Contains(HasSubstr("negative")));
  EXPECT_THAT(test::rejection(folder, with(test::nms(), 24, -6.0)), HasSubstr("from 1 to -6 um"));
}

TEST(InstrumentContradictions, HeadersThatReachIntoTheDataAreRejected) {
  const Folder folder;
  const auto changed = [](std::string bytes, const std::string& from, const std::string& to) {
    return replaced(std::move(bytes), from, to);
  };
  EXPECT_THAT(test::rejection(folder, changed(test::al3d(), "700", std::string("1\0\0", 3))),
              HasSubstr("depth image at byte 1;"));
  EXPECT_THAT(test::rejection(folder, changed(test::bcr(), "2048", "2046")),
              HasSubstr("2046 characters"));
  EXPECT_THAT(test::rejection(folder, changed(test::bcr(), "bcrstm", "bcrxyz")),
              HasSubstr("fileformat 'bcrxyz'"));
}

TEST(InstrumentContradictions, WhatIsMissingButNotNeededIsNoReasonToReject) {
  const Folder folder;
  const std::string al3d =
      replaced(test::al3d(), "3.000000028e+15", std::string("nan\0          ", 15));
  EXPECT_EQ(test::rejection(folder, al3d), "");
  std::string npl =
      "aNPL-V1.0\nNumPoints = 2\nNumProfiles = 1\nXscale = 1e-6\nYscale = 1e-6\n"
      "Zscale = 1e-9\nCompression = 0\n*\n1 2\n*\n*";
  EXPECT_EQ(test::rejection(folder, npl), "");
  const std::string no_length = replaced(test::bcr(), "xlength", "x_____h");
  EXPECT_THAT(test::rejection(folder, no_length), HasSubstr("<pixel"));
}

/// Names that no text format can hold as they are.
TEST(WrittenText, IsOneLineOfValidCharacters) {
  const Folder folder;
  topography::Topography map = test::small_map();
  map.channel = "two\nlines \x01 caf\xe9 \xc3\xa9";
  map.instrument = "caf\xe9 \x02\n\xc3\xa9\xc3\xa9\xc3\xa9";
  map.source = map.channel;
  map.metadata["Date"] = "yesterday\n<b>";
  for (const char* extension : {".x3p", ".gsf", ".txt", ".sdf", ".asdf", ".gwy", ".h5"}) {
    const auto file = folder / ("a" + std::string(extension));
    write(map, file);
    EXPECT_EQ(test::rejection(file), "") << extension;
  }
  EXPECT_EQ(read(folder / "a.gsf").channel, "two lines   caf? \xc3\xa9");
  EXPECT_EQ(read(folder / "a.x3p").metadata.at("Date"), "1970-01-01T00:00:00");
  map.metadata["Date"] = "2024-02-03T04:05:06.7+01:00";
  write(map, folder / "b.x3p");
  EXPECT_EQ(read(folder / "b.x3p").metadata.at("Date"), "2024-02-03T04:05:06.7+01:00");
}

TEST(EncryptedArchive, SaysWhatToDo) {
  const Folder folder;
  std::string bytes = x3p([](const std::string& xml) { return xml; });
  // Bit 0 of the flags, 6 bytes into the local header and 8 into the central one (ZIP specification
  // 4.3.7, 4.3.12), of every entry.
  for (const auto& [signature, offset] :
       {std::pair<std::string, std::size_t>("PK\x03\x04", 6), {"PK\x01\x02", 8}}) {
    for (std::size_t at = 0; (at = bytes.find(signature, at)) != std::string::npos; ++at) {
      bytes[at + offset] = static_cast<char>(bytes[at + offset] | 1);
    }
  }
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("encrypted"));
}

}  // namespace
}  // namespace tabor::scan
