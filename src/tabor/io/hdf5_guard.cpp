#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "tabor/io/hdf5.hpp"
#include "tabor/io/hdf5_library.hpp"

namespace tabor::io {
namespace {

/// The tables of a sound file are read in milliseconds; a forged global heap keeps HDF5 1.10 busy
/// for ever.
constexpr std::chrono::seconds kLimit{2};

[[noreturn]] void run_in_child(const std::function<void()>& action) {
  hdf5::Session::renew_in_copy();
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL}) ::signal(signal, SIG_DFL);
  try {
    action();
  } catch (...) {  // refusing the file is not crashing over it
  }
  ::_exit(0);
}

/// True if the child ended by itself and in time.
bool wait_for(pid_t child) {
  const auto deadline = std::chrono::steady_clock::now() + kLimit;
  int status = 0;
  auto pause = std::chrono::microseconds(50);
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::microseconds(5000));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

bool hdf5_survives(const std::function<void()>& action) {
  // The copy has one thread, this one: it must be the one that may use the library.
  const hdf5::Session session;
  const pid_t child = ::fork();
  if (child == 0) run_in_child(action);
  return child < 0 || wait_for(child);
}

}  // namespace tabor::io
