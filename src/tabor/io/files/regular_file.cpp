#include "tabor/io/files/regular_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tabor/core/error.hpp"

namespace tabor::io {

std::string reading_problem(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such file";
  if (error == EACCES) return "cannot be read: check its permissions";
  if (error == ELOOP) return "a link that leads to itself";
  return std::string("cannot be read: ") + std::strerror(error);
}

// Without O_NONBLOCK opening a pipe would wait for somebody to write into it; without O_NOCTTY a
// terminal could become the one that interrupts this program.
RegularFile::RegularFile(const std::filesystem::path& file)
    : name_(file.string()),
      descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  if (descriptor_ < 0 && errno != ENXIO) throw InputError(name_ + ": " + reading_problem(errno));
  const bool is_known = descriptor_ >= 0 && ::fstat(descriptor_, &status_) == 0;
  if (is_known && S_ISREG(status_.st_mode)) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw InputError(name_, "a folder, device or pipe", "a file", "");
}

RegularFile::~RegularFile() { ::close(descriptor_); }

std::size_t RegularFile::read(char* bytes, std::size_t size) const {
  for (;;) {
    const ssize_t n = ::read(descriptor_, bytes, size);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EINTR) throw InputError(name_ + ": " + reading_problem(errno));
  }
}

}  // namespace tabor::io
