#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace tabor::io {

/// Digests as lower-case hexadecimal text.
std::string sha256(std::span<const std::byte> bytes);
std::string sha256(std::string_view text);
/// Throws InputError. `between` is called after every MiB; what it throws ends the reading.
std::string sha256_of_file(const std::filesystem::path& file,
                           const std::function<void()>& between = {});

/// Only because the X3P format asks for it.
std::string md5(std::span<const std::byte> bytes);

enum class DigestKind { sha256, md5 };

/// The same digests of bytes that come piece after piece.
class RunningDigest {
 public:
  explicit RunningDigest(DigestKind kind);
  ~RunningDigest();
  RunningDigest(const RunningDigest&) = delete;
  RunningDigest& operator=(const RunningDigest&) = delete;
  void add(std::string_view bytes);
  std::string hexadecimal();  ///< once, at the end

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tabor::io
