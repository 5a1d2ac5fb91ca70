#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "bindings.hpp"
#include "tabor/core/convergence.hpp"

namespace tabor::python {

/// Runs `work` on another thread, while this one waits for it without the interpreter's lock,
/// looks for signals fifty times a second, and tells `progress`: None, or what is called with
/// (stage, done share, certificate), both NaN if unknown. Ctrl-C, and whatever `progress` raises,
/// stops the work and is raised here. `work` must not touch Python.
void watch(const nb::object& progress, const std::function<void(const Observer&)>& work);

/// The same for work that returns something.
template <typename Work>
auto watched(const nb::object& progress, Work&& work) {
  std::optional<decltype(work(Observer{}))> result;
  watch(progress, [&](const Observer& observer) { result.emplace(work(observer)); });
  return std::move(*result);
}

}  // namespace tabor::python
