#include "tabor/study/store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/atomic_file.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

int open_lock_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw OutputError(file.string() + ": cannot write: " + std::strerror(errno));
  }
  return descriptor;
}

/// True if the lock was taken, false if somebody else has it.
bool try_lock(int descriptor, int kind, const fs::path& file) {
  while (::flock(descriptor, kind | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) {
      return false;
    }
    if (errno != EINTR) {
      throw OutputError(file.string() + ": cannot be locked: " + std::strerror(errno));
    }
  }
  return true;
}

void remove_leftovers(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (io::is_temporary_name(entry.path())) {
      std::error_code ignored;
      fs::remove(entry.path(), ignored);
    }
  }
}

fs::path made_folder(const fs::path& folder) {
  io::make_folder(folder);
  return folder;
}

}  // namespace

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);  // drops the lock
  }
}

Store::Store(const fs::path& directory, Use use)
    : directory_(directory),
      folder_(made_folder(directory / "store")),
      use_(use),
      lock_(open_lock_file(folder_ / "lock")) {
  if (!try_lock(lock_.descriptor_, use == Use::alone ? LOCK_EX : LOCK_SH, folder_ / "lock")) {
    throw InputError(directory.string() +
                     ": another sweep works on these results; wait for it to end, give another -o, "
                     "or split one study with --shard i/n");
  }
  if (use == Use::alone) {
    remove_leftovers(directory_);
    remove_leftovers(folder_);
  }
}

void Store::remove(const Unit& unit) const {
  std::error_code error;
  fs::remove(path(unit), error);
  if (error) {
    throw OutputError(path(unit).string() + ": cannot be removed: " + error.message());
  }
}

FileLock Store::lock(const std::string& name, const std::function<void()>& keep_waiting) const {
  if (use_ == Use::alone) {
    return FileLock(-1);
  }
  const fs::path file = folder_ / (name + ".lock");
  FileLock lock(open_lock_file(file));
  while (!try_lock(lock.descriptor_, LOCK_EX, file)) {
    keep_waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return lock;
}

}  // namespace tabor::study
