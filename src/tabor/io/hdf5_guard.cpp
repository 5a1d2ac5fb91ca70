#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <new>

#include "tabor/io/hdf5.hpp"
#include "tabor/io/hdf5_library.hpp"

namespace tabor::io {
namespace {

/// What a copy of the process may take beyond what it has.
struct Limits {
  rlim_t bytes;    ///< of address space
  rlim_t seconds;  ///< of processor time: a slow disk is no damage
};

/// Room for the library's own tables and buffers.
constexpr rlim_t kLibraryBytes = rlim_t{256} << 20;
/// The tables of a sound file are read in milliseconds; a forged global heap keeps HDF5 1.10 busy
/// for ever.
constexpr rlim_t kSeconds = 2;
/// A copy that neither sends nor works for so long waits for a lock that a thread of the original
/// held when it was made: sanitizers' allocators have such locks.
constexpr int kPatience = 3;

#if defined(__has_feature)
#define TABOR_SANITIZED __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define TABOR_SANITIZED 1
#else
#define TABOR_SANITIZED 0
#endif
/// A copy may also wait busily for such a lock, and then ends as one over a forged file does. The
/// next one finds it open.
constexpr int kAttempts = TABOR_SANITIZED ? 2 : 1;

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

[[noreturn]] void run_in_copy(const Limits& limits, const std::function<void()>& action) {
  limit_seconds(limits.seconds);  // first: what follows may wait busily
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
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
  } catch (...) {  // refusing the file is not crashing over it
  }
  ::_exit(0);
}

/// A running copy of this process, ended with this object.
class Copy {
 public:
  /// Runs action(pipe), whose descriptor leads to receive().
  Copy(const Limits& limits, const std::function<void(int)>& action) {
    // The copy has one thread, this one: it must be the one that may use the library. Nor may
    // another copy be made meanwhile, or it would keep this one's pipe open.
    const hdf5::Session session;
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    number_ = ::fork();
    if (number_ == 0) run_in_copy(limits, [&] { action(ends[1]); });
    ::close(ends[1]);
    pipe_ = ends[0];
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

  /// False if there could be no copy: too many processes.
  bool started() const { return number_ > 0; }

  /// Up to `size` bytes; 0 at the end, and when it is stuck.
  std::size_t receive(char* bytes, std::size_t size) {
    if (!wait_for_news()) return 0;
    for (;;) {
      const ssize_t n = ::read(pipe_, bytes, size);
      if (n >= 0) return static_cast<std::size_t>(n);
      if (errno != EINTR) return 0;
    }
  }

  /// It waits for something that will not come: nothing is known about the file.
  bool is_stuck() const { return is_stuck_; }

  /// Waits for the end, which closes the pipe: true if the copy came to it by itself and sent
  /// nothing more; false if it is stuck.
  bool ended_well() {
    char more = 0;
    if (receive(&more, 1) > 0 || is_stuck_) return false;
    const int status = wait_for_status();
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
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

/// Limits for a map of so many bytes: chunks may be as large as the map, and are unpacked, sorted
/// and converted one after the other; 20 MB/s is slow for that.
Limits limits_for(std::size_t map_bytes) {
  constexpr std::size_t kSlowest = 20'000'000;  // bytes per second
  return {kLibraryBytes + 4 * map_bytes, kSeconds + map_bytes / kSlowest};
}

bool copy_survives(const Limits& limits, const std::function<void()>& action) {
  Copy copy(limits, [&](int) { action(); });
  return !copy.started() || copy.ended_well() || copy.is_stuck();
}

std::optional<Field> map_from_copy(std::array<Index, 2> shape, const SendRows& send_rows,
                                   const std::function<void(double)>& progress) {
  constexpr std::size_t kPiece = std::size_t{1} << 22;
  Field map(shape[0], shape[1]);
  const std::size_t size = static_cast<std::size_t>(map.size()) * sizeof(double);
  Copy copy(limits_for(size),
            [&](int pipe) { send_rows([pipe](const Field& rows) { send(pipe, rows); }); });
  if (!copy.started()) return hdf5_map_directly(shape, send_rows);
  auto* bytes = reinterpret_cast<char*>(map.data());
  std::size_t received = 0, told = 0;
  while (received < size) {
    const std::size_t n = copy.receive(bytes + received, std::min(kPiece, size - received));
    if (copy.is_stuck()) return hdf5_map_directly(shape, send_rows);
    if (n == 0) return std::nullopt;
    received += n;
    if (progress && (received - told >= kPiece || received == size)) {
      told = received;
      progress(static_cast<double>(received) / static_cast<double>(size));
    }
  }
  return copy.ended_well() || copy.is_stuck() ? std::optional(std::move(map)) : std::nullopt;
}

}  // namespace

bool hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  const Limits limits{kLibraryBytes + (unknown ? 0 : 4 * size), kSeconds};
  bool survives = false;
  for (int i = 0; i < kAttempts && !survives; ++i) survives = copy_survives(limits, action);
  return survives;
}

std::optional<Field> hdf5_map_from_copy(std::array<Index, 2> shape, const SendRows& send_rows,
                                        const std::function<void(double)>& progress) {
  std::optional<Field> map;
  for (int i = 0; i < kAttempts && !map; ++i) map = map_from_copy(shape, send_rows, progress);
  return map;
}

}  // namespace tabor::io
