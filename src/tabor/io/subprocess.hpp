#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tabor::io {

/// How a program that was run ended.
struct Completed {
  int exit_code = -1;      ///< 128 + signal if a signal ended it
  bool timed_out = false;  ///< it was killed because the time limit passed
  std::string output;      ///< first 64 KiB of stdout and stderr together
};

/// What a program may take beside time; 0: what this process may.
struct ProgramLimits {
  std::uint64_t address_space = 0;  ///< [bytes]
  std::uint64_t processor = 0;      ///< [s]
  std::uint64_t file = 0;           ///< [bytes], each that it writes
  bool are_set() const { return address_space > 0 || processor > 0 || file > 0; }
};

/// Full path of a program found through PATH. Entries of PATH that are empty or relative lead into
/// whatever folder somebody works in, perhaps one with files of others: they are left out.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program (no shell: arguments are passed as they are) and waits for it, at most `limit`.
/// `environment` adds to or replaces variables of this process. `waiting` is called a few times a
/// second; what it throws ends the program that runs. It works in `folder`, if one is given, and
/// does not begin without its limits. Throws InputError if it cannot be started.
Completed run_program(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment,
                      std::chrono::milliseconds limit, const std::function<void()>& waiting = {},
                      const ProgramLimits& limits = {}, const std::filesystem::path& folder = {});

/// A folder that exists as long as this object.
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
