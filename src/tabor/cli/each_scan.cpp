#include "tabor/cli/each_scan.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/engine/engine.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::cli {
namespace {

std::size_t bytes_for(const std::string& file, double bytes_per_pixel) {
  double n_pixels = 0;
  for (const scan::Channel& one : scan::ScanFile(file).info().channels) {
    n_pixels = std::max(n_pixels, static_cast<double>(one.nx) * static_cast<double>(one.ny));
  }
  return static_cast<std::size_t>(bytes_per_pixel * n_pixels);
}

}  // namespace

void for_each_scan(const std::vector<std::string>& files, const ScanWork& work,
                   const Context& context) {
  std::vector<std::exception_ptr> errors(files.size());
  std::vector<engine::Job> jobs(files.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    jobs[i].kind = work.verb;
    jobs[i].stage = work.verb + ' ' + files[i];
    jobs[i].compute = [&work, &error = errors[i], i](const engine::Monitor& monitor) {
      try {
        work.run(i, monitor.own);
      } catch (const InputError&) {  // the others go on
        error = std::current_exception();
      }
    };
    jobs[i].memory = [&work, &file = files[i]](const engine::Monitor&) {
      return bytes_for(file, work.bytes_per_pixel);
    };
  }
  engine::RunOptions options;
  options.observer = context.observer();
  engine::run_jobs(std::move(jobs), nullptr, options).rethrow();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace tabor::cli
