#include "noise/sensors/clock.hpp"

namespace touchdown::noise {

namespace {

/// How often something of this probability fails before it happens, by inversion of a uniform draw.
std::size_t failures_before(double probability, double uniform) {
  if (probability >= 1.0) return 0;
  constexpr double many = 1e15;
  return static_cast<std::size_t>(std::min(many, std::log(uniform) / std::log1p(-probability)));
}

}  // namespace

std::vector<Drop> drops_of(const Dropout& dropout, double period, std::size_t steps,
                           const ChannelDraws& draws) {
  std::vector<Drop> drops;
  std::size_t k = 1;
  for (std::uint64_t n = 0;; n += 2) {
    const std::size_t begin =
        k + failures_before(dropout.rate, draws.uniform(DrawnFor::dropout, n));
    if (begin >= steps) return drops;
    const std::size_t length =
        1 + failures_before(period / dropout.length, draws.uniform(DrawnFor::dropout, n + 1));
    k = std::min(steps, begin + length);
    drops.push_back({begin, k});
  }
}

}  // namespace touchdown::noise
