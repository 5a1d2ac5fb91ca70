#include "interpreter.hpp"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace tabor::python {
namespace {

/// How long the end waits for work to stop [ms]. Work asks ten times a second whether it goes on.
constexpr int kPatience = 2000;

std::atomic<bool> ends = false;
std::atomic<std::thread::id> ending_thread;  // the one that runs what atexit has
std::atomic<int> n_working = 0;              // threads that have given the lock away
std::atomic<int> n_inside = 0;               // of them, that wait for it or have it back

/// A copy made by fork() has one thread, and nothing that ends.
void begin_copy() {
  ends = false;
  n_working = n_inside = 0;
}
[[maybe_unused]] const int begins_copies = ::pthread_atfork(nullptr, nullptr, &begin_copy);

[[noreturn]] void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Counts this thread as inside, unless the interpreter ends. Counted first and asked then, so that
/// the end, which is said first and counts then, sees whoever has not seen it.
bool may_enter() {
  ++n_inside;
  if (!interpreter_ends()) return true;
  --n_inside;
  return false;
}

/// Called with the lock held, while daemon threads can still have it.
void end_calls() {
  ending_thread = std::this_thread::get_id();
  ends = true;
  PyThreadState* const thread = PyEval_SaveThread();
  for (int i = 0; i < kPatience && (n_working > 0 || n_inside > 0); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  PyEval_RestoreThread(thread);
}

}  // namespace

bool interpreter_ends() { return ends && ending_thread.load() != std::this_thread::get_id(); }

WithoutLock::WithoutLock() {
  ++n_working;
  thread_ = PyEval_SaveThread();
}

WithoutLock::~WithoutLock() {
  const bool may = may_enter();
  --n_working;
  if (!may) sleep_for_ever();
  PyEval_RestoreThread(thread_);
  --n_inside;
}

WithLock::WithLock() : holds_(may_enter()) {
  if (holds_) state_ = PyGILState_Ensure();
}

WithLock::~WithLock() {
  if (!holds_) return;
  PyGILState_Release(state_);
  --n_inside;
}

void bind_interpreter(nb::module_&) {
  // What a sleeping thread holds is there when the interpreter counts what was forgotten.
  nb::set_leak_warnings(false);
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&end_calls));
}

}  // namespace tabor::python
