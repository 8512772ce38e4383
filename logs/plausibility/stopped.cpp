#include <cmath>
#include <string>

#include <fmt/format.h>

#include "logs/plausibility/channels.hpp"
#include "logs/signals_from.hpp"

namespace touchdown::logs {

void StoppedChannels::Channel::add(bool stops, double since, double at) {
  if (stops && !is_stopped && stretches++ == 0) {
    first = since;
    value = at;
  }
  is_stopped = stops;
}

void StoppedChannels::add(const models::Observation& record) {
  Signals signals = signals_from(record, nullptr);
  const std::uint32_t stopped = stopped_.update(signals);
  // Removing gravity moves an acceleration that stopped.
  signals.linear_acceleration = record.imu.raw_linear_acceleration;
  const std::uint32_t measured = proper_.update(signals);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const StoppedSignals& which = (stopped >> i & 1U) != 0 ? stopped_ : proper_;
    channels_[i].add(((stopped | measured) >> i & 1U) != 0, which.since(i), which.value(i));
  }
  const Eigen::Quaterniond& q = record.imu.orientation;
  const double step = record.time - time_;
  time_ = record.time;
  constexpr double longest_step = 0.05;  // s
  // Written so that NaN starts anew.
  if (!(q.coeffs() == last_.coeffs() && step >= 0.0 && step < longest_step)) {
    turned_.setZero();
    squares_.setZero();
    rate_ = record.imu.angular_velocity;
    since_ = time_;
    last_ = q;
  } else {
    constexpr double memory = 0.05;  // s, of a low-pass against noise
    const Eigen::Vector3d& rate = record.imu.angular_velocity;
    rate_ += std::min(1.0, step / memory) * (rate - rate_);
    turned_ += step * rate;
    squares_ += step * rate_.cwiseAbs2();
  }
  constexpr double after = 0.25;       // s
  constexpr double least_turn = 0.25;  // rad/s: a biased gyroscope turns less
  constexpr double least_sway = 0.06;  // rad/s, about the mean, which has the bias
  const double held = time_ - since_;
  const Eigen::Vector3d mean = turned_ / held;
  const bool turns = mean.norm() > least_turn ||
                     (squares_ / held - mean.cwiseAbs2()).sum() > least_sway * least_sway;
  orientation_.add(held >= after && turns, since_, q.w());
}

void StoppedChannels::report(Findings& findings) const {
  const auto add = [&](std::string_view subject, const Channel& channel, const std::string& value) {
    if (channel.stretches == 0) return;
    findings.add(subject, fmt::format("repeats {} from {} s on{} although the robot moves: did "
                                      "the sensor, or its bus, drop out",
                                      value, readable(channel.first, 6),
                                      channel.stretches == 1 ? ""
                                                             : fmt::format(" (first of {} times)",
                                                                           channel.stretches)));
  };
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    // 0 is added to show −0 as 0.
    add(to_text(static_cast<SignalIndex>(i)), channel, fmt::format("{:.6g}", channel.value + 0.0));
  }
  add("orientation", orientation_, "itself");
}

}  // namespace touchdown::logs
