#include "tabor/io/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <string>

#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

/// An open file that closes itself.
class Descriptor {
 public:
  // Without O_NONBLOCK opening a pipe would wait for somebody to write into it.
  explicit Descriptor(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

std::string reason(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such file";
  if (error == EACCES) return "cannot be read: check its permissions";
  return std::string("cannot be read: ") + std::strerror(error);
}

std::size_t checked_size(const std::filesystem::path& file, const Descriptor& descriptor) {
  struct stat status {};
  if (descriptor.number() < 0 || ::fstat(descriptor.number(), &status) != 0) {
    throw InputError(file.string() + ": " + reason(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(file.string(), "a folder, device or pipe", "a file", "");
  }
  if (status.st_size == 0) {
    throw InputError(file.string(), "an empty file", "a scan", "copy it again");
  }
  return static_cast<std::size_t>(status.st_size);
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const Descriptor descriptor(file);
  const std::size_t size = checked_size(file, descriptor);
  void* start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.number(), 0);
  if (start == MAP_FAILED) throw InputError(file.string() + ": " + reason(errno));
  ::madvise(start, size, MADV_SEQUENTIAL);
  bytes_ = {static_cast<const char*>(start), size};
}

MappedFile::~MappedFile() { ::munmap(const_cast<char*>(bytes_.data()), bytes_.size()); }

void MappedFile::release(std::string_view part) const {
  const std::less<> before;
  if (before(part.data(), bytes_.data()) ||
      before(bytes_.data() + bytes_.size(), part.data() + part.size())) {
    return;
  }
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = static_cast<std::size_t>(part.data() - bytes_.data());
  const std::size_t first = (begin + page - 1) / page * page;
  const std::size_t end = (begin + part.size()) / page * page;
  if (first < end) ::madvise(const_cast<char*>(bytes_.data()) + first, end - first, MADV_DONTNEED);
}

}  // namespace tabor::io
