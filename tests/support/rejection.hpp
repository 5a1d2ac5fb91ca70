#pragma once

#include <functional>
#include <string>

#include "tabor/core/error.hpp"

namespace tabor::test {

/// The message with which the action was rejected (InputError); "accepted" if it was not.
inline std::string rejection(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace tabor::test
