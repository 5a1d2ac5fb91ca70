#include "tabor/cli/each_scan.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/engine/engine.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::cli {
namespace {

std::size_t bytes_for(const std::string& file) {
  constexpr double kBytesPerPixel =
      60;  // of all parameters, or spectra with autocorrelation: 42 at 1024 x 1024
  double n_pixels = 0;
  for (const scan::Channel& one : scan::ScanFile(file).info().channels) {
    n_pixels = std::max(n_pixels, static_cast<double>(one.nx) * static_cast<double>(one.ny));
  }
  return static_cast<std::size_t>(kBytesPerPixel * n_pixels);
}

}  // namespace

void for_each_scan(const std::vector<std::string>& files, const std::string& verb,
                   const std::function<void(std::size_t place, const Observer&)>& run,
                   const Context& context) {
  std::vector<std::exception_ptr> errors(files.size());
  std::vector<engine::Job> jobs(files.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    jobs[i].kind = verb;
    jobs[i].stage = verb + ' ' + files[i];
    jobs[i].compute = [&run, &error = errors[i], i](const engine::Monitor& monitor) {
      try {
        run(i, monitor.own);
      } catch (const InputError&) {  // the others go on
        error = std::current_exception();
      }
    };
    jobs[i].memory = [&file = files[i]](const engine::Monitor&) { return bytes_for(file); };
  }
  engine::RunOptions options;
  options.observer = context.observer();
  engine::run_jobs(std::move(jobs), nullptr, options).rethrow();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace tabor::cli
