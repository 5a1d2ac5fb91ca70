#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Runs another program with limits of time and memory, and finds it through PATH.
namespace tabor::io {

/// End of a program that was run.
struct Completed {
  int exit_code = -1;      ///< 128 + signal if a signal ended it
  bool timed_out = false;  ///< it was killed because the time limit passed
  std::string output;      ///< first 64 KiB of stdout and stderr together
};

/// Limits of a program beside time; 0: the limits of this process.
struct ProgramLimits {
  std::uint64_t address_space = 0;  ///< [bytes]
  std::uint64_t processor = 0;      ///< [s]
  std::uint64_t file = 0;           ///< [bytes], each that it writes
  bool are_set() const { return address_space > 0 || processor > 0 || file > 0; }
};

/// Returns the full path of a program found through PATH. Empty or relative entries of PATH depend
/// on the working folder, which may hold files of others: they are ignored.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program (no shell: arguments are passed as they are) and waits for it, at most `limit`.
/// `environment` adds to or replaces variables of this process. `waiting` is called a few times a
/// second; what it throws ends the program that runs. It runs in `folder`, if one is given, and
/// does not start if its limits cannot be set. Throws InputError if it cannot be started.
Completed run_program(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment,
                      std::chrono::milliseconds limit, const std::function<void()>& waiting = {},
                      const ProgramLimits& limits = {}, const std::filesystem::path& folder = {});

/// Becomes another program (no shell), with the streams and the environment of this process. Throws
/// InputError if it cannot be started; does not return otherwise.
[[noreturn]] void become_program(const std::filesystem::path& program,
                                 std::vector<std::string> arguments);

/// Temporary folder that exists as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tabor::io
