#include "noise/sensors/clock.hpp"

namespace touchdown::noise {

namespace {

/// Draws a geometric number of failures before the first success, by inverting a uniform draw.
std::size_t failures_before(double probability, double uniform) {
  if (probability >= 1.0) return 0;
  constexpr double many = 1e15;
  return static_cast<std::size_t>(std::min(many, std::log(uniform) / std::log1p(-probability)));
}

}  // namespace

DropoutProcess::DropoutProcess(const Dropout& dropout, double period, const ChannelDraws& draws)
    : begins_(dropout.rate), ends_(period / dropout.length), draws_(draws) {
  advance();
}

void DropoutProcess::advance() {
  const std::size_t begin =
      current_.end + failures_before(begins_, draws_.uniform(DrawnFor::dropout, drawn_));
  const std::size_t length =
      1 + failures_before(ends_, draws_.uniform(DrawnFor::dropout, drawn_ + 1));
  current_ = {begin, begin + length};
  drawn_ += 2;
}

}  // namespace touchdown::noise
