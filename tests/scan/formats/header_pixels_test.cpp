// Pixels in headers that none can be: named, and overridden in every format that has them.
#include <fmt/format.h>

#include <cstring>
#include <functional>

#include "scan/formats/sample.hpp"
#include "support/container_files.hpp"
#include "support/instrument_files.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::scan {
namespace {

using test::Folder;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

/// Puts a number, in the order of bytes of the machine or the other one, where another stands.
template <typename T>
std::string with(std::string bytes, std::size_t at, T value, bool swap = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  return bytes.replace(at, sizeof(T), raw, sizeof(T));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string written(const std::string& extension) {
  const Folder folder;
  write(test::small_map(), folder / ("map" + extension));
  return test::bytes_of(folder / ("map" + extension));
}

std::string x3p(double pixel) {
  test::ByteFile heights;
  for (const double z : {1.0, 2.0, 3.0, 4.0}) heights.append(z);
  return io::zip({{"main.xml", test::x3p_xml({.increment = fmt::format("{}", pixel)})},
                  {"data.bin", heights.bytes()}});
}

std::string plux(double pixel) {
  const std::string index = fmt::format(
      "<?xml version=\"1.0\"?><xml><GENERAL><IMAGE_SIZE_X>2</IMAGE_SIZE_X><IMAGE_SIZE_Y>2"
      "</IMAGE_SIZE_Y><FOV_X>{}</FOV_X><FOV_Y>4</FOV_Y></GENERAL><LAYER_0><FILENAME_Z>a.raw"
      "</FILENAME_Z></LAYER_0></xml>",
      pixel);
  test::ByteFile heights;
  for (const float z : {1.f, 2.f, 3.f, 4.f}) heights.append(z);
  return io::zip({{"index.xml", index}, {"a.raw", heights.bytes()}});
}

/// The offset of a double or float, so that its place need not be counted out.
template <typename T>
std::size_t place_of(const std::string& bytes, T value) {
  const std::size_t at = bytes.find(std::string_view(reinterpret_cast<char*>(&value), sizeof(T)));
  EXPECT_NE(at, std::string::npos);
  return at;
}

std::string gwy(double pixel) {
  const std::string bytes = written(".gwy");
  return with(bytes, bytes.find(std::string("xreal\0d", 7)) + 7, pixel);
}

std::string h5(double pixel) {
  const Folder folder;
  {
    io::Hdf5Writer writer(folder / "a.h5");
    writer.write("/surface/height", test::small_map().height);
    writer.attribute("/surface", "pixel_x_m", pixel);
    writer.attribute("/surface", "pixel_y_m", 1e-6);
    writer.commit();
  }
  return test::bytes_of(folder / "a.h5");
}

struct HeaderPixel {
  std::string name;
  std::function<std::string(double pixel)> bytes;
  std::string said;  ///< how the header calls it
};

std::vector<HeaderPixel> header_pixels() {
  const auto number = [](double pixel) { return fmt::format("{}", pixel); };
  return {
      {"x3p", x3p, "axis CX"},
      {"plux", plux, "FOV_X"},
      {"gwy", gwy, "xreal"},
      {"h5", h5, "pixel_x_m"},
      {"gsf",
       [=](double pixel) {
         const std::string bytes = written(".gsf");
         const std::size_t at = bytes.find("XReal = ") + 8;
         std::string value = number(pixel);
         value.resize(bytes.find('\n', at) - at, ' ');
         return std::string(bytes).replace(at, value.size(), value);
       },
       "XReal"},
      {"sdf", [](double pixel) { return with(written(".sdf"), 46, pixel); }, "Xscale"},
      {"asdf",
       [=](double pixel) {
         const std::string bytes = written(".asdf");
         const std::size_t at = bytes.find("Xscale = ") + 9;
         return std::string(bytes).replace(at, bytes.find('\n', at) - at, number(pixel));
       },
       "Xscale"},
      {"sur", [](double pixel) { return with(test::plain_sur(), 120, static_cast<float>(pixel)); },
       "a spacing of"},
      {"al3d",
       [=](double pixel) {
         std::string value = number(pixel);
         value.resize(4, '\0');
         return replaced(test::al3d(), std::string("2e-6", 4), value);
       },
       "PixelSizeXMeter"},
      {"opd",
       [](double pixel) {
         const std::string bytes = test::opd();
         return with(bytes, place_of(bytes, 2e-3f), static_cast<float>(pixel));
       },
       "Pixel_size"},
      {"plu", [](double pixel) { return with(test::plu(), 404, static_cast<float>(pixel)); },
       "per column"},
      {"nms", [](double pixel) { return with(test::nms(), 1376, pixel); }, "per column"},
      {"tmd",
       [](double pixel) {
         const std::string bytes = test::tmd();
         return with(bytes, place_of(bytes, 6e-3f), static_cast<float>(pixel));
       },
       "a length of"},
      {"bcr",
       [=](double pixel) {
         std::string value = number(pixel);
         value.resize(4, ' ');
         return replaced(test::bcr(), "xlength = 6000", "xlength = " + value);
       },
       "xlength"},
      {"gwyddion text",
       [=](double pixel) {
         return "# Width: " + number(pixel) + " µm\n# Height: 8 µm\n# Value units: um\n1 2\n3 4\n";
       },
       "width"},
      {"wyko text",
       [=](double pixel) {
         return "h=2 w=2\npixel size=" + number(pixel) +
                " m\ndata unit=um\nheight conversion factor (-> m)=1e-7\n1 2\n3 4\n";
       },
       "pixel size"}};
}

TEST(HeaderPixel, ThatNoneCanBeIsNamedAndMayBeOverridden) {
  const Folder folder;
  ReadOptions options;
  options.pixel_x = 0.5e-6;
  options.pixel_y = 0.25e-6;
  ReadOptions overriding = options;
  overriding.override_unit = true;
  for (const HeaderPixel& header : header_pixels()) {
    for (const double pixel : {0.0, -4.0, test::kNaN}) {
      SCOPED_TRACE(header.name + fmt::format(" {}", pixel));
      const std::string bytes = header.bytes(pixel);
      EXPECT_THAT(test::rejection(folder, bytes),
                  AllOf(HasSubstr("got a pixel of"), HasSubstr(header.said),
                        HasSubstr("<pixel=0.67um> <override_unit>")));
      EXPECT_THAT(test::rejection(folder, bytes, options),
                  AllOf(HasSubstr(header.said), HasSubstr("add <override_unit>")));
      ASSERT_EQ(test::rejection(folder, bytes, overriding), "");
      const topography::Topography map = test::read_bytes(folder, bytes, overriding);
      EXPECT_NEAR(map.grid.dx(), 0.5e-6, 1e-15);
      EXPECT_NEAR(map.grid.dy(), 0.25e-6, 1e-15);
      EXPECT_THAT(texts_of(map.warnings),
                  Contains(AllOf(HasSubstr("overridden"), HasSubstr(header.said))));
    }
  }
}

TEST(HeaderPixel, OfMetroProThatIsNegativeIsNamed) {
  const Folder folder;
  const std::string bytes = with(test::metropro(), 184, -2e-6f, true);
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("its lateral resolution"));
  ReadOptions options;
  options.pixel_x = 1e-6;
  options.override_unit = true;
  EXPECT_NEAR(test::read_bytes(folder, bytes, options).grid.dx(), 1e-6, 1e-15);
}

TEST(HeaderPixel, OfKeyenceThatIsZeroIsNamed) {
  const Folder folder;
  const std::string bytes = with(test::vk4(), 12 + 18 * 4 + 42 * 4, std::uint32_t{0});
  EXPECT_THAT(test::rejection(folder, bytes), HasSubstr("the measuring conditions"));
}

TEST(X3pSize, SaysHowManyHeightsThereAre) {
  const Folder folder;
  test::ByteFile heights;
  for (const double z : {1.0, 2.0, 3.0, 4.0}) heights.append(z);
  const auto of_size = [&](const std::string& nx) {
    return io::zip({{"main.xml", test::x3p_xml({.nx = nx})}, {"data.bin", heights.bytes()}});
  };
  EXPECT_THAT(test::rejection(folder, of_size("3")),
              HasSubstr("got 4 samples; expected 3 x 2 as its header says"));
  EXPECT_THAT(test::rejection(folder, of_size("1")),
              HasSubstr("data.bin of 32 bytes; expected 16 bytes"));
}

}  // namespace
}  // namespace tabor::scan
