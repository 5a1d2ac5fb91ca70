#include "tabor/io/files/mapped_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/io/files/lost_pages.hpp"
#include "tabor/io/files/regular_file.hpp"

namespace tabor::io {
namespace {

bool same(const std::timespec& a, const std::timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

}  // namespace

struct MappedFile::Opened {
  explicit Opened(const std::filesystem::path& path) : name(path), file(path) {
    if (file.status().st_size == 0) {
      throw InputError(name.string(), "an empty file", "a scan", "copy it again");
    }
  }

  bool has_changed() const {
    struct stat now {};
    return ::fstat(file.descriptor(), &now) != 0 || now.st_size != file.status().st_size ||
           !same(now.st_mtim, file.status().st_mtim);
  }

  [[noreturn]] void reject_changed() const {
    throw InputError(name.string(), "a file that changed while it was read",
                     "one that stays as it is", "read it again when it is complete");
  }

  std::filesystem::path name;
  RegularFile file;
  WatchedPages pages;
};

MappedFile::MappedFile(const std::filesystem::path& file)
    : opened_(std::make_unique<Opened>(file)) {
  const auto size = static_cast<std::size_t>(opened_->file.status().st_size);
  void* start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened_->file.descriptor(), 0);
  if (start == MAP_FAILED) throw InputError(file.string() + ": " + reading_problem(errno));
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
  if (opened_->pages.were_lost() || opened_->has_changed()) opened_->reject_changed();
}

void MappedFile::check_name() const {
  struct stat named {};
  const struct stat& opened = opened_->file.status();
  if (::stat(opened_->name.c_str(), &named) != 0 || named.st_dev != opened.st_dev ||
      named.st_ino != opened.st_ino) {
    opened_->reject_changed();
  }
  check();
}

}  // namespace tabor::io
