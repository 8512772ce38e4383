#pragma once

#include <cmath>
#include <string>

#include "models/robot_model.hpp"
#include "models/terrain.hpp"
#include "recordings/recording.hpp"
#include "render/video.hpp"

namespace touchdown {

inline const std::string upkie_mjcf = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";

inline Terrain staged_terrain() { return {.pieces = {Flat{3.0}, StairFlight{}}}; }

/// A run down the stairs that no physics engine made: constant speed, free fall after each edge.
/// Pictures of it depend on nothing but the renderer.
inline Recording staged_run(double seconds, const std::string& simulator = "mujoco") {
  constexpr double speed = 0.5, period = 1e-3, gravity = 9.81, radius = 0.05;
  constexpr double hip = 0.455, knee = 0.791;
  Recording recording;
  recording.info.simulator = simulator;
  recording.info.scenario = "staged";
  const Terrain terrain = staged_terrain();
  double z = height_at(terrain, 0.0);
  double fall_speed = 0.0;
  const auto rows = static_cast<std::size_t>(std::lround(seconds / period)) + 1;
  for (std::size_t k = 0; k < rows; ++k) {
    const double time = period * static_cast<double>(k);
    const double x = speed * time;
    fall_speed -= gravity * period;
    z += fall_speed * period;
    const double ground = height_at(terrain, x);
    const bool contact = z <= ground;
    if (contact) {
      z = ground;
      fall_speed = 0.0;
    }
    Observation observation;
    observation.time = time;
    const std::array<double, servo_count> angles = {hip,  -knee, x / radius,
                                                    -hip, knee,  -x / radius};
    for (std::size_t i = 0; i < servo_count; ++i) observation.servo[i].position = angles[i];
    for (const Servo servo : {Servo::left_knee, Servo::right_knee}) {
      observation.servo[index(servo)].torque =
          (contact ? 1.3 : 0.1) * (servo == Servo::left_knee ? 1 : -1);
    }
    observation.servo[index(Servo::left_wheel)].torque = contact ? 0.1 : -0.05;
    GroundTruth truth;
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
inline BeliefTrack staged_beliefs(const Recording& recording, const std::string& name,
                                  float gain = 0.05f) {
  BeliefTrack track{.name = name, .p_contact = {}, .p_takeoff = {}, .p_landing = {}};
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    float p = 1.0f;
    for (const GroundTruth& truth : recording.truth) {
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

}  // namespace touchdown
