#include "tabor/engine/store.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "lock";
constexpr const char* kShardLock = ".lock";  // extension of what lock() makes

bool is_of_kind(const fs::path& file, const std::vector<std::string>& kinds) {
  const std::string name = file.filename().string();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const std::string& kind) { return name.starts_with(kind + "-"); });
}

}  // namespace

Store::Store(const fs::path& folder, Use use, const std::string& busy)
    : folder_(folder),
      use_(use),
      lock_(io::FileLock::take_or_reject(
          folder_ / kLockName,
          use == Use::alone ? io::FileLock::Kind::alone : io::FileLock::Kind::shared, busy)) {
  if (use == Use::alone) io::remove_all_leftovers(folder_);
}

Store::Store(const fs::path& directory, Use use)
    : Store(directory / "store", use,
            directory.string() +
                ": another sweep works on these results; wait for it to end, give another -o, or "
                "split one study with <shard=i/n>") {
  if (use == Use::alone) io::remove_all_leftovers(directory);
}

void Store::remove(const Task& task) const {
  std::error_code error;
  fs::remove(path(task), error);
  if (error) throw OutputError(path(task).string() + ": cannot be removed: " + error.message());
}

void Store::discard(const std::vector<std::string>& kinds) {
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) files.push_back(entry.path());
  for (const fs::path& file : files) {
    const bool is_lock = file.extension() == kShardLock;
    if (is_lock || is_of_kind(file, kinds) || io::is_temporary_name(file)) {
      fs::remove(file, ignored);
    }
  }
  fs::remove(folder_ / kLockName, ignored);  // last: it keeps others away
  fs::remove(folder_, ignored);
}

std::optional<io::FileLock> Store::lock(const std::string& name,
                                        const std::function<void()>& keep_waiting) const {
  if (use_ == Use::alone) return std::nullopt;
  const fs::path file = folder_ / (name + kShardLock);
  for (;;) {
    std::optional<io::FileLock> lock = io::FileLock::take(file, io::FileLock::Kind::alone);
    if (lock) return lock;
    keep_waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace tabor::engine
