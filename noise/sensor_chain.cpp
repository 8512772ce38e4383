#include "noise/sensor_chain.hpp"

#include <numbers>

#include "core/random.hpp"

namespace touchdown::noise {

namespace {

/// Draws a geometric number of failures before the first success, by inverting a uniform draw.
std::size_t failures_before(double probability, double uniform) {
  if (probability >= 1.0) return 0;
  constexpr double many = 1e15;
  return static_cast<std::size_t>(std::min(many, std::log(uniform) / std::log1p(-probability)));
}

double constant_of(const Constant& constant, DrawnFor what, const ChannelDraws& draws) {
  return constant.value + (constant.sd > 0.0 ? constant.sd * draws.constant(what) : 0.0);
}

/// Adds the random walk, which starts at zero at the first step of a run.
void add_walk(std::span<double> values, double step_sd, std::span<const double> normal,
              ChannelState& state) {
  for (std::size_t k = state.step == 0 ? 1 : 0; k < values.size(); ++k) {
    state.walked += step_sd * normal[k];
    values[k] += state.walked;
  }
}

void add_vibration(std::span<double> values, double amplitude, const TurnsOfBoth& turns,
                   const ChannelDraws& draws) {
  for (std::size_t wheel = 0; wheel < turns.size(); ++wheel) {
    const double phase = 2.0 * std::numbers::pi * draws.uniform(DrawnFor::vibration, wheel);
    const double in_phase = amplitude * std::cos(phase);
    const double across = amplitude * std::sin(phase);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] += in_phase * turns[wheel].sine[k] + across * turns[wheel].cosine[k];
    }
  }
}

/// The acceleration of a mass on a spring and a damper, with a base that has these accelerations:
/// G(s) = (2ζωs + ω²)/(s² + 2ζωs + ω²) by the bilinear transform, which keeps its frequency.
void ring(std::span<double> values, const Mount& mount, double period, ChannelState& state) {
  const double turn = std::numbers::pi * mount.frequency * period;  // half a step
  if (2.0 * turn >= std::numbers::pi) return;  // too fast for these steps: rigid
  // In units of ω: s = (1 − z)/(t (1 + z)), z being the delay by a step.
  const double t = std::tan(turn);
  const double damped = 2.0 * mount.damping * t;
  const double scale = 1.0 / (1.0 + damped + t * t);
  const std::array<double, 3> base = {scale * (damped + t * t), scale * 2.0 * t * t,
                                      scale * (t * t - damped)};
  const std::array<double, 2> own = {scale * 2.0 * (t * t - 1.0), scale * (1.0 - damped + t * t)};
  auto& [first, second] = state.ringing;
  if (state.step == 0) {  // at rest in the first acceleration
    first = (1.0 - base[0]) * values.front();
    second = (base[2] - own[1]) * values.front();
  }
  for (double& value : values) {
    const double mass = base[0] * value + first;
    first = base[1] * value - own[0] * mass + second;
    second = base[2] * value - own[1] * mass;
    value = mass;
  }
}

void add_coloured(std::span<double> values, const ColouredNoise& noise, double period,
                  std::span<const double> normal, ChannelState& state) {
  const double kept = std::exp(-period / noise.time_constant);
  const double fresh = noise.sd * std::sqrt(1.0 - kept * kept);
  std::size_t k = 0;
  if (state.step == 0) {
    state.process = noise.sd * normal.front();
    values[k++] += state.process;
  }
  for (; k < values.size(); ++k) {
    state.process = kept * state.process + fresh * normal[k];
    values[k] += state.process;
  }
}

/// Turns draws from N(0, 1) into draws from Student's t distribution, scaled to variance 1. With a
/// second independent draw, z² + y² = −2 ln u for a uniform u, and z/√(z² + y²) is the cosine of a
/// uniform angle: Bailey's polar method (Bailey 1994, Theorem 2) in terms of normal draws.
void make_tails_heavy(std::span<double> normal, std::span<const double> other, double freedom) {
  for (std::size_t k = 0; k < normal.size(); ++k) {
    const double square = normal[k] * normal[k] + other[k] * other[k];
    normal[k] *= std::sqrt((freedom - 2.0) * std::expm1(square / freedom) / square);
  }
}

void low_pass(std::span<double> values, double gain, ChannelState& state) {
  if (state.step == 0) state.filtered = values.front();
  for (double& value : values) {
    state.filtered += gain * (value - state.filtered);
    value = state.filtered;
  }
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

double bias_of(const SensorChannel& channel, const ChannelDraws& draws) {
  return channel.bias == Constant() ? 0.0 : constant_of(channel.bias, DrawnFor::bias, draws);
}

WheelTurns wheel_turns(std::span<const double> position, std::span<const double> velocity,
                       double order) {
  WheelTurns turns{std::vector<double>(position.size()), std::vector<double>(position.size())};
  for (std::size_t k = 0; k < position.size(); ++k) {
    const double speed = std::abs(velocity[k]);
    turns.sine[k] = speed * std::sin(order * position[k]);
    turns.cosine[k] = speed * std::cos(order * position[k]);
  }
  return turns;
}

void disturb_values(std::span<double> values, const SensorChannel& channel, double period,
                    ChannelDraws& draws, ChannelState& state, const TurnsOfBoth* turns) {
  if (values.empty()) return;
  const auto series = [&](DrawnFor what) { return draws.series(what, state.step, values.size()); };
  if (channel.mount.frequency > 0.0) ring(values, channel.mount, period, state);
  if (!(channel.scale == Constant())) {
    const double gain = 1.0 + constant_of(channel.scale, DrawnFor::scale, draws);
    for (double& value : values) value *= gain;
  }
  if (!(channel.bias == Constant())) {
    const double bias = bias_of(channel, draws);
    for (double& value : values) value += bias;
  }
  if (channel.walk > 0.0) {
    add_walk(values, channel.walk * std::sqrt(period), series(DrawnFor::walk), state);
  }
  if (turns != nullptr) add_vibration(values, channel.vibration.amplitude, *turns, draws);
  if (channel.coloured.sd > 0.0) {
    add_coloured(values, channel.coloured, period, series(DrawnFor::coloured), state);
  }
  if (channel.low_pass > 0.0) low_pass(values, -std::expm1(-period / channel.low_pass), state);
  if (channel.white > 0.0) {
    const std::span<const double> normal = series(DrawnFor::white);
    std::vector<double> white(normal.begin(), normal.end());
    if (std::isfinite(channel.degrees_of_freedom)) {
      make_tails_heavy(white, series(DrawnFor::tail), channel.degrees_of_freedom);
    }
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += channel.white * white[k];
  }
  if (std::isfinite(channel.range)) {
    for (double& value : values) value = std::clamp(value, -channel.range, channel.range);
  }
  if (channel.resolution > 0.0) {
    const double step = channel.resolution;
    for (double& value : values) value = step * std::nearbyint(value / step);
  }
  state.step += values.size();
}

}  // namespace touchdown::noise
