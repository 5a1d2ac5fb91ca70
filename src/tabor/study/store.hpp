#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tabor/study/case.hpp"

namespace tabor::study {

/// A lock on a file, shared with other processes, held as long as the object lives. The system
/// drops it when a process dies, however it dies.
class FileLock {
 public:
  FileLock(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  friend class Store;
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

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
  FileLock lock(const std::string& name, const std::function<void()>& keep_waiting) const;

 private:
  std::filesystem::path directory_;
  std::filesystem::path folder_;
  Use use_;
  FileLock lock_;
};

}  // namespace tabor::study
