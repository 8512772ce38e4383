#include "experiments/run_directory/shard.hpp"

#include <regex>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

Shard shard_from(const std::string& text) {
  static const std::regex shape(R"((\d{1,6})/(\d{1,6}))");
  constexpr int most = 100'000;
  if (std::smatch part; std::regex_match(text, part, shape)) {
    const Shard shard{std::stoi(part[1]), std::stoi(part[2])};
    if (shard.index >= 1 && shard.index <= shard.count && shard.count <= most) return shard;
  }
  throw InputError(
      fmt::format("'{}' is no shard: expected k/n with k from 1 to n, for example 1/3", text));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

}  // namespace touchdown::experiments
