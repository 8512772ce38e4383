#include "experiments/submissions/sha256.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <openssl/evp.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

struct Free {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

}  // namespace

std::string sha256(std::string_view bytes) {
  constexpr std::size_t digest_bytes = 32;
  const std::unique_ptr<EVP_MD_CTX, Free> context(EVP_MD_CTX_new());
  std::array<unsigned char, digest_bytes> digest{};
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1 ||
      EVP_DigestUpdate(context.get(), bytes.data(), bytes.size()) != 1 ||
      EVP_DigestFinal_ex(context.get(), digest.data(), nullptr) != 1) {
    throw Error("libcrypto could not compute a SHA-256");
  }
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace touchdown::experiments
