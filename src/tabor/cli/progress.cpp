#include "tabor/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "tabor/cli/interrupt.hpp"
#include "tabor/core/printable.hpp"

namespace tabor::cli {

namespace {

constexpr double kTerminalPeriod = 0.1;  // [s] faster than the eye needs, slower than any solver
constexpr double kLinePeriod = 10;       // [s]

std::string describe(const Progress& progress, double share, double elapsed) {
  std::string line = printable(progress.stage);
  if (progress.convergence != nullptr) {
    line += fmt::format("  iteration {}  certificate {:.1e} (wanted {:.0e})",
                        progress.convergence->iterations, progress.convergence->certificate,
                        progress.convergence->tolerance);
  }
  if (share > 0) line += fmt::format("  {:.0f} %", 100 * share);
  if (share > 0.02 && share < 1) {
    line += "  " + format_duration(elapsed * (1 - share) / share) + " left";
  }
  return line;
}

}  // namespace

ProgressStyle progress_style_of_stderr(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::terminal : ProgressStyle::lines;
}

std::string format_duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

Observer ProgressPrinter::observer() {
  return [this](const Progress& progress) {
    if (style_ != ProgressStyle::none) show(progress);
    return !interrupted();
  };
}

void ProgressPrinter::show(const Progress& progress) {
  const double now = since_start_.seconds();
  if (progress.stage != stage_) {
    stage_ = progress.stage;
    stage_start_ = now;
    first_certificate_ = 0;
  }
  if (progress.convergence && !(first_certificate_ > 0 && std::isfinite(first_certificate_))) {
    first_certificate_ = progress.convergence->certificate;
  }
  const double period = style_ == ProgressStyle::terminal ? kTerminalPeriod : kLinePeriod;
  if (now - last_shown_ < period) return;
  last_shown_ = now;
  const bool is_part = !std::isnan(progress.whole);
  double share = is_part ? progress.whole : progress.fraction;
  if (std::isnan(share)) {
    share = progress.convergence ? share_done(first_certificate_, *progress.convergence) : 0;
  }
  const std::string line = describe(progress, share, is_part ? now : now - stage_start_);
  if (style_ == ProgressStyle::terminal) {
    err_ << "\r\033[K" << line << std::flush;
    line_on_screen_ = true;
  } else {
    err_ << line << '\n' << std::flush;
  }
}

void ProgressPrinter::clear() {
  if (line_on_screen_) err_ << "\r\033[K" << std::flush;
  line_on_screen_ = false;
}

}  // namespace tabor::cli
