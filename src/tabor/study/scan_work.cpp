#include "tabor/study/scan_work.hpp"

#include <chrono>
#include <utility>

namespace tabor::study {

ScanWork::ScanWork(ScanPlan plan, std::size_t n_pressures)
    : plan_(std::move(plan)),
      contacts_made_(n_pressures),
      n_open_tasks_(plan_.n_tasks()),
      n_open_flows_(n_pressures, 0),
      contacts_(n_pressures),
      taken_(n_pressures, false) {
  for (const ScanPlan::Flow& flow : plan_.flows) ++n_open_flows_[flow.pressure];
}

void ScanWork::flow_ended(std::size_t pressure) {
  const std::lock_guard lock(mutex_);
  if (--n_open_flows_[pressure] == 0) contacts_made_[pressure].drop();
}

void ScanWork::task_done() {
  const std::lock_guard lock(mutex_);
  if (--n_open_tasks_ == 0) surface_.drop();
}

std::vector<ScanWork::Ready> ScanWork::contact_ended(std::size_t pressure,
                                                     const std::string& error) {
  const std::lock_guard lock(mutex_);
  contacts_[pressure] = error;
  return take_ready();
}

std::vector<ScanWork::Ready> ScanWork::film_ended(const std::string& error) {
  const std::lock_guard lock(mutex_);
  film_ = error;
  return take_ready();
}

std::string ScanWork::wait_for(std::size_t pressure, const std::function<void()>& keep_waiting) {
  std::unique_lock lock(mutex_);
  while (!film_ || !contacts_[pressure]) {
    ended_.wait_for(lock, std::chrono::milliseconds(100));
    lock.unlock();
    keep_waiting();
    lock.lock();
  }
  return outcome(pressure);
}

std::vector<ScanWork::Ready> ScanWork::take_ready() {
  std::vector<Ready> ready;
  for (std::size_t pressure = 0; film_ && pressure < contacts_.size(); ++pressure) {
    if (contacts_[pressure] && !taken_[pressure]) {
      taken_[pressure] = true;
      ready.push_back({pressure, outcome(pressure)});
    }
  }
  ended_.notify_all();
  return ready;
}

std::string ScanWork::outcome(std::size_t pressure) const {
  return contacts_[pressure]->empty() ? *film_ : *contacts_[pressure];
}

}  // namespace tabor::study
