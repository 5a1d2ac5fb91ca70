#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

// Locks files between processes.
namespace tabor::io {

/// Locks a file against other processes as long as the object lives. The system releases the lock
/// when the process ends, however it ends.
class FileLock {
 public:
  enum class Kind {
    alone,  ///< no other process may have one
    shared  ///< others may have shared ones
  };

  /// Takes a lock and makes the file if there is none. Returns nullopt if others' locks exclude
  /// this one. Throws OutputError.
  static std::optional<FileLock> take(const std::filesystem::path& file, Kind kind);

  /// Takes a lock and also makes the folder if there is none. Throws InputError with the text
  /// `rejection` if others' locks exclude this one.
  static FileLock take_or_reject(const std::filesystem::path& file, Kind kind,
                                 const std::string& rejection);

  FileLock(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Guards the locks of this process: while it lives none is taken or released, so that a copy of
/// the process (fork) made meanwhile knows the locks that it has inherited and would otherwise
/// hold.
class HeldLocks {
 public:
  HeldLocks();
  /// Releases the inherited locks in the copy. Only calls close(), as the copy may have been made
  /// at any moment.
  void let_go() const;

 private:
  std::lock_guard<std::mutex> guard_;
};

}  // namespace tabor::io
