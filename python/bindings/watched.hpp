#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "bindings.hpp"
#include "tabor/core/convergence.hpp"

namespace tabor::python {

/// Runs `work` without the interpreter's lock, looks for signals fifty times a second, and tells
/// `progress`: None, or what is called with (stage, done share, certificate), both NaN if unknown.
/// Ctrl-C, and whatever `progress` raises, stops the work and is raised here. `work` must not
/// touch Python, and asks its observer on the thread that it is called on.
/// When the interpreter ends before a daemon thread's work, the work is stopped, and the thread
/// sleeps until the process is gone.
void watch(const nb::object& progress, const std::function<void(const Observer&)>& work);

/// The same for work that waits for threads of its own, which ask the observer in its place: it
/// runs on another thread, while this one looks.
void watch_beside(const nb::object& progress, const std::function<void(const Observer&)>& work);

/// watch() for work that returns something.
template <typename Work>
auto watched(const nb::object& progress, Work&& work) {
  std::optional<decltype(work(Observer{}))> result;
  watch(progress, [&](const Observer& observer) { result.emplace(work(observer)); });
  return std::move(*result);
}

/// watch_beside() likewise.
template <typename Work>
auto watched_beside(const nb::object& progress, Work&& work) {
  std::optional<decltype(work(Observer{}))> result;
  watch_beside(progress, [&](const Observer& observer) { result.emplace(work(observer)); });
  return std::move(*result);
}

}  // namespace tabor::python
