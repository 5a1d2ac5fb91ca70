#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// Computes SHA-256 and MD5 digests of bytes and files.
namespace tabor::io {

/// Return digests as lower-case hexadecimal text.
std::string sha256(std::span<const std::byte> bytes);
std::string sha256(std::string_view text);
/// Returns the digest of a file. `between` is called after every MiB; what it throws ends the
/// reading. Throws InputError.
std::string sha256_of_file(const std::filesystem::path& file,
                           const std::function<void()>& between = {});

/// Returns the MD5 digest, which the X3P format requires.
std::string md5(std::span<const std::byte> bytes);

enum class DigestKind { sha256, md5 };

/// Computes digests of bytes that come piece after piece.
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
