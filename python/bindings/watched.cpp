#include "watched.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace tabor::python {
namespace {

constexpr std::chrono::milliseconds kPeriod{20};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What the work says of itself, for the thread that waits.
struct News {
  std::string stage;
  double fraction = kUnknown;
  double certificate = kUnknown;
};

/// Work on another thread, and what the one that waits for it may ask.
class Run {
 public:
  explicit Run(const std::function<void(const Observer&)>& work) : work_(work) {}

  /// On the thread that works.
  void run() {
    try {
      work_([this](const Progress& progress) { return listen(progress); });
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    ended_.notify_all();
  }

  /// True if it ended within the period.
  bool ends() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kPeriod, [this] { return has_ended_; });
  }
  void stop() { stops_ = true; }
  News news() {
    const std::lock_guard lock(mutex_);
    return news_;
  }
  /// What it threw, once it has ended.
  std::exception_ptr error() const { return error_; }

 private:
  bool listen(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    news_ = {.stage = std::string(progress.stage),
             .fraction = progress.fraction,
             .certificate =
                 progress.convergence != nullptr ? progress.convergence->certificate : kUnknown};
    return !stops_;
  }

  const std::function<void(const Observer&)>& work_;  ///< not used once it has ended
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::atomic<bool> stops_ = false;
  News news_;
  std::exception_ptr error_;
};

/// Threads that wait for work: a new one, with the team of threads that OpenMP would make for it,
/// takes longer than a small call.
class Crew {
 public:
  /// Of this process. It is never destroyed, as its threads end with the process; a fork has none
  /// of them and gets a crew of its own.
  static Crew& of_process() {
    static std::mutex mutex;
    static Crew* crew = nullptr;
    const std::lock_guard lock(mutex);
    if (crew == nullptr || crew->process_ != ::getpid()) crew = new Crew;
    return *crew;
  }

  void start(std::shared_ptr<Run> run) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(run));
    if (waiting_.size() > n_idle_) {
      std::thread([this] { work(); }).detach();
    } else {
      wake_.notify_one();
    }
  }

 private:
  std::shared_ptr<Run> next() {
    std::unique_lock lock(mutex_);
    ++n_idle_;
    wake_.wait(lock, [this] { return !waiting_.empty(); });
    --n_idle_;
    std::shared_ptr<Run> run = std::move(waiting_.front());
    waiting_.pop_front();
    return run;
  }
  [[noreturn]] void work() {
    while (true) next()->run();
  }

  pid_t process_ = ::getpid();
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Run>> waiting_;
  std::size_t n_idle_ = 0;
};

/// Raises what a signal's handler or the callable raised.
void ask_python(const nb::object& progress, Run& run) {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  if (progress.is_none()) return;
  const News news = run.news();
  if (!news.stage.empty()) progress(news.stage.c_str(), news.fraction, news.certificate);
}

}  // namespace

void watch(const nb::object& progress, const std::function<void(const Observer&)>& work) {
  std::optional<nb::python_error> raised;
  std::exception_ptr error;
  {
    const nb::gil_scoped_release unlocked;
    const auto run = std::make_shared<Run>(work);
    Crew::of_process().start(run);
    while (!run->ends()) {
      const nb::gil_scoped_acquire locked;
      try {
        if (!raised) ask_python(progress, *run);
      } catch (nb::python_error& found) {
        raised.emplace(std::move(found));
        run->stop();
      }
    }
    error = run->error();
  }
  if (raised) throw std::move(*raised);
  if (error) std::rethrow_exception(error);
}

}  // namespace tabor::python
