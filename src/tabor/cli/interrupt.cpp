#include "tabor/cli/interrupt.hpp"

#include <signal.h>

#include <atomic>

namespace tabor::cli {

namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch such flags");

void handle(int signal) {
  flag = true;
  ::signal(signal, SIG_DFL);  // whoever asks twice does not want to wait
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = handle;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // not under nohup
}

void let_writing_fail() { ::signal(SIGXFSZ, SIG_IGN); }

bool interrupted() { return flag; }

void set_interrupted(bool value) { flag = value; }

}  // namespace tabor::cli
