// ZIP archives made to hurt: bombs, lying directories, names that point elsewhere, XML that grows.
#include <chrono>
#include <cstdlib>

#include "scan/formats/sample.hpp"
#include "tabor/io/files/zip.hpp"

namespace tabor::scan {
namespace {

using io::ZipContent;
using test::Folder;
using test::x3p_xml;

/// Rejected, or read, within 2 s of processor time. What it says.
std::string quick_rejection(const Folder& folder, const std::string& bytes) {
  const std::clock_t start = std::clock();
  const std::string message = test::rejection(folder, bytes);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0) << message;
  return message;
}

const std::string kHeights(4 * sizeof(double), '\1');

/// Converters stay out of it: what no reader takes is rejected at once.
class HostileArchive : public ::testing::Test {
 protected:
  HostileArchive() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nonexistent", 1); }
  ~HostileArchive() override { ::setenv("PATH", path_.c_str(), 1); }

  std::string rejection(const std::vector<ZipContent>& entries) const {
    return quick_rejection(folder, io::zip(entries));
  }

  Folder folder;

 private:
  std::string path_;
};

TEST_F(HostileArchive, SoundOnesAreRead) {
  EXPECT_EQ(rejection({{"main.xml", x3p_xml({})}, {"data.bin", kHeights}}), "");
}

TEST_F(HostileArchive, ADocumentThatUnpacksToAHundredMegabytesIsRejected) {
  const std::string message = rejection({{"main.xml", std::string(std::size_t{100} << 20, ' ')}});
  EXPECT_NE(message.find("at most"), std::string::npos) << message;
}

TEST_F(HostileArchive, DataThatUnpackToMoreThanTheDocumentSaysAreRejected) {
  const std::string message = rejection(
      {{"main.xml", x3p_xml({})}, {"data.bin", std::string(std::size_t{100} << 20, '\0')}});
  EXPECT_NE(message.find("32 bytes as main.xml says"), std::string::npos) << message;
}

TEST_F(HostileArchive, ADirectoryThatLiesAboutSizesIsRejected) {
  std::string bytes =
      io::zip({{"main.xml", x3p_xml({})}, {"data.bin", std::string(std::size_t{100} << 20, '\0')}});
  // Unpacked size in the central directory (ZIP specification 4.3.12: 24 bytes after its
  // signature).
  const std::size_t entry = bytes.rfind("PK\x01\x02");
  const std::uint32_t claimed = 32;
  std::memcpy(bytes.data() + entry + 24, &claimed, sizeof claimed);
  EXPECT_NE(quick_rejection(folder, bytes), "");
  const std::uint32_t huge = 0xFFFFFFF0;
  std::memcpy(bytes.data() + entry + 24, &huge, sizeof huge);
  EXPECT_NE(quick_rejection(folder, bytes), "");
}

TEST_F(HostileArchive, NestedArchivesAreNotUnpacked) {
  std::string bytes = io::zip({{"main.xml", x3p_xml({})}, {"data.bin", kHeights}});
  for (int depth = 0; depth < 20; ++depth) bytes = io::zip({{"inner.zip", bytes}});
  EXPECT_NE(quick_rejection(folder, bytes), "");
  EXPECT_NE(rejection({{"main.xml", bytes}}), "");
}

TEST_F(HostileArchive, OfManyEntriesAreHandledInTime) {
  std::vector<ZipContent> entries;
  for (int i = 0; i < 20000; ++i) entries.push_back({std::to_string(i), ""});
  EXPECT_NE(rejection(entries), "");
  entries.push_back({"main.xml", x3p_xml({})});
  entries.push_back({"data.bin", kHeights});
  EXPECT_EQ(rejection(entries), "");
}

TEST_F(HostileArchive, NothingOutsideIsReadOrWritten) {
  test::put_bytes(folder / "data.bin", kHeights);
  for (const std::string& name : {(folder / "data.bin").string(), std::string("../data.bin"),
                                  std::string("..\\data.bin"), std::string("data.bin")}) {
    const std::string message = rejection({{"main.xml", x3p_xml({.link = name})}});
    EXPECT_NE(message.find("no entry"), std::string::npos) << message;
  }
  const std::size_t n_files = folder.n_files();
  const std::string outside = "../written-by-tabor";
  EXPECT_EQ(rejection({{"main.xml", x3p_xml({.link = outside})}, {outside, kHeights}}), "");
  EXPECT_EQ(folder.n_files(), n_files);
  EXPECT_FALSE(std::filesystem::exists(folder / outside));
}

TEST_F(HostileArchive, ASymbolicLinkIsNotFollowed) {
  const std::string target = (folder / "main.xml").string();
  test::put_bytes(target, x3p_xml({}));
  std::string bytes = io::zip({{"main.xml", target}, {"data.bin", kHeights}});
  // Made by Unix (version made by, byte 5), mode 0120777 in the external attributes (byte 38).
  const std::size_t entry = bytes.find("PK\x01\x02");
  const std::uint32_t attributes = 0120777u << 16;
  bytes[entry + 5] = 3;
  std::memcpy(bytes.data() + entry + 38, &attributes, sizeof attributes);
  const std::string message = quick_rejection(folder, bytes);
  EXPECT_NE(message.find("XML"), std::string::npos) << message;
}

TEST_F(HostileArchive, EntitiesThatGrowAreNotExpanded) {
  std::string entities = "<!DOCTYPE lolz [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c <= 'z'; ++c) {
    entities += std::string("<!ENTITY ") + c + " \"";
    for (int i = 0; i < 10; ++i) entities += std::string("&") + static_cast<char>(c - 1) + ";";
    entities += "\">";
  }
  const std::string laughs = entities + "]>" + x3p_xml({.link = "&z;"});
  EXPECT_NE(rejection({{"main.xml", laughs}, {"data.bin", kHeights}}), "");
  const std::string outside =
      "<!DOCTYPE a [<!ENTITY f SYSTEM \"file:///etc/passwd\">]>" + x3p_xml({.link = "&f;"});
  const std::string message = rejection({{"main.xml", outside}, {"data.bin", kHeights}});
  EXPECT_EQ(message.find("root:"), std::string::npos) << message;
}

TEST_F(HostileArchive, DeeplyNestedXmlIsHandled) {
  const int depth = 200000;
  std::string xml;
  for (int i = 0; i < depth; ++i) xml += "<a>";
  EXPECT_NE(rejection({{"main.xml", xml}}), "");
  for (int i = 0; i < depth; ++i) xml += "</a>";
  EXPECT_NE(rejection({{"main.xml", xml}}), "");
}

TEST_F(HostileArchive, EndlessListsInXmlAreHandledInTime) {
  std::string items =
      "<xml><GENERAL><IMAGE_SIZE_X>2</IMAGE_SIZE_X><IMAGE_SIZE_Y>2</IMAGE_SIZE_Y>"
      "<FOV_X>1</FOV_X><FOV_Y>1</FOV_Y></GENERAL><INFO>";
  for (int i = 0; i < 60000; ++i) items += "<ITEM_" + std::to_string(i) + "/>";
  items += "</INFO>";
  for (int i = 0; i < 20000; ++i) {
    const std::string tag = "LAYER_" + std::to_string(i) + ">";
    items += "<" + tag + "<FILENAME_Z>z</FILENAME_Z></" + tag;
  }
  EXPECT_NO_FATAL_FAILURE(
      rejection({{"index.xml", items + "</xml>"}, {"z", std::string(16, '\1')}}));
}

TEST_F(HostileArchive, AbsurdSizesAreRejected) {
  for (const char* size :
       {"1e300", "-2", "0", "2.5", "nan", "4294967296", "18446744073709551616"}) {
    EXPECT_NE(rejection({{"main.xml", x3p_xml({.nx = size, .ny = size})}, {"data.bin", kHeights}}),
              "")
        << size;
  }
}

}  // namespace
}  // namespace tabor::scan
