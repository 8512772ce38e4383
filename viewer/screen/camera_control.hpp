#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "render/film/scene_view.hpp"

namespace touchdown::viewer {

/// The camera, which follows the robot, and which a user turns and moves closer.
class CameraControl {
 public:
  /// The next of the modes: film, behind, side, above.
  void next_mode();
  std::string mode() const;

  /// Turns the camera by a motion of the mouse (pixels).
  void turn(double right, double down);
  /// Moves it closer by steps of the mouse wheel.
  void approach(double steps);

  /// Follows the robot's base (m, world) smoothly. `seconds` since the last call; 0 jumps there.
  void follow(const Eigen::Vector3d& base, double seconds);

  const render::SceneCamera& camera() const { return camera_; }
  const Eigen::Vector3d& target() const { return target_; }

 private:
  std::size_t mode_ = 0;
  render::SceneCamera camera_;
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  bool follows_ = false;
};

}  // namespace touchdown::viewer
