#pragma once

#include <chrono>
#include <cstddef>

// Measures memory and wall-clock time of the process, and gives memory back.
namespace tabor {

/// Returns the largest resident memory of this process so far [bytes].
std::size_t peak_memory_bytes();

/// Returns the memory that this process could still take without swapping [bytes]; 0 if the system
/// does not say.
std::size_t available_memory_bytes();

/// Gives memory that has been freed back to the system, where the C library can.
void return_freed_memory();

/// Measures the time since construction (wall clock).
class Stopwatch {
 public:
  /// [s]
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tabor
