#include "experiments/run_directory/shard.hpp"

#include <charconv>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

Shard shard_from(std::string_view text) {
  constexpr int most = 100'000;
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto [slash, first_error] = std::from_chars(text.data(), end, shard.index);
  if (first_error == std::errc{} && slash != end && *slash == '/') {
    const auto [rest, second_error] = std::from_chars(slash + 1, end, shard.count);
    if (second_error == std::errc{} && rest == end && shard.index >= 1 &&
        shard.index <= shard.count && shard.count <= most) {
      return shard;
    }
  }
  throw InputError(
      fmt::format("'{}' is no shard: expected k/n with k from 1 to n, for example 1/3", text));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

}  // namespace touchdown::experiments
