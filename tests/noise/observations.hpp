#pragma once

#include <bit>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::noise {

using Steps = std::vector<models::Observation>;

/// All numbers of an observation by name.
inline std::vector<std::pair<std::string, double>> numbers(const models::Observation& o) {
  std::vector<std::pair<std::string, double>> all = {{"time", o.time},
                                                     {"pitch", o.pitch},
                                                     {"pitch rate", o.pitch_rate},
                                                     {"yaw", o.yaw},
                                                     {"yaw rate", o.yaw_rate}};
  for (std::size_t j = 0; j < models::servo_count; ++j) {
    const std::string name(models::servo_names[j]);
    all.emplace_back(name + " position", o.servo[j].position);
    all.emplace_back(name + " velocity", o.servo[j].velocity);
    all.emplace_back(name + " torque", o.servo[j].torque);
  }
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    all.emplace_back("raw " + axis, o.imu.raw_linear_acceleration[i]);
    all.emplace_back("linear " + axis, o.imu.linear_acceleration[i]);
    all.emplace_back("gyro " + axis, o.imu.angular_velocity[i]);
  }
  for (int i = 0; i < 4; ++i) all.emplace_back("attitude", o.imu.orientation.coeffs()[i]);
  return all;
}

/// Names of the numbers that differ between two runs, compared to the bit.
inline std::set<std::string> different(const Steps& a, const Steps& b) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto left = numbers(a[k]), right = numbers(b[k]);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (std::bit_cast<std::uint64_t>(left[i].second) !=
          std::bit_cast<std::uint64_t>(right[i].second)) {
        names.insert(left[i].first);
      }
    }
  }
  return names;
}

}  // namespace touchdown::noise
