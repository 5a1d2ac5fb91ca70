#pragma once

// Includes HDF5's headers, for hdf5_*.cpp alone, and wraps its identifiers and its global lock. No
// other file includes them.
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace tabor::io::hdf5 {

/// Lets one thread at a time use the library, as most builds of HDF5 are not thread-safe. Also
/// prevents the library from printing its own error stack: errors are reported by exceptions.
class Session {
 public:
  Session() : lock_(mutex()) { H5Eset_auto2(H5E_DEFAULT, on_error(), nullptr); }

  /// Makes a new mutex in a copy of the process that was made inside a session: a mutex knows its
  /// owner by the number of a thread, which the copy has not. From now on `handler` is told of
  /// every failing call.
  static void renew_in_copy(H5E_auto2_t handler) {
    new (&mutex()) std::recursive_mutex;
    on_error() = handler;
  }

 private:
  static H5E_auto2_t& on_error() {
    static H5E_auto2_t instance = nullptr;
    return instance;
  }
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex instance;
    return instance;
  }
  std::lock_guard<std::recursive_mutex> lock_;
};

/// HDF5 identifier that closes itself; negative means the call that made it failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;

  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// True where an external link to this file is one of a study's results into its store:
/// store/NAME.h5.
bool is_store_file(const std::string& target);

/// Makes the library follow such external links and no others from now on. To be called within a
/// session.
void follow_store_links_only();

/// Opens a file for reading; negative where it cannot be. To be called within a session. It stays
/// open until its last object is closed.
hid_t open_for_reading(const std::string& file);

/// Returns the access properties for writing, through a driver that records a failing write instead
/// of reporting it to HDF5, which would crash at the end of the program over a file it could not
/// flush.
Handle writing_access();

/// True once a write to this file, opened with writing_access(), has failed.
bool write_failed(hid_t file);

/// Returns the number of elements, or UINT64_MAX where the product does not fit.
inline std::uint64_t count_of(const std::vector<hsize_t>& shape) {
  std::uint64_t count = 1;
  for (const hsize_t n : shape) {
    if (__builtin_mul_overflow(count, static_cast<std::uint64_t>(n), &count)) return UINT64_MAX;
  }
  return count;
}

}  // namespace tabor::io::hdf5
