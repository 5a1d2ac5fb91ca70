// The libFuzzer program of all targets: `tabor_fuzz --target=x3p [libFuzzer's options] CORPUS`.
// Beside crashes it ends at inputs that take too much memory for their size or too long, and writes
// at its end what the hungriest and the slowest input took.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "fuzz/budget.hpp"
#include "fuzz/targets.hpp"

namespace {

using tabor::fuzz::Budget;
using tabor::fuzz::Target;

/// Sanitizers and coverage counters make the readers several times slower, so that a reader that
/// takes 2 s as users have it may take this here [s].
constexpr double kMostSeconds = 10;

const Target* chosen = nullptr;
std::size_t most_bytes = 0;
double most_seconds = 0;

void report() {
  std::fprintf(stderr, "tabor: peak memory %zu bytes, slowest input %.3f s\n", most_bytes,
               most_seconds);
}

[[noreturn]] void complain(const char* problem, double value, std::size_t size) {
  std::fprintf(stderr, "tabor: %s: %g for %zu bytes of input\n", problem, value, size);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (word.starts_with(kOption)) {
      chosen = &tabor::fuzz::target(std::string(word.substr(kOption.size())));
    }
  }
  if (chosen == nullptr) {
    std::fprintf(stderr, "usage: tabor_fuzz --target=NAME [libFuzzer options] [FOLDER...]\n");
    std::exit(2);
  }
  std::atexit(report);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Budget budget;
  chosen->run({reinterpret_cast<const char*>(data), size});
  most_bytes = std::max(most_bytes, budget.peak_bytes());
  most_seconds = std::max(most_seconds, budget.seconds());
  const std::size_t most = tabor::fuzz::allowed_bytes(size, chosen->packed) + chosen->library_bytes;
  if (budget.peak_bytes() > most) {
    complain("too much memory", static_cast<double>(budget.peak_bytes()), size);
  }
  if (budget.seconds() > kMostSeconds) complain("too slow [s]", budget.seconds(), size);
  return 0;
}
