#pragma once

#include <Python.h>

#include "bindings.hpp"

// The interpreter's lock, also while the interpreter ends. A daemon thread that asks for the lock
// then is ended by Python in the middle of C++, which ends the process by SIGABRT. So no thread
// asks any more once the interpreter has begun to end, and it waits for those that have asked.
namespace tabor::python {

/// The interpreter ends, and this is not the thread that ends it: the work here is of no use.
bool interpreter_ends();

/// Gives the lock away until the end of the scope. Where the interpreter ends meanwhile, the scope
/// has no end: the thread sleeps until the process is gone.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* thread_;
};

/// Takes the lock within such a scope, for its own one; false where the interpreter ends.
class WithLock {
 public:
  WithLock();
  ~WithLock();
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;
  explicit operator bool() const { return holds_; }

 private:
  bool holds_;
  PyGILState_STATE state_ = {};
};

}  // namespace tabor::python
