#include "noise/sensors/draws.hpp"

#include "core/random.hpp"

namespace touchdown::noise {

NoiseChannel ChannelDraws::stream(DrawnFor what) const {
  return static_cast<NoiseChannel>(static_cast<unsigned>(channel_) | static_cast<unsigned>(what)
                                                                         << 8U);
}

double ChannelDraws::constant(DrawnFor what) const {
  return standard_normal(key_, stream(what), 0);
}

std::span<const double> ChannelDraws::series(DrawnFor what, std::size_t first, std::size_t steps) {
  series_.resize(steps);
  fill_standard_normal(key_, stream(what), first, series_);
  return series_;
}

double ChannelDraws::uniform(DrawnFor what, std::uint64_t n) const {
  const std::uint64_t counter = (static_cast<std::uint64_t>(stream(what)) + 1U) << 48U;
  return uniform01(key_.seed, key_.run, counter | n);
}

}  // namespace touchdown::noise
