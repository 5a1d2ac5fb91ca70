#pragma once

#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tabor::fuzz {

/// A file that lies in memory where the system has a folder for that, so that a million inputs do
/// not touch a disk. It has a real name, as HDF5 demands.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) {
    const std::filesystem::path memory = "/dev/shm";
    path_ = (exists(memory) ? memory : std::filesystem::temp_directory_path()) / "tabor-XXXXXX";
    const int descriptor = ::mkstemp(path_.data());
    const bool written = descriptor >= 0 && ::write(descriptor, bytes.data(), bytes.size()) ==
                                                static_cast<ssize_t>(bytes.size());
    ::close(descriptor);
    if (!written) throw std::runtime_error("cannot write " + path_);
  }
  ~MemoryFile() { ::unlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace tabor::fuzz
