#pragma once

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "models/robot_model.hpp"

namespace touchdown::render {

/// How the robot is looked at.
struct ViewOptions {
  Eigen::Vector3d look_at_offset = {0.12, 0.0, -0.28};  ///< from the base, in the world (m)
  double azimuth = 128.0;                               ///< (degrees)
  double elevation = -13.0;                             ///< (degrees)
  double distance = 2.3;                                ///< (m)
};

/// Draws one robot on its terrain with MuJoCo's renderer into the GL context that is current. That
/// context must outlive it. The shadows' sharp region and the camera follow the robot.
class SceneView {
 public:
  /// Keeps a reference to `robot`.
  explicit SceneView(const models::RobotModel& robot, const ViewOptions& options = {});
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  /// Where the robot is: fill with `Poses::apply`.
  mjData& data() { return *data_; }

  /// Draws `data()` into `viewport`, looked at around `target` (m, world).
  void draw(const mjrRect& viewport, const Eigen::Vector3d& target);

 private:
  void place_sun(const Eigen::Vector3d& target);
  void switch_haze_on();

  const models::RobotModel& robot_;
  ViewOptions options_;
  mjData* data_ = nullptr;
  mjvScene scene_;
  mjvOption visibility_;
  mjvCamera camera_;
  mjrContext context_;
};

}  // namespace touchdown::render
