#include "tabor/study/scan_work.hpp"

#include <utility>

#include "tabor/core/error.hpp"

namespace tabor::study {

ScanWork::ScanWork(ScanPlan plan, std::size_t n_pressures)
    : plan_(std::move(plan)),
      n_open_tasks_(plan_.n_tasks()),
      contacts_(n_pressures),
      taken_(n_pressures, false) {}

std::shared_ptr<const topography::Topography> ScanWork::surface(const Make& make) {
  const std::lock_guard lock(surface_mutex_);
  if (surface_error_) {
    throw InputError(*surface_error_);
  }
  if (!surface_) {
    try {
      surface_ = std::make_shared<const topography::Topography>(make());
    } catch (const InputError& error) {
      surface_error_ = error.what();
      throw;
    }
  }
  return surface_;
}

void ScanWork::task_done() {
  const std::lock_guard lock(mutex_);
  if (--n_open_tasks_ == 0) {
    const std::lock_guard surface_lock(surface_mutex_);
    surface_.reset();
  }
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

std::vector<ScanWork::Ready> ScanWork::take_ready() {
  std::vector<Ready> ready;
  for (std::size_t pressure = 0; film_ && pressure < contacts_.size(); ++pressure) {
    if (contacts_[pressure] && !taken_[pressure]) {
      taken_[pressure] = true;
      ready.push_back({pressure, contacts_[pressure]->empty() ? *film_ : *contacts_[pressure]});
    }
  }
  return ready;
}

}  // namespace tabor::study
