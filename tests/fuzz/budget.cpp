#include "fuzz/budget.hpp"

#include <sanitizer/allocator_interface.h>

#include <atomic>
#include <ctime>

namespace tabor::fuzz {
namespace {

std::atomic<std::ptrdiff_t> held{0};
std::atomic<std::ptrdiff_t> peak{0};

void on_malloc(const volatile void*, std::size_t size) {
  const std::ptrdiff_t now = held += static_cast<std::ptrdiff_t>(size);
  if (now > peak) peak = now;
}

void on_free(const volatile void* block) {
  if (block == nullptr) return;
  held -=
      static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(const_cast<const void*>(block)));
}

double processor_seconds() {
  std::timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Budget::Budget() : start_(processor_seconds()) {
  static const int installed = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
  static_cast<void>(installed);
  held = 0;
  peak = 0;
}

std::size_t Budget::peak_bytes() const { return static_cast<std::size_t>(peak.load()); }

double Budget::seconds() const { return processor_seconds() - start_; }

}  // namespace tabor::fuzz
