#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "recordings/recording.hpp"

namespace touchdown::test {

/// A run as a spine might log it, made by formulas instead of a simulator: a flight of 0.2 s in
/// every second, the right wheel a little later; no two accelerations are equal.
inline recordings::Recording synthetic_log(double seconds, std::int64_t period_us = 1000,
                                           bool with_truth = true) {
  recordings::Recording log;
  log.info = {"synthetic", "mujoco", 5, 0, period_us, recordings::Outcome::finished, ""};
  const auto steps = static_cast<std::size_t>(1e6 * seconds / static_cast<double>(period_us));
  for (std::size_t k = 0; k < steps; ++k) {
    const double time = static_cast<double>(k) * log.period();
    const double phase = std::fmod(time, 1.0);
    const double jitter = std::sin(1.7 * static_cast<double>(k * k % 10007));
    const double shock = phase >= 0.8 ? std::exp(-(phase - 0.8) / 0.02) : 0.0;
    const bool falls = phase >= 0.6 && phase < 0.8;
    models::Observation o;
    o.time = time;
    // Upright: turned half about the IMU's y axis.
    o.imu.orientation = Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0);
    o.imu.linear_acceleration = {
        0.1 * jitter, 0.0, 0.2 * jitter + (falls ? -9.81 : 60.0 * shock * std::cos(900.0 * phase))};
    models::GroundTruth truth;
    for (std::size_t side = 0; side < models::wheel_count; ++side) {
      const bool air = phase >= (side == 0 ? 0.6 : 0.606) && phase < 0.8;
      const double sign = side == 0 ? 1.0 : -1.0;
      o.servo[3 * side].position = sign * 0.455;
      o.servo[3 * side + 1].position = sign * -0.791;
      o.servo[3 * side + 1].torque = sign * (air ? 0.05 : 1.3 + 4.0 * shock) + 0.05 * jitter;
      o.servo[3 * side + 2].torque = sign * (air ? 0.01 : 0.3 - 0.5 * shock) + 0.02 * jitter;
      o.servo[3 * side + 2].velocity = sign * 10.0 + jitter;
      truth.wheel_normal_force[side] = air ? 0.0 : 26.0;
    }
    log.observation.push_back(o);
    log.action.emplace_back();
    if (with_truth) log.truth.push_back(truth);
  }
  return log;
}

/// What a person who sees everything says about `synthetic_log`, from one time to another (s): a
/// stretch for each state of both wheels, its ends between two steps.
inline std::string synthetic_labels(double from, double to) {
  const recordings::Recording log = synthetic_log(to);
  std::string csv = "start,end,left,right\n";
  const auto touches = [&](std::size_t k) {
    const auto& force = log.truth[k].wheel_normal_force;
    return std::array<int, 2>{force[0] > 0.0 ? 1 : 0, force[1] > 0.0 ? 1 : 0};
  };
  auto begin = static_cast<std::size_t>(std::llround(from / log.period()));
  for (std::size_t k = begin + 1; k <= log.steps(); ++k) {
    if (k < log.steps() && touches(k) == touches(begin)) continue;
    const auto time = [&](std::size_t step) {
      return (static_cast<double>(step) - 0.5) * log.period();
    };
    csv += fmt::format("{},{},{},{}\n", time(begin), time(k), touches(begin)[0], touches(begin)[1]);
    begin = k;
  }
  return csv;
}

/// The same as a robot logs it: nobody says where it comes from, and nobody knows the truth.
inline recordings::Recording robot_log(double seconds, std::int64_t period_us = 1000) {
  recordings::Recording log = synthetic_log(seconds, period_us, false);
  log.info.scenario.clear();
  log.info.simulator.clear();
  log.info.outcome.reset();
  return log;
}

/// Nothing but rolling, or nothing but hanging.
inline recordings::Recording one_class_log(double seconds, bool contact) {
  recordings::Recording log = robot_log(seconds);
  for (std::size_t k = 0; k < log.steps(); ++k) {
    const double jitter = std::sin(0.1 * static_cast<double>(k));
    for (std::size_t side = 0; side < models::wheel_count; ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      log.observation[k].servo[3 * side + 1].torque = sign * (contact ? 1.2 : -0.1) + 0.1 * jitter;
      log.observation[k].servo[3 * side + 2].torque = sign * (contact ? 0.2 : 0.02) * jitter;
    }
  }
  return log;
}

}  // namespace touchdown::test
