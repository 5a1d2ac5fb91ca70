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

std::string describe(const Progress& progress) {
  std::string line = printable(progress.stage);
  if (progress.convergence != nullptr) {
    line += fmt::format("  iteration {}  certificate {:.1e} (wanted {:.0e})",
                        progress.convergence->iterations, progress.convergence->certificate,
                        progress.convergence->tolerance);
  }
  return line;
}

/// "  25 % of all, 3 min left"
std::string describe(double share, const std::optional<double>& left, const char* of_what) {
  if (!(share > 0)) return "";
  std::string text = fmt::format("  {:.0f} %{}", 100 * share, of_what);
  if (left) text += fmt::format(", {} left", format_estimate(*left));
  return text;
}

}  // namespace

ProgressStyle progress_style_of_stderr(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::terminal : ProgressStyle::lines;
}

ProgressPrinter::ProgressPrinter(std::ostream& err, ProgressStyle style)
    : ProgressPrinter(err, style, [watch = Stopwatch()] { return watch.seconds(); }) {}

Observer ProgressPrinter::observer() {
  return [this](const Progress& progress) {
    if (style_ != ProgressStyle::none && !progress.stage.empty()) show(progress);
    return !interrupted();
  };
}

double ProgressPrinter::share_of_stage(const Progress& progress, double now) {
  if (progress.stage != stage_) {
    stage_ = progress.stage;
    of_stage_ = TimeLeft(now);
    first_certificate_ = 0;
    share_ = std::nan("");
  }
  if (!std::isnan(progress.fraction)) return share_ = progress.fraction;
  if (progress.convergence == nullptr) return share_;  // the last that was told
  if (!(first_certificate_ > 0 && std::isfinite(first_certificate_))) {
    first_certificate_ = progress.convergence->certificate;
  }
  return share_ = share_done(first_certificate_, *progress.convergence);
}

void ProgressPrinter::show(const Progress& progress) {
  const double now = clock_();
  const double share = share_of_stage(progress, now);
  // Every message counts for the estimates, whether or not it is shown.
  const std::optional<double> stage_left = of_stage_.at(now, share);
  const std::optional<double> whole_left = whole_.at(now, progress.whole);
  const double period = style_ == ProgressStyle::terminal ? kTerminalPeriod : kLinePeriod;
  if (now - last_shown_ < period) return;
  last_shown_ = now;
  const std::string line =
      describe(progress) + (std::isnan(progress.whole)
                                ? describe(share, stage_left, "")
                                : describe(progress.whole, whole_left, " of all"));
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
