#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/study/made_once.hpp"
#include "tabor/study/plan.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::study {

/// What the workers share about one scan: its treated surface and its contacts without oil as long
/// as somebody needs them, and which of its units are ready, so that rows are made and films flow
/// as soon as their contact and their film are there.
class ScanWork {
 public:
  ScanWork(ScanPlan plan, std::size_t n_pressures);

  const ScanPlan& plan() const { return plan_; }

  using MakeSurface = std::function<topography::Topography()>;
  std::shared_ptr<const topography::Topography> surface(const MakeSurface& make) {
    return surface_.get(make);
  }

  using MakeContact = std::function<contact::State()>;
  std::shared_ptr<const contact::State> dry_contact(std::size_t pressure, const MakeContact& make) {
    return contacts_made_[pressure].get(make);
  }

  /// Ends one film that flows; after the last of a pressure its contact's memory is given back.
  void flow_ended(std::size_t pressure);

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

  /// Waits until contact and film of a pressure have ended, and returns why there is none, if so.
  /// `keep_waiting` is called ten times a second and throws to give up.
  std::string wait_for(std::size_t pressure, const std::function<void()>& keep_waiting);

 private:
  std::vector<Ready> take_ready();
  std::string outcome(std::size_t pressure) const;

  ScanPlan plan_;
  MadeOnce<topography::Topography> surface_;
  std::vector<MadeOnce<contact::State>> contacts_made_;
  std::mutex mutex_;  // of everything below
  std::condition_variable ended_;
  std::size_t n_open_tasks_;
  std::vector<std::size_t> n_open_flows_;  // per pressure
  std::optional<std::string> film_;
  std::vector<std::optional<std::string>> contacts_;
  std::vector<bool> taken_;
};

}  // namespace tabor::study
