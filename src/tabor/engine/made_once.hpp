#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "tabor/core/error.hpp"

namespace tabor::engine {

/// Value that several workers share: the first worker that needs it makes it while the others wait.
/// An InputError is stored and thrown again to each.
template <typename Value>
class MadeOnce {
 public:
  template <typename Make>
  std::shared_ptr<const Value> get(const Make& make) {
    const std::lock_guard lock(mutex_);
    if (error_) throw InputError(*error_);
    if (!value_) {
      try {
        value_ = std::make_shared<const Value>(make());
      } catch (const InputError& error) {
        error_ = error.what();
        throw;
      }
    }
    return value_;
  }

  /// Lets go of the value; whoever asks later makes it again.
  void drop() {
    const std::lock_guard lock(mutex_);
    value_.reset();
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const Value> value_;
  std::optional<std::string> error_;
};

}  // namespace tabor::engine
