#include "tabor/study/store.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/atomic_file.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

}  // namespace

Store::Store(const fs::path& directory, Use use)
    : directory_(directory),
      folder_(directory / "store"),
      use_(use),
      lock_(io::FileLock::take_or_refuse(
          folder_ / "lock",
          use == Use::alone ? io::FileLock::Kind::alone : io::FileLock::Kind::shared,
          directory.string() +
              ": another sweep works on these results; wait for it to end, give another -o, or "
              "split one study with --shard i/n")) {
  if (use == Use::alone) {
    io::remove_all_leftovers(directory_);
    io::remove_all_leftovers(folder_);
  }
}

void Store::remove(const Unit& unit) const {
  std::error_code error;
  fs::remove(path(unit), error);
  if (error) {
    throw OutputError(path(unit).string() + ": cannot be removed: " + error.message());
  }
}

std::optional<io::FileLock> Store::lock(const std::string& name,
                                        const std::function<void()>& keep_waiting) const {
  if (use_ == Use::alone) {
    return std::nullopt;
  }
  const fs::path file = folder_ / (name + ".lock");
  for (;;) {
    std::optional<io::FileLock> lock = io::FileLock::take(file, io::FileLock::Kind::alone);
    if (lock) {
      return lock;
    }
    keep_waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace tabor::study
