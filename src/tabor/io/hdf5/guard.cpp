#include "tabor/io/hdf5/guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/files/file_lock.hpp"
#include "tabor/io/files/protection.hpp"
#include "tabor/io/hdf5/library.hpp"

namespace tabor::io {
namespace {

/// What a copy of the process may take beyond what it has.
struct Limits {
  rlim_t bytes;    ///< of address space
  rlim_t seconds;  ///< of processor time: a slow disk is no damage
  unsigned wait;   ///< [s] by the clock: what works for nobody any more ends too
};

/// Memory for the library's own tables and buffers.
constexpr rlim_t kLibraryBytes = rlim_t{256} << 20;
/// The tables of a sound file are read in milliseconds; a forged global heap keeps HDF5 1.10 busy
/// for ever.
constexpr rlim_t kSeconds = 2;
/// A copy that neither sends nor works for so long [s] waits for what will not come.
constexpr int kPatience = 5;
/// A copy ends after so long [s], and longer for large files, even if it is never let go on.
constexpr unsigned kLongest = 60;

/// Runtime libraries, and allocators of sanitizers, have locks that a thread of the original may
/// hold when the copy is made. The copy waits for them for ever; the next one finds them open.
constexpr int kAttempts = 3;

/// Address space of this process [bytes]; 0 if the system does not say.
rlim_t address_space() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  file >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void limit_seconds(rlim_t seconds) {
  const rlimit limit{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &limit);
}

void limit_bytes(rlim_t bytes) {
  rlimit limit{};
  const rlim_t now = address_space();
  if (now == 0 || ::getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, now + bytes);
  ::setrlimit(RLIMIT_AS, &limit);
}

/// The library would call a file damaged, by an ordinary error, for which it had too little memory:
/// that is a failure of the copy.
herr_t end_without_memory(hid_t stack, void*) {
  const auto judge = [](unsigned, const H5E_error2_t* error, void*) -> herr_t {
    if (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC) ::_exit(1);
    return 0;
  };
  H5Ewalk2(stack, H5E_WALK_UPWARD, judge, nullptr);
  return 0;
}

/// The copy ends `seconds` from now, whatever it does or waits for.
void limit_wait(unsigned seconds) {
  sigset_t alarms;
  ::sigemptyset(&alarms);
  ::sigaddset(&alarms, SIGALRM);
  ::signal(SIGALRM, SIG_DFL);
  ::sigprocmask(SIG_UNBLOCK, &alarms, nullptr);
  ::alarm(seconds);
}

/// The copy ends with the process it was made by, which may be gone already.
void end_with(pid_t original) {
#if defined(__linux__)
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (::getppid() != original) ::_exit(1);
}

[[noreturn]] void run_in_copy(const Limits& limits, const std::function<void()>& action) {
  hdf5::Session::renew_in_copy(&end_without_memory);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL, SIGPIPE, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
  }
  limit_bytes(limits.bytes);
  try {
    action();
  } catch (const std::bad_alloc&) {
    ::_exit(1);
  } catch (...) {  // rejecting the file is not crashing over it
  }
  ::_exit(0);
}

/// How a copy ended; or that it waits for what will not come, or was not done in time.
enum class End { well, badly, stuck, late };

/// A running copy of this process, ended with this object.
class Copy {
 public:
  /// Runs action(pipe), whose descriptor leads to receive(). Throws Error if there can be no copy:
  /// the file is then not read at all.
  Copy(const std::filesystem::path& file, const Limits& limits,
       const std::function<void(int)>& action) {
    // The copy has one thread, this one: it must be the one that may use the library. Nor may
    // another copy be made meanwhile, or it would keep this one's pipe open.
    const hdf5::Session session;
    const HeldLocks locks;
    const pid_t original = ::getpid();
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) reject(file, errno);
    number_ = ::fork();
    if (number_ == 0) {
      limit_wait(limits.wait);  // first the limits: what follows may wait, idly or busily
      limit_seconds(limits.seconds);
      end_with(original);
      locks.let_go();
      ::close(ends[0]);  // or it would receive what it sends itself, and wait for ever
      run_in_copy(limits, [&] { action(ends[1]); });
    }
    const int error = errno;
    ::close(ends[1]);
    pipe_ = ends[0];
    if (number_ > 0) return;
    ::close(pipe_);
    reject(file, error);
  }
  ~Copy() {
    if (number_ > 0) {
      ::kill(number_, SIGKILL);
      wait_for_status();
    }
    if (pipe_ >= 0) ::close(pipe_);
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  /// Up to `size` bytes; 0 at the end, and when it is stuck.
  std::size_t receive(char* bytes, std::size_t size) {
    if (is_stuck_ || !wait_for_news()) return 0;
    for (;;) {
      const ssize_t n = ::read(pipe_, bytes, size);
      if (n >= 0) return static_cast<std::size_t>(n);
      if (errno != EINTR) return 0;
    }
  }

  /// Waits for the end, which closes the pipe: well if the copy came to it by itself and sent
  /// nothing more.
  End end() {
    char more = 0;
    if (receive(&more, 1) > 0) return End::badly;
    if (is_stuck_) return End::stuck;
    const int status = wait_for_status();
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return End::late;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? End::well : End::badly;
  }

 private:
  [[noreturn]] static void reject(const std::filesystem::path& file, int error) {
    throw Error(
        fmt::format("{}: HDF5 files are read in a process of their own, and there can be "
                    "none: {}; end other programs or allow more (ulimit -u, ulimit -n)",
                    file.string(), std::strerror(error)));
  }

  int wait_for_status() {
    int status = 0;
    while (::waitpid(number_, &status, 0) < 0 && errno == EINTR) {
    }
    number_ = -1;
    return status;
  }

  /// Processor time of the copy so far [s].
  double work() const {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(number_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Until the pipe has bytes or ends; false if the copy neither sends nor works.
  bool wait_for_news() {
    double before = work();
    for (int idle = 0; idle < kPatience; ++idle) {
      pollfd pipe{pipe_, POLLIN, 0};
      if (::poll(&pipe, 1, 1000) > 0) return true;
      const double now = work();
      if (now > before) idle = -1;
      before = now;
    }
    is_stuck_ = true;
    return false;
  }

  pid_t number_ = -1;
  int pipe_ = -1;
  bool is_stuck_ = false;
};

/// Ends the copy when nobody receives.
void send(int pipe, const Field& rows) {
  const auto* bytes = reinterpret_cast<const char*>(rows.data());
  std::size_t left = static_cast<std::size_t>(rows.size()) * sizeof(double);
  while (left > 0) {
    const ssize_t n = ::write(pipe, bytes, left);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    bytes += n;
    left -= static_cast<std::size_t>(n);
  }
}

/// Limits for so many bytes: chunks may be as large as the map, and are unpacked, sorted and
/// converted one after the other; 20 MB/s is slow for that, and 1 MB/s for a disk.
Limits limits_for(std::size_t bytes) {
  constexpr std::size_t kSlowest = 20'000'000;     // bytes per second
  constexpr std::size_t kSlowestDisk = 1'000'000;  // the same
  return {.bytes = kLibraryBytes + 4 * bytes,
          .seconds = kSeconds + bytes / kSlowest,
          .wait = kLongest + static_cast<unsigned>(bytes / kSlowestDisk)};
}

End receive_map(Copy& copy, Field& map, const std::function<void(double)>& progress) {
  constexpr std::size_t kPiece = std::size_t{1} << 22;
  const std::size_t size = static_cast<std::size_t>(map.size()) * sizeof(double);
  auto* bytes = reinterpret_cast<char*>(map.data());
  std::size_t received = 0, told = 0;
  while (received < size) {
    const std::size_t n = copy.receive(bytes + received, std::min(kPiece, size - received));
    if (n == 0) {
      const End end = copy.end();
      return end == End::well ? End::badly : end;  // it sent less
    }
    received += n;
    if (progress && (received - told >= kPiece || received == size)) {
      told = received;
      progress(static_cast<double>(received) / static_cast<double>(size));
    }
  }
  return copy.end();
}

/// True if one of the attempts ends well. Throws InputError if the last one is stuck or late.
bool one_ends_well(const std::filesystem::path& file, const Limits& limits,
                   const std::function<End()>& attempt) {
  End end = End::badly;
  for (int i = 0; i < kAttempts && end != End::well && end != End::late; ++i) end = attempt();
  if (end == End::well || end == End::badly) return end == End::well;
  throw InputError(file.string(),
                   end == End::late ? fmt::format("not read in {} s", limits.wait)
                                    : fmt::format("no answer from its reader in {} s", kPatience),
                   "a file that can be read", "copy it to a local disk and try again");
}

std::optional<Field> map_from_copy(const std::filesystem::path& file, std::array<Index, 2> shape,
                                   const SendRows& send_rows,
                                   const std::function<void(double)>& progress) {
  Field map(shape[0], shape[1]);
  const Limits limits = limits_for(static_cast<std::size_t>(map.size()) * sizeof(double));
  const bool is_whole = one_ends_well(file, limits, [&] {
    Copy copy(file, limits,
              [&](int pipe) { send_rows([pipe](const Field& rows) { send(pipe, rows); }); });
    return receive_map(copy, map, progress);
  });
  return is_whole ? std::optional(std::move(map)) : std::nullopt;
}

std::optional<Field> map_from_this_process(std::array<Index, 2> shape, const SendRows& send_rows,
                                           const std::function<void(double)>& progress) {
  Field map(shape[0], shape[1]);
  Index n_rows = 0;
  send_rows([&](const Field& rows) {
    if (n_rows + rows.rows() <= map.rows()) map.middleRows(n_rows, rows.rows()) = rows;
    n_rows += rows.rows();
    if (progress) progress(static_cast<double>(n_rows) / static_cast<double>(map.rows()));
  });
  return n_rows == map.rows() ? std::optional(std::move(map)) : std::nullopt;
}

std::atomic<bool> is_isolated{false};

[[noreturn]] void reject_damaged(const std::filesystem::path& file) {
  throw InputError(file.string() + ": damaged HDF5 file");
}

}  // namespace

void isolate_hdf5_reading(bool on) { is_isolated = on; }

bool hdf5_reading_is_isolated() { return is_isolated; }

bool hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action) {
  if (!is_isolated) return true;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  const Limits limits = limits_for(unknown ? 0 : size);
  return one_ends_well(file, limits, [&] {
    Copy copy(file, limits, [&](int) { action(); });
    return copy.end();
  });
}

std::optional<Field> guarded_hdf5_map(const std::filesystem::path& file, std::array<Index, 2> shape,
                                      const SendRows& send_rows,
                                      const std::function<void(double)>& progress) {
  return is_isolated ? map_from_copy(file, shape, send_rows, progress)
                     : map_from_this_process(shape, send_rows, progress);
}

void require_hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action) {
  if (!hdf5_survives(file, action)) reject_damaged(file);
}

Field read_guarded_map(const std::filesystem::path& file, const std::string& path) {
  const std::array<Index, 2> shape =
      read_guarded(file, [&](const Hdf5Reader& reader) { return reader.map_shape(path); });
  const SendRows send_rows = [&](const std::function<void(const Field&)>& accept) {
    Hdf5Reader(file).for_rows(path, [&](Index, const Field& rows) { accept(rows); });
  };
  std::optional<Field> map = guarded_hdf5_map(file, shape, send_rows, {});
  if (!map) reject_damaged(file);
  return std::move(*map);
}

}  // namespace tabor::io
