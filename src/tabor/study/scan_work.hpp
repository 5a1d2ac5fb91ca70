#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tabor/study/plan.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::study {

/// What the workers share about one scan: its treated surface as long as somebody needs it, and
/// which of its units are ready, so that rows are made as soon as their contact and their film are
/// there.
class ScanWork {
 public:
  using Make = std::function<topography::Topography()>;

  ScanWork(ScanPlan plan, std::size_t n_pressures);

  const ScanPlan& plan() const { return plan_; }

  /// The surface; the first caller makes it while the others wait. A failure is remembered and
  /// thrown again to each (InputError).
  std::shared_ptr<const topography::Topography> surface(const Make& make);

  /// Ends one task of the plan; after the last the surface's memory is given back.
  void task_done();

  /// The outcome of a unit: "" for success, otherwise why there is none. Returns the pressures
  /// whose rows can now be made, with the reason why they fail, if they do.
  struct Ready {
    std::size_t pressure;
    std::string error;
  };
  std::vector<Ready> contact_ended(std::size_t pressure, const std::string& error);
  std::vector<Ready> film_ended(const std::string& error);

 private:
  std::vector<Ready> take_ready();

  ScanPlan plan_;
  std::mutex surface_mutex_;
  std::shared_ptr<const topography::Topography> surface_;
  std::optional<std::string> surface_error_;
  std::mutex mutex_;  // of everything below
  std::size_t n_open_tasks_;
  std::optional<std::string> film_;
  std::vector<std::optional<std::string>> contacts_;
  std::vector<bool> taken_;
};

}  // namespace tabor::study
