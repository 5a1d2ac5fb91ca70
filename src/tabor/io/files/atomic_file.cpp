#include "tabor/io/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/io/files/regular_file.hpp"

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
    if (value_ >= 0) ::close(value_);
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

/// What the names of all temporary files of `file` begin with.
std::string temporary_prefix(const fs::path& file) {
  return fmt::format(".{}.", file.filename().string());
}

/// Unique in this process and, by the process number, on this machine.
fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> counter{0};
  return file.parent_path() /
         fmt::format("{}{}-{}{}", temporary_prefix(file), ::getpid(), counter++, kSuffix);
}

/// True if `name` is the prefix and the two numbers of temporary_name().
bool is_temporary_of(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix) || !name.ends_with(kSuffix)) return false;
  if (name.size() < prefix.size() + kSuffix.size()) return false;
  const std::string_view rest =
      std::string_view(name).substr(prefix.size(), name.size() - prefix.size() - kSuffix.size());
  return rest.find_first_not_of("0123456789-") == std::string_view::npos;
}

bool is_same_file(int descriptor, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Locks are dropped by the system when their process dies, however it dies.
void remove_if_unlocked(const fs::path& path) {
  const Descriptor descriptor(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  struct stat status {};
  if (!descriptor.is_open() || ::fstat(descriptor.value(), &status) != 0) return;
  if (!S_ISREG(status.st_mode) || ::flock(descriptor.value(), LOCK_EX | LOCK_NB) != 0) return;
  if (is_same_file(descriptor.value(), path)) ::unlink(path.c_str());
}

template <typename IsLeftover>
void remove_where(const fs::path& folder, const IsLeftover& is_leftover) {
  std::error_code ignored;
  fs::directory_iterator entries(folder.empty() ? "." : folder, ignored);
  std::vector<fs::path> found;
  for (; entries != fs::directory_iterator(); entries.increment(ignored)) {
    if (is_leftover(entries->path())) found.push_back(entries->path());
  }
  for (const fs::path& path : found) remove_if_unlocked(path);
}

void write_all(int descriptor, std::span<const std::byte> bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(file, "write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

fs::path written_file(const fs::path& file) {
  constexpr int most_links = 40;  // as the kernel follows
  fs::path target = file;
  std::error_code error;
  for (int n_links = 0; fs::is_symlink(target, error); ++n_links) {
    if (n_links == most_links) fail(file, "write", ELOOP);
    const fs::path link = fs::read_symlink(target, error);
    if (error) fail(file, "write", error.value());
    target = target.parent_path() / link;
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) fail(file, "write", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw OutputError(file.string() + ": got a device or pipe; expected the name of a file");
  }
  return target;
}

TemporaryFile::TemporaryFile(fs::path file) : file_(std::move(file)), target_(written_file(file_)) {
  while (!create()) {
  }
}

bool TemporaryFile::create() {
  temporary_ = temporary_name(target_);
  locked_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (locked_ < 0) fail(file_, "write", errno);
  // Somebody who clears up may lock and remove the new file before this process has locked it.
  const bool is_taken = ::flock(locked_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!is_taken && is_same_file(locked_, temporary_)) return true;
  ::close(std::exchange(locked_, -1));
  return false;
}

TemporaryFile::~TemporaryFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (locked_ >= 0) ::close(locked_);
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
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(file_, "write", errno);
  temporary_.clear();
  // The new name itself lives in the folder. A folder that cannot be synchronised (some network
  // file systems) is no reason to call a written file lost.
  const fs::path folder = target_.parent_path();
  const Descriptor directory(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) ::fsync(directory.value());
}

bool is_temporary_name(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('.') && name.ends_with(kSuffix);
}

void remove_leftovers(const fs::path& file) {
  const fs::path target = written_file(file);
  const std::string prefix = temporary_prefix(target);
  remove_where(target.parent_path(), [&](const fs::path& path) {
    return is_temporary_of(path.filename().string(), prefix);
  });
}

void remove_all_leftovers(const fs::path& folder) { remove_where(folder, &is_temporary_name); }

void write_file(const fs::path& file, const std::function<void(const Append&)>& write) {
  TemporaryFile temporary(file);
  {
    Descriptor descriptor(temporary.path(), O_WRONLY | O_TRUNC);
    if (!descriptor.is_open()) fail(file, "write", errno);
    write([&](std::string_view piece) {
      write_all(descriptor.value(), std::as_bytes(std::span(piece.data(), piece.size())), file);
    });
    if (!descriptor.close()) fail(file, "write", errno);
  }
  temporary.commit();
}

void write_file(const fs::path& file, std::span<const std::byte> bytes) {
  write_file(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void write_file(const fs::path& file, std::string_view text) {
  write_file(file, [text](const Append& append) { append(text); });
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
