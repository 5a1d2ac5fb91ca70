#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tabor/io/hdf5/library.hpp"

// A virtual file driver of HDF5 (HDF5 reference manual, "Virtual File Layer"): plain reads and
// writes at offsets. What sets it apart from the driver HDF5 comes with: a write that fails, on a
// full disk, is noted and the next ones are skipped. HDF5 itself cannot close a file it cannot
// flush; the file stays half open and crashes the program at its end.
namespace tabor::io::hdf5 {
namespace {

struct File {
  H5FD_t base;  // must be first: HDF5 sees only this part
  int descriptor;
  haddr_t end_of_addresses;
  haddr_t end_of_file;
  bool failed;
};

constexpr haddr_t kLargestAddress = (haddr_t{1} << 62) - 1;

File* file_of(H5FD_t* base) { return reinterpret_cast<File*>(base); }
const File* file_of(const H5FD_t* base) { return reinterpret_cast<const File*>(base); }

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
  const int mode = ((flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY) |
                   ((flags & H5F_ACC_TRUNC) != 0 ? O_TRUNC : 0) |
                   ((flags & H5F_ACC_CREAT) != 0 ? O_CREAT : 0);
  const int descriptor = ::open(name, mode | O_CLOEXEC, 0666);
  if (descriptor < 0) return nullptr;
  struct stat status {};
  ::fstat(descriptor, &status);
  auto* file = new File{{}, descriptor, 0, static_cast<haddr_t>(status.st_size), false};
  return &file->base;
}

herr_t close_file(H5FD_t* base) {
  const bool closed = ::close(file_of(base)->descriptor) == 0;
  delete file_of(base);
  return closed ? 0 : -1;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t end_of_addresses(const H5FD_t* base, H5FD_mem_t) { return file_of(base)->end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  file_of(base)->end_of_addresses = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* base, H5FD_mem_t) { return file_of(base)->end_of_file; }

/// Gives access to `failed`.
herr_t handle(H5FD_t* base, hid_t, void** result) {
  *result = &file_of(base)->failed;
  return 0;
}

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  auto* bytes = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t n = ::pread(file_of(base)->descriptor, bytes, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return -1;
    if (n == 0) {  // beyond the end: reserved and not yet written
      std::memset(bytes, 0, size);
      return 0;
    }
    bytes += n;
    address += static_cast<haddr_t>(n);
    size -= static_cast<size_t>(n);
  }
  return 0;
}

herr_t write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* buffer) {
  File& file = *file_of(base);
  const auto* bytes = static_cast<const char*>(buffer);
  file.end_of_file = std::max(file.end_of_file, address + size);
  while (size > 0 && !file.failed) {
    const ssize_t n = ::pwrite(file.descriptor, bytes, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      file.failed = true;
      break;
    }
    bytes += n;
    address += static_cast<haddr_t>(n);
    size -= static_cast<size_t>(n);
  }
  return 0;
}

/// The file is as long as HDF5 believes, which is what its readers check first.
herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  File& file = *file_of(base);
  if (file.end_of_addresses != file.end_of_file) {
    file.failed =
        file.failed || ::ftruncate(file.descriptor, static_cast<off_t>(file.end_of_addresses)) != 0;
    file.end_of_file = file.end_of_addresses;
  }
  return 0;
}

H5FD_class_t describe_driver() {
  H5FD_class_t driver{};
  driver.name = "tabor";
  driver.maxaddr = kLargestAddress;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.open = &open_file;
  driver.close = &close_file;
  driver.query = &query;
  driver.get_eoa = &end_of_addresses;
  driver.set_eoa = &set_end_of_addresses;
  driver.get_eof = &end_of_file;
  driver.get_handle = &handle;
  driver.read = &read;
  driver.write = &write;
  driver.truncate = &truncate;
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return driver;
}

/// Properties without locks: files get their name only when they are complete, so nobody needs a
/// lock on them, and network file systems without locks would fail to open them.
Handle file_access(H5F_close_degree_t degree) {
  follow_store_links_only();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, degree);
  return access;
}

}  // namespace

hid_t open_for_reading(const std::string& file) {
  // Others of this process may have it open with the same library, as Debian's h5py does. All must
  // then ask for the same degree and locks (H5F_open of HDF5 1.10.7 and later).
  const Handle access = file_access(H5F_CLOSE_WEAK);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, access);
  if (opened >= 0) return opened;
  H5Pset_file_locking(access, true, true);
  return H5Fopen(file.c_str(), H5F_ACC_RDONLY, access);
}

Handle writing_access() {
  static const H5FD_class_t driver = describe_driver();
  static const hid_t registered = H5FDregister(&driver);
  Handle access = file_access(H5F_CLOSE_STRONG);
  H5Pset_driver(access, registered, nullptr);
  return access;
}

bool write_failed(hid_t file) {
  const Handle access(H5Fget_access_plist(file), &H5Pclose);
  void* failed = nullptr;
  return H5Fget_vfd_handle(file, access, &failed) < 0 || *static_cast<const bool*>(failed);
}

}  // namespace tabor::io::hdf5
