#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/engine/task.hpp"
#include "tabor/io/files/file_lock.hpp"

namespace tabor::engine {

/// Folder of results, one file per task. Files appear complete or not at all, so that a program
/// killed at any instant loses at most the running tasks.
class Store {
 public:
  enum class Use {
    alone,  ///< no other process may work on it
    shared  ///< other shards of the same run may
  };

  /// Opens DIR/store of a study's results in DIR (docs/results.md): makes the folders and takes the
  /// lock. Throws InputError if another sweep holds it, OutputError if the folder cannot be
  /// written.
  Store(const std::filesystem::path& directory, Use use);

  /// Opens any folder as a store; `busy` is the message if another process holds it.
  Store(const std::filesystem::path& folder, Use use, const std::string& busy);

  const std::filesystem::path& folder() const { return folder_; }
  bool is_shared() const { return use_ == Use::shared; }

  /// Returns the folder of a study's results.
  std::filesystem::path directory() const { return folder_.parent_path(); }
  std::filesystem::path path(const Task& task) const { return folder_ / task.file; }
  bool has(const Task& task) const { return std::filesystem::exists(path(task)); }
  void remove(const Task& task) const;

  /// Removes every file of these kinds of tasks and every lock, and then the folder if it is empty:
  /// for results that are also stored elsewhere. Nothing may be stored afterwards.
  void discard(const std::vector<std::string>& kinds);

  /// Waits until no other shard works on `name`, and locks it; `keep_waiting` is called ten times a
  /// second and throws to give up. Returns nullopt at once where the store is not shared.
  std::optional<io::FileLock> lock(const std::string& name,
                                   const std::function<void()>& keep_waiting) const;

 private:
  std::filesystem::path folder_;
  Use use_;
  io::FileLock lock_;  // on the file "lock"
};

}  // namespace tabor::engine
