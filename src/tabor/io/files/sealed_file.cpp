#include "tabor/io/files/sealed_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/io/files/regular_file.hpp"

namespace tabor::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWord = "tabor-sha256 ";
constexpr std::size_t kDigits = 64;
constexpr std::size_t kSize = kWord.size() + kDigits + 1;
constexpr const char* kKey = "sha256";

std::string seal_of(const std::string& digest) { return std::string(kWord) + digest + '\n'; }

/// Reads `size` bytes if there are so many.
bool read_all(const RegularFile& file, char* bytes, std::size_t size) {
  while (size > 0) {
    const std::size_t n = file.read(bytes, size);
    if (n == 0) return false;
    bytes += n;
    size -= n;
  }
  return true;
}

/// Returns the digest of the first `size` bytes; nothing if there are fewer.
std::optional<std::string> digest_of_first(const RegularFile& file, std::uintmax_t size) {
  RunningDigest digest(DigestKind::sha256);
  std::vector<char> block(std::size_t{1} << 20);
  while (size > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(size, block.size()));
    if (!read_all(file, block.data(), wanted)) return std::nullopt;
    digest.add({block.data(), wanted});
    size -= wanted;
  }
  return digest.hexadecimal();
}

/// What is wrong with the end of the file; "" if it is the digest of what comes before.
std::string problem_of_seal(const RegularFile& file) {
  const auto size = static_cast<std::uintmax_t>(file.status().st_size);
  if (size < kSize) return "cut short";
  const auto digest = digest_of_first(file, size - kSize);
  std::string line(kSize, '\0');
  const bool is_whole = digest && read_all(file, line.data(), kSize) && line == seal_of(*digest);
  return is_whole ? "" : "its bytes are not those that were written";
}

std::string text_without_seal(Json object) {
  object.erase(kKey);
  return to_text(object);
}

}  // namespace

void seal(const fs::path& file) {
  const std::string line = seal_of(sha256_of_file(file));
  std::ofstream stream(file, std::ios::binary | std::ios::app);
  stream << line << std::flush;
  if (!stream) throw OutputError(file.string() + ": cannot write: " + std::strerror(errno));
}

std::string broken_seal(const fs::path& file) {
  try {
    const std::string problem = problem_of_seal(RegularFile(file));
    return problem.empty() ? "" : file.string() + ": " + problem;
  } catch (const InputError& error) {
    return error.what();
  }
}

Json sealed(Json object) {
  object[kKey] = sha256(to_text(object));
  return object;
}

bool is_sealed(const Json& object) {
  return object.contains(kKey) && object.at(kKey) == sha256(text_without_seal(object));
}

}  // namespace tabor::io
