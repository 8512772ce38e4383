#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "logs/recording.hpp"
#include "models/robot_model.hpp"

namespace touchdown::render {

/// The robot's configuration at every row of a recording, as MuJoCo's qpos.
///
/// A simulated run has the base's pose in its ground truth. For a robot's log, the orientation
/// comes from the IMU and the position from the wheels' odometry, and the lower tyre is put on the
/// floor.
class Poses {
 public:
  /// Keeps references to both. Errors: `InputError` for a recording without rows.
  Poses(const models::RobotModel& robot, const logs::Recording& recording);

  std::size_t count() const { return base_.size(); }
  /// The base's position in the world (m). NaN is replaced by the last number before it.
  const Eigen::Vector3d& base_position(std::size_t row) const { return base_[row]; }
  /// Writes the row's positions into `data` and computes the poses of all geoms.
  void apply(std::size_t row, mjData& data) const;

 private:
  void write(std::size_t row, mjData& data) const;

  const models::RobotModel& robot_;
  const logs::Recording& recording_;
  std::vector<Eigen::Vector3d> base_;
};

/// Computes all that MuJoCo's renderer needs from the positions in `data`.
void update_geoms(const mjModel& model, mjData& data);

/// Filters `values`, sampled every `period` seconds, with a first-order low-pass of `time_constant`
/// seconds, forward and then backward. The result is smooth and has no lag.
std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant);

/// Where the camera stands. A robot larger than Upkie is seen from farther away.
struct SceneCamera {
  double azimuth = 128.0;                        ///< degrees; 90 looks along the world's y axis
  double elevation = -13.0;                      ///< degrees; negative looks down
  double distance = 2.3;                         ///< of the point it looks at (m)
  Eigen::Vector3d look_at = {0.12, 0.0, -0.28};  ///< from the target, in the world (m)
};

/// The elevation of a camera that looks at `target` (degrees), or the next steeper one from which
/// it stands above the ground.
double elevation_above_ground(const models::RobotModel& robot, const mjData& data,
                              const SceneCamera& camera, const Eigen::Vector3d& target);

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

  /// Draws `data()` into `viewport`. The camera looks at the surroundings of `target` (m, world),
  /// and rises where it would be below the ground.
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
  void add(const SceneVector& vector, mjtGeom shape, double width, const float* colour);
  void place_sun(const Eigen::Vector3d& target);
  void switch_haze_on();

  const models::RobotModel& robot_;
  models::MjDataPtr data_;
  double scale_;  ///< of the camera's distance, for a robot larger than Upkie
  mjvScene scene_;
  mjvOption visibility_;
  mjvCamera camera_;
  mjrContext context_;
};

}  // namespace touchdown::render
