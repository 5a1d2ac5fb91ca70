#include "tabor/cli/scan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <utility>

#include "tabor/cases/warnings.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/scan/read_parameters.hpp"

namespace tabor::cli {

namespace {

using topography::Topography;

void declare_reading(OptionSet& set, scan::ReadOptions& read) {
  for (const auto& parameter : scan::read_parameters()) declare(set, parameter, read);
}

/// "mean|plane" -> mean, plane; nothing for an argument that is not said by samples.
std::vector<std::string> samples_of(const std::string& argument) {
  const std::vector<std::string> words = split(argument, '|');
  return words.size() > 1 ? words : std::vector<std::string>();
}

void declare_treatment(OptionSet& set, topography::Treatment& treatment) {
  set.group("Treatment, in the order given");
  for (const topography::StepDescription& step : topography::treatment_steps()) {
    const auto assign = [&treatment, name = step.name,
                         is_switch = step.argument.empty()](const std::string& value) {
      const std::string text = is_switch ? name : fmt::format("{}={}", name, value);
      topography::check({text});
      for (const std::string& one : topography::expanded({text})) treatment.push_back(one);
    };
    Option& option = set.add({.flag = "--" + step.name,
                              .placeholder = step.argument,
                              .help = step.help,
                              .words = samples_of(step.argument),
                              .assign = assign});
    option.repeatable = true;
  }
}

/// With what is said of a file, and where that stands if it was not typed.
scan::ReadOptions with_origin(scan::ReadOptions read, const Context& context) {
  for (const ParameterHead& one : scan::read_parameters()) {
    if (context.has_default(one.option())) read.origin[one.name] = context.defaults_file;
  }
  return read;
}

/// A digest is a matter of one thread: it is made beside the reading, and given up with it.
class ScanDigest {
 public:
  explicit ScanDigest(const scan::ScanFile& file)
      : sha256_(std::async(std::launch::async, [this, &file] {
          return file.sha256([this] {
            if (is_given_up_) throw Interrupted();
          });
        })) {}
  ~ScanDigest() { is_given_up_ = true; }
  ScanDigest(const ScanDigest&) = delete;
  ScanDigest& operator=(const ScanDigest&) = delete;

  /// Waits for it; throws Interrupted when the observer asks to stop.
  std::string get(const Observer& observer) {
    while (sha256_.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
      report_progress(observer, "hash", std::nan(""));
    }
    return sha256_.get();
  }

 private:
  std::atomic<bool> is_given_up_ = false;
  std::future<std::string> sha256_;  // last: its end waits for the thread
};

}  // namespace

void declare_scan(OptionSet& set, ScanRequest& request, bool with_treatment) {
  set.group("Surface");
  set.input("SCAN", "a scan file, see 'tabor formats'", request.file);
  declare_reading(set, request.read);
  if (with_treatment) declare_treatment(set, request.treatment);
}

void declare_scans(OptionSet& set, ScanRequest& request, std::vector<std::string>& files,
                   bool with_treatment) {
  OptionSet one;
  declare_scan(one, request, with_treatment);
  for (const Option& option : one.options()) {
    if (option.is_positional()) {
      set.group(option.group);
      set.positionals("SCAN", "scan files, see 'tabor formats'; two or more stand side by side",
                      files)
          .names = option.names;
    } else {
      set.add(option);
    }
  }
}

void check(const ScanRequest& request) {
  try {
    topography::check(request.treatment);
  } catch (const InputError& error) {
    throw UsageError(std::string("--") + error.what());
  }
}

Scan read_scan(const ScanRequest& request, Context& context) {
  return read_scan(request, context, context.observer());
}

Scan read_scan(const ScanRequest& request, const Context& context, const Observer& observer) {
  check(request);
  return read_scan(scan::ScanFile(request.file, observer), request, context, observer);
}

namespace {

/// Names the file in what its treatment rejects, as reading does.
Topography treated(Topography surface, const ScanRequest& request, const Observer& observer) {
  try {
    return topography::apply(request.treatment, std::move(surface), observer);
  } catch (const InputError& error) {
    throw InputError(request.file + ": " + error.what());
  }
}

}  // namespace

Scan read_scan(const scan::ScanFile& file, const ScanRequest& request, const Context& context,
               const Observer& observer) {
  ScanDigest sha256(file);
  Topography surface = treated(file.read(with_origin(request.read, context)), request, observer);
  return {.surface = std::move(surface),
          .path = request.file,
          .sha256 = sha256.get(observer),
          .treatment = request.treatment};
}

results::Case doubts_of(const Scan& scan) {
  return {.surface = scan.path, .warnings = cases::of_surface(scan.surface)};
}

void require_no_holes(const Scan& scan) {
  topography::require_no_holes(scan.surface, scan.path, "add --fill harmonic");
}

std::string pixels_text(const Grid& grid) {
  std::string pixel = si(grid.dx(), "m");
  if (grid.dx() != grid.dy()) pixel += " x " + si(grid.dy(), "m");
  return fmt::format("{} x {} pixels of {}", grid.nx, grid.ny, pixel);
}

void describe(const Scan& scan, Facts& facts) {
  const double n = scan.surface.tiles;
  facts.fact("scan", fmt::format("{} ({}), {}{}", scan.path, scan.surface.format,
                                 pixels_text(scan.surface.grid),
                                 n > 1 ? fmt::format(", {0} x {0} mirror images", n) : ""));
  facts.fact("treatment",
             scan.treatment.empty() ? "none" : fmt::format("{}", fmt::join(scan.treatment, ", ")));
}

}  // namespace tabor::cli
