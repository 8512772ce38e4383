#pragma once

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "models/robot_model.hpp"

namespace touchdown::render {

/// Draws one robot on its terrain with MuJoCo's renderer into the current GL context, which must
/// outlive it. The sharp region of the shadows and the camera follow the robot.
class SceneView {
 public:
  /// Keeps a reference to `robot`.
  explicit SceneView(const models::RobotModel& robot);
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  /// The robot's state; fill it with `Poses::apply`.
  mjData& data() { return *data_; }

  /// Draws `data()` into `viewport`. The camera looks at the surroundings of `target` (m, world).
  void draw(const mjrRect& viewport, const Eigen::Vector3d& target);

 private:
  void place_sun(const Eigen::Vector3d& target);
  void switch_haze_on();

  const models::RobotModel& robot_;
  models::MjDataPtr data_;
  mjvScene scene_;
  mjvOption visibility_;
  mjvCamera camera_;
  mjrContext context_;
};

}  // namespace touchdown::render
