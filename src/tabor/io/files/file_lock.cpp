#include "tabor/io/files/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::io {
namespace {

/// Descriptors of all locks, and of those that are being tried.
struct Registry {
  std::mutex mutex;
  std::vector<int> descriptors;
};

Registry& registry() {
  static auto* const instance = new Registry;  // locks may be dropped at the end of the program
  return *instance;
}

int open_registered(const std::filesystem::path& file) {
  Registry& all = registry();
  const std::lock_guard guard(all.mutex);
  all.descriptors.reserve(all.descriptors.size() + 1);
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0) all.descriptors.push_back(descriptor);
  return descriptor;
}

void close_registered(int descriptor) {
  Registry& all = registry();
  const std::lock_guard guard(all.mutex);
  std::erase(all.descriptors, descriptor);
  ::close(descriptor);
}

/// True if the lock was taken, false if others' exclude it.
bool try_lock(int descriptor, FileLock::Kind kind, const std::filesystem::path& file) {
  const int operation = (kind == FileLock::Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
  while (::flock(descriptor, operation) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) {
      throw OutputError(file.string() + ": cannot be locked: " + std::strerror(errno));
    }
  }
  return true;
}

/// False once somebody has removed or replaced the file.
bool is_still(const std::filesystem::path& file, int descriptor) {
  struct stat there {};
  struct stat opened {};
  return ::stat(file.c_str(), &there) == 0 && ::fstat(descriptor, &opened) == 0 &&
         there.st_dev == opened.st_dev && there.st_ino == opened.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::filesystem::path& file, Kind kind) {
  for (;;) {
    const int descriptor = open_registered(file);
    if (descriptor < 0) {
      throw OutputError(file.string() + ": cannot write: " + std::strerror(errno));
    }
    FileLock lock(descriptor);
    if (!try_lock(descriptor, kind, file)) return std::nullopt;
    if (is_still(file, descriptor)) return lock;
  }
}

FileLock FileLock::take_or_reject(const std::filesystem::path& file, Kind kind,
                                  const std::string& rejection) {
  make_folder(file.parent_path());
  std::optional<FileLock> lock = take(file, kind);
  if (!lock) throw InputError(rejection);
  return std::move(*lock);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close_registered(descriptor_);  // drops the lock
}

HeldLocks::HeldLocks() : guard_(registry().mutex) {}

void HeldLocks::let_go() const {
  for (const int descriptor : registry().descriptors) ::close(descriptor);
}

}  // namespace tabor::io
