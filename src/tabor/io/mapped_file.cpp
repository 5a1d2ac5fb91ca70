#include "tabor/io/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/io/lost_pages.hpp"

namespace tabor::io {
namespace {

std::string reason(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such file";
  if (error == EACCES) return "cannot be read: check its permissions";
  return std::string("cannot be read: ") + std::strerror(error);
}

/// An open file that closes itself.
class Descriptor {
 public:
  // Without O_NONBLOCK opening a pipe would wait for somebody to write into it.
  explicit Descriptor(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (number_ < 0) throw InputError(file.string() + ": " + reason(errno));
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

using Status = struct stat;

Status checked_status(const std::filesystem::path& file, const Descriptor& descriptor) {
  Status status{};
  if (::fstat(descriptor.number(), &status) != 0) {
    throw InputError(file.string() + ": " + reason(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(file.string(), "a folder, device or pipe", "a file", "");
  }
  if (status.st_size == 0) {
    throw InputError(file.string(), "an empty file", "a scan", "copy it again");
  }
  return status;
}

bool same(const std::timespec& a, const std::timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

}  // namespace

struct MappedFile::Opened {
  explicit Opened(const std::filesystem::path& path)
      : file(path), descriptor(path), status(checked_status(path, descriptor)) {}

  bool has_changed() const {
    Status now{};
    return ::fstat(descriptor.number(), &now) != 0 || now.st_size != status.st_size ||
           !same(now.st_mtim, status.st_mtim);
  }

  std::filesystem::path file;
  Descriptor descriptor;
  Status status;
  WatchedPages pages;
};

MappedFile::MappedFile(const std::filesystem::path& file)
    : opened_(std::make_unique<Opened>(file)) {
  const auto size = static_cast<std::size_t>(opened_->status.st_size);
  void* start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened_->descriptor.number(), 0);
  if (start == MAP_FAILED) throw InputError(file.string() + ": " + reason(errno));
  ::madvise(start, size, MADV_SEQUENTIAL);
  bytes_ = {static_cast<const char*>(start), size};
  opened_->pages.watch(bytes_);
}

MappedFile::~MappedFile() {
  opened_->pages.forget();
  ::munmap(const_cast<char*>(bytes_.data()), bytes_.size());
}

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

void MappedFile::check() const {
  if (opened_->pages.were_lost() || opened_->has_changed()) {
    throw InputError(opened_->file.string(), "a file that changed while it was read",
                     "one that stays as it is", "read it again when it is complete");
  }
}

}  // namespace tabor::io
