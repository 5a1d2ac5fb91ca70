#pragma once

#include <algorithm>

#include "tabor/core/parallel.hpp"

namespace tabor::study {

/// Shares the machine's threads among the workers for as long as it lives.
class ThreadShare {
 public:
  explicit ThreadShare(int n_workers) : before_(thread_count()) {
    set_thread_count(std::max(1, before_ / n_workers));
  }
  ~ThreadShare() { set_thread_count(before_); }
  ThreadShare(const ThreadShare&) = delete;
  ThreadShare& operator=(const ThreadShare&) = delete;

 private:
  int before_;
};

}  // namespace tabor::study
