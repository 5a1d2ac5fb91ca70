#include "tabor/io/files/lost_pages.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

#include "tabor/io/files/protection.hpp"

namespace tabor::io {

/// Where a watched map lies. The signal handler reads these, and it must not wait for a lock.
struct WatchedPages::Place {
  std::atomic<const char*> begin{nullptr};  ///< null: this place is free
  std::atomic<const char*> end{nullptr};
  std::atomic<bool> lost{false};

  bool holds(const char* address) const {
    const std::less<> before;
    return begin != nullptr && !before(address, begin) && before(address, end);
  }
};

namespace {

std::array<WatchedPages::Place, 256> places;
struct sigaction earlier_handler {};
bool handler_is_installed = false;
std::size_t page_size = 4096;  // asked for before there is a signal

/// Puts zeros from the page of this address to the end of its map; false if it is in none.
bool put_zeros(const char* address) {
  for (WatchedPages::Place& place : places) {
    if (!place.holds(address)) continue;
    place.lost = true;
    const char* begin = place.begin;
    const std::size_t offset = static_cast<std::size_t>(address - begin) / page_size * page_size;
    const std::size_t size = static_cast<std::size_t>(place.end - begin) - offset;
    return ::mmap(const_cast<char*>(begin) + offset, size, PROT_READ,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
  }
  return false;
}

/// After it returns, the same access is tried again: it finds zeros, or raises the signal anew for
/// the handler that was there before.
void on_bus_error(int signal, siginfo_t* what, void*) {
  const bool is_an_access = what->si_code > 0;  // else somebody sent the signal
  if (is_an_access && put_zeros(static_cast<const char*>(what->si_addr))) return;
  ::sigaction(signal, &earlier_handler, nullptr);
  if (!is_an_access) ::raise(signal);
}

void install_handler() {
  page_size = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  struct sigaction handler {};
  handler.sa_sigaction = &on_bus_error;
  handler.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigemptyset(&handler.sa_mask);
  ::sigaction(SIGBUS, &handler, &earlier_handler);
}

}  // namespace

bool lost_pages_are_trapped() { return handler_is_installed; }

void trap_lost_pages(bool on) {
  if (on == handler_is_installed) return;
  if (on) {
    install_handler();
  } else {
    ::sigaction(SIGBUS, &earlier_handler, nullptr);
  }
  handler_is_installed = on;
}

void WatchedPages::watch(std::string_view map) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  Place* const free = std::find_if(places.begin(), places.end(),
                                   [](const Place& place) { return place.begin == nullptr; });
  if (free == places.end()) return;
  free->lost = false;
  free->end = map.data() + map.size();
  free->begin = map.data();
  place_ = free;
}

void WatchedPages::forget() {
  if (place_ != nullptr) place_->begin = nullptr;
  place_ = nullptr;
}

bool WatchedPages::were_lost() const { return place_ != nullptr && place_->lost; }

}  // namespace tabor::io
