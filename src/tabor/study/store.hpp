#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/io/file_lock.hpp"
#include "tabor/study/task.hpp"

namespace tabor::study {

/// A folder of results, one file per task. Files appear complete or not at all, so that a program
/// killed at any instant loses at most the tasks in hand.
class Store {
 public:
  enum class Use {
    alone,  ///< nobody else may work on it
    shared  ///< other shards of the same run may
  };

  /// DIR/store of a study's results in DIR (docs/results.md). Makes the folders and takes the lock.
  /// Throws InputError if another sweep holds it, OutputError if the folder cannot be written.
  Store(const std::filesystem::path& directory, Use use);

  /// The same for any folder; `busy` is the message if somebody else holds it.
  Store(const std::filesystem::path& folder, Use use, const std::string& busy);

  const std::filesystem::path& folder() const { return folder_; }
  bool is_shared() const { return use_ == Use::shared; }

  /// Of a study's results.
  std::filesystem::path directory() const { return folder_.parent_path(); }
  std::filesystem::path path(const Task& task) const { return folder_ / task.file; }
  bool has(const Task& task) const { return std::filesystem::exists(path(task)); }
  void remove(const Task& task) const;

  /// For results that outlive their run elsewhere: removes every file of these kinds of tasks and
  /// every lock, and then the folder if nothing else is in it. Nothing may be stored afterwards.
  void discard(const std::vector<std::string>& kinds);

  /// Waits until no other shard works on `name`; `keep_waiting` is asked ten times a second and
  /// throws to give up. Alone, there is nobody to wait for.
  std::optional<io::FileLock> lock(const std::string& name,
                                   const std::function<void()>& keep_waiting) const;

 private:
  std::filesystem::path folder_;
  Use use_;
  io::FileLock lock_;  // on the file "lock"
};

}  // namespace tabor::study
