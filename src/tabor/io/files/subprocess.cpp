#include "tabor/io/files/subprocess.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

extern char** environ;

namespace tabor::io {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kMaxOutput = std::size_t{64} * 1024;

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string name = split(*entry, '=').front();
    if (!changes.contains(name)) variables.emplace_back(*entry);
  }
  for (const auto& [name, value] : changes) {
    std::string& variable = variables.emplace_back(name);
    variable.append("=").append(value);
  }
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// The child's standard streams: nothing to read, both outputs into the pipe; its own process
/// group, so that its children can be killed with it.
pid_t spawn(const std::string& program, std::vector<std::string> arguments,
            std::vector<std::string> environment, const std::array<int, 2>& pipe_ends,
            const std::filesystem::path& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  arguments.insert(arguments.begin(), program);
  pid_t child = -1;
  const int error = posix_spawn(&child, program.c_str(), &actions, &attributes,
                                pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    throw InputError("cannot start " + program + ": " + std::strerror(error));
  }
  return child;
}

void end(pid_t child, int& status) {
  kill(-child, SIGKILL);
  waitpid(child, &status, 0);
}

std::string lower_of(std::uint64_t limit, __rlimit_resource resource, std::uint64_t unit) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) now.rlim_max = RLIM_INFINITY;
  const std::uint64_t lowest =
      std::min<std::uint64_t>(now.rlim_max, limit == 0 ? RLIM_INFINITY : limit);
  return lowest == RLIM_INFINITY ? "unlimited"
                                 : std::to_string(std::max<std::uint64_t>(1, lowest / unit));
}

/// The words of a shell that sets the limits and becomes the program: it cannot begin without them.
std::vector<std::string> limited(const std::string& program, const std::vector<std::string>& words,
                                 const ProgramLimits& limits) {
  std::vector<std::string> all{
      "-c",
      R"(ulimit -v "$1" && ulimit -t "$2" && ulimit -f "$3" && shift 3 && exec "$@")",
      "sh",
      lower_of(limits.address_space, RLIMIT_AS, 1024),
      lower_of(limits.processor, RLIMIT_CPU, 1),
      lower_of(limits.file, RLIMIT_FSIZE, 512),
      program};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::clamp<long long>(left.count(), 0, 1 << 30));
}

/// Reads until every writer has closed the pipe (true) or the deadline has passed (false).
bool drain(int pipe_end, Clock::time_point deadline, const std::function<void()>& waiting,
           std::string& output) {
  constexpr int kPeriod = 200;  // [ms]
  std::array<char, 4096> buffer;
  while (Clock::now() < deadline) {
    if (waiting) waiting();
    pollfd ready{pipe_end, POLLIN, 0};
    if (poll(&ready, 1, std::min(kPeriod, milliseconds_until(deadline))) <= 0) continue;
    const ssize_t n = read(pipe_end, buffer.data(), buffer.size());
    if (n == 0) return true;
    if (n > 0 && output.size() < kMaxOutput) {
      output.append(buffer.data(), static_cast<std::size_t>(n));
    }
  }
  return false;
}

/// Waits for the child to end; true if it did so before the deadline.
bool wait_for(pid_t child, Clock::time_point deadline, int& status) {
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (const std::string& folder : split(path == nullptr ? "/usr/bin" : path, ':')) {
    if (!folder.starts_with('/')) continue;
    const std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

Completed run_program(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment,
                      std::chrono::milliseconds limit, const std::function<void()>& waiting,
                      const ProgramLimits& limits, const std::filesystem::path& folder) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw InputError("cannot start " + program.string() + ": " + std::strerror(errno));
  }
  const auto deadline = Clock::now() + limit;
  const pid_t child =
      limits.are_set()
          ? spawn("/bin/sh", limited(program.string(), arguments, limits),
                  merged_environment(environment), pipe_ends, folder)
          : spawn(program.string(), arguments, merged_environment(environment), pipe_ends, folder);
  close(pipe_ends[1]);
  Completed completed;
  int status = 0;
  bool closed = false;
  try {
    closed = drain(pipe_ends[0], deadline, waiting, completed.output);
  } catch (...) {
    close(pipe_ends[0]);
    end(child, status);
    throw;
  }
  close(pipe_ends[0]);
  if (!closed || !wait_for(child, deadline, status)) {
    completed.timed_out = true;
    end(child, status);
  }
  completed.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return completed;
}

void become_program(const std::filesystem::path& program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program.string());
  execv(program.c_str(), pointers(arguments).data());
  throw InputError("cannot start " + program.string() + ": " + std::strerror(errno));
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tabor-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw OutputError("cannot create a temporary folder " + pattern + ": " + std::strerror(errno));
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tabor::io
