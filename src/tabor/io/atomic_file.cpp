#include "tabor/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/regular_file.hpp"

namespace tabor::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".tabor-tmp";

[[noreturn]] void fail(const fs::path& file, const std::string& action, int error) {
  throw OutputError(file.string() + ": cannot " + action + ": " + std::strerror(error));
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (value_ >= 0) {
      ::close(value_);
    }
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }
  bool is_open() const { return value_ >= 0; }
  /// close() may report a delayed write error, so it is asked for it once.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

/// Unique in this process and, by the process number, on this machine.
fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> counter{0};
  return file.parent_path() /
         fmt::format(".{}.{}-{}{}", file.filename().string(), ::getpid(), counter++, kSuffix);
}

void write_all(int descriptor, std::span<const std::byte> bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written < 0) {
      fail(file, "write", errno);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

fs::path written_file(const fs::path& file) {
  constexpr int most_links = 40;  // as the kernel follows
  fs::path target = file;
  std::error_code error;
  for (int n_links = 0; fs::is_symlink(target, error); ++n_links) {
    if (n_links == most_links) {
      fail(file, "write", ELOOP);
    }
    const fs::path link = fs::read_symlink(target, error);
    if (error) {
      fail(file, "write", error.value());
    }
    target = target.parent_path() / link;
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) {
    fail(file, "write", EISDIR);
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw OutputError(file.string() + ": got a device or pipe; expected the name of a file");
  }
  return target;
}

TemporaryFile::TemporaryFile(fs::path file)
    : file_(std::move(file)), target_(written_file(file_)), temporary_(temporary_name(target_)) {
  const Descriptor descriptor(temporary_, O_WRONLY | O_CREAT | O_EXCL);
  if (!descriptor.is_open()) {
    fail(file_, "write", errno);
  }
}

TemporaryFile::~TemporaryFile() {
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
  }
}

void TemporaryFile::commit() {
  Descriptor descriptor(temporary_, O_RDONLY);
  struct stat replaced {};
  if (descriptor.is_open() && ::stat(target_.c_str(), &replaced) == 0) {
    ::fchmod(descriptor.value(), replaced.st_mode & 07777);
  }
  if (!descriptor.is_open() || ::fsync(descriptor.value()) != 0 || !descriptor.close()) {
    fail(file_, "write", errno);
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    fail(file_, "write", errno);
  }
  temporary_.clear();
  // The new name itself lives in the folder. A folder that cannot be synchronised (some network
  // file systems) is no reason to call a written file lost.
  const fs::path folder = target_.parent_path();
  const Descriptor directory(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) {
    ::fsync(directory.value());
  }
}

bool is_temporary_name(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('.') && name.ends_with(kSuffix);
}

void write_file(const fs::path& file, std::span<const std::byte> bytes) {
  TemporaryFile temporary(file);
  {
    Descriptor descriptor(temporary.path(), O_WRONLY | O_TRUNC);
    if (!descriptor.is_open()) {
      fail(file, "write", errno);
    }
    write_all(descriptor.value(), bytes, file);
    if (!descriptor.close()) {
      fail(file, "write", errno);
    }
  }
  temporary.commit();
}

void write_file(const fs::path& file, std::string_view text) {
  write_file(file, std::as_bytes(std::span(text.data(), text.size())));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    fail(folder, "make the folder", error ? error.value() : ENOTDIR);
  }
}

std::string read_text(const fs::path& file, std::size_t max_bytes) {
  const RegularFile opened(file);
  std::string text;
  char block[1 << 16];
  while (const std::size_t n = opened.read(block, sizeof block)) {
    text.append(block, n);
    if (text.size() > max_bytes) {
      throw InputError(file.string(), "more than " + std::to_string(max_bytes) + " bytes",
                       "a small text file", "");
    }
  }
  return text;
}

}  // namespace tabor::io
