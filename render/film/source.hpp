#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "models/robot_model.hpp"
#include "recordings/recording.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

/// What one estimator believed along a recording: one number per row and wheel (left, right). A
/// vector that is empty is not drawn.
struct BeliefTrack {
  std::string name;
  std::array<std::vector<float>, models::wheel_count> p_contact;
  std::array<std::vector<float>, models::wheel_count> p_takeoff;
  std::array<std::vector<float>, models::wheel_count> p_landing;
};

/// One run as it is shown: the robot that was compiled for the run's terrain, and what it did.
struct VideoSource {
  const models::RobotModel& robot;
  const recordings::Recording& recording;
  const std::vector<BeliefTrack>& beliefs;
};

/// How many wheels truly touched the ground, row by row; empty for a robot's log.
std::vector<std::uint8_t> wheels_in_contact(const recordings::Recording& recording,
                                            const scoring::LabelConfig& labels);

/// "MuJoCo", "Bullet", or what a recording calls itself.
std::string engine_label(const recordings::Recording& recording);

}  // namespace touchdown::render
