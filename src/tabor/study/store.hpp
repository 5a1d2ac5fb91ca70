#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tabor/io/file_lock.hpp"
#include "tabor/study/case.hpp"

namespace tabor::study {

/// The folder a study's results are kept in: DIR/store, one file per unit (docs/results.md). Files
/// appear complete or not at all, so that a program killed at any instant loses at most the unit in
/// hand.
class Store {
 public:
  enum class Use {
    alone,  ///< nobody else may work on it
    shared  ///< other shards of the same study may
  };

  /// Makes the folders and takes the lock. Throws InputError if another sweep holds it, OutputError
  /// if the folder cannot be written.
  Store(const std::filesystem::path& directory, Use use);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path path(const Unit& unit) const { return folder_ / unit.file; }
  bool has(const Unit& unit) const { return std::filesystem::exists(path(unit)); }
  void remove(const Unit& unit) const;

  /// Waits until no other shard works on `name`; `keep_waiting` is asked ten times a second and
  /// throws to give up. Alone, there is nobody to wait for.
  std::optional<io::FileLock> lock(const std::string& name,
                                   const std::function<void()>& keep_waiting) const;

 private:
  std::filesystem::path directory_;
  std::filesystem::path folder_;
  Use use_;
  io::FileLock lock_;
};

}  // namespace tabor::study
