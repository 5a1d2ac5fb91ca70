#pragma once

#include <chrono>
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

/// Full path of a program found through PATH.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program (no shell: arguments are passed as they are) and waits for it, at most `limit`.
/// `environment` adds to or replaces variables of this process. `waiting` is called a few times a
/// second; what it throws ends the program that runs. Throws InputError if it cannot be started.
Completed run_program(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment,
                      std::chrono::milliseconds limit, const std::function<void()>& waiting = {});

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
