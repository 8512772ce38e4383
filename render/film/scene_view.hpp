#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "models/robot_model.hpp"

namespace touchdown::render {

/// Where the camera stands.
struct SceneCamera {
  double azimuth = 128.0;                        ///< degrees; 90 looks along the world's y axis
  double elevation = -13.0;                      ///< degrees; negative looks down
  double distance = 2.3;                         ///< of the point it looks at (m)
  Eigen::Vector3d look_at = {0.12, 0.0, -0.28};  ///< from the target, in the world (m)
};

/// A vector that is drawn from one point to another, in the world (m).
struct SceneVector {
  Eigen::Vector3d from, to;
};

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
  void draw(const mjrRect& viewport, const Eigen::Vector3d& target, const SceneCamera& camera = {},
            std::span<const SceneVector> vectors = {});

  /// The point of the robot (m, world) that the last picture shows at `x`, `y`; nothing where it
  /// shows no robot. Both are shares of the viewport, from its lower left corner.
  std::optional<Eigen::Vector3d> robot_at(const mjrRect& viewport, double x, double y) const;
  /// The motion in the world (m) that moves `point` by `pixels` (right, up) in the last picture.
  Eigen::Vector3d motion_of(const mjrRect& viewport, const Eigen::Vector3d& point,
                            const Eigen::Vector2d& pixels) const;

  /// Copies a picture (RGB, 8 bits each, rows from below) to the place of `area`.
  void copy(const std::uint8_t* pixels, const mjrRect& area) const;

 private:
  void add(const SceneVector& vector);
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
