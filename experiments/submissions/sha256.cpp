#include "experiments/submissions/sha256.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <new>

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::experiments {

namespace {

struct Free {
  void operator()(AVSHA* sum) const { av_free(sum); }
};

}  // namespace

std::string sha256(std::string_view bytes) {
  constexpr int bits = 256;
  const std::unique_ptr<AVSHA, Free> sum(av_sha_alloc());
  if (!sum) throw std::bad_alloc();
  av_sha_init(sum.get(), bits);
  av_sha_update(sum.get(), reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::array<std::uint8_t, bits / 8> digest{};
  av_sha_final(sum.get(), digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace touchdown::experiments
