#pragma once

#include <cmath>
#include <string>

#include "logs/recording.hpp"
#include "models/profile.hpp"
#include "models/robot_model.hpp"
#include "render/film/video.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::render {

inline models::Terrain staged_terrain() {
  return {.pieces = {models::Flat{3.0}, models::StairFlight{}}};
}

/// A run down the stairs without a physics engine: constant speed, free fall after each edge. Its
/// pictures depend on the renderer alone.
inline logs::Recording staged_run(double seconds, const std::string& simulator = "mujoco") {
  constexpr double speed = 0.5, period = 1e-3, gravity = 9.81, radius = 0.05;
  constexpr double hip = 0.455, knee = 0.791;
  logs::Recording recording;
  recording.info.simulator = simulator;
  recording.info.scenario = "staged";
  const models::Terrain terrain = staged_terrain();
  const models::Profile profile(terrain);
  double z = profile.height(0.0);
  double fall_speed = 0.0;
  const auto rows = static_cast<std::size_t>(std::lround(seconds / period)) + 1;
  for (std::size_t k = 0; k < rows; ++k) {
    const double time = period * static_cast<double>(k);
    const double x = speed * time;
    fall_speed -= gravity * period;
    z += fall_speed * period;
    const double ground = profile.height(x);
    const bool contact = z <= ground;
    if (contact) {
      z = ground;
      fall_speed = 0.0;
    }
    models::Observation observation;
    observation.time = time;
    const std::array<double, models::servo_count> angles = {hip,  -knee, x / radius,
                                                            -hip, knee,  -x / radius};
    for (std::size_t i = 0; i < models::servo_count; ++i) observation.servo[i].position = angles[i];
    for (const models::Servo servo : {models::Servo::left_knee, models::Servo::right_knee}) {
      observation.servo[models::index(servo)].torque =
          (contact ? 1.3 : 0.1) * (servo == models::Servo::left_knee ? 1 : -1);
    }
    observation.servo[models::index(models::Servo::left_wheel)].torque = contact ? 0.1 : -0.05;
    models::GroundTruth truth;
    const double leg = 0.168 * std::cos(hip) + 0.175 * std::cos(hip - knee);
    const double forward = 0.168 * std::sin(hip) + 0.175 * std::sin(hip - knee);
    truth.base_position = {x - forward, 0.0, z + radius + 0.164 + leg};
    truth.wheel_normal_force = {contact ? 26.0 : 0.0, contact ? 26.0 : 0.0};
    recording.observation.push_back(observation);
    recording.action.emplace_back();
    recording.truth.push_back(truth);
  }
  return recording;
}

/// An estimator that follows the truth with a lag.
inline BeliefTrack staged_beliefs(const logs::Recording& recording, const std::string& name,
                                  std::size_t line_type = 1, float gain = 0.05f) {
  BeliefTrack track{.name = name,
                    .colour = line_colour(line_type),
                    .p_contact = {},
                    .p_takeoff = {},
                    .p_landing = {}};
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    float p = 1.0f;
    for (const models::GroundTruth& truth : recording.truth) {
      const float target = truth.wheel_normal_force[wheel] > 1.0 ? 1.0f : 0.0f;
      const float change = gain * (target - p);
      p += change;
      track.p_contact[wheel].push_back(p);
      track.p_takeoff[wheel].push_back(std::min(1.0f, std::max(0.0f, -20.0f * change)));
      track.p_landing[wheel].push_back(std::min(1.0f, std::max(0.0f, 20.0f * change)));
    }
  }
  return track;
}

}  // namespace touchdown::render
