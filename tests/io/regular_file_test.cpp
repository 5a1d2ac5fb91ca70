// Every file of a user is opened in one way, which neither waits nor reads without end.
#include "tabor/io/files/regular_file.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <functional>
#include <map>

#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/files/mapped_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/image/png.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/io/text/toml.hpp"

namespace tabor::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder with one of everything that is no file of bytes.
class RegularFiles : public testing::Test {
 protected:
  RegularFiles() {
    ::mkfifo((folder_ / "pipe").c_str(), 0600);
    fs::create_directory(folder_ / "folder");
    fs::create_symlink("/dev/zero", folder_ / "endless");
    fs::create_symlink(folder_ / "pipe", folder_ / "link");
    socket_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder_ / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
    ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  ~RegularFiles() override { ::close(socket_); }

  test::Folder folder_;
  int socket_ = -1;
};

TEST_F(RegularFiles, NothingElseIsOpenedWhoeverReads) {
  const std::map<std::string, std::function<void(const fs::path&)>> readers{
      {"file", [](const fs::path& file) { RegularFile{file}; }},
      {"mapped", [](const fs::path& file) { MappedFile{file}; }},
      {"text", [](const fs::path& file) { read_text(file); }},
      {"csv", [](const fs::path& file) { read_csv(file); }},
      {"json", [](const fs::path& file) { read_json(file); }},
      {"toml", [](const fs::path& file) { Config::read(file); }},
      {"png", [](const fs::path& file) { read_png(file); }},
      {"digest", [](const fs::path& file) { sha256_of_file(file); }},
      {"hdf5", [](const fs::path& file) { Hdf5Reader{file}; }}};
  for (const auto& [name, read] : readers) {
    for (const std::string what : {"pipe", "folder", "endless", "link", "socket"}) {
      EXPECT_THAT(test::rejection([&, reader = &read] { (*reader)(folder_ / what); }),
                  HasSubstr("a folder, device or pipe"))
          << name << " " << what;
    }
    EXPECT_THAT(test::rejection([&, reader = &read] { (*reader)(folder_ / "absent"); }),
                HasSubstr("no such file"))
        << name;
  }
}

TEST_F(RegularFiles, ALinkToAFileIsAFile) {
  test::put_bytes(folder_ / "a", "abc");
  fs::create_symlink(folder_ / "a", folder_ / "b");
  EXPECT_EQ(read_text(folder_ / "b"), "abc");
}

TEST_F(RegularFiles, WhoWatchesADigestMayStopIt) {
  struct Stop {};
  test::put_bytes(folder_ / "a", std::string(3 << 20, 'a'));
  int n_calls = 0;
  EXPECT_THROW(sha256_of_file(folder_ / "a",
                              [&] {
                                if (++n_calls == 2) throw Stop();
                              }),
               Stop);
  EXPECT_EQ(n_calls, 2);
}

}  // namespace
}  // namespace tabor::io
