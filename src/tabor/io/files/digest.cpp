// The only file that knows OpenSSL.
#include "tabor/io/files/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/io/files/regular_file.hpp"

namespace tabor::io {
namespace {

/// One running digest.
class Digest {
 public:
  explicit Digest(const EVP_MD* kind) : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), kind, nullptr) == 1);
  }

  void add(const void* data, std::size_t size) {
    check(EVP_DigestUpdate(context_.get(), data, size) == 1);
  }

  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      constexpr char digits[] = "0123456789abcdef";
      text += digits[bytes[i] >> 4];
      text += digits[bytes[i] & 15];
    }
    return text;
  }

 private:
  static void check(bool done) {
    if (!done) throw Error("the cryptographic library offers no such digest");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

std::string digest_of(const EVP_MD* kind, std::span<const std::byte> bytes) {
  Digest digest(kind);
  digest.add(bytes.data(), bytes.size());
  return digest.hexadecimal();
}

}  // namespace

std::string sha256(std::span<const std::byte> bytes) { return digest_of(EVP_sha256(), bytes); }

std::string sha256(std::string_view text) {
  return sha256(std::as_bytes(std::span(text.data(), text.size())));
}

std::string md5(std::span<const std::byte> bytes) { return digest_of(EVP_md5(), bytes); }

struct RunningDigest::State {
  Digest digest;
};

RunningDigest::RunningDigest(DigestKind kind)
    : state_(new State{Digest(kind == DigestKind::md5 ? EVP_md5() : EVP_sha256())}) {}
RunningDigest::~RunningDigest() = default;
void RunningDigest::add(std::string_view bytes) { state_->digest.add(bytes.data(), bytes.size()); }
std::string RunningDigest::hexadecimal() { return state_->digest.hexadecimal(); }

std::string sha256_of_file(const std::filesystem::path& file,
                           const std::function<void()>& between) {
  const RegularFile opened(file);
  Digest digest(EVP_sha256());
  std::vector<char> block(1 << 20);
  while (const std::size_t n = opened.read(block.data(), block.size())) {
    digest.add(block.data(), n);
    if (between) between();
  }
  return digest.hexadecimal();
}

}  // namespace tabor::io
