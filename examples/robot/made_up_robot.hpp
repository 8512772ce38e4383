#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <touchdown/estimator.hpp>
#include <vector>

inline constexpr double rate = 1000.0;  // Hz

inline int usage(const char* text) {
  std::fprintf(stderr, "usage: %s\n", text);
  return 2;
}

/// Replaces your servos and IMU: an Upkie that rolls, drops off a step every second, lands, and
/// rolls on. It also measures the time of each update.
class MadeUpRobot {
 public:
  bool is_on() const { return step_ < steps; }

  /// The next record, as the robot's software provides it.
  const touchdown::RobotRecord& read() {
    const double time = step_ / rate;
    const bool air = in_the_air();
    const double since_landing = time < 1.0 ? 1.0 : std::fmod(time, 1.0);
    const double up =
        (air ? -9.81 : 60.0 * std::exp(-since_landing / 0.01) * std::cos(600.0 * since_landing)) +
        0.2 * noise();
    for (std::size_t side = 0; side < 2; ++side) {
      // The right leg is the left one's mirror image, and so are the signs of its joints.
      const double sign = side == 0 ? 1.0 : -1.0;
      joints_[3 * side] = {sign * 0.455, 0.02 * noise(), sign * (air ? 0.1 : -2.0) + 0.1 * noise()};
      joints_[3 * side + 1] = {-sign * 0.791, 0.02 * noise(),
                               sign * (air ? 0.05 : 1.3) + 0.05 * noise()};
      joints_[3 * side + 2] = {
          sign * 10.0 * time, sign * 10.0 + 0.2 * noise(),
          sign * (air ? 0.0 : 0.2 + 0.1 * std::sin(7.0 * time)) + 0.02 * noise()};
    }
    record_.time = time;
    record_.joints = joints_;
    record_.orientation = {0.0, 0.0, 0.0, 1.0};  // upright, with Upkie's IMU
    record_.angular_velocity.setConstant(0.01 * noise());
    record_.linear_acceleration = {0.0, 0.0, -up};
    record_.proper_acceleration = {0.0, 0.0, -up - 9.81};
    requested_ = std::chrono::steady_clock::now();
    return record_;
  }

  /// Takes the belief about the last record, checks it and prints changes of contact.
  void take(const touchdown::Belief& belief, touchdown::RecordFaults faults) {
    const std::chrono::duration<double, std::micro> took =
        std::chrono::steady_clock::now() - requested_;
    durations_.push_back(took.count());
    faulty_ += faults.any() ? 1 : 0;
    right_ += belief.wheel[0].contact == !in_the_air() ? 1 : 0;
    if (belief.wheel[0].contact != contact_) {
      contact_ = belief.wheel[0].contact;
      std::printf("%.3f s: left wheel %s, P(contact) %.17g\n", step_ / rate,
                  contact_ ? "touches down" : "takes off", belief.wheel[0].p_contact);
    }
    ++step_;
  }

  /// Prints a summary. Returns the exit code: 0 if the accuracy is above 90 % and no record had
  /// faults.
  int report() {
    std::sort(durations_.begin(), durations_.end());
    const auto quantile = [&](double q) {
      return durations_[static_cast<std::size_t>(q * static_cast<double>(durations_.size() - 1))];
    };
    const double share = 100.0 * right_ / steps;
    std::printf("contact accuracy %.1f %%, %d records had faults\n", share, faulty_);
    std::printf("update: median %.2f us, p99.9 %.2f us, longest %.2f us\n", quantile(0.5),
                quantile(0.999), durations_.back());
    return share > 90.0 && faulty_ == 0 ? 0 : 1;
  }

 private:
  static constexpr int steps = 10'000;

  bool in_the_air() const { return std::fmod(step_ / rate, 1.0) > 0.8; }

  /// Between −1 and 1, the same on every computer.
  double noise() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(static_cast<std::int32_t>(state_ >> 32U)) * 0x1p-31;
  }

  std::array<touchdown::JointSignals, 6> joints_{};
  touchdown::RobotRecord record_;
  std::chrono::steady_clock::time_point requested_;
  std::vector<double> durations_;
  std::uint64_t state_ = 1;
  int step_ = 0;
  int right_ = 0;
  int faulty_ = 0;
  bool contact_ = true;
};
