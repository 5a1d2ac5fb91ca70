#include "watched.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "interpreter.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::python {
namespace {

constexpr std::chrono::milliseconds kPeriod{20};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What the work says of itself.
struct News {
  std::string stage;
  double fraction = kUnknown;
  double certificate = kUnknown;
};

News news_of(const Progress& progress) {
  return {.stage = std::string(progress.stage),
          .fraction = progress.fraction,
          .certificate =
              progress.convergence != nullptr ? progress.convergence->certificate : kUnknown};
}

/// Raises what a signal's handler or the callable raised.
void ask_python(const nb::object& progress, const News& news) {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  if (!progress.is_none() && !news.stage.empty()) {
    progress(news.stage.c_str(), news.fraction, news.certificate);
  }
}

/// Asks Python in the middle of the work, no more often than the period.
class Between {
 public:
  explicit Between(const nb::object& progress) : progress_(progress) {}

  bool listen(const Progress& progress) {
    if (interpreter_ends()) stops_ = true;
    if (stops_ || std::this_thread::get_id() != owner_) return !stops_;
    const auto now = Clock::now();
    if (now < next_) return true;
    next_ = now + kPeriod;
    const WithLock locked;
    if (!locked) return false;
    try {
      ask_python(progress_, news_of(progress));
    } catch (nb::python_error& found) {
      raised_.emplace(std::move(found));
      stops_ = true;
    }
    return !stops_;
  }
  /// With the interpreter's lock held.
  void rethrow() {
    if (raised_) throw std::move(*raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  const nb::object& progress_;
  const std::thread::id owner_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + kPeriod;
  std::atomic<bool> stops_ = false;
  std::optional<nb::python_error> raised_;
};

/// Works under a watch of its own, so that work that does not know the observer asks it, too.
void work_under(const Observer& observer, const std::function<void(const Observer&)>& work) {
  const Watch watch(observer, "");
  work(observer);
}

/// Work on a thread of its own.
class Worker {
 public:
  explicit Worker(const std::function<void(const Observer&)>& work)
      : thread_([this, &work] { run(work); }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

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
  void run(const std::function<void(const Observer&)>& work) {
    try {
      work_under([this](const Progress& progress) { return listen(progress); }, work);
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    ended_.notify_all();
  }

  bool listen(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    news_ = news_of(progress);
    return !stops_;
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::atomic<bool> stops_ = false;
  News news_;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace

void watch(const nb::object& progress, const std::function<void(const Observer&)>& work) {
  Between between(progress);
  std::exception_ptr error;
  {
    const WithoutLock unlocked;
    try {
      work_under([&](const Progress& told) { return between.listen(told); }, work);
    } catch (...) {
      error = std::current_exception();
    }
  }
  between.rethrow();
  if (error) std::rethrow_exception(error);
}

void watch_beside(const nb::object& progress, const std::function<void(const Observer&)>& work) {
  std::optional<nb::python_error> raised;
  std::exception_ptr error;
  {
    const WithoutLock unlocked;
    Worker worker(work);
    while (!worker.ends()) {
      const WithLock locked;
      if (!locked) {
        worker.stop();
        continue;
      }
      try {
        if (!raised) ask_python(progress, worker.news());
      } catch (nb::python_error& found) {
        raised.emplace(std::move(found));
        worker.stop();
      }
    }
    error = worker.error();
  }
  if (raised) throw std::move(*raised);
  if (error) std::rethrow_exception(error);
}

}  // namespace tabor::python
